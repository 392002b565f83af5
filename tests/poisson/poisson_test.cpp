#include "components/poisson/poisson.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/poisson/solved.hpp"

namespace tushar::poisson {

namespace {

/// Returns the order of convergence between `cells` and twice as many.
template <int D, class Make>
double order(int cells, const Make& make, const Settings& settings, const std::string& exact) {
  const double coarse = solved<D>(make(cells), settings, exact).error;
  return std::log2(coarse / solved<D>(make(2 * cells), settings, exact).error);
}

grid::Domain oneDimension(int cells) {
  grid::Domain domain = test::unitBox<1>(cells);
  condition(domain, 0, 0, BoundaryKind::dirichlet, 2);
  condition(domain, 0, 1, BoundaryKind::neumann, 1 - M_PI);
  return domain;
}
grid::Domain repeated(int cells) {
  grid::Domain domain = test::unitBox<2>(cells);
  domain.periodic = {{1, 1, 0}};
  return domain;
}

/// Returns the message about a system without a solution, with its remedy.
template <int D>
std::pair<std::string, std::string> refusal(const grid::Domain& domain, const Settings& settings) {
  try {
    solved<D>(domain, settings, "0");
  } catch (const NumericalError& error) {
    return {error.what(), error.advice()};
  }
  return {"nothing", "nothing"};
}

}  // namespace

TEST(Poisson, IsOfSecondOrderInOneDimensionWithAValueAndASlopeGiven) {
  // phi = 2 + x + sin(pi x), k = 1 + x
  const Settings settings = settingsOf("1 + pi*cos(pi*x) - (1 + x)*pi^2*sin(pi*x)", "1 + x");
  EXPECT_NEAR((order<1>(16, oneDimension, settings, "2 + x + sin(pi*x)")), 2, 0.1);
}

TEST(Poisson, IsOfSecondOrderInTwoDimensionsBetweenKeptSides) {
  const Settings settings = settingsOf("-2*pi^2*sin(pi*x)*sin(pi*y)");
  EXPECT_NEAR((order<2>(12, keptAtOne<2>, settings, "1 + sin(pi*x)*sin(pi*y)")), 2, 0.1);
}

TEST(Poisson, IsOfSecondOrderInThreeDimensionsBetweenKeptSides) {
  const Settings settings = settingsOf("-3*pi^2*sin(pi*x)*sin(pi*y)*sin(pi*z)");
  EXPECT_NEAR((order<3>(8, keptAtOne<3>, settings, "1 + sin(pi*x)*sin(pi*y)*sin(pi*z)")), 2, 0.1);
}

TEST(Poisson, IsOfSecondOrderInAPeriodicBoxWhereAConstantIsFree) {
  const Settings settings = settingsOf("-8*pi^2*sin(2*pi*x)*cos(2*pi*y)");
  EXPECT_NEAR((order<2>(12, repeated, settings, "sin(2*pi*x)*cos(2*pi*y)")), 2, 0.1);
}

TEST(Poisson, TakesASourceThatTheSlopesAtTheFacesBalance) {
  // phi = 1.5 x² - x less its mean; the error of a parabola is the same everywhere, so a mean of 0 removes it.
  EXPECT_LT(solved<1>(betweenSlopes(8, 1, 2), settingsOf("3"), "1.5*x*x - x + 1.5/(12*64)").error, 1e-9);
}

TEST(Poisson, RefusesASourceThatNothingBalances) {
  for (const auto& [what, advice] :
       {refusal<2>(repeated(8), settingsOf("3 + sin(2*pi*x)")), refusal<1>(betweenSlopes(8, 1, 1), settingsOf("5"))}) {
    EXPECT_NE(what.find("the integral of the source exceeds that of k dphi/dn over the faces by 3"), std::string::npos)
        << what;
    EXPECT_NE(advice.find("smaller by 3 everywhere"), std::string::npos) << advice;
  }
}

TEST(Poisson, TakesTheSourceOfTheEndOfTheStep) {
  // The step goes from t = 0.5 to 1; the error of a parabola is h²/4 everywhere, because of the half cells at the sides
  // with given values.
  const Settings settings = settingsOf("2*t");
  EXPECT_NEAR(solved<1>(keptAtOne<1>(8), settings, "1 + x*(x - 1)").error, 1.0 / (4 * 64), 1e-9);
}

TEST(Poisson, NeedsHardlyMoreIterationsOnFinerGrids) {
  const Settings settings = settingsOf("1");
  const double coarse = solved<3>(keptAtOne<3>(8), settings, "0").iterations;
  const double fine = solved<3>(keptAtOne<3>(24), settings, "0").iterations;
  EXPECT_GT(coarse, 1);
  EXPECT_LT(fine, 1.5 * coarse);
}

TEST(Poisson, GivesTheSameBitsOnAnyPatches) {
  const Settings settings = settingsOf("-2*pi^2*sin(pi*x)*sin(pi*y)");
  grid::Domain one = keptAtOne<2>(12), many = one;
  one.patches = {{1, 1, 1}};
  many.patches = {{5, 3, 1}};
  const Solved alone = solved<2>(one, settings, "0"), shared = solved<2>(many, settings, "0");
  EXPECT_EQ(alone.iterations, shared.iterations);
  EXPECT_EQ(alone.phi, shared.phi);
}

TEST(Poisson, KeepsTheFluxOverAJumpOfTheCoefficient) {
  // phi is piecewise linear: k phi' = 1 on both sides of the jump at .5.
  grid::Domain domain = test::unitBox<1>(8);
  condition(domain, 0, 0, BoundaryKind::dirichlet, 0);
  condition(domain, 0, 1, BoundaryKind::dirichlet, 0.5 + 0.5e-6);
  Settings settings = settingsOf("0", "x < 0.5 ? 1 : 1e6");
  settings.solver = {"preonly", "lu", 1e-10, 1, ""};  // leaves rounding times 1e6
  EXPECT_LT(solved<1>(domain, settings, "x < 0.5 ? x : 0.5 + (x - 0.5)*1e-6").error, 1e-10);
}

TEST(Poisson, TellsThatTheSolverGaveUpAndWhatToTry) {
  Settings settings = settingsOf("1");
  settings.solver.maxIterations = 1;
  settings.solver.preconditioner = "none";
  try {
    solved<2>(keptAtOne<2>(12), settings, "0");
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("Poisson's equation did not converge: more iterations than allowed, after 1 iteration;"),
              std::string::npos);
    EXPECT_NE(error.advice().find("<preconditioner>"), std::string::npos);
  }
}

}  // namespace tushar::poisson
