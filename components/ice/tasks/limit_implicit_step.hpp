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

/// The rates of PushedGas in cells.
template <int D, int K, class DiffusionAt>
class ImplicitRates {
 public:
  ImplicitRates(const GasBefore<D, K>& gas, const euler::Rows<D, K>& pushing, double soundSpeedKnob,
                const DiffusionAt& diffusionAt)
      : gas_(gas), pushing_(pushing), knob_(soundSpeedKnob), diffusion_at_(diffusionAt) {}

  /// Those of a cell.
  PushedGas<D> of(const Index<D>& cell) const {
    const double sound = knob_ * gas_.soundSpeed(cell);
    PushedGas<D> crossed;
    for (int d = 0; d < D; ++d) {
      const double perWidth = gas_.level().inverseSpacing(d);
      crossed.flow[d] = (speed(cell, d) + sound) * perWidth;
      crossed.diffusion[d] = diffusion_at_(cell, d);
      crossed.push[d] = perWidth * std::max(acceleration(cell, d), acceleration(cell + Index<D>::unit(d), d));
    }
    return crossed;
  }
  /// The greatest rate of a row of at least Lanes::count cells that no side of the grid touches.
  double greatest(const Index<D>& row, int count, const euler::CrossingRate<D>& crossing) const {
    const std::ptrdiff_t first = gas_.old().offsetOf(row);
    Lanes most = 0.0;
    for (int i = 0; i < count; i += Lanes::count) {
      Index<D> cell = row;
      const int from = std::min(i, count - Lanes::count);
      cell[0] += from;
      most = max(most, ratesOf(cell, first + from).rate(crossing));
    }
    return tushar::greatest(most);
  }

 private:
  /// The greatest of the speeds of a cell and of those prescribed at its faces along an axis [m/s].
  double speed(const Index<D>& cell, int axis) const {
    double most = std::abs(gas_.old().number(cell, euler::kVelocity(axis)));
    for (const Index<D>& face : {cell, cell + Index<D>::unit(axis)})
      if (gas_.isOnSide(face, axis))
        if (const auto given = gas_.givenVelocity(face, axis)) most = std::max(most, std::abs(*given));
    return most;
  }
  /// |a_d| at a face [m/s²].
  double acceleration(const Index<D>& face, int axis) const {
    const double second = 1, gained = gas_.mobility(face, axis, second);
    if (gained == 0) return 0;
    const double* above = pushing_.component(euler::kPressure<D>) + pushing_.offsetOf(face);
    const double rise = above[0] - above[-pushing_.stride(axis)];
    return std::abs(gas_.acceleration(axis, gas_.density(face, axis)) - gained * rise);
  }
  PushedGas<D, Lanes> ratesOf(const Index<D>& cell, std::ptrdiff_t place) const {
    const Lanes sound = knob_ == 0 ? Lanes(0.0) : knob_ * soundSpeeds(cell, place);
    PushedGas<D, Lanes> crossed;
    for (int d = 0; d < D; ++d) {
      const double perWidth = gas_.level().inverseSpacing(d);
      const std::ptrdiff_t step = gas_.old().stride(d);
      const Lanes v = Lanes::at(gas_.old().component(euler::kVelocity(d)) + place);
      crossed.flow[d] = (abs(v) + sound) * perWidth;
      crossed.diffusion[d] = Lanes::of([&](int lane) {
        Index<D> at = cell;
        at[0] += lane;
        return diffusion_at_(at, d);
      });
      crossed.push[d] = perWidth * max(acceleration(place, d, step), acceleration(place + step, d, step));
    }
    return crossed;
  }
  /// |a_d| at the lower faces of cells [m/s²].
  Lanes acceleration(std::ptrdiff_t place, int axis, std::ptrdiff_t step) const {
    const double* rho = gas_.old().component(euler::kDensity) + place;
    const double* p = pushing_.component(euler::kPressure<D>) + place;
    const Lanes density = 0.5 * (Lanes::at(rho - step) + Lanes::at(rho));
    const Lanes gained = gas_.level().inverseSpacing(axis) / density;
    return abs(gas_.acceleration(axis, density) - gained * (Lanes::at(p) - Lanes::at(p - step)));
  }
  Lanes soundSpeeds(const Index<D>& cell, std::ptrdiff_t place) const {
    if constexpr (K == 1)
      if (!gas_.gas().law)
        return sqrt(euler::lawOf<euler::StiffenedGas>(gas_.gas())
                        .soundSpeedSquared(Lanes::at(gas_.old().component(euler::kDensity) + place),
                                           Lanes::at(gas_.old().component(euler::kPressure<D>) + place)));
    return Lanes::of([&](int lane) {
      Index<D> at = cell;
      at[0] += lane;
      return gas_.soundSpeed(at);
    });
  }

  const GasBefore<D, K>& gas_;
  const euler::Rows<D, K>& pushing_;
  double knob_;
  const DiffusionAt& diffusion_at_;
};

/// Returns the greatest rate of PushedGas of the patch [1/s], with the flow (|v_d| + k c) / h_d, the diffusion
/// `diffusionAt(cell, d)` [1/s] and the push a_d / h_d. It includes the acceleration a_d = |g_d - (dp/dx_d) / rho|, so
/// that gas initially at rest does not cross a cell within the step. |v_d| is the maximum of the cell's velocity and of
/// the velocities prescribed at its faces. The pressure in a_d is `pushing`, the pressure at the end of the previous
/// step. It is not the pressure of the gas itself, which also contains the effect of conduction; sound equalises that
/// effect before it moves the gas. k is Uintah's `knob_for_speedSound`. Source: N. Kwatra & al., J. Comput. Phys. 228
/// (2009) 4146, section 3.3.
template <int D, int K, class DiffusionAt>
double greatestImplicitRate(const Patch& patch, const GasBefore<D, K>& gas, const euler::Rows<D, K>& pushing,
                            double soundSpeedKnob, const euler::Courant& courant, const DiffusionAt& diffusionAt) {
  const euler::CrossingRate<D> crossing(courant);
  const ImplicitRates<D, K, DiffusionAt> rates(gas, pushing, soundSpeedKnob, diffusionAt);
  double greatest = 0;
  grid::forEachRow<D>(patch.cells(), [&](Index<D> first, int count) {
    bool isAtSide = count < Lanes::count + 2;
    for (int d = 1; d < D; ++d) isAtSide |= gas.isSide(first[d], d) || gas.isSide(first[d] + 1, d);
    const int end = first[0] + count;
    if (!isAtSide) {  // cells between the first and the last one
      ++first[0];
      greatest = std::max(greatest, rates.greatest(first, count - 2, crossing));
      --first[0];
    }
    const int step = isAtSide ? 1 : count - 1;
    for (; first[0] < end; first[0] += step) greatest = std::max(greatest, rates.of(first).rate(crossing));
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
