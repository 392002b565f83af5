#include <gtest/gtest.h>

#include <numeric>

#include "components/mpm/gas/conserving/stable_time_step.hpp"
#include "tests/mpm/gas/conserving/boxes.hpp"

// The bodies of the conserving method's tasks on plain fields: no scheduler, no warehouse, no scene.

namespace tushar::mpm::gas::conserving {

namespace {

/// The grid's state and all variables of a step, in the order of the schedule.
template <int D, class Scheme>
struct Step {
  const BoxCloud<D>& cloud;
  NodeValues<double> mass, relaxation;
  NodeValues<Vec<D>> velocity, acceleration;
  CellValues<double> cellMass, cellEnergy, pressure, viscosity, shock, work;
  CellValues<Tensor<D>> gradient, stress;
  std::vector<Vec<D>> x, edges, v;
  std::vector<Modes<D>> modes;
  std::vector<double> energy, affine;
  Minimum factor;

  Step(const BoxCloud<D>& of, double dt)
      : cloud(of),
        mass(of.level),
        relaxation(of.level),
        velocity(of.level),
        acceleration(of.level),
        cellMass(of.level),
        cellEnergy(of.level),
        pressure(of.level),
        viscosity(of.level),
        shock(of.level),
        work(of.level),
        gradient(of.level),
        stress(of.level) {
    const Patch& patch = of.patch();
    interpolateParticlesToGrid<D>(patch, of.gas,
                                  {.x = of.read(of.x),
                                   .edges = of.read(of.edges),
                                   .mass = of.read(of.mass),
                                   .velocity = of.read(of.v),
                                   .modes = of.read(of.modes),
                                   .internalEnergy = of.read(of.energy),
                                   .nodeMass = mass.write(),
                                   .nodeVelocity = velocity.write(),
                                   .cellMass = cellMass.write(),
                                   .cellInternalEnergy = cellEnergy.write()});
    computeVelocityGradient<D>(patch, of.gas, velocity.read(), gradient.write());
    computePressure<D, Scheme>(patch, of.gas, {1, 0.5}, cellMass.read(), cellEnergy.read(), gradient.read(),
                               pressure.write(), viscosity.write(), shock.write());
    computeStress<D, Scheme>(patch, of.gas, pressure.read(), viscosity.read(), gradient.read(), dt, stress.write());
    computeAcceleration<D>(patch, of.gas, stress.read(), mass.read(), acceleration.write());
    computeRelaxation<D>(patch, of.gas, shock.read(), relaxation.write());
    computeWork<D>(patch, of.gas, stress.read(), cellEnergy.read(), velocity.read(), acceleration.read(), dt,
                   work.write());
    update(dt);
  }
  void update(double dt) {
    updateParticles<D, Scheme>(cloud.patch(), cloud.gas,
                               {.x = cloud.read(cloud.x),
                                .edges = cloud.read(cloud.edges),
                                .velocity = cloud.read(cloud.v),
                                .modes = cloud.read(cloud.modes),
                                .internalEnergy = cloud.read(cloud.energy),
                                .affineEnergy = cloud.read(cloud.affine),
                                .nodeVelocity = velocity.read(),
                                .acceleration = acceleration.read(),
                                .relaxation = relaxation.read(),
                                .work = work.read(),
                                .newX = cloud.write(x),
                                .newEdges = cloud.write(edges),
                                .newVelocity = cloud.write(v),
                                .newModes = cloud.write(modes),
                                .newInternalEnergy = cloud.write(energy),
                                .newAffineEnergy = cloud.write(affine)},
                               dt, factor);
  }
};

template <int D>
Index3 resolution() {
  return D == 1 ? Index3{{9, 1, 1}} : D == 2 ? Index3{{7, 6, 1}} : Index3{{5, 4, 4}};
}

template <int D>
grid::Domain shaped() {
  return freeDomain(resolution<D>());
}

template <int D, class Scheme>
void expectStepToConserve() {
  BoxCloud<D> cloud(resolution<D>());
  const Step<D, Scheme> step(cloud, 0.01);
  const Totals<D> before(cloud.mass, cloud.v, cloud.energy, cloud.affine);
  const Totals<D> after(cloud.mass, step.v, step.energy, step.affine);

  EXPECT_NEAR((after.momentum - before.momentum).norm(), 0, 1e-12 * before.mass);
  EXPECT_NEAR(after.energy, before.energy, 1e-13 * before.energy);
  double moved = 0;
  for (std::size_t p = 0; p < cloud.x.size(); ++p) moved += std::abs(step.energy[p] - cloud.energy[p]);
  EXPECT_GT(moved, 1e-3);
}

/// Gives every particle the velocity of u(x) = u_0 + slope x.
template <int D>
void setLinearVelocity(BoxCloud<D>& cloud, const Vec<D>& mean, const Tensor<D>& slope) {
  for (std::size_t p = 0; p < cloud.x.size(); ++p) {
    cloud.v[p] = mean + slope * cloud.x[p];
    cloud.modes[p].setZero();
    for (int d = 0; d < D; ++d) cloud.modes[p].col(gradientColumn(d)) = slope.col(d);
  }
}

}  // namespace

TEST(ConservingStep, KeepsMomentumAndTotalEnergy) {
  expectStepToConserve<1, Apic>();
  expectStepToConserve<2, Apic>();
  expectStepToConserve<3, Apic>();
  expectStepToConserve<1, AffineFlip>();
  expectStepToConserve<2, AffineFlip>();
  expectStepToConserve<3, AffineFlip>();
}

TEST(ConservingStep, GathersAllMassAndReproducesLinearVelocities) {
  BoxCloud<2> cloud(Index3{{9, 9, 1}});
  const Vec<2> mean(0.3, -0.2);
  const Tensor<2> slope{{1.0, 0.5}, {-0.25, 2.0}};
  setLinearVelocity<2>(cloud, mean, slope);
  const Step<2, AffineFlip> step(cloud, 0.001);

  EXPECT_NEAR(std::accumulate(step.mass.values.begin(), step.mass.values.end(), 0.0),
              std::accumulate(cloud.mass.begin(), cloud.mass.end(), 0.0), 1e-12);
  EXPECT_NEAR(std::accumulate(step.cellMass.values.begin(), step.cellMass.values.end(), 0.0),
              std::accumulate(cloud.mass.begin(), cloud.mass.end(), 0.0), 1e-12);
  const Box awayFromTheRim{{{3, 3, 0}}, {{7, 7, 1}}};  // there boxes are cut off
  forEach<2>(awayFromTheRim, [&](const Index<2>& cell) {
    const Vec<2> corner(cloud.level.nodePosition(0, cell[0]), cloud.level.nodePosition(1, cell[1]));
    EXPECT_NEAR((step.velocity.read()[cell] - mean - slope * corner).norm(), 0, 1e-12);
    if (cell[0] < 6 && cell[1] < 6) {
      EXPECT_NEAR((step.gradient.read()[cell] - slope).norm(), 0, 1e-11);
    }
  });
}

TEST(ConservingStep, CarriesAUniformFlowAsItIs) {
  BoxCloud<2> cloud(resolution<2>());
  setLinearVelocity<2>(cloud, Vec<2>(0.3, -0.2), Tensor<2>::Zero());
  Step<2, AffineFlip> step(cloud, 0.01);
  std::fill(step.acceleration.values.begin(), step.acceleration.values.end(), Vec<2>::Zero());
  std::fill(step.work.values.begin(), step.work.values.end(), 0.0);
  step.update(0.01);

  for (std::size_t p = 0; p < cloud.x.size(); ++p) {
    EXPECT_NEAR((step.v[p] - cloud.v[p]).norm(), 0, 1e-14);
    EXPECT_NEAR(step.energy[p] + step.affine[p], cloud.energy[p] + cloud.affine[p], 1e-13);
    EXPECT_NEAR(step.modes[p].norm(), 0, 1e-11);
  }
}

TEST(ConservingStep, StressTakesTheFacesAsTheyStandHalfAStepLater) {
  const Grid grid(shaped<2>());
  const Level& level = grid.level();
  Gas gas;
  CellValues<double> pressure(level), viscosity(level);
  CellValues<Tensor<2>> gradient(level), stress(level);
  std::fill(pressure.values.begin(), pressure.values.end(), 2.0);
  std::fill(viscosity.values.begin(), viscosity.values.end(), 0.5);
  std::fill(gradient.values.begin(), gradient.values.end(), Tensor<2>{{0.2, 0.4}, {-0.6, -0.2}});
  computeStress<2, AffineFlip>(grid.patches().front(), gas, pressure.read(), viscosity.read(), gradient.read(), 1.0,
                               stress.write());

  const Tensor<2> expected = 2.5 * Tensor<2>{{0.9, 0.3}, {-0.2, 1.1}};  // cof of {{1.1, .2}, {-.3, .9}}; div v = 0
  EXPECT_NEAR((stress.values.front() - expected).norm(), 0, 1e-14);
}

TEST(Viscosity, OfShocksGrowsWithTheJumpAndIsNoneInExpansion) {
  EXPECT_DOUBLE_EQ(shockViscosity(1, 2, 3, -0.5, {1, 0.5}).viscosity[0], 2 * 0.5 * (0.5 + 0.5 * 3));
  EXPECT_DOUBLE_EQ(shockViscosity(1, 2, 3, 0.5, {1, 0.5}).viscosity[0], 0);
}

TEST(Viscosity, OfSmoothFlowIsThatOfShocksWhereTheyAreStrongAndNoneWhereNeighboursExplainTheFlow) {
  const Compression strong{-2, -0.1, 2}, smooth{-0.01, 0, 0.01}, fan{0.2, 0.1, -0.2}, behindShock{0.2, 0.1, 1};
  EXPECT_DOUBLE_EQ(smoothViscosity(1, 1, 1, strong, {1, 0.5}).viscosity[0],
                   shockViscosity(1, 1, 1, -2, {1, 0.5}).viscosity[0]);
  EXPECT_DOUBLE_EQ(smoothViscosity(1, 1, 1, strong, {1, 0.5}).shock[0], 1);
  EXPECT_DOUBLE_EQ(smoothViscosity(1, 1, 1, smooth, {1, 0.5}).viscosity[0], 0);
  EXPECT_DOUBLE_EQ(smoothViscosity(1, 1, 1, smooth, {1, 0.5}).shock[0], 0);
  EXPECT_DOUBLE_EQ(smoothViscosity(1, 1, 1, fan, {1, 0.5}).viscosity[0], 0);
  EXPECT_DOUBLE_EQ(smoothViscosity(1, 1, 1, behindShock, {1, 0.5}).viscosity[0], -0.5 * 0.1);
  EXPECT_DOUBLE_EQ(smoothViscosity(0.1, 1, 1, {0.2, 10, 1}, {1, 9}).viscosity[0], -0.4 * 0.1);
}

TEST(LimitModes, KeepsKineticEnergyWithinWhatThereIs) {
  BoxCloud<2> cloud(resolution<2>());
  for (Modes<2>& modes : cloud.modes) modes *= 1000;
  const std::vector<Modes<2>> before = cloud.modes;
  limitModes<2>(cloud.patch(), cloud.gas, 0.25, cloud.read(cloud.edges), cloud.read(cloud.energy),
                cloud.read(cloud.affine), cloud.write(cloud.modes));
  for (std::size_t p = 0; p < cloud.x.size(); ++p) {
    const LanesVec<2> inertia = footprintOf<2>(cloud.level, cloud.x[p], cloud.edges[p]).inertia();
    EXPECT_LE(modalEnergy<2>(cloud.modes[p], Vec<2>(inertia[0][0], inertia[1][0])),
              cloud.affine[p] + 0.25 * cloud.energy[p] + 1e-12);
    EXPECT_LT(cloud.modes[p].norm(), before[p].norm());
  }
}

TEST(CountSteps, CallsForARemapWhenItsTimeHasComeOrACellIsOverfull) {
  const Remap remap{3, 0.02};
  const auto count = [&](double age, double fill) {
    Maximum result;
    countSteps(Grid(shaped<1>()).patches().front(), remap, age, fill, result);
    return result.value;
  };
  EXPECT_EQ(count(0, 1), 1);
  EXPECT_EQ(count(1, 1), 2);
  EXPECT_EQ(count(2, 1), 0);
  EXPECT_EQ(count(0, 1.03), 0);
}

/// Returns dt for a plane with velocity gradient `of` in one cell of mass `mass` and 0 elsewhere.
double deformationLimit(const Tensor<2>& of, double mass = 1) {
  const Grid grid(shaped<2>());
  const Level& level = grid.level();
  CellValues<double> cellMass(level);
  CellValues<Tensor<2>> gradient(level);
  std::fill(cellMass.values.begin(), cellMass.values.end(), 1.0);
  std::fill(gradient.values.begin(), gradient.values.end(), Tensor<2>::Zero());
  cellMass.values[3] = mass;
  gradient.values[3] = of;
  Minimum dt;
  limitDeformation<2>(grid.patches().front(), Gas(), cellMass.read(), gradient.read(), dt);
  return dt.value;
}

TEST(LimitDeformation, BoundsWhatACellIsCompressedAndStretched) {
  EXPECT_TRUE(std::isinf(deformationLimit(Tensor<2>{{0, 0}, {0, 0}})));
  EXPECT_TRUE(std::isinf(deformationLimit(Tensor<2>{{0, 9}, {0, 0}})));
  EXPECT_DOUBLE_EQ(deformationLimit(Tensor<2>{{4, 0}, {0, -4}}), 0.1);
}

TEST(LimitDeformation, LetsAFrontRunTwiceAsFarIntoAnEmptyCell) {
  const Tensor<2> gradient{{4, 0}, {0, -4}};
  EXPECT_DOUBLE_EQ(deformationLimit(gradient, 0), 2 * deformationLimit(gradient, 1));
}

/// A line of gas that moves with `speed`, with a velocity change of `compression` [m/s] across each cell.
struct MovingLine {
  BoxCloud<1> cloud{Index3{{4, 1, 1}}};
  CellValues<double> mass{cloud.level}, energy{cloud.level};
  CellValues<Tensor<1>> gradient{cloud.level};
  Maximum pastGrid, pastGas;

