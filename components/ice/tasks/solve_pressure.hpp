#pragma once

#include "components/ice/face_flow.hpp"
#include "components/ice/labels.hpp"
#include "core/numerics/cell_system.hpp"

namespace tushar::ice {

/// References to the totals that report on the solve of a step.
struct SolveTotals {
  Maximum &iterations, &assembly, &preconditioner, &solution;

  static SolveTotals from(auto& take) {
    return {.iterations = take(computes(total::iterations)),
            .assembly = take(computes(solvers::assemblyTime)),
            .preconditioner = take(computes(solvers::preconditionerTime)),
            .solution = take(computes(solvers::solveTime))};
  }
};

/// The result of a solve: p' - p and p' [Pa].
struct PressureViews {
  CellView<double> change, atEnd;

  static PressureViews from(auto& take) {
    return {.change = take(computes(c::pressureChange)), .atEnd = take(computes(c::pressureAtEnd))};
  }
};

/// A face of a cell.
template <int D>
struct CellFace {
  int axis, side;        ///< side: 0 for the lower face, 1 for the upper one
  Index<D> index, next;  ///< index of the face (that of the cell above it), and of the neighbour beyond it
  double ratio, out;     ///< dt / h [s/m], without and with the sign of the outward normal
};

/// Calls visit(CellFace) for each face of a cell, axis by axis, the lower face first.
template <int D, class Visit>
void forEachFaceOf(const Level& level, const Index<D>& cell, double dt, Visit&& visit) {
  for (int d = 0; d < D; ++d) {
    const double ratio = dt * level.inverseSpacing(d);
    visit(CellFace<D>{d, 0, cell, cell - Index<D>::unit(d), ratio, -ratio});
    visit(CellFace<D>{d, 1, cell + Index<D>::unit(d), cell + Index<D>::unit(d), ratio, ratio});
  }
}

/// Returns the equation `weight * d = 0` of a cell, where d is the change of the cell's pressure.
template <int D>
numerics::CellEquation<D> equationWith(const Index<D>& cell, double weight) {
  numerics::CellEquation<D> equation{{}, 0};
  equation.left.cells[0] = cell;
  equation.left.weights[0] = weight;
  return equation;
}

/// Adds `weight * (d - d_n)` to the left-hand side of a cell's equation. d_n is the change in the cell `next`; beyond
/// the grid, it is 0.
template <int D, int K>
void couple(const FaceFlow<D, K>& flow, const Index<D>& next, double weight, numerics::Balance<D>& left) {
  left.weights[0] += weight;
  if (!flow.isOnGrid(next)) return;
  left.cells[left.count] = next;
  left.weights[left.count++] = -weight;
}

/// The pressure of the cell beyond a face minus that of the cell itself, before the step [Pa].
template <int D, int K>
double riseAcross(const FaceFlow<D, K>& flow, const Index<D>& cell, const CellFace<D>& face) {
  return flow.old().number(face.next, euler::kPressure<D>) - flow.old().number(cell, euler::kPressure<D>);
}

/// The equations for the changes d of the pressures of cells: d - sum over the faces of link (d_n - d) = right. Numbers
/// are double or Lanes.
template <int D, class Number = double>
struct PressureEquations {
  std::array<std::array<Number, 2>, D> links;  ///< through the lower and the upper face along each axis
  Number right = 0.0;
};

/// The equation for the change p' - p of the pressure of the cell at a place in the rows of the flow or, for Lanes, of
/// the cells that begin there. It follows from the equation of the internal energy, (rho e)' = rho e - dt div((rho e +
/// p) u_f) + dt v . grad p, with u_f of p', but with the enthalpy at faces and v . grad p before the step. In gas, rho
/// e + p = gamma (p + p_inf) / (gamma - 1). With d = p' - p, and u_f of d = 0, this gives
///
///   d - dt div(gamma P_f loss_f (d_R - d_L)) = -dt div(gamma P_f u_f) + (gamma - 1) dt v . grad p,
///
/// which is symmetric and positive definite.
template <int D, class Number = double>
[[gnu::always_inline]] inline PressureEquations<D, Number> pressureEquationsAt(const FaceFlow<D>& flow,
                                                                               std::ptrdiff_t place, double dt) {
  const double gamma = flow.gas().gamma;
  const auto pressure = [&](std::ptrdiff_t step) {
    return euler::numberAt<Number>(flow.old().component(euler::kPressure<D>) + place + step);
  };
  const Number middle = pressure(0);
  PressureEquations<D, Number> equations;
  for (int d = 0; d < D; ++d) {
    const double ratio = dt * flow.level().inverseSpacing(d);
    const Number velocity = euler::numberAt<Number>(flow.old().component(euler::kVelocity(d)) + place);
    for (const int side : {0, 1}) {
      const std::ptrdiff_t step = flow.old().stride(d), face = place + (side == 0 ? 0 : step);
      const double out = side == 0 ? -ratio : ratio;
      const Number beyond = pressure(side == 0 ? -step : step);
      const Number enthalpy = gamma * (0.5 * (middle + beyond) + flow.gas().pInfinity);
      equations.right -= out * enthalpy * euler::numberAt<Number>(flow.unchangedAt(d, face));
      equations.right += 0.5 * (gamma - 1) * out * velocity * (beyond - middle);
      equations.links[d][side] = ratio * enthalpy * euler::numberAt<Number>(flow.lossAt(d, face));
    }
  }
  return equations;
}

/// The equation of a cell.
template <int D>
numerics::CellEquation<D> pressureEquation(const Level& level, const FaceFlow<D>& flow, const Index<D>& cell,
                                           double dt) {
  numerics::CellEquation<D> equation = equationWith(cell, 1);
  const PressureEquations<D> of = pressureEquationsAt<D>(flow, flow.old().offsetOf(cell), dt);
  forEachFaceOf<D>(level, cell, dt, [&](const CellFace<D>& face) {
    couple(flow, face.next, of.links[face.axis][face.side], equation.left);
  });
  equation.right = of.right;
  return equation;
}

/// Sets the equations of a row of cells.
template <int D>
void fillPressureEquations(const FaceFlow<D>& flow, const Index<D>& row, int count, double dt,
                           const solvers::BoxRow<D>& to) {
  const std::ptrdiff_t first = flow.old().offsetOf(row);
  euler::forEachRegister(count, [&](auto number, std::ptrdiff_t i) {
    using Number = decltype(number);
    const PressureEquations<D, Number> of = pressureEquationsAt<D, Number>(flow, first + i, dt);
    Number diagonal = 1.0;
    for (int d = 0; d < D; ++d) {
      for (const Number& link : of.links[d]) diagonal += link;
      euler::put(of.links[d][1], to.links[d] + i);
    }
    euler::put(diagonal, to.diagonal + i);
    euler::put(of.right, to.right + i);
  });
  for (int d = 0; d < D; ++d) {
    Index<D> last = row;
    last[0] += count - 1;
    if (!flow.isSide(last[d] + 1, d)) continue;
    if (d == 0)
      to.links[0][count - 1] = 0;
    else
      std::fill_n(to.links[d], count, 0.0);
  }
}

/// 1 / (rho c²) of a cell [1/Pa].
template <int D, int K>
double softnessIn(const FaceFlow<D, K>& flow, const Index<D>& cell) {
  const euler::State<D, K> w = flow.old().state(cell);
  return 1 / (w[euler::kDensity] *
              euler::lawIn<D>(flow.gas(), w).soundSpeedSquared(w[euler::kDensity], w[euler::kPressure<D>]));
}

/// The equation in a gas with its own equation of state, and in several gases. It is dp/dt + v . grad p = -rho c² div
/// v, divided by rho c²:
///
///   d / (rho c²) - dt div(loss_f (d_R - d_L)) = -dt div u_f - dt v . grad p / (rho c²),
///
/// which is also symmetric and positive definite.
template <int D, int K>
numerics::CellEquation<D> equationByLaw(const Level& level, const FaceFlow<D, K>& flow, const Index<D>& cell,
                                        double dt) {
  const double softness = softnessIn(flow, cell);
  numerics::CellEquation<D> equation = equationWith(cell, softness);
  forEachFaceOf<D>(level, cell, dt, [&](const CellFace<D>& face) {
    const double velocity = flow.old().number(cell, euler::kVelocity(face.axis));
    equation.right -= face.out * flow.unchanged(face.index, face.axis) +
                      0.5 * softness * face.out * velocity * riseAcross(flow, cell, face);
    couple(flow, face.next, face.ratio * flow.loss(face.index, face.axis), equation.left);
  });
  return equation;
}

/// p + p_inf of a cell [Pa].
template <int D, int K>
double stiffPressureIn(const FaceFlow<D, K>& flow, const Index<D>& cell) {
  const euler::State<D, K> w = flow.old().state(cell);
  if constexpr (K == 1)
    return w[euler::kPressure<D>] + flow.gas().pInfinity;
  else
    return euler::lawIn<D>(flow.gas(), w).heat(w[euler::kDensity], w[euler::kPressure<D>]);
}

/// The equations for the changes of pressures: functions of a patch, by its number on the rank, and of a cell.
template <class IsEmpty, class EquationOf, class ScaleOf, class FillRow = numerics::NoRows>
struct ChangeEquations {
  IsEmpty isEmpty;        ///< whether the pressure does not change, since there is no gas
  EquationOf equationOf;  ///< the equation
  ScaleOf scaleOf;        ///< the pressure, in the unit of the equation
  FillRow fillRow = {};   ///< see CellSystem::solve
};
template <class IsEmpty, class EquationOf, class ScaleOf>
ChangeEquations(IsEmpty, EquationOf, ScaleOf) -> ChangeEquations<IsEmpty, EquationOf, ScaleOf>;
template <class IsEmpty, class EquationOf, class ScaleOf, class FillRow>
ChangeEquations(IsEmpty, EquationOf, ScaleOf, FillRow) -> ChangeEquations<IsEmpty, EquationOf, ScaleOf, FillRow>;

/// Solves for the change of pressure in the step [Pa], given the state that the flow of each patch contains, and
/// computes the pressure at the end. The initial guess is the pressure at the end of the previous step. The residual
/// measures by how much the gas would miss the computed pressure, in the unit of the equation. Therefore, the tolerance
/// is relative to the largest pressure in that unit, or to the right-hand side if it is larger. Throws NumericalError
/// if the solver fails.
template <int D, int K, class Equations>
void solveForChange(const RankPatches& patches, const Workers& workers, const IceSettings& settings,
                    const std::vector<FaceFlow<D, K>>& flows, const std::vector<CellView<const double>>& guess,
                    const std::vector<PressureViews>& fresh, const SolveTotals& totals, const Equations& equations) {
  const auto old = [&](std::size_t p, const Index<D>& cell) {
    return flows[p].old().number(cell, euler::kPressure<D>);
  };
  std::vector<CellView<double>> changes;
  std::vector<CellView<const double>> first;
  std::vector<double> greatest(patches.size(), 0.0);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const CellView<double>& change = changes.emplace_back(fresh[p].change);
    first.emplace_back(change.values(), change.stored(), change.box());
  }
  forEachOn(workers, patches, [&](std::size_t p) {
    forEach<D>(patches[p]->cells(), [&](const Index<D>& cell) {
      changes[p][cell] = equations.isEmpty(p, cell) ? 0 : guess[p][cell] - old(p, cell);
      greatest[p] = std::max(greatest[p], std::abs(equations.scaleOf(p, cell)));
    });
  });
  const double scale = workers.ranks.max(std::ranges::max(greatest)) *
                       std::sqrt(static_cast<double>(patches.front()->level().cells().size()));
  numerics::CellSystem<D> system(patches, workers);
  const solvers::Outcome outcome = system.solve(settings.solver, first, equations.equationOf, scale, equations.fillRow);
  system.requireConvergence(outcome, "the pressure", "CFD/ICE/ImplicitSolver", "c.pressure",
                            ", or a smaller <delt_max>");
  system.take(changes);
  forEachOn(workers, patches, [&](std::size_t p) {
    forEach<D>(patches[p]->cells(),
               [&](const Index<D>& cell) { fresh[p].atEnd[cell] = old(p, cell) + changes[p][cell]; });
  });
  totals.iterations.add(outcome.krylovIterations);
  solvers::addTimes(outcome, totals.assembly, totals.preconditioner, totals.solution);
}

