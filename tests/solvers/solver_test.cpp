#include "core/solvers/solver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tushar::solvers {

namespace {

Unknowns row(int count) {
  Unknowns unknowns;
  unknowns.owned = count;
  unknowns.entries.assign(count, 3);
  return unknowns;
}

/// -x'' for a row of values with x = 0 beyond its ends, or without flux through them if `closed`.
void laplacian(Matrix& matrix, int count, bool closed) {
  for (int k = 0; k < count; ++k) {
    const bool first = k == 0, last = k == count - 1;
    const std::vector<int> columns{k, first ? -1 : k - 1, last ? -1 : k + 1};
    const double diagonal = closed && (first || last) ? 1 : 2;
    matrix.add({columns.data(), 1}, columns, std::vector<double>{diagonal, -1, -1});
  }
}

/// u_k² = 2 + k for each of three unknowns; the residual is undefined for u < 0.
class Roots : public NonlinearProblem {
 public:
  bool residual(std::span<const double> u, std::span<double> r) override {
    u_.assign(u.begin(), u.end());
    for (std::size_t k = 0; k < u.size(); ++k) r[k] = u[k] * u[k] - 2 - static_cast<double>(k);
    return std::all_of(u.begin(), u.end(), [](double value) { return value >= 0; });
  }
  void tangent(Matrix& matrix) override {
    for (int k = 0; k < 3; ++k) matrix.add({&k, 1}, {&k, 1}, std::vector<double>{2 * u_[k]});
  }

 private:
  std::vector<double> u_;
};

/// ln u = 0, undefined for u <= 0. Newton's step from u is -u ln u, which leads from 10 to -13.
class Logarithm : public NonlinearProblem {
 public:
  bool residual(std::span<const double> u, std::span<double> r) override {
    u_ = u[0];
    r[0] = u_ > 0 ? std::log(u_) : 0;
    return u_ > 0;
  }
  void tangent(Matrix& matrix) override {
    const int zero = 0;
    matrix.add({&zero, 1}, {&zero, 1}, std::vector<double>{1 / u_});
  }

 private:
  double u_ = 0;
};

/// arctan(10 u) = 0. Newton's step leads from u = 1 to -14, and from there further away.
class Plateau : public NonlinearProblem {
 public:
  bool residual(std::span<const double> u, std::span<double> r) override {
    u_ = u[0];
    r[0] = std::atan(10 * u_);
    return true;
  }
  void tangent(Matrix& matrix) override {
    const int zero = 0;
    matrix.add({&zero, 1}, {&zero, 1}, std::vector<double>{10 / (1 + 100 * u_ * u_)});
  }

 private:
  double u_ = 0;
};

/// A chain of 26 springs of 1, a force of 1 on the last, and one more unknown with very little stiffness: a particle
/// that has just reached into the next cell touches its node with a slope of 4e-6.
class Chain : public NonlinearProblem {
 public:
  static constexpr int links = 26;

  bool residual(std::span<const double> u, std::span<double> r) override {
    for (int k = 0; k < links; ++k)
      r[std::size_t(k)] = (k == links - 1 ? 1 : 2) * u[std::size_t(k)] - (k > 0 ? u[std::size_t(k) - 1] : 0) -
                          (k < links - 1 ? u[std::size_t(k) + 1] : 1);
    const double stretch = u[links - 1] - u[links - 2];
    r[links - 1] += slope * u[links];
    r[links - 2] -= slope * u[links];
    r[links] = slope * stretch + held * u[links];
    return true;
  }
  void tangent(Matrix& matrix) override {
    laplacian(matrix, links, false);
    const int last = links - 1, weak = links;
    const std::array<int, 3> touched{links - 2, last, weak};
    matrix.add({&last, 1}, {&last, 1}, std::vector<double>{-1});
    matrix.add({&touched[0], 2}, {&weak, 1}, std::vector<double>{-slope, slope});
    matrix.add({&weak, 1}, touched, std::vector<double>{-slope, slope, held});
  }

 private:
  static constexpr double slope = 4.2e-6, held = 8.6e-11;
};

class Throwing : public Roots {
  void tangent(Matrix&) override { throw std::out_of_range("the material has no tangent"); }
};

NewtonSettings directNewton() {
  NewtonSettings settings;
  settings.linear = {"preonly", "lu", 1e-10, 10, ""};
  return settings;
}

}  // namespace

