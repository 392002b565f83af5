#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "components/mpm/gas/paper/tasks/compute_internal_force.hpp"
#include "components/mpm/gas/paper/tasks/compute_pressure.hpp"
#include "components/mpm/gas/paper/tasks/filter_density.hpp"
#include "components/mpm/gas/paper/tasks/integrate_acceleration.hpp"
#include "components/mpm/gas/paper/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/gas/paper/tasks/redistribute.hpp"
#include "components/mpm/gas/paper/tasks/update_particles.hpp"
#include "tests/support/levels.hpp"
#include "tests/support/particles.hpp"

// The bodies of the gas method's tasks on plain fields: no scheduler, no warehouse, no scene.

namespace tushar::mpm::gas::paper {

namespace {

/// Particles at random positions in every cell of a grid, with random values.
template <int D>
struct Cloud : test::Particles {
  std::vector<Vec<D>> x, v;
  std::vector<double> mass, density, energy, pressure;
  Gas gas;

  explicit Cloud(const Index3& resolution, int perCell = 3) : Particles(test::domain(resolution)) {
    std::mt19937 generator(42);
    std::uniform_real_distribution<double> uniform(0.01, 0.99);
    gas.name = "gas";
    set.reset(patch(), 1);
    forEach<3>(level.cells(), [&](const Index3& cell) {
      const int first = static_cast<int>(x.size());
      for (int k = 0; k < perCell; ++k) {
        Vec<D> at, speed;
        for (int d = 0; d < D; ++d) {
          at[d] = level.nodePosition(d, cell[d]) + uniform(generator) * level.spacing(d);
          speed[d] = uniform(generator) - 0.5;
        }
        x.push_back(at);
        v.push_back(speed);
        density.push_back(0.5 + uniform(generator));
        energy.push_back(1 + uniform(generator));
        mass.push_back(density.back() * level.cellVolume() / perCell * (0.8 + 0.4 * uniform(generator)));
        pressure.push_back(gas.pressure(density.back(), energy.back()));
      }
      set.at(cell) = {first, static_cast<int>(x.size())};
    });
    set.setOwned(static_cast<int>(x.size()));
  }
  template <class T>
  NodeView<T> nodes(std::vector<T>& values) const {
    values.resize(level.nodes().size());
    return {values.data(), level.nodes()};
  }
  template <class T>
  NodeView<const T> readNodes(const std::vector<T>& values) const {
    return {values.data(), level.nodes()};
  }
  double total(const std::vector<double>& e, const std::vector<Vec<D>>& velocity) const {
    double sum = 0;
    for (std::size_t p = 0; p < x.size(); ++p) sum += mass[p] * (e[p] + 0.5 * velocity[p].squaredNorm());
    return sum;
  }
};

/// The particles after a step.
template <int D>
struct Next {
  std::vector<Vec<D>> x, v;
  std::vector<double> density, energy, divergence;

