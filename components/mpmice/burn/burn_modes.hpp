#pragma once

#include "components/mpm/solid/constitutive/model.hpp"
#include "components/mpmice/burn/neighbourhood.hpp"

namespace tushar::mpmice {

/// The particles of a body at the start of a step, with their stress and, for cracks, their internal variables.
struct StressedParticles {
  ParticleView<const double> mass;
  ParticleView<const mpm::solid::Matrix3> deformation;
  std::optional<ParticleView<const mpm::solid::Matrix3>>
      stress;  ///< stress, if it does not follow from the deformation
  std::optional<ParticleView<const double>> state;

  static StressedParticles from(auto& take, bool keepsStress, bool burnsCracks, const ParticleLabel<double>* state) {
    return {.mass = take(requiresOld(p::mass)),
            .deformation = take(requiresOld(p::deformationMeasure)),
            .stress = take(when(keepsStress, requiresOld(p::stress))),
            .state = take(when(burnsCracks, requiresOld(*state)))};
  }
};

/// Whether the solids store the stress of a body because it does not follow from the deformation.
inline bool keepsStress(const mpm::solid::Material& material) {
  return material.isDamageable() || !material.model->dependsOnDeformationOnly();
}

/// Computes for each cell the mean pressure of the burning body [Pa], and the radius of its widest crack [m]. Both are
/// 0 in cells without the body; the radius is also 0 if cracks do not burn.
template <int D>
void measureLoad(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
                 int stateSize, const std::vector<StressedParticles>& bodies, CellView<double> pressure,
                 CellView<double> radius) {
  const StressedParticles& body = bodies[settings.burning->body];
  const mpm::solid::Material& material = materials[settings.burning->body];
  const int crack = offsetOf(*material.model, crackRadiusLabel);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double volume = 0, sum = 0;
    radius[cell] = 0;
    for (const int p : body.mass.template in<D>(cell)) {
      const double undeformed = body.mass[p] / material.undeformedDensity();
      const double own = undeformed * body.deformation[p].determinant();
      volume += own;
      if (body.stress) {
        sum -= own * (*body.stress)[p].trace() / 3;
      } else {
        mpm::solid::Matrix3 kirchhoff;
        material.model->kirchhoffStress(&body.deformation[p], 1, &kirchhoff);
        sum -= undeformed * kirchhoff.trace() / 3;
      }
      if (body.state) radius[cell] = std::max(radius[cell], (&(*body.state)[0])[p * stateSize + crack]);
    }
    pressure[cell] = volume > 0 ? sum / volume : 0;
  });
}

/// Views of the results of measureLoad.
struct Load {
  CellView<const double> pressure, crackRadius;

  static Load from(auto& take, int ghost) {
    return {.pressure = take(requiresNew(c::bodyPressure, ghost)),
            .crackRadius = take(requiresNew(c::crackRadius, ghost))};
  }
};

/// Views of the times for which cells had waited for a flame before the step; empty without an induction time.
struct Waited {
  std::optional<CellView<const double>> mode, time, induction;

  static Waited from(auto& take, bool waits) {
    return {.mode = take(when(waits, requiresOld(c::burnMode, 1))),
            .time = take(when(waits, requiresOld(c::waited))),
            .induction = take(when(waits, requiresOld(c::inductionTime)))};
  }
  template <int D>
  BurnMode modeIn(const Index<D>& cell) const {
    return static_cast<BurnMode>(static_cast<int>((*mode)[cell]));
  }
};

struct NewBurnModes {
  CellView<double> mode, pressure, waited, induction;

  static NewBurnModes from(auto& take) {
    return {.mode = take(computes(c::burnMode)),
            .pressure = take(computes(c::burnPressure)),
            .waited = take(computes(c::waited)),
            .induction = take(computes(c::inductionTime))};
  }
};

/// Determines in which mode each cell of an explosive burns, given the state at the start of the step, as Uintah's DDT1
/// does. The pressure of a cell is the mean pressure of gas and explosive, weighted by volume. The pressure of the
/// product gas is the mean of the surrounding cells with the largest free volume.
template <int D>
class BurnModes {
 public:
  BurnModes(const Level& level, const Settings& settings, const GasInCells<D>& cells, const Reactant& reactant,
            const Load& load)
      : level_(level),
        model_(settings.burning->model),
        reactant_(reactant),
        load_(load),
        around_(level, settings, cells, reactant) {}

  struct Found {
    BurnMode mode = BurnMode::none;
    double pressure = 0;               ///< pressure at which the cell burns [Pa]
    double waited = 0, induction = 0;  ///< time that the cell has waited, and its induction time [s]
  };
  /// Determines the mode of a cell. `before` has values only with an induction time; `dt` is the time step [s].
  Found find(const Index<D>& cell, const Waited& before, double dt) const {
    if (!(reactant_.mass[cell] > 0)) return {};
    const double own = pressureOf(cell);
    if (own > model_.ddt()->detonationPressure) refuseDetonation(cell, own);
    const auto around = around_.look(cell);
    const double pressure = std::max(own, around.product);
    const bool isSurface = around_.isExposed(cell, leastStep);
    const bool lights = isSurface && around.isHot && around.product > model_.leastPressure;
    const bool cracked = model_.ddt()->burnsCracks && ice::Ddt::enterCracks(pressure, load_.crackRadius[cell]) &&
                         pressure > model_.leastPressure;
    if (before.mode) return wait(cell, {isSurface, lights, cracked, around.isHot, pressure}, before, dt);
    if (lights) return {BurnMode::surface, pressure, 0, 0};
    return {cracked && around.isHot ? BurnMode::cracks : BurnMode::none, pressure, 0, 0};
  }

