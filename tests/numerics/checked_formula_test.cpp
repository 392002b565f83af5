#include "core/numerics/checked_formula.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tushar::numerics {

namespace {

const input::Expression& inverse() {
  static const input::Expression formula = *input::Expression::parse("1/x");
  return formula;
}

/// What the user reads of a value at `x` that is refused.
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
  const CheckedFormula formula{inverse(), {}, "Heat/temperature", "K"};

  EXPECT_EQ(formula.finiteAt(Vec3(-4, 0, 0)), -0.25);
  EXPECT_EQ(formula.positiveAt(Vec3(4, 0, 0)), 0.25);
}

TEST(CheckedFormula, SaysWhereItIsNotWhatItMustBe) {
  const CheckedFormula formula{inverse(), {"a.ups", 3, 5}, "Heat/temperature", "K"};

  EXPECT_THROW(formula.finiteAt(Vec3::Zero()), InputError);
  EXPECT_EQ(
      refusal(formula, -0.5),
      "a.ups:3:5: Heat/temperature: it is -2 K at (-0.5, 0, 0), and must be finite and greater than 0 everywhere");
}

TEST(CheckedFormula, NamesNoUnitOfANumberWithoutDimension) {
  const CheckedFormula formula{inverse(), {"a.ups", 3, 5}, "Poisson/coefficient", ""};

  EXPECT_EQ(
      refusal(formula, -0.5),
      "a.ups:3:5: Poisson/coefficient: it is -2 at (-0.5, 0, 0), and must be finite and greater than 0 everywhere");
}

}  // namespace tushar::numerics
