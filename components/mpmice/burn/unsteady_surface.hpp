#pragma once

#include "components/mpmice/burn/neighbourhood.hpp"

// Surfaces that remember how they burned (ice::UnsteadyBurn). Particles carry the state of the surface in their cell,
// so that it moves with the body; a cell has the mean of its particles that burn.

namespace tushar::mpmice {

/// Views of the state of a surface on particles or in cells.
template <class View>
struct SurfaceHeats {
  View temperature, gradient;

  static SurfaceHeats onParticles(auto& take, auto access) {
    return {take(access(p::surfaceTemperature)), take(access(p::surfaceGradient))};
  }
};

struct OldSurface : SurfaceHeats<ParticleView<const double>> {
  static OldSurface from(auto& take) {
    return {SurfaceHeats::onParticles(take, [](const auto& label) { return requiresOld(label); })};
  }
};
struct NewSurface : SurfaceHeats<ParticleView<double>> {
  static NewSurface from(auto& take) {
    return {SurfaceHeats::onParticles(take, [](const auto& label) { return computes(label); })};
  }
};

/// Sets the surface state of particles at the start: nothing burns.
inline void startSurface(const Patch&, const mpm::solid::Material&, ParticleView<const double> mass,
                         const NewSurface& fresh) {
  for (int p = 0; p < mass.owned(); ++p) fresh.temperature[p] = fresh.gradient[p] = 0;
}

/// Computes the state of the surface in each cell at the start of a step: the mean over the particles of the burning
/// body that burned, weighted by their mass; 0 if there are none.
template <int D>
void measureSurface(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                    const std::vector<ParticleView<const double>>& masses, const std::vector<OldSurface>& bodies,
                    CellView<double> temperature, CellView<double> gradient) {
  const ParticleView<const double>& mass = masses[settings.burning->body];
  const OldSurface& body = bodies[settings.burning->body];
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double sum = 0, heat = 0, slope = 0;
    for (const int p : mass.template in<D>(cell)) {
      if (!(body.gradient[p] > 0)) continue;
      sum += mass[p];
      heat += mass[p] * body.temperature[p];
      slope += mass[p] * body.gradient[p];
    }
    temperature[cell] = sum > 0 ? heat / sum : 0;
    gradient[cell] = sum > 0 ? slope / sum : 0;
  });
}

/// Views of the results of measureSurface.
struct SurfaceBefore {
  CellView<const double> temperature, gradient;

  static SurfaceBefore from(auto& take, int ghost) {
    return {.temperature = take(requiresNew(c::surfaceTemperatureBefore, ghost)),
            .gradient = take(requiresNew(c::surfaceGradientBefore, ghost))};
  }
};
struct SurfaceNow {
  CellView<double> temperature, gradient, rate;

  static SurfaceNow from(auto& take) {
    return {.temperature = take(computes(c::surfaceTemperature)),
            .gradient = take(computes(c::surfaceGradient)),
            .rate = take(computes(c::unsteadyRate))};
  }
};

/// Advances the state of surfaces, given the state of the gas at the start of the step.
template <int D>
class UnsteadySurface {
 public:
  UnsteadySurface(const Level& level, const Settings& settings, const GasInCells<D>& cells, const Reactant& reactant,
                  const SurfaceBefore& before)
      : level_(level),
        model_(settings.burning->model),
        reactant_(reactant),
        before_(before),
        around_(level, settings, cells, reactant) {}

  struct Found {
    ice::SurfaceHeat state;
    double rate = 0;  ///< burn rate [kg/(m² s)]
  };
  /// Finds the state of the surface in a cell after the time step dt [s], and the rate in this state; both are 0 if the
  /// cell has no surface of the body, or if nothing burns there.
  Found find(const Index<D>& cell, double dt) const {
    if (!(reactant_.mass[cell] > 0) || !hasSurface(cell)) return {};
    const auto around = around_.look(cell);
    if (!around.isHot || !(around.product > model_.leastPressure)) return {};
    const ice::AtSurface at{around.product, reactant_.temperature[cell], reactant_.mass[cell] / reactant_.volume[cell]};
    const ice::SurfaceHeat state = model_.unsteady()->after(stateBefore(cell), dt, at);
    const std::optional<double> rate = model_.unsteady()->rateIn(state, at);
    if (!rate) refuse(cell, state, at);
    return {state, *rate};
  }

 private:
  /// Whether a part of the surface is in the cell or at its faces.
  bool hasSurface(const Index<D>& cell) const { return !around_.isEmpty(cell) || around_.isExposed(cell, 0); }
  /// The state before the step; in a cell that begins to burn, the mean of the cells around it that burned.
  ice::SurfaceHeat stateBefore(const Index<D>& cell) const {
    if (before_.gradient[cell] > 0) return {before_.temperature[cell], before_.gradient[cell]};
    ice::SurfaceHeat mean;
    int count = 0;
    around_.forEachAround(cell, [&](const Index<D>& at) {
      if (!(before_.gradient[at] > 0)) return;
      mean.temperature += before_.temperature[at];
      mean.gradient += before_.gradient[at];
      ++count;
    });
    if (count > 0) mean = {mean.temperature / count, mean.gradient / count};
    return mean;
  }
  [[noreturn]] void refuse(const Index<D>& cell, const ice::SurfaceHeat& state, const ice::AtSurface& at) const {
    const Vec3 place = level_.expandPoint<D>(level_.cellCentre<D>(cell));
    throw NumericalError(
        fmt::format("no burn rate belongs to a surface of {:.6g} K with the gradient {:.6g} K/m at {:.6g} Pa, in the "
                    "cell at ({:g}, {:g}, {:g}) m: the pressure rises faster than Unsteady_Burn can follow",
                    state.temperature, state.gradient, at.pressure, place[0], place[1], place[2]),
        "a greater <GasUnsteadyCoef>, or Steady_Burn", "c.surfaceTemperature", level_.cellNumber<D>(cell));
  }

  const Level& level_;
  const ice::BurnModel& model_;
  const Reactant& reactant_;
  const SurfaceBefore& before_;
  Neighbourhood<D> around_;
};

/// Computes the state of surfaces after the step, and the rate at which they burn in the step.
template <int D>
void advanceSurface(const Patch& patch, const Settings& settings, double dt, const GasInCells<D>& cells,
                    const Reactant& reactant, const SurfaceBefore& before, const SurfaceNow& fresh) {
  const UnsteadySurface<D> surface(patch.level(), settings, cells, reactant, before);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const auto found = surface.find(cell, dt);
    fresh.temperature[cell] = found.state.temperature;
    fresh.gradient[cell] = found.state.gradient;
    fresh.rate[cell] = found.rate;
  });
}

/// Gives the particles of the burning body the state of the surface in their cell.
template <int D>
void keepSurface(const Patch& patch, const mpm::solid::Material& material, const Settings& settings,
                 CellView<const double> temperature, CellView<const double> gradient, ParticleView<const double> mass,
                 const NewSurface& fresh) {
  const bool burns = static_cast<std::size_t>(material.index) == settings.burning->body;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    for (const int p : mass.template in<D>(cell)) {
      fresh.temperature[p] = burns ? temperature[cell] : 0;
      fresh.gradient[p] = burns ? gradient[cell] : 0;
    }
  });
}

}  // namespace tushar::mpmice
