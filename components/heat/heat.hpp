#pragma once

#include "core/core.hpp"
#include "core/input/diagnostics.hpp"
#include "core/input/expression.hpp"
#include "core/simulation/catalogue.hpp"
#include "core/solvers/report.hpp"

namespace tushar::heat {

namespace c {
inline constexpr CellLabel<double> temperature{"c.temperature", "K", "temperature", Bound::finite};
}
inline constexpr ReductionLabel<Sum> totalEnergy{"TotalEnergy", "J", "heat in all cells, from 0 K"};
inline constexpr ReductionLabel<Maximum> iterations{"KrylovIterations", "1", "iterations of the linear solve"};

/// The `Heat` section.
struct Settings {
  Location where;                       ///< in the scene
  input::Expression conductivity{1.0};  ///< k, W/(m K)
  double density = 1;                   ///< rho, kg/m³
  double specificHeat = 1;              ///< c, J/(kg K)
  double cfl = 0.9;                     ///< part of the greatest stable time step
  input::Expression temperature{0.0};   ///< at the start, K
  double theta = 0;                     ///< part of the new temperature in the flux; 0: explicit in time
  solvers::LinearSettings solver;       ///< where theta is not 0

  double capacity() const { return density * specificHeat; }  ///< rho c, J/(m³ K)
};

/// Heat conduction, rho c dT/dt = div(k grad T), explicit or implicit in time, centred in space, in D dimensions.
///
/// At a face with `Temperature` Dirichlet the value [K] is kept, with Neumann the outward derivative [K/m]; any other
/// face is insulated. The smallest complete component: copy it with tools/new_component.
template <int D>
class Heat : public Component {
 public:
  explicit Heat(Settings settings) : settings_(std::move(settings)) {}

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  std::string advice() const override { return "a <temperature> that is finite everywhere, or a smaller <cfl>"; }

 private:
  Settings settings_;
};

/// T at the middle of each cell, from the scene's formula. Throws InputError where that is not finite, or k not greater
/// than 0.
template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> temperature);

/// dt = cfl rho c / max(sum over the cell's faces of k / h_d²), for one k everywhere the limit of von Neumann: no cell
/// overshoots its neighbours.
template <int D>
void computeStableTimeStep(const Patch& patch, const Settings& settings, Minimum& dt);

/// T' = T + dt sum_d (k_{i-1/2} (T_{i-1} - T_i) + k_{i+1/2} (T_{i+1} - T_i)) / (rho c h_d²); k at faces is the harmonic
/// mean of both cells, so that the flux is right where k jumps (Patankar, Numerical Heat Transfer and Fluid Flow, 4.2).
template <int D>
void conduct(const Patch& patch, const Settings& settings, CellView<const double> temperature, double dt,
             CellView<double> newTemperature);

/// Heat in the patch's cells [J].
template <int D>
void sumEnergy(const Patch& patch, const Settings& settings, CellView<const double> temperature, Sum& energy);

/// What sus knows of this component.
simulation::ComponentKind kind();

}  // namespace tushar::heat
