#include "core/numerics/checked_formula.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/levels.hpp"

namespace tushar::numerics {

namespace {

const input::Expression& inverse() {
  static const input::Expression formula = [] {
    input::Expression parsed = *input::Expression::parse("1/x");
    parsed.readAt({"a.ups", 3, 5});
    return parsed;
  }();
  return formula;
}

/// Returns the error message for a refused value at `x`.
std::string refusal(const CheckedFormula& formula, double x) {
  try {
    formula.positiveAt(Vec3(x, 0, 0));
  } catch (const InputError& error) {
    return error.problems().at(0).text();
  }
  return "";
}

}  // namespace

TEST(CheckedFormula, GivesItsValue) {
  const CheckedFormula formula{inverse(), "Heat/temperature", "K"};

  EXPECT_EQ(formula.finiteAt(Vec3(-4, 0, 0)), -0.25);
  EXPECT_EQ(formula.positiveAt(Vec3(4, 0, 0)), 0.25);
}

TEST(CheckedFormula, SaysWhereItIsNotWhatItMustBe) {
  const CheckedFormula formula{inverse(), "Heat/temperature", "K"};

  EXPECT_THROW(formula.finiteAt(Vec3::Zero()), InputError);
  EXPECT_EQ(
      refusal(formula, -0.5),
      "a.ups:3:5: Heat/temperature: it is -2 K at (-0.5, 0, 0), but must be finite and greater than 0 everywhere");
}

TEST(CheckedFormula, NamesNoUnitOfANumberWithoutDimension) {
  const CheckedFormula formula{inverse(), "Poisson/coefficient", ""};

  EXPECT_EQ(
      refusal(formula, -0.5),
      "a.ups:3:5: Poisson/coefficient: it is -2 at (-0.5, 0, 0), but must be finite and greater than 0 everywhere");
}

TEST(CheckedFormula, FillsAPatchAndIsCheckedInEveryCell) {
  const grid::Grid grid(test::domain({{4, 1, 1}}));
  const grid::Level& level = grid.level();
  std::vector<double> values(4);
  const CheckedFormula formula{inverse(), "Heat/temperature", "K"};

  formula.fill<1>(grid.patches().front(), data::CellView<double>(values.data(), level.cells()));
  for (int k = 0; k < 4; ++k) EXPECT_EQ(values[k], 1 / level.cellCentre<1>(Index<1>{{k}})[0]);
  EXPECT_NO_THROW(formula.requirePositive<1>(grid.patches().front()));
  const input::Expression early = *input::Expression::parse("1.5*0.25-x");
  EXPECT_THROW((CheckedFormula{early, "Heat/temperature", "K"}.requirePositive<1>(grid.patches().front())), InputError);
}

}  // namespace tushar::numerics