/// Solves for the change of pressure in the step [Pa], given the state before it, and computes the pressure at the end.
/// Throws NumericalError if the solver gives up.
template <int D>
void solvePressure(const RankPatches& patches, const Workers& workers, const euler::Settings& method,
                   const IceSettings& settings, double time, double dt, const std::vector<euler::OldState<D>>& before,
                   const std::vector<CellView<const double>>& guess, const std::vector<PressureViews>& fresh,
                   const SolveTotals& totals) {
  const Level& level = patches.front()->level();
  const euler::GhostRules<D> rules = euler::ghostRules<D>(level, method.gas, time);
  std::vector<FaceFlow<D>> flows;
  for (std::size_t p = 0; p < patches.size(); ++p)
    flows.emplace_back(level, method, settings, rules, patches[p]->cells(), dt);
  forEachOn(workers, patches, [&](std::size_t p) { flows[p].hold(patches[p]->cells(), before[p]); });
  const auto none = [](std::size_t, const Index<D>&) { return false; };
  if (method.gas.law) {
    const ChangeEquations equations{
        none, [&](std::size_t p, const Index<D>& cell) { return equationByLaw<D>(level, flows[p], cell, dt); },
        [&](std::size_t p, const Index<D>& cell) {
          return stiffPressureIn(flows[p], cell) * softnessIn(flows[p], cell);
        }};
    return solveForChange<D>(patches, workers, settings, flows, guess, fresh, totals, equations);
  }
  const ChangeEquations equations{
      none, [&](std::size_t p, const Index<D>& cell) { return pressureEquation<D>(level, flows[p], cell, dt); },
      [&](std::size_t p, const Index<D>& cell) { return stiffPressureIn(flows[p], cell); },
      [&](std::size_t p, const Index<D>& row, int count, const solvers::BoxRow<D>& to) {
        fillPressureEquations<D>(flows[p], row, count, dt, to);
      }};
  solveForChange<D>(patches, workers, settings, flows, guess, fresh, totals, equations);
}

}  // namespace tushar::ice
