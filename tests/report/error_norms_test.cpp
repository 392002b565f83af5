#include "core/report/error_norms.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/data/reduction.hpp"

namespace tushar::report {

namespace {

using data::Norm;

constexpr data::ReductionLabel<Norm> label{"Error.density", "kg/m^3", "error"};
const MeasuredError error{"density", "cell", &label, {"L1", "L2", "max", "relative"}};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Returns the norm of an error `e` where the exact value has the given magnitude.
Norm normOf(double e, double magnitude) {
  Norm norm;
  norm.add(e, magnitude);
  return norm;
}

}  // namespace

TEST(ErrorNorms, HaveEachItsNumber) {
  Norm norm = normOf(-3, 4);
  norm.add(1, 4);

  const ErrorNorms norms = normsOf(error, norm.values());

  EXPECT_EQ(norms.norms,
            (std::map<std::string, double>{{"L1", 2}, {"L2", std::sqrt(5.0)}, {"max", 3}, {"relative", 0.5}}));
  EXPECT_EQ(unmeasurable({norms}), std::nullopt);
}

TEST(ErrorNorms, OfAFieldThatIsZeroEverywhereAreNotRelative) {
  for (const double e : {0.0, 2.0}) {
    const ErrorNorms norms = normsOf(error, normOf(e, 0).values());

    EXPECT_EQ(norms.norms, (std::map<std::string, double>{{"L1", e}, {"L2", e}, {"max", e}}));
    EXPECT_EQ(unmeasurable({norms}), std::nullopt);
  }
}

TEST(ErrorNorms, OfNothingAreNone) {
  const MeasuredError greatest{"mass_projection", "", &label, {"max"}};

  EXPECT_TRUE(normsOf(error, Norm().values()).norms.empty());
  EXPECT_TRUE(normsOf(error, {}).norms.empty());
  EXPECT_TRUE(normsOf(greatest, data::Maximum().values()).norms.empty());
}

TEST(ErrorNorms, ThatAreNotFiniteAreNamed) {
  for (const double value : {nan, std::numeric_limits<double>::infinity()}) {
    Norm norm = normOf(1, 1);
    norm.add(value, 1);

    const auto sentence = unmeasurable({normsOf(error, normOf(1, 1).values()), normsOf(error, norm.values())});

    ASSERT_TRUE(sentence);
    EXPECT_EQ(*sentence,
              "the report has no errors at the end of the run, because the L1 norm of the error of density, cell, is "
              "not finite");
  }
}

}  // namespace tushar::report
