#pragma once

#include "components/ice/face_flow.hpp"
#include "components/ice/labels.hpp"
#include "core/numerics/cell_system.hpp"

namespace tushar::ice {

/// The report of the last solve.
struct SolveTotals {
  Maximum &iterations, &assembly, &preconditioner, &solution;

  static SolveTotals from(auto& take) {
    return {.iterations = take(computes(total::iterations)),
            .assembly = take(computes(solvers::assemblyTime)),
            .preconditioner = take(computes(solvers::preconditionerTime)),
            .solution = take(computes(solvers::solveTime))};
  }
};

/// The result of a solve: p' - p and p', Pa.
struct PressureViews {
  CellView<double> change, atEnd;

  static PressureViews from(auto& take) {
    return {.change = take(computes(c::pressureChange)), .atEnd = take(computes(c::pressureAtEnd))};
  }
};

/// The equation for the change of a cell's pressure, p' - p, of the internal energy
/// (rho e)' = rho e - dt div((rho e + p) u_f) + dt v . grad p, with u_f of p', the enthalpy at faces and v . grad p
/// before the step. In gas rho e + p = gamma (p + p_inf) / (gamma - 1), so that with d = p' - p, and u_f of d = 0,
///
///   d - dt div(gamma P_f loss_f (d_R - d_L)) = -dt div(gamma P_f u_f) + (gamma - 1) dt v . grad p,
///
/// symmetric and positive definite.
template <int D>
numerics::CellEquation<D> pressureEquation(const Level& level, const FaceFlow<D>& flow, const Index<D>& cell,
                                           double dt) {
  const std::size_t p = euler::kPressure<D>;
  const double gamma = flow.gas().gamma;
  numerics::CellEquation<D> equation{{}, 0};
  numerics::Balance<D>& left = equation.left;
  left.cells[0] = cell;
  left.weights[0] = 1;
  for (int d = 0; d < D; ++d) {
    const double ratio = dt * level.inverseSpacing(d);
    const double velocity = flow.old().number(cell, euler::kVelocity(d));
    for (const int side : {0, 1}) {
      const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(d);
      const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : face;
      const double enthalpy = gamma * flow.stiffPressure(face, d);
      const double out = (side == 0 ? -1 : 1) * ratio;
      const double rise = flow.old().number(next, p) - flow.old().number(cell, p);
      equation.right -= out * enthalpy * flow.unchanged(face, d);
      equation.right += 0.5 * (gamma - 1) * out * velocity * rise;
      const double weight = ratio * enthalpy * flow.loss(face, d);
      left.weights[0] += weight;
      if (!flow.isOnGrid(next)) continue;
      left.cells[left.count] = next;
      left.weights[left.count++] = -weight;
    }
  }
  return equation;
}

/// The same in a gas with a law of its own, from dp/dt + v . grad p = -rho c² div v, over rho c²:
///
///   d / (rho c²) - dt div(loss_f (d_R - d_L)) = -dt div u_f - dt v . grad p / (rho c²),
///
/// symmetric and positive definite, too.
template <int D>
numerics::CellEquation<D> equationByLaw(const Level& level, const FaceFlow<D>& flow, const Index<D>& cell, double dt) {
  const std::size_t p = euler::kPressure<D>;
  const double rho = flow.old().number(cell, euler::kDensity);
  const double softness = 1 / (rho * flow.gas().soundSpeedSquared(rho, flow.old().number(cell, p)));
  numerics::CellEquation<D> equation{{}, 0};
  numerics::Balance<D>& left = equation.left;
  left.cells[0] = cell;
  left.weights[0] = softness;
  for (int d = 0; d < D; ++d) {
    const double ratio = dt * level.inverseSpacing(d);
    const double velocity = flow.old().number(cell, euler::kVelocity(d));
    for (const int side : {0, 1}) {
      const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(d);
      const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : face;
      const double out = (side == 0 ? -1 : 1) * ratio;
      const double rise = flow.old().number(next, p) - flow.old().number(cell, p);
      const double weight = ratio * flow.loss(face, d);
      equation.right -= out * flow.unchanged(face, d) + 0.5 * softness * out * velocity * rise;
      left.weights[0] += weight;
      if (!flow.isOnGrid(next)) continue;
      left.cells[left.count] = next;
      left.weights[left.count++] = -weight;
    }
  }
  return equation;
}

/// Solves for the change of pressure in the step in all cells [Pa], from the state before it; the last step's pressure
/// is the first guess; gives the pressure at the end. The residual is how far the gas would miss that pressure, so the
/// tolerance is relative to the greatest pressure where that is less than the right-hand side.
/// Throws NumericalError if the solver gives up.
template <int D>
void solvePressure(const RankPatches& patches, const mpi::Communicator& ranks, const euler::Settings& method,
                   const IceSettings& settings, double time, double dt, const std::vector<euler::OldState<D>>& before,
                   const std::vector<CellView<const double>>& guess, const std::vector<PressureViews>& fresh,
                   const SolveTotals& totals) {
  const Level& level = patches.front()->level();
  const std::size_t number = euler::kPressure<D>;
  const euler::GhostRules<D> rules = euler::ghostRules<D>(level, method.gas, time);
  std::vector<FaceFlow<D>> flows;
  std::vector<CellView<double>> changes;
  std::vector<CellView<const double>> first;
  double greatest = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const CellView<double>& change = changes.emplace_back(fresh[p].change);
    flows.emplace_back(level, method, settings, rules, patches[p]->cells(), dt).hold(patches[p]->cells(), before[p]);
    forEach<D>(patches[p]->cells(), [&](const Index<D>& cell) {
      const double old = flows[p].old().number(cell, number);
      change[cell] = guess[p][cell] - old;
      greatest = std::max(greatest, std::abs(old + method.gas.pInfinity));
    });
    first.emplace_back(change.values(), change.stored(), change.box());
  }
  const double scale = ranks.max(greatest) * std::sqrt(static_cast<double>(level.cells().size()));
  numerics::CellSystem<D> system(patches, ranks);
  const auto equationOf = [&](std::size_t p, const Index<D>& cell) {
    return method.gas.law ? equationByLaw<D>(level, flows[p], cell, dt)
                          : pressureEquation<D>(level, flows[p], cell, dt);
  };
  const solvers::Outcome outcome = system.solve(settings.solver, first, equationOf, scale);
  system.requireConvergence(outcome, "the pressure", "CFD/ICE/ImplicitSolver", "c.pressure",
                            ", or a smaller <delt_max>");
  system.take(changes);
  for (std::size_t p = 0; p < patches.size(); ++p)
    forEach<D>(patches[p]->cells(), [&](const Index<D>& cell) {
      fresh[p].atEnd[cell] = flows[p].old().number(cell, number) + changes[p][cell];
    });
  totals.iterations.add(outcome.krylovIterations);
  solvers::addTimes(outcome, totals.assembly, totals.preconditioner, totals.solution);
}

}  // namespace tushar::ice
