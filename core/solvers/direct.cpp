#include "core/solvers/direct.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>

#include "core/solvers/block_factors.hpp"
#include "core/solvers/newton_rules.hpp"
#include "core/solvers/stopwatch.hpp"

namespace tushar::solvers {

namespace {

double product(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

int worstOf(std::span<const double> residual) {
  const auto size = [](double value) {
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : std::abs(value);
  };
  const auto worst =
      std::max_element(residual.begin(), residual.end(), [&](double a, double b) { return size(a) < size(b); });
  return static_cast<int>(worst - residual.begin());
}

constexpr const char* singular = "the matrix is singular";

bool isAutomatic(const LinearSettings& settings) { return settings.solver == "automatic"; }

/// The pivots of a matrix must have a greater ratio than this. If others can solve the system, this excludes matrices
/// that only round-off keeps regular.
double leastRatio(const LinearSettings& settings) { return isAutomatic(settings) ? 1e-12 : 0; }

/// Factors of earlier systems. A system with the same pattern uses their order of elimination, which is the same that
/// it would choose.
class EarlierFactors {
 public:
  BlockFactors of(const BlockMatrix& matrix) {
    for (BlockFactors& factors : kept_)
      if (factors.suits(matrix)) {
        std::swap(factors, kept_.back());
        BlockFactors found = std::move(kept_.back());
        kept_.pop_back();
        return found;
      }
    return BlockFactors(matrix);
  }
  void keep(BlockFactors&& factors) {
    if (kept_.size() == most) kept_.erase(kept_.begin());
    kept_.push_back(std::move(factors));
  }
  static EarlierFactors& ofThread() {
    static thread_local EarlierFactors factors;
    return factors;
  }

 private:
  static constexpr std::size_t most = 2;  // motion and heat
  std::vector<BlockFactors> kept_;
};

/// A matrix and its factors.
class FactorizedMatrix {
 public:
  FactorizedMatrix(const Unknowns& unknowns, const LinearSettings& settings)
      : matrix_(unknowns), least_(leastRatio(settings)) {}
  FactorizedMatrix(const FactorizedMatrix&) = delete;
  FactorizedMatrix& operator=(const FactorizedMatrix&) = delete;
  ~FactorizedMatrix() {
    if (factors_ && matrix_.blocks() <= mostKept) EarlierFactors::ofThread().keep(std::move(*factors_));
  }

  /// Assembles and factorizes the matrix, and adds the times to the outcome; returns false if it is singular.
  template <class Fill>
  bool update(Fill&& fill, Outcome& outcome) {
    const Stopwatch assembly;
    matrix_.assemble(fill);
    outcome.assembly += assembly.seconds();
    const Stopwatch setup;
    if (!factors_ || !factors_->suits(matrix_)) factors_.emplace(EarlierFactors::ofThread().of(matrix_));
    is_regular_ = factors_->factorize(matrix_) > least_;
    outcome.setup += setup.seconds();
    return is_regular_;
  }
  bool isRegular() const { return is_regular_; }
  /// Replaces b by the solution.
  void solve(std::span<double> b) const { factors_->solve(b); }

 private:
  static constexpr std::size_t mostKept = 1000000;  ///< blocks of a matrix whose factors stay in memory

  BlockMatrix matrix_;
  double least_;  ///< smallest ratio of pivots of a regular matrix
  bool is_regular_ = true;
  std::optional<BlockFactors> factors_;
};

/// Newton's method with factorized tangents.
class DirectNewton {
 public:
  DirectNewton(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings, std::span<double> u)
      : problem_(problem),
        settings_(settings),
        u_(u),
        r_(u.size()),
        there_(u.size()),
        residual_(u.size()),
        matrix_(unknowns, settings.linear),
        changes_(settings) {}

  Outcome solve() {
    const Stopwatch whole;
    const bool isDefined = problem_.residual(u_, r_);
    outcome_.residuals.push_back(isDefined ? std::sqrt(product(r_, r_)) : std::numeric_limits<double>::infinity());
    bool isSmall = false;
    while (!isOver(isSmall)) isSmall = advance();
    if (!outcome_.converged) outcome_.worst = worstOf(r_);
    outcome_.solve = whole.seconds() - outcome_.assembly - outcome_.setup;
    return std::move(outcome_);
  }
  bool isRegular() const { return matrix_.isRegular(); }

 private:
  void end(bool converged, const char* reason) {
    outcome_.converged = converged;
    outcome_.reason = reason;
  }
  /// Round-off is not tested before the first iteration, because a load may be as small as the round-off of a large
  /// stiffness, but must still act.
  bool isOver(bool changesAreSmall) {
    if (!outcome_.reason.empty()) return true;
    const int iteration = outcome_.newtonIterations;
    const double norm = outcome_.residuals.back();
    if (!std::isfinite(norm))
      end(false, "the residual became infinite or NaN");
    else if (changesAreSmall)
      end(true, "the last change is small");
    else if (norm == 0 || (iteration > 0 && problem_.isNegligible(u_, r_)))
      end(true, "the residual is only rounding error");
    else if (iteration == settings_.maxIterations)
      end(false, "more iterations than allowed");
    return !outcome_.reason.empty();
  }
  /// One iteration; returns whether the change is small.
  bool advance() {
    if (!matrix_.update([&](Matrix& matrix) { problem_.tangent(matrix); }, outcome_)) {
      end(false, "a linear solve failed, the matrix is singular");
      return false;
    }
    step_ = r_;
    matrix_.solve(step_);
    ++outcome_.krylovIterations;
    const Trial trial = chooseStep(product(r_, step_), [&](double length) { return tryStep(length); });
    if (!trial.isFinite) {
      end(false, "no fraction of the last Newton step reduces the residual");
      return false;
    }
    double square = 0, energy = 0;
    for (std::size_t k = 0; k < r_.size(); ++k) {
      const double change = there_[k] - u_[k];
      square += change * change;
      energy += change * r_[k];
    }
    std::copy(there_.begin(), there_.end(), u_.begin());
    r_.swap(residual_);
    outcome_.residuals.push_back(std::sqrt(product(r_, r_)));
    return changes_.after(++outcome_.newtonIterations, square, energy);
  }
  Trial tryStep(double length) {
    for (std::size_t k = 0; k < there_.size(); ++k) there_[k] = u_[k] - length * step_[k];
    const bool isDefined = problem_.residual(there_, residual_);
    const double slope = product(residual_, step_);
    return {length, slope, isDefined && std::isfinite(slope)};
  }

  NonlinearProblem& problem_;
  const NewtonSettings& settings_;
  std::span<double> u_;
  std::vector<double> r_, step_, there_, residual_;
  FactorizedMatrix matrix_;
  SmallChanges changes_;
  Outcome outcome_;
};

/// Whether a Krylov method would not be faster than LU factors.
bool isSmall(const Unknowns& unknowns) {
  const int most = unknowns.axes < 3 ? 6000 : 600;
  return unknowns.axes == 1 || unknowns.owned * unknowns.block <= most;
}

}  // namespace

bool isDirect(const Unknowns& unknowns, const LinearSettings& settings) {
  if (!unknowns.ranks->isAlone() || unknowns.constantIsFree || unknowns.block > 3) return false;
  if (!settings.petsc.empty() || std::getenv("PETSC_OPTIONS")) return false;
  return settings.solver == "preonly" ||
         (settings.solver == "automatic" &&
          (settings.preconditioner == "gamg" || settings.preconditioner == "multigrid") && isSmall(unknowns));
}

std::optional<Outcome> solveDirectly(const Unknowns& unknowns, const LinearProblem& problem,
                                     const LinearSettings& settings, std::span<double> x) {
  Outcome outcome;
  FactorizedMatrix matrix(unknowns, settings);
  if (!matrix.update(problem.assemble, outcome)) {
    if (isAutomatic(settings)) return std::nullopt;
    outcome.reason = singular;
    return outcome;
  }
  const Stopwatch whole;
  std::copy(problem.rightHandSide.begin(), problem.rightHandSide.end(), x.begin());
  matrix.solve(x);
  outcome.solve = whole.seconds();
  outcome.krylovIterations = 1;
  outcome.converged = true;
  for (const double value : x) outcome.converged = outcome.converged && std::isfinite(value);
  outcome.reason = outcome.converged ? "solved" : singular;
  return outcome;
}

std::optional<Outcome> solveDirectly(const Unknowns& unknowns, NonlinearProblem& problem,
                                     const NewtonSettings& settings, std::span<double> u) {
  const std::vector<double> guess(u.begin(), u.end());
  DirectNewton newton(unknowns, problem, settings, u);
  Outcome outcome = newton.solve();
  if (newton.isRegular() || !isAutomatic(settings.linear)) return outcome;
  std::copy(guess.begin(), guess.end(), u.begin());
  return std::nullopt;
}

}  // namespace tushar::solvers
