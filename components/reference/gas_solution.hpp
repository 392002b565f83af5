#pragma once

#include <vector>

#include "components/reference/gas_reference.hpp"
#include "components/reference/riemann_solution.hpp"
#include "core/core.hpp"

namespace tushar::reference {

/// The time at which errors are measured [s]. It is counted from the start of the run, where exact solutions have t =
/// 0, and is set before the tasks run.
struct Clock {
  double time = 0;
};

/// Labels of the error norms of a gas: one reduction per field.
struct GasErrorLabels {
  ReductionLabel<Norm> density, velocity, pressure, energy;
};

/// Errors of particles, relative to the exact values at their positions.
inline constexpr GasErrorLabels particleError{
    {"ParticleError.density", "kg/m^3", "error of density at the particles"},
    {"ParticleError.velocity", "m/s", "magnitude of the velocity error at the particles"},
    {"ParticleError.pressure", "Pa", "error of pressure (without artificial viscosity) at the particles"},
    {"ParticleError.energy", "J/kg", "error of internal energy at the particles"}};

/// Errors of cell means, relative to exact cell means; cells without gas count as vacuum.
inline constexpr GasErrorLabels cellError{{"CellError.density", "kg/m^3", "error of the mean density of cells"},
                                          {"CellError.velocity", "m/s", "error of the mean velocity of cells"},
                                          {"CellError.pressure", "Pa", "error of the mean pressure of cells"},
                                          {"CellError.energy", "J/kg", "error of the mean internal energy of cells"}};

/// Error norms of a gas relative to exact values: one norm per field.
struct ErrorNorms {
  Norm &density, &velocity, &pressure, &energy;

  static ErrorNorms from(auto& take, const GasErrorLabels* labels) {
    return {.density = take(computes(labels->density)),
            .velocity = take(computes(labels->velocity)),
            .pressure = take(computes(labels->pressure)),
            .energy = take(computes(labels->energy))};
  }

  /// Adds the errors of a cell, node or particle to the norms; `weight` is the weight of a cell, Level::weight().
  void add(const GasState& found, const GasState& exact, double weight = 1) const {
    density.add(found.density - exact.density, exact.density, weight);
    velocity.add((found.velocity - exact.velocity).norm(), exact.velocity.norm(), weight);
    pressure.add(found.pressure - exact.pressure, exact.pressure, weight);
    energy.add(found.energy - exact.energy, exact.energy, weight);
  }
};

/// max_i |m_i / V_i - rho_exact(x_i)| over the nodes.
inline constexpr ReductionLabel<Norm> nodeError{
    "NodeError.density", "kg/m^3", "error of nodal mass divided by nodal volume, relative to the exact density"};

/// Computes the exact means over a cell of a grid.
template <int D>
GasState cellMean(const GasReference& exact, const Level& level, const Index<D>& cell, double time) {
  Vec<D> lower, upper;
  for (int d = 0; d < D; ++d) {
    lower[d] = level.nodePosition(d, cell[d]);
    upper[d] = level.nodePosition(d, cell[d] + 1);
  }
  return exact.average(level.expandPoint<D>(lower), level.expandPoint<D>(upper), time);
}

/// Where a component can measure errors.
enum class MeasuredPlace { particle, cell, node };

/// A component that solves for a gas and can measure the errors of the gas relative to an exact state.
class GasSolution {
 public:
  virtual ~GasSolution() = default;
  /// The laws of the gases; none if a GasLaw cannot describe them.
  virtual std::vector<GasLaw> gases() const = 0;
  /// The places for which scheduleMeasureError adds tasks.
  virtual std::vector<MeasuredPlace> measuredPlaces() const {
    return {MeasuredPlace::particle, MeasuredPlace::cell, MeasuredPlace::node};
  }
  /// Adds diagnostic tasks that compute the error labels of measuredPlaces relative to `exact` at the time of `clock`.
  /// Both must outlive the task list.
  virtual void scheduleMeasureError(TaskList& tasks, const GasReference& exact, const Clock& clock) const = 0;
};

}  // namespace tushar::reference
