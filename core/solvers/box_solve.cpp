#include "core/solvers/box_solve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/solvers/box_multigrid.hpp"
#include "core/solvers/stopwatch.hpp"
#include "core/solvers/tolerances.hpp"

namespace tushar::solvers {

namespace {

using Values = std::vector<double>;

double product(const BoxShape& shape, const Values& a, const Values& b) {
  return shape.sum([a = a.data(), b = b.data()](std::ptrdiff_t at) { return a[at] * b[at]; });
}

double norm(const BoxShape& shape, const Values& a) { return std::sqrt(product(shape, a, a)); }

void takeOutMean(const BoxShape& shape, Values& values) {
  const double mean = shape.sum([&](std::ptrdiff_t at) { return values[at]; }) / static_cast<double>(shape.cells());
  shape.forEachCell([&](std::ptrdiff_t at) { values[at] -= mean; });
}

/// The preconditioners.
class Preconditioner {
 public:
  Preconditioner(const BoxSystem& system, const std::string& name)
      : matrix_(system.matrix), constantIsFree_(system.constantIsFree), isDiagonal_(name == "jacobi") {
    if (name == "multigrid") multigrid_.emplace(matrix_);
  }
  /// z = M r, where M is about the inverse of the matrix.
  void apply(const Values& r, Values& z) {
    if (multigrid_)
      multigrid_->apply(r, z);
    else if (isDiagonal_)
      matrix_.shape.forEachCell(
          [&](std::ptrdiff_t at) { z[at] = matrix_.diagonal[at] > 0 ? r[at] / matrix_.diagonal[at] : 0; });
    else
      z = r;
    if (constantIsFree_) takeOutMean(matrix_.shape, z);
  }

 private:
  const BoxStencil<double>& matrix_;
  bool constantIsFree_, isDiagonal_;
  std::optional<BoxMultigrid> multigrid_;
};

/// Conjugate gradients. Source: J. R. Shewchuk, An Introduction to the Conjugate Gradient Method (1994), B3.
class ConjugateGradients {
 public:
  ConjugateGradients(BoxSystem& system, Preconditioner& preconditioner, const LinearSettings& settings)
      : system_(system), preconditioner_(preconditioner), settings_(settings), r_(system.b.size()) {}

  /// Returns false if others must try: if the matrix is not positive definite, if it is so nearly singular that
  /// round-off spoils the solution, or if multigrid takes too many iterations.
  bool solve(Outcome& outcome) {
    const BoxShape& shape = system_.matrix.shape;
    outcome.residuals.push_back(renew());
    const double given = norm(shape, system_.b), size = given > 0 ? given : outcome.residuals.front();
    const Tolerances tolerances = Tolerances::of(settings_.tolerance, system_.scale, size);
    const double largest = std::max(tolerances.relative * size, tolerances.absolute);
    for (int start = 0; start < mostStarts; ++start) {
      while (outcome.residuals.back() > largest || !isSmallInEachCell()) {
        if (isMultigrid() && outcome.krylovIterations == mostWithMultigrid) return false;
        if (outcome.krylovIterations == settings_.maxIterations) {
          outcome.reason = "more iterations than allowed";
          outcome.worst = worst();
          return true;
        }
        if (!advance()) return false;
        ++outcome.krylovIterations;
        outcome.residuals.push_back(norm(shape, r_));
      }
      // The residual of the method is b - A x but for round-off.
      const double actual = renew();
      outcome.converged = actual <= std::max({largest, 2 * outcome.residuals.back(), roundOff()});
      outcome.residuals.back() = actual;
      if (outcome.converged || !std::isfinite(actual)) break;
    }
    outcome.reason = "solved";
    return outcome.converged;
  }

 private:
  static constexpr int mostStarts = 3;
  static constexpr int mostWithMultigrid = 300;  ///< from here on, an algebraic multigrid is faster

  bool isMultigrid() const { return settings_.preconditioner == "multigrid"; }

