#pragma once

#include "core/core.hpp"
#include "core/input/expression.hpp"
#include "core/simulation/catalogue.hpp"
#include "core/solvers/report.hpp"

namespace tushar::poisson {

namespace c {
inline constexpr CellLabel<double> phi{"c.phi", "1", "solution", Bound::finite};
}
namespace boundary {
inline constexpr BoundaryLabel<double> phi{"Phi"};
}
inline constexpr ReductionLabel<Maximum> iterations{"KrylovIterations", "1", "iterations of the linear solve"};
inline constexpr ReductionLabel<Maximum> finalResidual{"KrylovResidual", "1",
                                                       "final residual divided by the initial one"};

/// The `Poisson` section.
struct Settings {
  input::Expression coefficient{1.0};  ///< coefficient k
  input::Expression source{0.0};       ///< source f
  solvers::LinearSettings solver;
};

/// div(k grad phi) = f in D dimensions, by finite volumes; each step solves it with f at the end of the step.
///
/// A face with a Dirichlet condition for `Phi` has the given value, one with a Neumann condition the given outward
/// derivative; any other face has no flux. Without any Dirichlet condition, phi has mean 0, and a source that is not
/// balanced by the faces is refused. This component is the template for methods whose steps need a global solve.
template <int D>
class Poisson : public Component {
 public:
  explicit Poisson(Settings settings) : settings_(std::move(settings)) {}

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  std::vector<simulation::Reported> reported() const override { return {simulation::iterationsOfRun(iterations)}; }

 private:
  Settings settings_;
};

/// Sets phi = 0, the initial guess for the first solve. Throws InputError where k is not greater than 0.
template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> phi);

/// References to the totals that report on the solve of a step.
struct SolveTotals {
  Maximum &iterations, &finalResidual, &assembly, &preconditioner, &solution;

  static SolveTotals from(auto& take) {
    return {.iterations = take(computes(poisson::iterations)),
            .finalResidual = take(computes(poisson::finalResidual)),
            .assembly = take(computes(solvers::assemblyTime)),
            .preconditioner = take(computes(solvers::preconditionerTime)),
            .solution = take(computes(solvers::solveTime))};
  }
};

/// Solves for phi in the cells of all patches, starting from the old phi. Throws NumericalError if the solver does not
/// converge.
template <int D>
void solve(const RankPatches& patches, const Workers& workers, const Settings& settings, double time, double dt,
           const std::vector<CellView<const double>>& oldPhi, const std::vector<CellView<double>>& phi,
           const SolveTotals& totals);

/// Describes this component to sus.
simulation::ComponentKind kind();

}  // namespace tushar::poisson
