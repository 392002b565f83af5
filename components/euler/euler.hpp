#pragma once

#include "components/euler/labels.hpp"
#include "components/euler/settings.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::euler {

/// The default refinement criteria of a gas: variables whose differences show where it needs finer cells.
template <int D>
std::vector<simulation::Criterion> criteria();

/// Godunov's method for the Euler equations of gas dynamics in D dimensions: dU/dt + sum_d dF_d(U)/dx_d = 0, U = (rho,
/// rho v, E).
///
/// A face with `Symmetric`, or whose only condition is a tangential Dirichlet `Velocity`, is a wall; a face with
/// Dirichlet values of `Density`, `Velocity` or `Pressure` is an inflow; any other face is an outflow. Mass, momentum
/// and energy change only by fluxes through the sides of the grid.
template <int D>
class Euler : public Component, public reference::GasSolution {
 public:
  explicit Euler(Settings settings) : settings_(std::move(settings)) {}

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;
  void scheduleAfterRefluxing(TaskList& tasks) const override;
  std::vector<std::shared_ptr<const data::JointInterpolation>> jointInterpolations() const override;
  std::vector<simulation::Criterion> criteria() const override { return euler::criteria<D>(); }
  std::string advice() const override {
    return "a smaller Euler/cfl, Euler/limiter minmod, or Euler/reconstruction first_order";
  }
  std::vector<reference::GasLaw> gases() const override;
  void scheduleMeasureError(TaskList& tasks, const reference::GasReference& exact,
                            const reference::Clock& clock) const override;
  std::vector<reference::MeasuredPlace> measuredPlaces() const override { return {reference::MeasuredPlace::cell}; }

 protected:
  const Settings& settings() const { return settings_; }
  /// Whether the gas carries any other quantities, whose fluxes follow from the mass flux.
  virtual bool keepsFaceMasses() const { return false; }
  /// The labels of these quantities, each times the density.
  virtual std::vector<const data::Label*> carried() const { return {}; }

 private:
  Settings settings_;
};

/// Schedules the diagnostics that do not depend on the type of gas: mass, momentum, energy, kinetic energy, and the
/// smallest density and energy.
template <int D>
void scheduleTotals(TaskList& tasks);

extern template class Euler<1>;
extern template class Euler<2>;
extern template class Euler<3>;

}  // namespace tushar::euler
