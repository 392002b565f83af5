#include <gtest/gtest.h>

#include "components/euler/boundary.hpp"
#include "components/euler/tasks/advance_mixture.hpp"
#include "tests/euler/gas_box.hpp"

// Gas that enters through the sides of the grid.

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

/// Returns the ghost state at the lower side of a line of cells with density 1, velocity .3 and pressure 2.
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

grid::BoundaryCondition varying(const grid::BoundaryVariable& label, const std::string& formula) {
  grid::BoundaryCondition condition = given(label, 0);
  condition.formula = std::make_shared<const input::VectorExpression>(
      input::VectorExpression({*input::Expression::parse(formula), input::Expression(), input::Expression()}));
  return condition;
}

/// The states of 4 x 4 cells and two layers of ghost cells, with side parts on x-; the density numbers the cells.
class Square {
 public:
  explicit Square(const grid::Domain& domain, double time = 0) : grid_(domain) {
    rows_.hold(grid_.level().cells().grown(2, 2));
    forEach<2>(grid_.level().cells(), [&](const Index<2>& cell) {
      store<2>(rows_.at(cell), 0, {1.0 + 4 * cell[1] + cell[0], 0.3, 0.2, 2});
    });
    fillBeyondGrid<2>(grid_.level(), ghostRules<2>(grid_.level(), gas_, time), rows_);
  }
  State<2> at(int x, int y) { return load<2>(rows_.at(Index<2>{{x, y}}), 0); }

 private:
  Gas gas_ = air();
  Grid grid_;
  Rows<2> rows_{64};
};

/// A domain with walls all around, and a jet of density 9 through the faces of cells (0, 0) and (0, 1) on x-.
grid::Domain withJet() {
  grid::Domain domain = closedBox(2, 4);
  domain.boundaries.parts[0] = {{grid::SidePart::rectangle(0, Vec3::Zero(), Vec3(0, 0.5, 1)),
                                 {given(boundary::density, 9), given(boundary::velocity, 4)}}};
  return domain;
}

}  // namespace

TEST(GasSides, LetAJetInThroughAPart) {
  Square square(withJet());
  for (const int x : {-1, -2}) {
    EXPECT_EQ(square.at(x, 1), (State<2>{9, 4, 0, 2}));
    EXPECT_EQ(square.at(x, 2), (State<2>{9.0 - 1 - x, -0.3, 0.2, 2}));
  }
  EXPECT_EQ(square.at(4, 1), (State<2>{8, -0.3, 0.2, 2}));
}

TEST(GasSides, TellTheRuleOfTheFaceOfACell) {
  const Grid grid(withJet());
  const GhostRules<2> rules = ghostRules<2>(grid.level(), air());
  EXPECT_FALSE(ruleAt<2>(grid.level(), rules, 0, 0, Index<2>{{0, 1}}).mirrored);
  EXPECT_EQ(ruleAt<2>(grid.level(), rules, 0, 0, Index<2>{{0, 1}}).value[kDensity], 9);
  EXPECT_TRUE(ruleAt<2>(grid.level(), rules, 0, 0, Index<2>{{0, 2}}).mirrored);
  EXPECT_TRUE(ruleAt<2>(grid.level(), rules, 1, 0, Index<2>{{0, 0}}).mirrored);
}

TEST(GasSides, MirrorAPartInAWallAcross) {
  Square square(withJet());
  EXPECT_EQ(square.at(-1, -1), (State<2>{9, 4, 0, 2}));
  grid::Domain turned =
      closedBox(2, 4);  // the jet on y-, through the second face: beyond x- the axis before is mirrored
  turned.boundaries.parts[2] = {
      {grid::SidePart::rectangle(1, Vec3(0.25, 0, 0), Vec3(0.5, 0, 1)), {given(boundary::density, 9)}}};
  Square other(turned);
  EXPECT_EQ(other.at(1, -1)[kDensity], 9);
  EXPECT_EQ(other.at(-2, -1)[kDensity], 9);
  EXPECT_EQ(other.at(-1, -1), (State<2>{1, -0.3, -0.2, 2}));
}

TEST(GasSides, TakeFormulasInTheMiddleOfCellsBeyond) {
  grid::Domain domain = closedBox(2, 4);
  domain.boundaries.face(0, 1) = {varying(boundary::density, "100*x + 10*y + t")};
  Square square(domain, 3);
  EXPECT_DOUBLE_EQ(square.at(4, 1)[kDensity], 112.5 + 3.75 + 3);
  EXPECT_DOUBLE_EQ(square.at(5, 2)[kDensity], 137.5 + 6.25 + 3);
  EXPECT_EQ(square.at(4, 1)[kPressure<2>], 2);
  EXPECT_DOUBLE_EQ(square.at(4, -1)[kDensity], 112.5 + 1.25 + 3) << "mirrored";
}

TEST(GasSides, RefuseAFormulaThatGivesNoDensity) {
  grid::Domain domain = closedBox(2, 4);
  domain.boundaries.face(0, 1) = {varying(boundary::density, "2 - t")};
  EXPECT_NO_THROW(Square(domain, 1));
  try {
    Square(domain, 2);
    FAIL() << "a density of 0";
  } catch (const NumericalError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 34), "Density at side x+ is 0 kg/m^3, bu");
  }
}

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