TEST(Solver, SolvesALinearSystemByEveryMethod) {
  for (const auto& [method, preconditioner] :
       {std::pair{"cg", "gamg"}, {"cg", "hypre"}, {"gmres", "ilu"}, {"bcgs", "jacobi"}, {"preonly", "lu"}}) {
    const int count = 40;
    std::vector<double> b(count, 1), x(count, 0);

    const Outcome outcome = solver().solve(row(count), {[](Matrix& a) { laplacian(a, 40, false); }, b},
                                           {method, preconditioner, 1e-12, 1000, ""}, x);

    ASSERT_TRUE(outcome.converged) << method << ' ' << preconditioner << ' ' << outcome.reason;
    // x_k = k (n + 1 - k) / 2; the condition number of about 700 multiplies the tolerance.
    for (int k = 0; k < count; ++k) EXPECT_NEAR(x[std::size_t(k)], 0.5 * (k + 1) * (count - k), 1e-7) << method;
  }
}

TEST(Solver, TakesTheSolutionOfMeanZeroWhereAConstantIsFree) {
  const int count = 32;
  Unknowns unknowns = row(count);
  unknowns.constantIsFree = true;
  std::vector<double> b(count), x(count, 5);
  for (int k = 0; k < count; ++k) b[std::size_t(k)] = 1 + (k < count / 2 ? 1 : -1);  // 1 of it cannot be balanced

  const Outcome outcome =
      solver().solve(unknowns, {[](Matrix& a) { laplacian(a, 32, true); }, b}, {"cg", "gamg", 1e-12, 100, ""}, x);

  EXPECT_TRUE(outcome.converged);
  double mean = 0;
  for (const double value : x) mean += value / count;
  EXPECT_NEAR(mean, 0, 1e-10);
  EXPECT_NEAR(x.front() - x[1], 1, 1e-9);
}

TEST(Solver, TellsHowASolveFailed) {
  std::vector<double> b(40, 1), x(40, 0);

  const Outcome outcome =
      solver().solve(row(40), {[](Matrix& a) { laplacian(a, 40, false); }, b}, {"cg", "none", 1e-12, 3, ""}, x);

  EXPECT_FALSE(outcome.converged);
  EXPECT_EQ(outcome.residuals.size(), 4U);
  EXPECT_TRUE(outcome.worst >= 0 && outcome.worst < 40);
  const std::string sentence = sentenceOf("a row", outcome);
  EXPECT_EQ(sentence.find("a row did not converge: more iterations than allowed (DIVERGED_ITS), after 3 iterations; "
                          "residuals 6.32, "),
            0U)
      << sentence;
}

TEST(Solver, TellsWhyAPreconditionerFailed) {
  std::vector<double> b(4, 1), x(4, 0);

  const Outcome outcome =
      solver().solve(row(4), {[](Matrix& a) { laplacian(a, 4, true); }, b}, {"preonly", "lu", 1e-12, 1, ""}, x);

  EXPECT_FALSE(outcome.converged);
  EXPECT_EQ(outcome.reason,
            "the preconditioner could not be built, which happens if the matrix is singular (DIVERGED_PC_FAILED)");
}

TEST(Solver, TellsByHowMuchARightHandSideIsUnbalancedWhereAConstantIsFree) {
  Unknowns unknowns = row(4);
  unknowns.constantIsFree = true;
  std::vector<double> b{3, -1, 1, -2}, x(4, 0);

  const Outcome outcome =
      solver().solve(unknowns, {[](Matrix& a) { laplacian(a, 4, true); }, b}, {"cg", "jacobi", 1e-12, 100, ""}, x);

  EXPECT_EQ(outcome.unbalanced, 1);
  EXPECT_EQ(outcome.loads, 7);
}

TEST(Solver, PassesOptionsThroughToPetsc) {
  std::vector<double> b(40, 1), x(40, 0);

  const Outcome outcome = solver().solve(row(40), {[](Matrix& a) { laplacian(a, 40, false); }, b},
                                         {"cg", "none", 1e-12, 1000, "-ksp_max_it 2"}, x);

  EXPECT_EQ(outcome.krylovIterations, 2);
}

TEST(Solver, GivesTheOptionsOfASolveToNoOther) {
  const auto iterations = [](const char* options) {
    std::vector<double> b(40, 1), x(40, 0);
    return solver()
        .solve(row(40), {[](Matrix& a) { laplacian(a, 40, false); }, b}, {"cg", "none", 1e-12, 1000, options}, x)
        .krylovIterations;
  };
  const int before = iterations("");

  EXPECT_LT(iterations("-ksp_max_it 2"), before);
  EXPECT_EQ(iterations(""), before);
}

/// Newton's method with LU factors by PETSc and without it.
class DirectNewton : public testing::TestWithParam<bool> {
 protected:
  static Outcome solve(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings,
                       std::span<double> u) {
    return GetParam() ? solver().solve(unknowns, problem, settings, u) : solvers::solve(unknowns, problem, settings, u);
  }
  template <class Problem>
  static void expectRoot(double root, double start) {
    std::vector<double> u{start};
    Problem problem;

    const Outcome outcome = solve(row(1), problem, directNewton(), u);

    EXPECT_TRUE(outcome.converged) << outcome.reason;
    EXPECT_NEAR(u[0], root, 1e-12);
  }
};
INSTANTIATE_TEST_SUITE_P(Newton, DirectNewton, testing::Bool(),
                         [](const auto& of) { return of.param ? "ByPetsc" : "WithoutPetsc"; });