 private:
  /// The step of the area at a face from which on the surface passes through it.
  static constexpr double leastStep = 0.3;

  [[noreturn]] void refuseDetonation(const Index<D>& cell, double pressure) const {
    const Vec3 at = level_.expandPoint<D>(level_.cellCentre<D>(cell));
    throw NumericalError(
        fmt::format("the body detonates: its pressure is {:.6g} Pa in the cell at ({:g}, {:g}, {:g}) m, "
                    "above <ThresholdPressureJWL>; this DDT1 models only deflagration",
                    pressure, at[0], at[1], at[2]),
        "weaker confinement, or a shorter <maxTime>", "c.burnPressure", level_.cellNumber<D>(cell));
  }
  struct Conditions {
    bool isSurface, lights, cracked, isHot;
    double pressure;
  };
  /// The path of a flame into a cell.
  struct Flame {
    double part = std::numeric_limits<double>::infinity();  ///< time of the flame relative to that along a surface
    BurnMode from = BurnMode::none;
  };

  double pressureOf(const Index<D>& cell) const {
    const double gas = around_.freeVolume(cell), body = reactant_.volume[cell];
    if (!(gas + body > 0)) return 0;
    return ((gas > 0 ? gas * around_.gasPressure(cell) : 0) + body * load_.pressure[cell]) / (gas + body);
  }
  static bool burns(BurnMode mode) { return mode == BurnMode::surface || mode == BurnMode::cracks; }

  /// Determines the mode of a cell with an induction time: it waits from the first step in which there is a flame next
  /// to it.
  Found wait(const Index<D>& cell, const Conditions& now, const Waited& before, double dt) const {
    const bool burned = burns(before.modeIn(cell));
    const Flame flame = burned ? Flame{1, before.modeIn(cell)} : flameInto(cell, now, before);
    Found found{BurnMode::none, now.pressure, 0, 0};
    if (flame.from == BurnMode::none) return found;
    found.waited = (*before.time)[cell] + dt;
    found.induction = (*before.induction)[cell];
    if (!burned) {
      const double time = inductionTime(flame.part, now.pressure);
      found.induction = (*before.time)[cell] > 0 ? 0.2 * time + 0.8 * (*before.induction)[cell] : time;
    }
    const bool isOver = burned || found.waited >= found.induction;
    if (isOver && now.lights && flame.from == BurnMode::surface)
      found.mode = BurnMode::surface;
    else if (isOver && now.cracked && now.isHot && flame.from == BurnMode::cracks)
      found.mode = BurnMode::cracks;
    else if (!isOver)
      found.mode = BurnMode::waiting;
    return found;
  }
  /// The induction time [s] at a pressure [Pa]; `part` is the ratio of Flame.
  double inductionTime(double part, double pressure) const {
    double width = 0;
    for (int d = 0; d < D; ++d) width += level_.spacing(d) / D;
    const ice::Induction& law = *model_.ddt()->induction;
    return part * law.time(width, pressure);
  }
  Flame flameInto(const Index<D>& cell, const Conditions& now, const Waited& before) const {
    const ice::Induction& law = *model_.ddt()->induction;
    Flame best;
    const auto take = [&](double part, BurnMode from) {
      if (part < best.part) best = {part, from};
    };
    around_.forEachAround(cell, [&](const Index<D>& at) {
      const double part = law.part(at == cell ? 1 : cosineOf(cell, at));
      if (now.lights && around_.isHot(at)) take(part, BurnMode::surface);
      if (!now.cracked || !burns(before.modeIn(at))) return;
      if (!now.isSurface)
        take(law.part(1), BurnMode::cracks);
      else if (around_.isHot(at))
        take(part, before.modeIn(at));
    });
    return best;
  }
  /// Cosine of the angle between the direction from the neighbour `from` and the normal of the surface; 0 if there is
  /// no normal.
  double cosineOf(const Index<D>& cell, const Index<D>& from) const {
    const Vec<D> way = level_.cellCentre<D>(cell) - level_.cellCentre<D>(from);
    return std::abs(around_.surface().space().normal(cell).dot(way)) / way.norm();
  }

  const Level& level_;
  const ice::BurnModel& model_;
  const Reactant& reactant_;
  const Load& load_;
  Neighbourhood<D> around_;
};

/// Determines how the cells of a patch burn.
template <int D>
void findBurnModes(const Patch& patch, const Settings& settings, double dt, const GasInCells<D>& cells,
                   const Reactant& reactant, const Load& load, const Waited& before, const NewBurnModes& fresh) {
  const BurnModes<D> modes(patch.level(), settings, cells, reactant, load);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const auto found = modes.find(cell, before, dt);
    fresh.mode[cell] = double(found.mode);
    fresh.pressure[cell] = found.pressure;
    fresh.waited[cell] = found.waited;
    fresh.induction[cell] = found.induction;
  });
}

/// Sets the initial modes: nothing burns before the first step.
template <int D>
void startBurnModes(const Patch& patch, CellView<double> mode, CellView<double> waited, CellView<double> induction) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { mode[cell] = waited[cell] = induction[cell] = 0; });
}

}  // namespace tushar::mpmice
