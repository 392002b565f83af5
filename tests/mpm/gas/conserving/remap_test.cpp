#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/tasks/particle_maker.hpp"
#include "tests/mpm/gas/conserving/boxes.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

/// The result of a redistribution.
template <int D>
struct Made {
  tasks::ParticleMaker maker{7};
  std::vector<Vec<D>> x, edges, v;
  std::vector<Modes<D>> modes;
  std::vector<double> mass, energy, affine;

  NewBoxes<D> fresh() {
    return {.x = x,
            .edges = edges,
            .mass = mass,
            .velocity = v,
            .modes = modes,
            .internalEnergy = energy,
            .affineEnergy = affine};
  }
};

template <int D>
void remapAll(const BoxCloud<D>& cloud, Made<D>& made) {
  CellValues<double> mass(cloud.level), energy(cloud.level);
  gatherInCells<D>(cloud.patch(), cloud.gas, cloud.read(cloud.x), cloud.read(cloud.edges), cloud.read(cloud.mass),
                   cloud.read(cloud.energy), 0.0, mass.write(), energy.write());
  remap<D>(cloud.patch(), cloud.boxes(), mass.read(), energy.read(), made.maker, made.fresh());
}

template <int D>
void expectTotals(const Totals<D>& before, const Made<D>& made) {
  const Totals<D> after(made.mass, made.v, made.energy, made.affine);
  EXPECT_NEAR(after.mass, before.mass, 1e-13 * before.mass);
  EXPECT_NEAR((after.momentum - before.momentum).norm(), 0, 1e-13 * before.mass);
  EXPECT_NEAR(after.energy, before.energy, 1e-13 * before.energy);
  for (const double e : made.energy) EXPECT_GT(e, 0);
  for (const double a : made.affine) EXPECT_GE(a, 0);
}
template <int D>
void expectSameTotals(const BoxCloud<D>& cloud, const Made<D>& made) {
  expectTotals<D>({cloud.mass, cloud.v, cloud.energy, cloud.affine}, made);
}

}  // namespace

TEST(Remap, KeepsMassMomentumAndEnergyInEveryDimension) {
  const BoxCloud<1> line(Index3{{9, 1, 1}});
  const BoxCloud<2> plane(Index3{{7, 6, 1}});
  const BoxCloud<3> space(Index3{{5, 4, 4}});
  Made<1> onLine;
  Made<2> inPlane;
  Made<3> inSpace;
  remapAll(line, onLine);
  remapAll(plane, inPlane);
  remapAll(space, inSpace);

  expectSameTotals(line, onLine);
  expectSameTotals(plane, inPlane);
  expectSameTotals(space, inSpace);
  EXPECT_EQ(inSpace.x.size(), 80U);
}

TEST(Remap, MakesHeatOfMotionThatGoesLost) {
  BoxCloud<2> cloud(Index3{{7, 6, 1}});
  for (Modes<2>& modes : cloud.modes) modes *= 300;  // far more than K_A and e can pay for
  Made<2> made;
  remapAll(cloud, made);

  expectSameTotals(cloud, made);
}

TEST(Remap, ReproducesALinearVelocityOfAUniformGas) {
  BoxCloud<2> cloud(Index3{{7, 6, 1}});
  const Tensor<2> slope{{1.0, 0.5}, {-0.25, 2.0}};
  for (std::size_t p = 0; p < cloud.x.size(); ++p) {
    cloud.x[p] = cloud.level.cellCentre<2>(cloud.level.cellOf<2>(cloud.x[p])) + Vec<2>(0.03, -0.02);
    cloud.edges[p] = Vec<2>(cloud.level.spacing(0), cloud.level.spacing(1));
    cloud.mass[p] = 1;
    cloud.energy[p] = 10;
    cloud.affine[p] = 1;
    cloud.v[p] = slope * cloud.x[p];
    cloud.modes[p].setZero();
    for (int d = 0; d < 2; ++d) cloud.modes[p].col(gradientColumn(d)) = slope.col(d);
  }
  Made<2> made;
  remapAll(cloud, made);

  for (std::size_t p = 0; p < made.x.size(); ++p) {
    const Index<2> cell = cloud.level.cellOf<2>(made.x[p]);
    if (cell[0] < 2 || cell[1] < 2 || cell[0] > 4 || cell[1] > 3) continue;  // away from the cut rim
    EXPECT_NEAR((made.v[p] - slope * made.x[p]).norm(), 0, 1e-13);
    for (int d = 0; d < 2; ++d) EXPECT_NEAR((made.modes[p].col(gradientColumn(d)) - slope.col(d)).norm(), 0, 1e-11);
    EXPECT_NEAR(made.mass[p], 1, 1e-13);
  }
}

