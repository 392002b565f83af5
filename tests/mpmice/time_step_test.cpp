#include "tests/mpmice/fields.hpp"

#include "components/mpm/solid/constitutive/comp_neo_hook.hpp"
#include "components/mpm/solid/constitutive/make_model.hpp"
#include "components/mpmice/tasks/compute_stable_time_step.hpp"
#include "components/mpmice/tasks/solve_pressure.hpp"
#include "components/mpmice/wave_speeds.hpp"

namespace tushar::mpmice {

namespace {

template <class T>
class FlatAlongAxes : public testing::Test {};
TYPED_TEST_SUITE(FlatAlongAxes, AllAxes);

/// Returns the step that two particles with the given velocities allow on a unit square of 10 x 10 cells, with a cfl of
/// .5.
Minimum stepFor(const std::vector<Vec<2>>& velocity, const mpm::solid::Material& material) {
  const Grid grid(euler::closedBox(2, 10));
  data::ParticleSet set;
  set.reset(grid.patches().front(), 0);
  set.setOwned(static_cast<int>(velocity.size()));
  Minimum dt;
  limitStepOfRigidBodies<2>(grid.patches().front(), material, 0.5, {velocity.data(), set, grid.level().cells()}, dt);
  return dt;
}

/// A body whose waves have the speed c [m/s].
mpm::solid::Material bodyWithWaves(double c) {
  mpm::solid::Material material;
  material.density = 3;
  mpm::solid::CompNeoHook model;
  model.bulkModulus = material.density * c * c;
  model.shearModulus = 0;
  material.model = mpm::solid::makeModel(model, material);
  material.bodies.emplace_back();
  return material;
}

/// A gas in which the speed of sound is 1 m/s.
euler::Settings gasWithSound(const input::VectorExpression& velocity = {}) {
  euler::Settings settings;
  settings.gas.specificHeat = 1;
  euler::GasObject object;
  object.density = input::Expression(1.0);
  object.temperature = input::Expression(1 / (1.4 * 0.4));
  object.velocity = velocity;
  settings.objects.push_back(object);
  return settings;
}

}  // namespace

TEST(StepOfRigidBodies, LetsTheFastestParticleCrossAPartOfACell) {
  EXPECT_EQ(stepFor({{1, 2}, {-4, 0}}, {}).value, 0.5 * 0.1 / 4);
}

TEST(StepOfRigidBodies, IsNotLimitedAtRest) {
  EXPECT_EQ(stepFor({{0, 0}, {0, 0}}, {}).value, Minimum().value);
  EXPECT_EQ(stepFor({}, {}).value, Minimum().value);
}

TEST(StepOfRigidBodies, IsAtMostHalfOfThatForWhichConductionIsStable) {
  mpm::solid::Material material;
  material.density = 2;
  material.specificHeat = 3;
  material.thermalConductivity = 12;  // a diffusivity of 2, and h^2 / (4 a) in a plane
  EXPECT_NEAR(stepFor({{0, 0}}, material).value, 0.5 * 0.01 / 8, 1e-17);  // round-off
}

TEST(WaveSpeeds, AreThoseOfBodiesAndGasAtTheStart) {
  EXPECT_NEAR(fastestInBodies({bodyWithWaves(7), bodyWithWaves(9), bodyWithWaves(8)}), 9, 1e-14);
  EXPECT_NEAR(fastestInGas(gasWithSound()), 1, 1e-15);
  EXPECT_NEAR(fastestInGas(gasWithSound(input::VectorExpression(Vec3(3, -4, 5)))), 13, 1e-14);
}

TEST(WaveSpeeds, MakeImplicitStepsNeedlessWhereBodiesAreTenTimesAsFast) {
  EXPECT_TRUE(areBodiesMuchFaster({bodyWithWaves(10.001)}, gasWithSound()));
  EXPECT_FALSE(areBodiesMuchFaster({bodyWithWaves(9.999)}, gasWithSound()));
  EXPECT_FALSE(areBodiesMuchFaster({bodyWithWaves(100)}, gasWithSound(input::VectorExpression(Vec3(20, 0, 0)))));
}

TYPED_TEST(FlatAlongAxes, AreTheCellsOfBodiesAndTheirNeighboursAlsoBeyondTheGrid) {
  constexpr int D = TypeParam::value;
  const Grid grid(euler::closedBox(D, 8));
  const Level& level = grid.level();
  GasFields<D> fields(level.cells());
  for (std::size_t k = 0; k < fields.free.values.size(); ++k)
    if (wild(static_cast<double>(k)) < 0.1) fields.free.values[k] = wild(0.5 + static_cast<double>(k));
  const GasInCells<D> cells = fields.gas();
  const ice::IsFlat<D> isFlat = flatAtBodies<D>(grid.patches().front(), cells);
  forEach<D>(level.cells().grown(2, D), [&](const Index<D>& cell) {
    bool expected = cells.hasBody(nearestOnGrid(level, cell));
    for (int d = 0; d < D; ++d)
      for (const Index<D>& next : {cell - Index<D>::unit(d), cell + Index<D>::unit(d)})
        expected |= cells.hasBody(nearestOnGrid(level, next));
    EXPECT_EQ(isFlat(cell), expected);
  });
}

TYPED_TEST(FlatAlongAxes, StepsAreShorterBesideLighterBodies) {
  constexpr int D = TypeParam::value;
  const Grid grid(euler::closedBox(D, 6));
  GasFields<D> fields(grid.level().cells());
  Settings settings;
  const auto stepBeside = [&](double density) {
    std::vector<mpm::solid::Material> bodies(2);
    bodies[0].density = 1000;
    bodies[1].density = density;
    Minimum dt;
    limitStepOfLightBodies<D>(grid.patches().front(), bodies, settings, fields.gas(), dt);
    return dt.value;
  };
  EXPECT_EQ(stepBeside(0.1), Minimum().value) << "there is no wall";
  fields.free.values.back() = fields.density.values.back() = 0;
  EXPECT_NEAR(stepBeside(0.1) / (0.1 / std::sqrt(1.4) / 6), 1, 1e-14);
  EXPECT_EQ(stepBeside(0.8), Minimum().value) << "cfl is .8";
}

TYPED_TEST(FlatAlongAxes, StepsFollowFromTheFastestCellWithGas) {
  constexpr int D = TypeParam::value;
  const Grid grid(euler::closedBox(D, D == 1 ? 600 : D == 2 ? 21 : 9));
  GasFields<D> fields(grid.level().cells());
  for (std::size_t i = 0; i < fields.density.values.size(); ++i) {
    const double seed = static_cast<double>(i);
    fields.free.values[i] = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 0.1 + 0.9 * wild(seed);
    fields.density.values[i] = i % 7 == 0 ? 0 : fields.free.values[i] * (0.5 + wild(seed + 0.1));
    fields.energy.values[i] = 3 + wild(seed + 0.2);
    for (int d = 0; d < D; ++d) fields.momentum.values[i][d] = fields.density.values[i] * (wild(seed + d) - 0.5);
  }
  Settings settings;
  const Patch& patch = grid.patches().front();
  for (const euler::Courant& courant : {euler::Courant{0.3}, euler::Courant{0.3, 0.5}, euler::Courant{0.1, 0.5}}) {
    settings.gas.courant = courant;
    Minimum dt;
    computeStableTimeStep<D>(patch, settings, fields.gas(), dt);
    const euler::CrossingRate<D> crossing(courant);
    EXPECT_EQ(dt.value, courant.number / fastestRate<D>(patch, settings.gas.gas, crossing, fields.gas()));
  }
}

}  // namespace tushar::mpmice
