#include "components/poisson/poisson.hpp"

#include "core/input/schema.hpp"
#include "core/numerics/cell_system.hpp"
#include "core/numerics/checked_formula.hpp"
#include "core/numerics/composite_diffusion.hpp"
#include "core/simulation/by_dimension.hpp"
#include "core/solvers/input.hpp"

namespace tushar::poisson {

template <int D>
void Poisson<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.perPatch("poisson::initialize", initialize<D>, with(settings_), computes(c::phi));
}

template <int D>
void Poisson<D>::scheduleTimeAdvance(TaskList& tasks) const {
  tasks.perRank("poisson::solve", solve<D>, withWorkers(), with(settings_), startTime(), requiresOld(delT),
                requiresOld(c::phi), computes(c::phi), totals<SolveTotals>());
}

template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> phi) {
  numerics::CheckedFormula{settings.coefficient, "Poisson/coefficient", ""}.requirePositive<D>(patch);
  phi.fill(0);
}

namespace {

/// Whether phi is given at a face of any cell on any rank. A part of a side may be so small that only finer cells have
/// a face in it.
template <int D>
bool keepsValueSomewhere(const RankPatches& patches, const mpi::Communicator& ranks) {
  bool keeps = false;
  for (const Patch* patch : patches) {
    const Level& level = patch->level();
    const BoundarySides<double> sides = level.sides(boundary::phi);
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        Box faces = patch->cells();
        const bool isAtSide = side == 0 ? faces.lower[d] == 0 : faces.upper[d] == level.cells().upper[d];
        if (!isAtSide || level.isPeriodic(d)) continue;
        faces.upper[d] = faces.lower[d] + 1;  // how far a cell is from the side does not matter
        forEach<D>(faces, [&](const Index<D>& cell) {
          const auto& given = sides(d, side, cell);
          keeps |= given && given->isDirichlet();
        });
      }
  }
  return ranks.any(keeps);
}

/// Throws NumericalError if there is no solution. If no face has a given value, a solution exists only if the integral
/// of f dV equals the influx k dphi/dn dA that follows from the slopes at the faces. Source: R. Courant & D. Hilbert,
/// Methods of Mathematical Physics 1, V.14 (a free constant is orthogonal to f).
void refuseImbalance(const Level& level, const solvers::Outcome& outcome, double tolerance) {
  if (!(std::abs(outcome.unbalanced) > tolerance * outcome.loads)) return;
  const double excess = -outcome.unbalanced / (static_cast<double>(level.cells().size()) * level.cellVolume());
  throw NumericalError(
      fmt::format("Poisson's equation has no solution: no face prescribes Phi, and the integral of the source exceeds "
                  "that of k dphi/dn over the faces by {:.6g}, which is {:.2g} of the sum of all contributions",
                  -outcome.unbalanced, std::abs(outcome.unbalanced) / outcome.loads),
      fmt::format("a <source> that is smaller by {:.15g} everywhere, or a face with a Dirichlet value", excess),
      "c.phi");
}

}  // namespace

template <int D>
void solve(const RankPatches& patches, const Workers& workers, const Settings& settings, double time, double dt,
           const std::vector<CellView<const double>>& oldPhi, const std::vector<CellView<double>>& phi,
           const SolveTotals& totals) {
  const Level& level = patches.front()->level();
  const numerics::CompositeDiffusion<D> diffusion(level.grid(), settings.coefficient, boundary::phi);
  // The negative of the balance is positive definite.
  const auto equationOf = [&](std::size_t p, const Index<D>& cell) {
    const Level& own = patches[p]->level();
    numerics::Balance<D> balance = diffusion.balance(own.number(), cell);
    balance.scale(-1);
    const double f = settings.source(own.expandPoint<D>(own.cellCentre<D>(cell)), time + dt);
    const double right = balance.constant - own.cellVolume() * f;
    return numerics::CellEquation<D>{std::move(balance), right};
  };
  numerics::CellSystem<D> system(patches, workers);
  if (!keepsValueSomewhere<D>(patches, workers.ranks)) system.freeConstant();
  const solvers::Outcome outcome = system.solve(settings.solver, oldPhi, equationOf);
  refuseImbalance(level, outcome, settings.solver.tolerance);
  system.requireConvergence(outcome, "Poisson's equation", "Poisson", "c.phi");
  system.take(phi);
  totals.iterations.add(outcome.krylovIterations);
  solvers::addTimes(outcome, totals.assembly, totals.preconditioner, totals.solution);
  if (!outcome.residuals.empty() && outcome.residuals.front() > 0)
    totals.finalResidual.add(outcome.residuals.back() / outcome.residuals.front());
}

namespace {

const input::Schema<Settings>& schema() {
  static const input::Schema<Settings> schema =
      input::Schema<Settings>("Poisson", "div(coefficient grad phi) = source.")
          .allOurs()
          .value("coefficient", &Settings::coefficient, input::Expression(1.0), "1", "k", input::WithoutTime(),
                 input::positive())
          .value("source", &Settings::source, input::Expression(0.0), "1/m^2", "f, evaluated at the end of each step")
          .section("Solver", &Settings::solver, solvers::linearSchema());
  return schema;
}

}  // namespace

simulation::ComponentKind kind() {
  simulation::ComponentKind kind =
      simulation::kindWithSection<Poisson>("poisson", "Poisson's equation; the smallest component with a global solve",
                                           schema(), {boundary::phi, grid::symmetric});
  kind.takesLevels = true;
  kind.takesPartsOfSides = true;
  return kind;
}

template class Poisson<1>;
template class Poisson<2>;
template class Poisson<3>;

}  // namespace tushar::poisson