TEST_P(DirectNewton, ConvergesQuadratically) {
  std::vector<double> u{3, 3, 3};
  Roots problem;
  NewtonSettings settings = directNewton();
  settings.displacement = 1e-20;

  const Outcome outcome = solve(row(3), problem, settings, u);

  ASSERT_TRUE(outcome.converged) << outcome.reason;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(u[std::size_t(k)], std::sqrt(2.0 + k), 1e-14);
  // r' = (du)² and du = r / 2u: each residual is at most r² / 4u² <= r² / 8 of the one before.
  for (std::size_t k = 1; k < outcome.residuals.size(); ++k)
    EXPECT_LE(outcome.residuals[k], outcome.residuals[k - 1] * outcome.residuals[k - 1] / 8 + 1e-14);
}

TEST_P(DirectNewton, EndsWhereTheSquareOfTheLastChangeIsSmallBesideThatOfTheGreatest) {
  NewtonSettings settings = directNewton();
  settings.displacement = 1e-4;
  settings.energy = 1;
  std::vector<double> u{3, 3, 3}, byHand(u);
  Roots problem;

  const Outcome outcome = solve(row(3), problem, settings, u);

  double square = 1, greatest = 0;
  int iterations = 0;
  for (; square > settings.displacement * greatest; ++iterations) {
    square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double change = (byHand[k] * byHand[k] - 2 - double(k)) / (2 * byHand[k]);
      byHand[k] -= change;
      square += change * change;
    }
    greatest = std::max(greatest, square);
  }
  EXPECT_EQ(outcome.newtonIterations, iterations);
}

TEST_P(DirectNewton, GoesBackWhereThereIsNoResidual) { expectRoot<Logarithm>(1, 10); }

TEST_P(DirectNewton, GoesBackFromAStepThatLeadsFarOut) { expectRoot<Plateau>(0, 1); }

TEST(Newton, SolvesByMultigridWhereAnUnknownIsHardlyHeld) {
  Unknowns unknowns = row(Chain::links + 1);
  unknowns.entries.assign(unknowns.entries.size(), 4);
  for (int k = 0; k <= Chain::links; ++k) unknowns.coordinates.push_back(k);
  std::vector<double> byMultigrid(Chain::links + 1, 0), direct = byMultigrid;
  Chain chain;

  const Outcome outcome = solver().solve(unknowns, chain, NewtonSettings{}, byMultigrid);

  ASSERT_TRUE(outcome.converged) << outcome.reason;
  ASSERT_TRUE(solver().solve(unknowns, chain, directNewton(), direct).converged);
  // Linear systems are solved to 1e-8, the changes of the solution to 1e-10; the chain's condition number is 700.
  for (std::size_t k = 0; k < direct.size(); ++k) EXPECT_NEAR(byMultigrid[k] / direct[k], 1, 1e-6) << k;
}

TEST_P(DirectNewton, PassesOnWhatTheProblemThrows) {
  std::vector<double> u{3, 3, 3};
  Throwing problem;
  EXPECT_THROW(solve(row(3), problem, directNewton(), u), std::out_of_range);
}

TEST(Newton, TellsOfTheLinearSolveThatFailed) {
  std::vector<double> u(Chain::links + 1, 0);
  Unknowns unknowns = row(Chain::links + 1);
  unknowns.entries.assign(unknowns.entries.size(), 4);
  NewtonSettings settings;
  settings.linear = {"gmres", "none", 1e-12, 3, ""};
  Chain chain;

  const Outcome outcome = solver().solve(unknowns, chain, settings, u);

  EXPECT_FALSE(outcome.converged);
  EXPECT_EQ(outcome.reason, "a linear solve failed, more iterations than allowed (DIVERGED_ITS)");
  EXPECT_EQ(outcome.krylovResiduals.size(), 4U);
  EXPECT_NE(sentenceOf("it", outcome).find("; last linear solve: 3 iterations; residuals "), std::string::npos);
}

TEST_P(DirectNewton, TellsThatItGaveUp) {
  std::vector<double> u{3000, 3, 3};
  Roots problem;
  NewtonSettings settings = directNewton();
  settings.maxIterations = 2;

  const Outcome outcome = solve(row(3), problem, settings, u);

  EXPECT_FALSE(outcome.converged);
  EXPECT_EQ(outcome.newtonIterations, 2);
  EXPECT_EQ(outcome.worst, 0);
}

}  // namespace tushar::solvers
