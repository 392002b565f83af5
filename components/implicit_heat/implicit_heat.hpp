#pragma once

#include "components/heat/heat.hpp"
#include "core/core.hpp"
#include "core/simulation/catalogue.hpp"
#include "core/solvers/report.hpp"

namespace tushar::implicit_heat {

namespace c = heat::c;
namespace boundary = heat::boundary;
using heat::totalEnergy;
inline constexpr ReductionLabel<Maximum> iterations{"KrylovIterations", "1", "iterations of the linear solve"};

/// The `Heat` section for implicit steps; these do not use `cfl` and `refinementTolerance`.
struct Settings : heat::Settings {
  double theta = 1;  ///< weight of the new temperature in the flux
  solvers::LinearSettings solver;
};

/// Heat conduction, rho c dT/dt = div(k grad T), implicit in time, centred in space, in D dimensions: stable with any
/// time step.
///
/// A face with a Dirichlet condition for `Temperature` has the given value [K], one with a Neumann condition the given
/// outward derivative [K/m]; any other face is insulated.
template <int D>
class ImplicitHeat : public Component {
 public:
  explicit ImplicitHeat(Settings settings) : settings_(std::move(settings)) {}

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  std::string advice() const override { return "a <temperature> that is finite everywhere, or a smaller <delt_max>"; }
  std::vector<simulation::Reported> reported() const override { return {simulation::iterationsOfRun(iterations)}; }

 private:
  Settings settings_;
};

/// Solves rho c (T' - T) / dt = div(k grad T*) with T* = theta T' + (1 - theta) T. This is a linear system for T* in
/// all cells; it gives T' = T + (T* - T) / theta. theta = 1 is backward Euler, of first order in time; on a single
/// level, T' then stays within the range of T and the boundary values. theta = 1/2 is the method of Crank & Nicolson,
/// Proc. Camb. Phil. Soc. 43 (1947) 50, of second order. Both are stable for any dt. Throws NumericalError if the
/// solver fails.
template <int D>
void conduct(const RankPatches& patches, const Workers& workers, const Settings& settings, double dt,
             const std::vector<CellView<const double>>& temperature,
             const std::vector<CellView<double>>& newTemperature, Maximum& iterationsTaken, Maximum& assembly,
             Maximum& setup, Maximum& solution);

/// Describes this component to sus.
simulation::ComponentKind kind();

}  // namespace tushar::implicit_heat
