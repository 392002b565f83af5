#include "components/poisson/poisson.hpp"

#include "components/poisson/balance.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/by_dimension.hpp"
#include "core/solvers/input.hpp"

namespace tushar::poisson {

template <int D>
void Poisson<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.perPatch("poisson::initialize", initialize<D>, with(settings_), computes(c::phi));
}

/// A solve takes any time step.
template <int D>
void Poisson<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perPatch(
      "poisson::computeStableTimeStep", [](const Patch&, Minimum&) {}, computes(delT));
}

template <int D>
void Poisson<D>::scheduleTimeAdvance(TaskList& tasks) const {
  tasks.perRank("poisson::solve", solve<D>, togetherOnRanks(), with(settings_), startTime(), requiresOld(delT),
                requiresOld(c::phi), computes(c::phi), computes(iterations), computes(finalResidual),
                computes(assemblyTime), computes(preconditionerTime), computes(solveTime));
}

template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> phi) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Vec3 middle = level.expandPoint<D>(level.cellCentre<D>(cell));
    const double k = settings.coefficient(middle);
    if (!(k > 0 && std::isfinite(k)))
      throw InputError(
          {{settings.where, "Poisson/coefficient",
            fmt::format("it is {:g} at ({:g}, {:g}, {:g}), and must be finite and greater than 0 everywhere", k,
                        middle[0], middle[1], middle[2])}});
    phi[cell] = 0;
  });
}

namespace {

bool keepsValueSomewhere(const Level& level) {
  for (int d = 0; d < level.dimension(); ++d)
    for (const int side : {0, 1})
      if (const auto* condition = level.isPeriodic(d) ? nullptr : level.boundary(d, side, "Phi"))
        if (condition->kind == "Dirichlet") return true;
  return false;
}

/// Where no face keeps a value, integral f dV must be what the slopes at the faces bring in, k dphi/dn dA; or else
/// there is no solution (R. Courant & D. Hilbert, Methods of Mathematical Physics 1, V.14: a free constant is
/// orthogonal to f).
void refuseImbalance(const Level& level, const solvers::Outcome& outcome, double tolerance) {
  if (!(std::abs(outcome.unbalanced) > tolerance * outcome.loads)) return;
  const double excess = -outcome.unbalanced / (static_cast<double>(level.cells().size()) * level.cellVolume());
  throw NumericalError(
      fmt::format(
          "Poisson's equation has no solution: no face keeps a value of Phi, and the source over the whole grid is "
          "greater by {:.6g} than what the slopes at the faces let in, {:.2g} of all that is summed",
          -outcome.unbalanced, std::abs(outcome.unbalanced) / outcome.loads),
      fmt::format("a <source> that is smaller by {:.15g} everywhere, or a face with a Dirichlet value", excess),
      "c.phi");
}

}  // namespace

template <int D>
void solve(const RankPatches& patches, const mpi::Communicator& ranks, const Settings& settings, double time, double dt,
           const std::vector<CellView<const double>>& oldPhi, const std::vector<CellView<double>>& phi,
           Maximum& iterationsTaken, Maximum& residualLeft, Maximum& assembly, Maximum& setup, Maximum& solution) {
  const Level& level = patches.front()->level();
  const solvers::CellNumbering number(level);
  solvers::Unknowns unknowns = cellUnknowns<D>(number, ranks);
  unknowns.constantIsFree = !keepsValueSomewhere(level);
  std::vector<double> right(unknowns.entries.size()), x(right.size());
  const auto place = [&](const Index<D>& cell) { return static_cast<std::size_t>(number(cell)); };
  // The negative of the balance is positive definite.
  const auto assemble = [&](solvers::Matrix& matrix) {
    forEachCell<D>(patches, [&](std::size_t, const Index<D>& cell) {
      Balance<D> balance = balanceOf<D>(level, settings.coefficient, "Phi", cell);
      for (double& weight : balance.weights) weight = -weight;
      const std::vector<int> columns = balance.columns(number);
      matrix.add({columns.data(), 1}, columns, {balance.weights.data(), balance.count});
      const double f = settings.source(level.expandPoint<D>(level.cellCentre<D>(cell)), time + dt);
      right[place(cell)] = balance.constant - level.cellVolume() * f;
    });
  };
  forEachCell<D>(patches, [&](std::size_t p, const Index<D>& cell) { x[place(cell)] = oldPhi[p][cell]; });
  const solvers::Outcome outcome = solvers::solver().solve(unknowns, {assemble, right}, settings.solver, x);
  refuseImbalance(level, outcome, settings.solver.tolerance);
  if (!outcome.converged)
    throw NumericalError(
        solvers::sentenceOf("Poisson's equation", outcome) +
            solvers::worstPlace(ranks, poisson::placeOf<D>(patches, number, outcome.worst), "in the cell"),
        "another <preconditioner>, a larger <tolerance> or more <maxiterations> in <Poisson>/<Solver>", "c.phi");
  forEachCell<D>(patches, [&](std::size_t p, const Index<D>& cell) { phi[p][cell] = x[place(cell)]; });
  iterationsTaken.add(outcome.krylovIterations);
  solvers::addTimes(outcome, assembly, setup, solution);
  if (!outcome.residuals.empty() && outcome.residuals.front() > 0)
    residualLeft.add(outcome.residuals.back() / outcome.residuals.front());
}

namespace {

const input::Schema<Settings>& schema() {
  static const input::Schema<Settings> schema =
      input::Schema<Settings>("Poisson", "div(coefficient grad phi) = source.")
          .location(&Settings::where)
          .value("coefficient", &Settings::coefficient, input::Expression(1.0), "1", "k", input::WithoutTime(),
                 input::positive())
          .ours()
          .value("source", &Settings::source, input::Expression(0.0), "1/m^2", "f, at the end of each step")
          .ours()
          .section("Solver", &Settings::solver, solvers::linearSchema())
          .ours();
  return schema;
}

}  // namespace

simulation::ComponentKind kind() {
  return simulation::kindWithSection<Poisson>(
      "poisson", "Poisson's equation; the smallest component with a global solve", schema(), {{"Phi"}, {"Symmetric"}});
}

template class Poisson<1>;
template class Poisson<2>;
template class Poisson<3>;

}  // namespace tushar::poisson
