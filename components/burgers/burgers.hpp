#pragma once

#include "core/core.hpp"
#include "core/input/expression.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::burgers {

namespace c {
inline constexpr CellLabel<double> u{"c.u", "m/s", "mean of u over the cell"};
inline constexpr CellLabel<double> predicted{"c.predictedU", "m/s", "u after a step of Euler's method"};
}  // namespace c
namespace boundary {
inline constexpr BoundaryLabel<double> velocity{"Velocity"};
}
inline constexpr ReductionLabel<Sum> totalMomentum{"TotalMomentum", "m^4/s", "integral of u"};
inline constexpr ReductionLabel<Sum> totalEnergy{"TotalEnergy", "m^5/s^2", "integral of u^2 / 2"};

/// A function that computes the slope of a cell from the differences to its two neighbours.
using Slope = double (*)(double, double);

/// The `Burgers` section.
struct Settings {
  double viscosity = 0;             ///< viscosity nu [m²/s]
  double cfl = 0.5;                 ///< fraction of the stable time step, 1 / (sum_d |u| / h_d + 2 nu / h_d²)
  int limiter = 2;                  ///< index of the limiter, as in slopeOf
  input::Expression velocity{0.0};  ///< initial u [m/s]
};

/// The slope function with this index. 0: none, first order; 1: minmod; 2: van Leer; 3: monotonised central.
Slope slopeOf(int limiter);

/// Burgers' equation, du/dt + sum_d d(u²/2)/dx_d = nu div grad u, by finite volumes in D dimensions.
///
/// Godunov's flux with face states from limited slopes, centred differences for the viscosity, and Heun's method in
/// time. It is of second order where u is smooth. At a face with a Dirichlet condition for `Velocity`, this u
/// [m/s] enters; at any other face, u leaves unchanged. Sources: S. K. Godunov, Mat. Sb. 47 (1959) 271; B. van
/// Leer, J. Comput. Phys. 32 (1979) 101; S. Gottlieb & C.-W. Shu, Math. Comp. 67 (1998) 73.
template <int D>
class Burgers : public Component {
 public:
  explicit Burgers(Settings settings) : settings_(std::move(settings)) {}

  void scheduleInitialize(TaskList& tasks) const override;
  void scheduleComputeStableTimeStep(TaskList& tasks) const override;
  void scheduleTimeAdvance(TaskList& tasks) const override;
  void scheduleDiagnostics(TaskList& tasks) const override;

  const Settings& settings() const { return settings_; }

 private:
  Settings settings_;
};

/// Sets u at the centre of each cell from the scene's formula.
template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> u);

/// Computes dt = cfl / max(sum_d |u| / h_d + 2 nu / h_d²).
template <int D>
void computeStableTimeStep(const Patch& patch, const Settings& settings, CellView<const double> u, Minimum& dt);

/// Godunov's flux between two states: the maximum of u²/2 between them if left > right, otherwise its minimum.
double godunovFlux(double left, double right);

/// Computes u* = u + dt L(u), where L(u) is the net inflow into a cell divided by its volume.
template <int D>
void predict(const Patch& patch, const Settings& settings, CellView<const double> u, double dt,
             CellView<double> predicted, RimFlux<double> flux = {});

/// Computes u' = (u + u* + dt L(u*)) / 2.
template <int D>
void correct(const Patch& patch, const Settings& settings, CellView<const double> u, CellView<const double> predicted,
             double dt, CellView<double> newU, RimFlux<double> flux = {});

/// Computes the integrals of u and u²/2 over the patch's cells.
template <int D>
void sumTotals(const Patch& patch, CellView<const double> u, Sum& momentum, Sum& energy);

/// Describes this component to sus.
simulation::ComponentKind kind();

}  // namespace tushar::burgers
