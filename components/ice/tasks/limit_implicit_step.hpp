#pragma once

#include "components/euler/tasks/add_varying_diffusion.hpp"
#include "components/ice/face_flow.hpp"
#include "components/ice/pushed_gas.hpp"

namespace tushar::ice {

/// Computes the pressure of the gas [Pa]; in the first step, it is used as the pressure at the end of a previous step.
template <int D>
void initializePressure(const Patch& patch, const euler::Gas& gas, CellView<const double> density,
                        CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                        CellView<double> pressure) {
  const euler::StateViews<D, const double> state{density, momentum, totalEnergy};
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { pressure[cell] = euler::pressureIn(gas, state, cell); });
}

/// Returns the greatest rate of PushedGas of the patch [1/s], with the flow (|v_d| + k c) / h_d, the diffusion
/// `diffusionAt(cell, d)` [1/s] and the push a_d / h_d. It includes the acceleration a_d = |g_d - (dp/dx_d) / rho|, so
/// that gas initially at rest does not cross a cell within the step. |v_d| is the maximum of the cell's velocity and of
/// the velocities prescribed at its faces. The pressure in a_d is `pushing`, the pressure at the end of the previous
/// step. It is not the pressure of the gas itself, which also contains the effect of conduction; sound equalises that
/// effect before it moves the gas. k is Uintah's `knob_for_speedSound`. Source: N. Kwatra & al., J. Comput. Phys. 228
/// (2009) 4146, section 3.3.
template <int D, int K, class DiffusionAt>
double greatestImplicitRate(const Patch& patch, const GasBefore<D, K>& gas, const euler::Rows<D, K>& pushing,
                            double soundSpeedKnob, const euler::Courant& courant, DiffusionAt&& diffusionAt) {
  const euler::CrossingRate<D> crossing(courant);
  const Level& level = patch.level();
  const double second = 1;
  const auto acceleration = [&](const Index<D>& face, int axis) {
    const std::size_t p = euler::kPressure<D>;
    const double gained = gas.mobility(face, axis, second);
    if (gained == 0) return 0.0;
    const double rise = pushing.number(face, p) - pushing.number(face - Index<D>::unit(axis), p);
    return std::abs(gas.acceleration(axis, gas.density(face, axis)) - gained * rise);
  };
  const auto speed = [&](const Index<D>& cell, int axis) {
    double most = std::abs(gas.old().number(cell, euler::kVelocity(axis)));
    for (const Index<D>& face : {cell, cell + Index<D>::unit(axis)})
      if (const auto given = gas.givenVelocity(face, axis)) most = std::max(most, std::abs(*given));
    return most;
  };
  double greatest = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double sound = soundSpeedKnob * gas.soundSpeed(cell);
    PushedGas<D> crossed;
    for (int d = 0; d < D; ++d) {
      const double perWidth = level.inverseSpacing(d);
      crossed.flow[d] = (speed(cell, d) + sound) * perWidth;
      crossed.diffusion[d] = diffusionAt(cell, d);
      crossed.push[d] = perWidth * std::max(acceleration(cell, d), acceleration(cell + Index<D>::unit(d), d));
    }
    greatest = std::max(greatest, crossed.rate(crossing));
  });
  return greatest;
}

/// Computes dt = cfl / s, where s is the greatestImplicitRate of the gas before the step, with `diffusionAt(gas, cell,
/// d)`. Throws NumericalError where a density, or p + p_inf, is not positive.
template <int D, class DiffusionAt>
void limitImplicitStepWith(const Patch& patch, const euler::Settings& method, const IceSettings& settings,
                           const euler::OldState<D>& before, double time, CellView<const double> pressure, Minimum& dt,
                           DiffusionAt&& diffusionAt) {
  const Level& level = patch.level();
  euler::refuseBroken<D, const double>(patch, method.gas, before, nullptr);
  const euler::GhostRules<D> rules = euler::ghostRules<D>(level, method.gas, time);
  const Box cells = patch.cells().grown(1, D);
  GasBefore<D> gas(level, method.gas, settings, rules, cells.size());
  gas.hold(cells, before);
  euler::Rows<D> pushing = gas.old();
  gas.fillWithPressure(pressure, pushing);
  const double greatest =
      greatestImplicitRate<D, 1>(patch, gas, pushing, settings.soundSpeedKnob, method.courant,
                                 [&](const Index<D>& cell, int d) { return diffusionAt(gas, cell, d); });
  if (greatest > 0) dt.add(method.courant.number / greatest, "CFL");
}

/// Computes dt as in limitImplicitStepWith, with the diffusion 2 nu / h_d², where nu is the largest diffusivity.
template <int D>
void limitImplicitStep(const Patch& patch, const euler::Settings& method, const IceSettings& settings,
                       const euler::OldState<D>& before, double time, CellView<const double> pressure, Minimum& dt) {
  limitImplicitStepWith<D>(patch, method, settings, before, time, pressure, dt,
                           [&](const GasBefore<D>& gas, const Index<D>& cell, int d) {
                             if (!settings.diffusion.acts()) return 0.0;
                             const double perWidth = patch.level().inverseSpacing(d);
                             const double density = gas.old().number(cell, euler::kDensity);
                             return 2 * settings.diffusion.greatest(method.gas, density) * perWidth * perWidth;
                           });
}

/// Computes dt as in limitImplicitStepWith, with the diffusion (nu_below + nu_above) / h_d² of varying coefficients.
template <int D>
void limitVaryingImplicitStep(const Patch& patch, const euler::Settings& method, const IceSettings& settings,
                              const euler::VaryingDiffusion& how, const euler::OldState<D>& before, double time,
                              CellView<const double> pressure, Minimum& dt) {
  const euler::GhostRules<D> rules = euler::diffusionRules<D>(patch.level(), method.gas, time);
  euler::Diffuser<D> diffuser(patch.level(), patch.cells(), rules, how.smagorinsky);
  euler::Rows<D> rates =
      euler::ratesOfDiffusion<D>(patch, diffuser, euler::diffusingCells<D>(patch.level(), method.gas, how, before));
  limitImplicitStepWith<D>(
      patch, method, settings, before, time, pressure, dt,
      [&](const GasBefore<D>&, const Index<D>& cell, int d) { return rates.number(cell, euler::kVelocity(d)); });
}

}  // namespace tushar::ice