  MovingLine(double speed, double compression) {
    const double h = cloud.level.minSpacing();
    std::fill(cloud.v.begin(), cloud.v.end(), Vec<1>(speed));
    std::fill(cloud.energy.begin(), cloud.energy.end(), 1.0);
    std::fill(mass.values.begin(), mass.values.end(), 1.0);
    std::fill(energy.values.begin(), energy.values.end(), 1.0);
    std::fill(gradient.values.begin(), gradient.values.end(), Tensor<1>(-compression / h));
    measureSignals<1>(cloud.patch(), cloud.gas, cloud.read(cloud.v), cloud.read(cloud.energy), mass.read(),
                      energy.read(), gradient.read(), pastGrid, pastGas);
  }
  double timeStep() const {
    Minimum dt;
    computeAcousticTimeStep<1>(cloud.patch(), cloud.gas, {}, mass.read(), gradient.read(), pastGrid.value,
                               pastGas.value, dt);
    return dt.value;
  }
};

TEST(MeasureSignals, KnowsThemPastTheGridAndPastTheGas) {
  const double c = std::sqrt(Gas().soundSpeedSquared(1));
  const MovingLine moving(-3, 0), compressed(0, 2);

  EXPECT_DOUBLE_EQ(moving.pastGrid.value, 3 + c);
  EXPECT_DOUBLE_EQ(moving.pastGas.value, 1.25 * c);
  EXPECT_DOUBLE_EQ(compressed.pastGrid.value, c);
  EXPECT_DOUBLE_EQ(compressed.pastGas.value, 1.25 * (2.8 + std::sqrt(2.8 * 2.8 + c * c)));
}

TEST(ComputeAcousticTimeStep, IsTheSameAtAnySpeedAndAFifthShorterThanAtRest) {
  const double moving = MovingLine(10, 0).timeStep();

  EXPECT_DOUBLE_EQ(MovingLine(100, 0).timeStep(), moving);
  EXPECT_DOUBLE_EQ(MovingLine(0, 0).timeStep(), 1.25 * moving);
}

TEST(ComputeAcousticTimeStep, IsShorterWhereAShockRuns) {
  EXPECT_LT(MovingLine(100, 0.3).timeStep(), MovingLine(100, 0).timeStep());
}

}  // namespace tushar::mpm::gas::conserving
