#pragma once

#include "core/core.hpp"
#include "core/input/expression.hpp"
#include "core/numerics/checked_formula.hpp"
#include "core/numerics/diffusion.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::heat {

namespace c {
inline constexpr CellLabel<double> temperature{"c.temperature", "K", "temperature", Bound::finite};
}
namespace boundary {
inline constexpr BoundaryLabel<double> temperature{"Temperature"};
}
inline constexpr ReductionLabel<Sum> totalEnergy{"TotalEnergy", "J", "heat in all cells, from 0 K"};

/// The `Heat` section.
struct Settings {
  input::Expression conductivity{1.0};  ///< conductivity k [W/(m K)]
  double density = 1;                   ///< density rho [kg/m³]
  double specificHeat = 1;              ///< specific heat c [J/(kg K)]
  double cfl = 0.9;                     ///< fraction of the largest stable time step
  input::Expression temperature{0.0};   ///< initial temperature [K]
  /// Error of linear interpolation between cells above which the cells are refined [K]; 0: never.
  double refinementTolerance = 0;

  double capacity() const { return density * specificHeat; }  ///< rho c [J/(m³ K)]
};

/// Heat conduction, rho c dT/dt = div(k grad T), explicit in time, centred in space, in D dimensions.
///
/// A face with a Dirichlet condition for `Temperature` has the given value [K], one with a Neumann condition the given
/// outward derivative [K/m]; any other face is insulated. This is the smallest complete component: copy it with
/// tools/new_component.
template <int D>
class Heat : public Component {
 public:
  explicit Heat(Settings settings) : settings_(std::move(settings)) {}

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  void scheduleErrorEstimate(TaskList& tasks) const override;
  std::string advice() const override { return "a <temperature> that is finite everywhere, or a smaller <cfl>"; }

 private:
  Settings settings_;
};

/// Sets T at the centre of each cell from the scene's formula. Throws InputError if it is not finite, or if k is not
/// greater than 0.
template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> temperature) {
  numerics::CheckedFormula{settings.temperature, "Heat/temperature", "K"}.fill<D>(patch, temperature);
  numerics::CheckedFormula{settings.conductivity, "Heat/thermal_conductivity", "W/(m K)"}.requirePositive<D>(patch);
}

/// Computes dt = cfl rho c / max(sum over the cell's faces of k / h_d²). For a uniform k, this is von Neumann's limit:
/// no cell overshoots its neighbours.
template <int D>
void computeStableTimeStep(const Patch& patch, const Settings& settings, Minimum& dt) {
  const numerics::Diffusion<D> diffusion(patch.level(), settings.conductivity, boundary::temperature, patch.cells());
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    dt.add(settings.cfl * settings.capacity() / diffusion.rate(cell), "conduction");
  });
}

/// Performs one explicit step: T' = T + dt sum_d (k_{i-1/2} (T_{i-1} - T_i) + k_{i+1/2} (T_{i+1} - T_i)) / (rho c
/// h_d²), where k at faces is that of Diffusion. The stored fluxes are those of T [K m/s].
template <int D>
void conduct(const Patch& patch, const Settings& settings, CellView<const double> temperature, double dt,
             CellView<double> newTemperature, RimFlux<double> flux = {}) {
  const numerics::Diffusion<D> diffusion(patch.level(), settings.conductivity, boundary::temperature, patch.cells());
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    newTemperature[cell] = temperature[cell] + dt / settings.capacity() * diffusion(temperature, cell);
  });
  flux.forEachFace<D>([&](const Index<D>& cell, int d, int side, double& through) {
    through += diffusion.flux(temperature, cell, d, side) / settings.capacity();
  });
}

/// Marks cells in which the error of linear interpolation between cells exceeds `tolerance` [K]. The error is |T_{i-1}
/// - 2 T_i + T_{i+1}| / 8 along the worst axis, that is, h² |T''| / 8. On cells twice as wide, it is four times as
/// large; therefore cells with more than a quarter of the tolerance are kept. At a side of the grid, the inner
/// neighbour takes the place of the missing one.
template <int D>
void estimateError(const Patch& patch, double tolerance, CellView<const double> temperature, Marks marks) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double worst = 0;
    for (int d = 0; d < D; ++d) {
      const Index<D> before = cell - Index<D>::unit(d), behind = cell + Index<D>::unit(d);
      if (!temperature.box().contains(before) || !temperature.box().contains(behind)) continue;
      worst = std::max(worst, std::abs(temperature[before] - 2 * temperature[cell] + temperature[behind]) / 8);
    }
    if (worst > tolerance)
      marks.refine(cell);
    else if (worst > tolerance / 4)
      marks.keep(cell);
  });
}

/// Computes the heat in the patch's cells [J].
template <int D>
void sumEnergy(const Patch& patch, const Settings& settings, CellView<const double> temperature, Sum& energy) {
  const double capacity = settings.capacity() * patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { energy.add(capacity * temperature[cell]); });
}

/// Describes this component to sus.
simulation::ComponentKind kind();

}  // namespace tushar::heat