  ParticleUpdate<D> from(const Cloud<D>& cloud, const std::vector<Vec<D>>& acceleration,
                         const std::vector<Vec<D>>& star) {
    return {.x = cloud.read(cloud.x),
            .velocity = cloud.read(cloud.v),
            .mass = cloud.read(cloud.mass),
            .density = cloud.read(cloud.density),
            .internalEnergy = cloud.read(cloud.energy),
            .pressure = cloud.read(cloud.pressure),
            .acceleration = cloud.readNodes(acceleration),
            .velocityStar = cloud.readNodes(star),
            .newX = cloud.write(x),
            .newVelocity = cloud.write(v),
            .newDensity = cloud.write(density),
            .newInternalEnergy = cloud.write(energy),
            .divergence = cloud.write(divergence)};
  }
};

/// Returns the relative change of total energy over one step of the conserving update.
template <int D>
double energyDrift(const Index3& resolution) {
  const Cloud<D> cloud(resolution);
  Next<D> next;
  std::vector<double> mass;
  std::vector<Vec<D>> velocity, force, acceleration, star;
  const double dt = 0.002;
  interpolateParticlesToGrid<D>(cloud.patch(), cloud.gas, cloud.read(cloud.x), cloud.read(cloud.mass),
                                cloud.read(cloud.v), cloud.nodes(mass), cloud.nodes(velocity));
  computeInternalForceOfVolumes<D>(cloud.patch(), cloud.gas, cloud.read(cloud.pressure), cloud.read(cloud.mass),
                                   cloud.read(cloud.density), cloud.nodes(force));
  computeAndIntegrateAcceleration<D>(cloud.patch(), cloud.gas, cloud.readNodes(mass), cloud.readNodes(force),
                                     cloud.readNodes(velocity), dt, cloud.nodes(acceleration), cloud.nodes(star));
  setGridBoundaryConditions<D>(cloud.patch(), cloud.gas, cloud.nodes(acceleration), cloud.nodes(star));
  updateParticlesConserving<D>(cloud.patch(), cloud.gas, next.from(cloud, acceleration, star), dt);
  return cloud.total(next.energy, next.v) / cloud.total(cloud.energy, cloud.v) - 1;
}

template <int D>
void expectLinearReproduction(const Index3& resolution) {
  const Cloud<D> cloud(resolution);
  forEach<D>(cloud.level.cells(), [&](const Index<D>& cell) {
    const ShapeFunctions<D> shape(CellPlaces<D>(cloud.level), cell);
    for (const int p : cloud.set.in(cell)) {
      const Vec<D>& at = cloud.x[p];
      const auto s = shape.at(at);
      double sum = 0;
      Vec<D> mean = Vec<D>::Zero(), gradients = Vec<D>::Zero();
      for (int k = 0; k < Linear<D>::nodes; ++k) {
        sum += s[k];
        for (int d = 0; d < D; ++d) {
          mean[d] += s[k] * cloud.level.nodePosition(d, Linear<D>::node(cell, k)[d]);
          gradients[d] += Linear<D>::centreGradient(cloud.level, k, d);
        }
      }
      EXPECT_NEAR(sum, 1, 1e-15);
      EXPECT_LT((mean - at).norm(), 1e-14);
      EXPECT_LT(gradients.norm(), 1e-13);
    }
  });
}

/// The pieces of one cell of unit length, with random values.
std::vector<Piece<1>> somePieces(int count, double volume = 0.25) {
  std::vector<Piece<1>> pieces;
  for (int k = 0; k < count; ++k) {
    Piece<1> piece;
    piece.id = static_cast<ParticleId>(k);
    piece.x[0] = (k + 0.3) / count;
    piece.velocity[0] = 0.3 * std::sin(3.0 * k + 1);
    piece.volume = volume * (1 + 0.1 * k);
    piece.mass = piece.volume * (1 + 0.2 * k);
    piece.internalEnergy = 1 + 0.05 * k;
    pieces.push_back(piece);
  }
  return pieces;
}

struct Sums {
  double mass = 0, momentum = 0, energy = 0, volume = 0, least = 1e300;
};
Sums sumsOf(const std::vector<Piece<1>>& pieces) {
  Sums sums;
  for (const Piece<1>& p : pieces) {
    sums.mass += p.mass;
    sums.momentum += p.mass * p.velocity[0];
    sums.energy += p.mass * (p.internalEnergy + 0.5 * p.velocity[0] * p.velocity[0]);
    sums.volume += p.volume;
    sums.least = std::min(sums.least, p.internalEnergy);
    EXPECT_TRUE(p.x[0] >= 0 && p.x[0] < 1);
  }
  return sums;
}
void expectConserved(const std::vector<Piece<1>>& before, const std::vector<Piece<1>>& after) {
  const Sums a = sumsOf(before), b = sumsOf(after);
  EXPECT_NEAR(b.mass, a.mass, 1e-13 * a.mass);
  EXPECT_NEAR(b.volume, a.volume, 1e-13 * a.volume);
  EXPECT_NEAR(b.momentum, a.momentum, 1e-13 * a.mass);
  EXPECT_NEAR(b.energy, a.energy, 1e-13 * a.energy);
  EXPECT_GT(b.least, 0);
}
CellShape<1> unitCell() {
  CellShape<1> cell;
  cell.lower[0] = 0;
  cell.spacing[0] = 1;
  cell.volume = 1;
  return cell;
}

}  // namespace

TEST(Linear, SumsToOneAndReproducesPositionsInEveryDimension) {
  expectLinearReproduction<1>({{9, 1, 1}});
  expectLinearReproduction<2>({{5, 4, 1}});
  expectLinearReproduction<3>({{3, 4, 2}});
}

TEST(InterpolateParticlesToGrid, KeepsMassAndMomentum) {
  const Cloud<2> cloud(Index3{{5, 4, 1}});
  std::vector<double> mass;
  std::vector<Vec<2>> velocity;

  interpolateParticlesToGrid<2>(cloud.patch(), cloud.gas, cloud.read(cloud.x), cloud.read(cloud.mass),
                                cloud.read(cloud.v), cloud.nodes(mass), cloud.nodes(velocity));

  double onNodes = 0, onParticles = 0;
  Vec<2> momentum = Vec<2>::Zero();
  for (std::size_t i = 0; i < mass.size(); ++i) {
    onNodes += mass[i];
    momentum += mass[i] * velocity[i];
  }
  for (std::size_t p = 0; p < cloud.x.size(); ++p) {
    onParticles += cloud.mass[p];
    momentum -= cloud.mass[p] * cloud.v[p];
  }
  EXPECT_NEAR(onNodes, onParticles, 1e-14);
  EXPECT_LT(momentum.norm(), 1e-15);
}

TEST(ComputeInternalForce, IsTheDifferenceOfTheCellsMeanPressuresInOneDimension) {
  const Cloud<1> cloud({{3, 1, 1}}, 2);
  const std::vector<double> pressure{1, 3, 10, 20, 4, 6};  // means 2, 15, 5
  const double area = cloud.level.cellVolume() / cloud.level.spacing(0);
  std::vector<Vec<1>> force;

  computeInternalForce<1>(cloud.patch(), cloud.gas, cloud.read(pressure), cloud.nodes(force));

  EXPECT_NEAR(force[1][0], (2 - 15) * area, 1e-14);
  EXPECT_NEAR(force[2][0], (15 - 5) * area, 1e-14);
}

TEST(ComputeInternalForce, VanishesInsideAUniformPressureInThreeDimensions) {
  const Cloud<3> cloud(Index3{{4, 3, 3}});
  const std::vector<double> pressure(cloud.x.size(), 7.0);
  std::vector<Vec<3>> force;
  const NodeView<Vec<3>> view = cloud.nodes(force);

  computeInternalForce<3>(cloud.patch(), cloud.gas, cloud.read(pressure), view);

  forEach<3>(Box{{{1, 1, 1}}, {{4, 3, 3}}}, [&](const Index3& node) { EXPECT_LT(view[node].norm(), 1e-15); });
}

TEST(UpdateParticles, FollowsEquations12To15) {
  const Cloud<1> cloud({{2, 1, 1}}, 1);
  std::vector<Vec<1>> a{Vec<1>(1.0), Vec<1>(2.0), Vec<1>(4.0)}, star{Vec<1>(0.5), Vec<1>(0.7), Vec<1>(0.2)};
  Next<1> next;
  const double dt = 0.01, h = 0.5, s = cloud.x[0][0] / h;

  updateParticles<1>(cloud.patch(), cloud.gas, next.from(cloud, a, star), dt);

  const double d = (0.7 - 0.5) / h;
  EXPECT_NEAR(next.v[0][0], cloud.v[0][0] + dt * ((1 - s) * 1 + s * 2), 1e-15);
  EXPECT_NEAR(next.x[0][0], cloud.x[0][0] + dt * ((1 - s) * 0.5 + s * 0.7), 1e-15);
  EXPECT_NEAR(next.energy[0], cloud.energy[0] - cloud.pressure[0] / cloud.density[0] * d * dt, 1e-15);
  EXPECT_NEAR(next.density[0], cloud.density[0] * (1 - d * dt), 1e-15);
  EXPECT_NEAR(next.divergence[0], d, 1e-15);
}

TEST(UpdateParticlesConserving, KeepsTotalEnergyToRoundOff) {
  EXPECT_LT(std::abs(energyDrift<1>({{12, 1, 1}})), 1e-14);
  EXPECT_LT(std::abs(energyDrift<2>({{5, 4, 1}})), 1e-14);
  EXPECT_LT(std::abs(energyDrift<3>({{3, 4, 2}})), 1e-14);
}

TEST(FilterDensity, MakesAnExtremumTheMeanOfThreeCellsAndLeavesTheRim) {
  Cloud<1> cloud({{5, 1, 1}}, 1);
  std::vector<double> density{1, 9, 3, 4, 2}, mean(5);
  const CellView<double> means(mean.data(), cloud.level.cells());

  averageDensity<1>(cloud.patch(), cloud.gas, cloud.read(density), means);
  filterDensity<1>(cloud.patch(), cloud.gas, CellView<const double>(mean.data(), cloud.level.cells()),
                   cloud.write(density));

  EXPECT_EQ(density[0], 1);
  EXPECT_NEAR(density[1], 13.0 / 3, 1e-14);
  EXPECT_NEAR(density[2], 16.0 / 3, 1e-14);
  EXPECT_NEAR(density[3], 9.0 / 3, 1e-14);
  EXPECT_EQ(density[4], 2);
}

TEST(FilterDensity, TreatsAPlaneExtremumInTwoDimensionsAsInOne) {
  Cloud<2> cloud({{5, 3, 1}}, 1);
  std::vector<double> density, mean(15);
  for (int y = 0; y < 3; ++y)
    for (const double value : {1.0, 9.0, 3.0, 4.0, 2.0}) density.push_back(value * (1 + 1e-16 * y));
  const CellView<double> means(mean.data(), cloud.level.cells());

  averageDensity<2>(cloud.patch(), cloud.gas, cloud.read(density), means);
  filterDensity<2>(cloud.patch(), cloud.gas, CellView<const double>(mean.data(), cloud.level.cells()),
                   cloud.write(density));

  EXPECT_NEAR(density[6], 13.0 / 3, 1e-14);
}

/// Two equal cells, such as mirror images, are no extremum, whatever round-off makes of them.
TEST(FilterDensity, LeavesCellsThatDifferByRoundOff) {
  for (const double rounding : {-1e-15, 0.0, 1e-15}) {
    Cloud<1> cloud({{6, 1, 1}}, 1);
    const std::vector<double> given{1, 2, 5 * (1 + rounding), 5, 2, 1};
    std::vector<double> density = given;
    const CellView<const double> means(given.data(), cloud.level.cells());
    filterDensity<1>(cloud.patch(), cloud.gas, means, cloud.write(density));
    EXPECT_EQ(density, given);
  }
}

TEST(ComputePressure, AddsViscosityWhereTheGasIsCompressedOnly) {
  Cloud<1> cloud({{2, 1, 1}}, 1);
  const std::vector<double> divergence{-2, 2};
  std::vector<double> pressure;
  const double h = 0.5, c = std::sqrt(1.4 * 0.4 * cloud.energy[0]), rho = cloud.density[0];

  computePressure<1>(cloud.patch(), cloud.gas, {0.6, 2.75}, cloud.read(cloud.density), cloud.read(cloud.energy),
                     cloud.read(divergence), cloud.write(pressure));

  EXPECT_NEAR(pressure[0], 0.4 * rho * cloud.energy[0] + rho * (0.6 * h * h * 4 + 2.75 * h * c * 2), 1e-14);
  EXPECT_EQ(pressure[1], cloud.gas.pressure(cloud.density[1], cloud.energy[1]));
}

TEST(ShareCellVolume, GivesEachParticleOfACellTheSameVolume) {
  Cloud<1> cloud({{2, 1, 1}}, 4);
  std::vector<double> mass;

  shareCellVolume<1>(cloud.patch(), cloud.gas, cloud.read(cloud.density), cloud.write(mass));

  for (std::size_t p = 0; p < mass.size(); ++p)
    EXPECT_NEAR(mass[p], cloud.density[p] * cloud.level.cellVolume() / 4, 1e-16);
}

TEST(ComputeStableTimeStep, IsTheCourantLimitOfTheFastestParticle) {
  Cloud<1> cloud({{100, 1, 1}}, 7);
  double fastest = 0;
  for (std::size_t p = 0; p < cloud.x.size(); ++p)
    fastest = std::max(fastest, std::abs(cloud.v[p][0]) + std::sqrt(1.4 * 0.4 * cloud.energy[p]));
  Minimum dt;

  computeStableTimeStep<1>(cloud.patch(), cloud.gas, 0.2125, cloud.read(cloud.v), cloud.read(cloud.energy), dt);

  EXPECT_NEAR(dt.value, 0.2125 * 0.01 / fastest, 1e-17);
}

TEST(Redistribute, SplitsALargeParticleIntoTwoThatTogetherAreTheSame) {
  std::vector<Piece<1>> pieces = somePieces(1, 1.0);
  const std::vector<Piece<1>> before = pieces;

  split<1>(pieces, unitCell(), 2);

  ASSERT_EQ(pieces.size(), 2u);
  expectConserved(before, pieces);
  EXPECT_NE(pieces[0].id, pieces[1].id);
  EXPECT_NEAR(pieces[1].x[0] - pieces[0].x[0], 0.5, 1e-12);
}

TEST(Redistribute, LeavesSmallParticlesWhole) {
  std::vector<Piece<1>> pieces = somePieces(1, 0.2);

  split<1>(pieces, unitCell(), 2);

  EXPECT_EQ(pieces.size(), 1u);
}

TEST(Redistribute, MergesTheNearestUntilThereAreFewEnough) {
  std::vector<Piece<1>> pieces = somePieces(6);
  const std::vector<Piece<1>> before = pieces;

  merge<1>(pieces, 3);

  EXPECT_EQ(pieces.size(), 3u);
  expectConserved(before, pieces);
}

TEST(Redistribute, SeedsACellAnewWithItsSlopesAndTheSameSums) {
  std::vector<Piece<1>> pieces = somePieces(5);
  const std::vector<Piece<1>> before = pieces;
  CellShape<1> cell = unitCell();
  cell.densitySlope[0] = 0.5;
  cell.pressureSlope[0] = -0.2;
  cell.velocitySlope[0][0] = 3;

  reseed<1>(pieces, cell, Gas(), 4);

  ASSERT_EQ(pieces.size(), 4u);
  expectConserved(before, pieces);
  EXPECT_LT(pieces[0].density(), pieces[3].density());
  EXPECT_LT(pieces[0].velocity[0], pieces[3].velocity[0]);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(pieces[k].x[0], (k + 0.5) / 4, 1e-15);
}

}  // namespace tushar::mpm::gas::paper