TEST(Remap, LeavesAnEmptyCellEmpty) {
  BoxCloud<1> cloud(Index3{{9, 1, 1}});
  for (int p = 3; p < 6; ++p) cloud.edges[p] *= 0.3;
  cloud.x[4][0] = cloud.level.nodePosition(0, 4) + 0.01;
  cloud.x[3][0] = cloud.level.nodePosition(0, 3) + 0.01;
  cloud.set.at(Index<1>{{4}}) = {4, 4};
  Made<1> made;
  remapAll(cloud, made);

  EXPECT_EQ(made.x.size(), 8U);
}

TEST(Remap, LetsGasReachNoFartherIntoAnEmptyCell) {
  BoxCloud<1> cloud(Index3{{9, 1, 1}});
  const double h = cloud.level.spacing(0);
  for (int cell = 0; cell < 9; ++cell) {
    const auto p = static_cast<std::size_t>(cell);
    cloud.edges[p][0] = h;
    cloud.x[p] = cloud.level.cellCentre<1>(Index<1>{{cell}}) + Vec<1>(0.3 * h);
    cloud.mass[p] = 1;
    if (cell > 4) cloud.set.at(Index<1>{{cell}}) = {9, 9};
  }
  Made<1> made;
  remapAll(cloud, made);

  ASSERT_EQ(made.x.size(), 6U);
  EXPECT_NEAR(made.x.back()[0] + 0.5 * made.edges.back()[0], cloud.level.nodePosition(0, 5) + 0.3 * h, 1e-2 * h);
  EXPECT_NEAR(made.x.back()[0] - 0.5 * made.edges.back()[0], cloud.level.nodePosition(0, 5), 1e-13);
  for (std::size_t p = 1; p < 5; ++p) EXPECT_NEAR(made.edges[p][0], h, 1e-13);
}

/// The ids of the particles of a patch after a redistribution, ascending.
template <int D>
std::vector<ParticleId> idsAfter(const BoxCloud<D>& cloud, Made<D>& made) {
  data::ParticleSet set = cloud.set;
  made.maker.makeSet(set, cloud.patch(), 0, cloud.ids.data());
  std::vector<ParticleId> ids(static_cast<std::size_t>(set.owned()));
  made.maker.writeIds(cloud.ids.data(), ids.data());
  std::sort(ids.begin(), ids.end());
  return ids;
}

TEST(SplitLong, HalvesAlongEachLongAxisAndKeepsTheOthers) {
  BoxCloud<2> cloud(Index3{{7, 6, 1}});
  cloud.edges[20] = Vec<2>(1.9 * cloud.level.spacing(0), 1.6 * cloud.level.spacing(1));
  Made<2> made;
  splitLong<2>(cloud.patch(), 1.4, cloud.boxes(), made.maker, made.fresh());

  expectTotals<2>({{cloud.mass[20]}, {cloud.v[20]}, {cloud.energy[20]}, {cloud.affine[20]}}, made);
  EXPECT_EQ(made.x.size(), 4);
  for (const Vec<2>& edges : made.edges) EXPECT_LE(edges[0], 1.4 * cloud.level.spacing(0));
  const std::vector<ParticleId> ids = idsAfter(cloud, made);
  std::vector<ParticleId> before = cloud.ids;
  std::sort(before.begin(), before.end());
  EXPECT_EQ(ids.size(), before.size() + 3);
  EXPECT_TRUE(std::includes(ids.begin(), ids.end(), before.begin(), before.end()));
}

TEST(SplitLong, KeepsAllParticlesWhereNoneIsLong) {
  const BoxCloud<2> cloud(Index3{{7, 6, 1}});
  Made<2> made;
  splitLong<2>(cloud.patch(), 1.4, cloud.boxes(), made.maker, made.fresh());

  EXPECT_TRUE(made.x.empty());
}

}  // namespace tushar::mpm::gas::conserving
