#include <gtest/gtest.h>

#include "components/euler/boundary.hpp"
#include "tests/euler/gas_box.hpp"

// What sides of the grid let in.

namespace tushar::euler {

namespace {

Gas air() {
  Gas gas;
  gas.specificHeat = 2.5;
  return gas;
}

using Conditions = std::vector<grid::BoundaryCondition>;

grid::BoundaryCondition given(const grid::BoundaryVariable& label, double value, int material = -1) {
  return {label, BoundaryKind::dirichlet, Vec3(value, 0, 0), material};
}

/// The state beyond the lower side of a line of cells with density 1, velocity .3 and pressure 2.
State<1> beyond(const Conditions& conditions, Gas gas = air()) {
  grid::Domain domain = openBox(1, 4);
  domain.boundaries.face(0, 0) = conditions;
  const Grid grid(domain);
  Rows<1> rows(6);
  rows.hold(grid.level().cells().grown(1, 1));
  for (int i = 0; i < 4; ++i) store<1>(rows.at(Index<1>{{i}}), 0, gasAt(1, 0.3, 2));
  fillBeyondGrid<1>(grid.level(), ghostRules<1>(grid.level(), gas), rows);
  return load<1>(rows.at(Index<1>{{-1}}), 0);
}

}  // namespace

TEST(GasSides, LetGasOutWhereNothingIsGiven) { EXPECT_EQ(beyond({}), gasAt(1, 0.3, 2)); }

TEST(GasSides, TakeANeumannConditionForNone) {
  EXPECT_EQ(beyond({{boundary::density, BoundaryKind::neumann, Vec3::Zero()},
                    {boundary::velocity, BoundaryKind::neumann, Vec3::Zero()}}),
            gasAt(1, 0.3, 2));
}

TEST(GasSides, MirrorTheGasInAWall) {
  const State<1> wall = gasAt(1, -0.3, 2);
  EXPECT_EQ(beyond({{grid::symmetric, BoundaryKind::symmetry}}), wall);
  EXPECT_EQ(beyond({given(boundary::velocity, 0)}), wall);
  EXPECT_EQ(beyond({given(boundary::velocity, 0), given(boundary::temperature, 5)}), wall);
}

TEST(GasSides, LetGasOfAVelocityIn) {
  EXPECT_EQ(beyond({given(boundary::velocity, 0.7)}), gasAt(1, 0.7, 2));
  EXPECT_EQ(beyond({given(boundary::velocity, 0), given(boundary::pressure, 3)}), gasAt(1, 0, 3));
}

TEST(GasSides, MakeTheThirdOfDensityPressureAndTemperature) {
  // R = (gamma - 1) c_v = 1 but for round-off.
  const auto expectNear = [](const State<1>& found, const State<1>& expected) {
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-14);
  };
  expectNear(beyond({given(boundary::temperature, 4), given(boundary::density, 0.5)}), gasAt(0.5, 0.3, 2));
  expectNear(beyond({given(boundary::temperature, 4), given(boundary::pressure, 8)}), gasAt(2, 0.3, 8));
  expectNear(beyond({given(boundary::temperature, 4)}), gasAt(0.5, 0.3, 2));
}

TEST(GasSides, TakeConditionsOfTheirMaterialAndThePressureOfAll) {
  Gas second = air();
  second.material = 1;
  const Conditions conditions{given(boundary::density, 3, 0), given(boundary::density, 5, 1),
                              given(boundary::pressure, 7, 0)};
  EXPECT_EQ(beyond(conditions, second), gasAt(5, 0.3, 7));
}

}  // namespace tushar::euler