  /// Sets r = b - A x, begins anew, and returns |r|.
  double renew() {
    r_ = system_.b;
    system_.matrix.subtract(system_.x, r_);
    slope_ = 0;
    return norm(system_.matrix.shape, r_);
  }
  /// The norm of the residual that the rounding of a solution leaves: that of the terms of the equations.
  double roundOff() const {
    const std::vector<double>&diagonal = system_.matrix.diagonal, &x = system_.x;
    const auto term = [&](std::ptrdiff_t at) { return diagonal[at] * x[at] * (diagonal[at] * x[at]); };
    return 2 * std::numeric_limits<double>::epsilon() * std::sqrt(system_.matrix.shape.sum(term));
  }
  /// Whether the residual of each cell is small beside the terms of its own equation. Where conductivities differ by
  /// many orders of magnitude, |r| beside |b| says nothing about the equations of the worst conductor.
  bool isSmallInEachCell() const {
    if (system_.scale > 0) return true;
    const std::vector<double>&diagonal = system_.matrix.diagonal, &x = system_.x;
    const auto [greatest, worst] = system_.matrix.shape.greatest<2>([&](std::ptrdiff_t at) {
      return std::array{std::abs(x[at]), diagonal[at] > 0 ? std::abs(r_[at]) / diagonal[at] : 0};
    });
    return worst <= settings_.tolerance * greatest;
  }
  bool advance() {
    const BoxShape& shape = system_.matrix.shape;
    if (p_.empty()) {
      p_.resize(r_.size());
      q_ = z_ = p_;
    }
    preconditioner_.apply(r_, z_);
    const double before = slope_;
    slope_ = product(shape, r_, z_);
    const double kept = before > 0 ? slope_ / before : 0;
    update(p_, kept, z_, 1);
    system_.matrix.multiply(p_, q_);
    const double curvature = product(shape, p_, q_);
    if (!(curvature > 0) || !(slope_ > 0)) return false;
    const double length = slope_ / curvature;
    update(system_.x, 1, p_, length);
    update(r_, 1, q_, -length);
    return true;
  }
  /// a = kept a + factor b.
  void update(Values& a, double kept, const Values& b, double factor) const {
    const BoxShape& shape = system_.matrix.shape;
    shape.forEachRow([&, to = a.data(), from = b.data()](std::ptrdiff_t first) {
      for (std::ptrdiff_t at = first; at < first + shape.extent(0); ++at) to[at] = kept * to[at] + factor * from[at];
    });
  }
  /// The number of the first cell with the largest residual.
  int worst() const {
    const BoxShape& shape = system_.matrix.shape;
    const double greatest = shape.greatest<1>([&](std::ptrdiff_t at) { return std::array{std::abs(r_[at])}; })[0];
    const double all = static_cast<double>(shape.cells());
    double left = 0;  // the cells from the first one with this residual on
    for (int z = shape.extent(2) - 1; z >= 0; --z) {
      double number = all - static_cast<double>(shape.cellsOfPlane()) * (shape.slabs().first() + z);
      shape.forEachCellIn(z, [&](std::ptrdiff_t at) {
        if (std::abs(r_[at]) == greatest) left = std::max(left, number);
        --number;
      });
    }
    left = shape.slabs().ranks().max(left);
    return left > 0 ? static_cast<int>(all - left) : -1;
  }

  BoxSystem& system_;
  Preconditioner& preconditioner_;
  const LinearSettings& settings_;
  Values r_, z_, p_, q_;
  double slope_ = 0;
};

}  // namespace

bool suitsBox(const LinearSettings& settings) {
  if (!settings.petsc.empty() || std::getenv("PETSC_OPTIONS")) return false;
  if (settings.solver != "cg" && settings.solver != "automatic") return false;
  return settings.preconditioner == "multigrid" || settings.preconditioner == "jacobi" ||
         settings.preconditioner == "none";
}

std::optional<Outcome> solve(BoxSystem& system, const LinearSettings& settings) {
  const BoxShape& shape = system.matrix.shape;
  Outcome outcome;
  if (system.constantIsFree) {
    outcome.unbalanced = shape.sum([&](std::ptrdiff_t at) { return system.b[at]; });
    outcome.loads = shape.sum([&](std::ptrdiff_t at) { return std::abs(system.b[at]); });
    takeOutMean(shape, system.b);
  }
  const Stopwatch setup;
  Preconditioner preconditioner(system, settings.preconditioner);
  outcome.setup = setup.seconds();
  const Stopwatch iterations;
  if (!ConjugateGradients(system, preconditioner, settings).solve(outcome)) return std::nullopt;
  outcome.solve = iterations.seconds();
  if (system.constantIsFree) takeOutMean(shape, system.x);
  return outcome;
}

}  // namespace tushar::solvers
