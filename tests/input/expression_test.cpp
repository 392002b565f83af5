#include "core/input/expression.hpp"

#include <cmath>
#include <vector>

#include "core/base/threads.hpp"
#include "tests/input/support.hpp"

namespace tushar::input {
namespace {

const Vec3 point(2, 3, 5);

TEST(Expression, IsConstantWhenItIsANumber) {
  const Expression expression = *Expression::parse(" 1e5 ");

  EXPECT_TRUE(expression.isConstant());
  EXPECT_EQ(expression(point), 1e5);
  EXPECT_EQ(expression.text(), "1e5");
}

TEST(Expression, IsConstantWithoutVariables) {
  const Expression expression = *Expression::parse("2*pi + ln(e)");

  EXPECT_TRUE(expression.isConstant());
  EXPECT_DOUBLE_EQ(expression(point), 2 * M_PI + 1);
}

TEST(Expression, DependsOnPlaceAndTime) {
  const Expression expression = *Expression::parse("x + 10*y + 100*z + 1000*t");

  EXPECT_FALSE(expression.isConstant());
  EXPECT_TRUE(expression.dependsOnTime());
  EXPECT_EQ(expression(point, 7), 7532);
}

TEST(Expression, TellsExponentsFromTheConstantE) {
  EXPECT_EQ((*Expression::parse("1e5*x"))(point), 2e5);
  EXPECT_DOUBLE_EQ((*Expression::parse("e^x"))(point), std::exp(2.0));
}

TEST(Expression, KnowsConditions) {
  const Expression expression = *Expression::parse("x < 2.5 && y == 3 ? 1 : 2");

  EXPECT_EQ(expression(point), 1);
  EXPECT_EQ(expression({3, 3, 0}), 2);
  EXPECT_FALSE(expression.dependsOnTime());
}

TEST(Expression, IsIndependentOfItsCopies) {
  Expression copy;
  {
    const Expression original = *Expression::parse("2*x");
    copy = original;
    EXPECT_EQ(original({1, 0, 0}), 2);
  }

  EXPECT_EQ(copy({3, 0, 0}), 6);
}

TEST(Expression, SaysWhyTextIsNoFormula) {
  EXPECT_EQ(Expression::parse("").problem, "found nothing, expected a number or a formula");
  EXPECT_EQ(Expression::parse("1e999").problem, "found '1e999', which is outside the range of a double");
  EXPECT_EQ(Expression::parse("x=2").problem,
            "found 'x=2', expected a formula in x, y, z and t: '=' would assign to a variable");
  EXPECT_EQ(Expression::parse("x,y").problem,
            "found 'x,y', expected a formula in x, y, z and t: it has several results");
  EXPECT_EQ(Expression::parse("1/0").problem, "found '1/0', which is not a finite number");
  EXPECT_EQ(Expression::parse("nan").problem,
            "found 'nan', expected a formula in x, y, z and t: Unexpected token \"nan\" found at position 0.");
}

TEST(Expression, IsEvaluatedBySeveralThreadsAtOnce) {
  const Expression formula = *Expression::parse("sin(x) + y*t");
  Threads threads(4);
  std::vector<double> found(10000);

  threads.forEach(static_cast<int>(found.size()), [&](int k) { found[k] = formula({k * 0.1, 2, 0}, k); });

  for (int k = 0; k < static_cast<int>(found.size()); ++k) ASSERT_EQ(found[k], std::sin(k * 0.1) + 2.0 * k);
}

TEST(VectorExpression, SplitsAtTheOuterCommas) {
  const VectorExpression expression = *VectorExpression::parse("[ max(x, 1), 2, t ]");

  EXPECT_EQ(expression(point, 4), Vec3(2, 2, 4));
  EXPECT_FALSE(expression.isConstant());
  EXPECT_TRUE(expression.dependsOnTime());
  EXPECT_TRUE(expression[1].isConstant());
  EXPECT_EQ(expression.text(), "[max(x, 1),2,t]");
}

TEST(VectorExpression, SaysWhyTextIsNotThreeFormulas) {
  EXPECT_EQ(VectorExpression::parse("1").problem, "found '1', expected three formulas, such as [a,b,c]");
  EXPECT_EQ(VectorExpression::parse("").problem, "found nothing, expected three formulas, such as [a,b,c]");
  EXPECT_EQ(VectorExpression::parse("[1,2]").problem, "found '[1,2]', expected three formulas, such as [a,b,c]");
  EXPECT_EQ(VectorExpression::parse("[1,,2]").problem, "in '[1,,2]': found nothing, expected a number or a formula");
}

}  // namespace
}  // namespace tushar::input