TEST(GasSides, GiveSeveralGasesThePressureWhateverTheFirstOneIs) {
  const ColdCurve cold{.kind = ColdCurve::Kind::murnaghan, .density = 1, .exponent = 2, .compressibility = 1};
  Settings solid, second;
  solid.gas = {.specificHeat = 1, .law = std::make_shared<const Gas::Law>(CurvedGas(cold, 0, 1))};
  second.gas = air();
  grid::Domain domain = openBox(1, 4);
  domain.boundaries.face(0, 0) = {given(boundary::pressure, 7)};
  const Grid grid(domain);
  const GhostRule<1> rule = ghostRulesOf<1>(grid.level(), solid.gas, {solid, second})[0][0];
  EXPECT_EQ(rule.factor, (State<1>{1, 1, 0}));
  EXPECT_EQ(rule.value, (State<1>{0, 0, 7}));
}

TEST(GasSides, MeetInCornersThatDoNotDependOnTheOrderOfAxes) {
  const auto wind = [](const Vec3& v) {
    return grid::BoundaryCondition{boundary::velocity, BoundaryKind::dirichlet, v, -1};
  };
  grid::Domain domain = openBox(2, 4), turned = domain;  // turned: x and y are exchanged
  domain.boundaries.face(0, 0) = {given(boundary::density, 9), wind({4, 1, 0})};
  domain.boundaries.face(1, 0) = {given(boundary::density, 5), wind({2, -3, 0})};
  turned.boundaries.face(1, 0) = {given(boundary::density, 9), wind({1, 4, 0})};
  turned.boundaries.face(0, 0) = {given(boundary::density, 5), wind({-3, 2, 0})};
  domain.boundaries.face(0, 1) = turned.boundaries.face(1, 1) = {{grid::symmetric, BoundaryKind::symmetry}};
  Square square(domain), other(turned);
  for (const int i : {-1, -2})
    for (const int j : {-1, -2}) {
      EXPECT_EQ(square.at(i, j), (State<2>{7, 3, -1, 2})) << "the mean";
      EXPECT_EQ(other.at(j, i), (State<2>{7, -1, 3, 2}));
      // A wall and an inflow: the order does not matter.
      EXPECT_EQ(square.at(3 - i, j)[kDensity], 5);
      EXPECT_EQ(square.at(3 - i, j)[kVelocity(0)], other.at(j, 3 - i)[kVelocity(1)]);
    }
}

TEST(GasSides, MeetInCornersAsBeforeIfTheirRulesCommute) {
  Square square(closedBox(2, 4));
  EXPECT_EQ(square.at(-1, -2), (State<2>{1 + 4, -0.3, -0.2, 2}));
  grid::Domain domain = openBox(2, 4);
  for (const int axis : {0, 1}) domain.boundaries.face(axis, 0) = {given(boundary::density, 9)};
  EXPECT_EQ(Square(domain).at(-2, -1), (State<2>{9, 0.3, 0.2, 2}));
}

TEST(GasSides, RaiseAPressureThatContinuesByTheWeightOfTheGas) {
  const double h = 0.25;
  Gas heavy = air();
  heavy.gravity = Vec3(-0.4, 0, 0);
  const double perDensity = 1.4 * 2;  // c²; the entropy stays
  EXPECT_EQ(beyond({}, heavy), (State<1>{1 + 0.4 * h / perDensity, 0.3, 2 + 0.4 * h})) << "x- is below";
  heavy.push = Vec3(0.1, 0, 0);
  const State<1> pushed = beyond({}, heavy);
  EXPECT_DOUBLE_EQ(pushed[kDensity], 1 + 0.3 * h / perDensity);
  EXPECT_EQ(pushed[kPressure<1>], 2 + 0.4 * h - 0.1 * h);
  heavy.push.setZero();
  EXPECT_EQ(beyond({given(boundary::pressure, 3)}, heavy), (State<1>{1, 0.3, 3})) << "a given pressure stays";
  EXPECT_EQ(beyond({given(boundary::density, 3)}, heavy), (State<1>{3, 0.3, 2 + 2 * 0.4 * h})) << "the mean density";
  EXPECT_EQ(beyond({{grid::symmetric, BoundaryKind::symmetry}}, heavy), (State<1>{1, -0.3, 2})) << "walls mirror";
  heavy.gravity = Vec3(100, 0, 0);
  EXPECT_GT(beyond({}, heavy)[kPressure<1>], 0) << "on cells that are too coarse, the pressure remains positive";
}

TEST(GasSides, ThatRelaxKnowTheWeightOfTheGas) {
  // The pressure far away is that at the side, so there is nothing to relax.
  Gas heavy = air();
  heavy.gravity = Vec3(-0.4, 0, 0);
  const grid::BoundaryCondition waves{boundary::waves, BoundaryKind::dirichlet, Vec3(2 + 0.05, 0.27, 0)};
  EXPECT_DOUBLE_EQ(beyond({waves}, heavy)[kVelocity(0)], 0.3);
  EXPECT_DOUBLE_EQ(beyond({waves}, heavy)[kPressure<1>], 2.1);
}

TEST(GasSides, GiveNoPressureThatRisesAlongAPeriodicAxis) {
  grid::Domain domain = openBox(2, 4);
  domain.periodic[0] = 1;
  domain.boundaries.face(1, 0) = {given(boundary::pressure, 2)};
  const Grid grid(domain);
  Gas gas = air();
  gas.weight = Vec3(0.2, -0.1, 0);
  const Place place{grid.level(), 1, 0, grid::restOfSide, Vec3(0.875, -0.125, 0.5)};
  EXPECT_DOUBLE_EQ(*pressureAt(place, gas), 2 + 0.1 * 0.25);
}

}  // namespace tushar::euler
