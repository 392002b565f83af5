#pragma once

#include "components/mpmice/burn/burn_bodies.hpp"
#include "components/mpmice/tasks/sum_energy_of_bodies.hpp"

namespace tushar::mpmice {

/// Views of the particles of a body at the end of a step, with their masses before burning.
template <int D>
struct BurningParticles {
  ParticleView<const double> mass, temperature;
  ParticleView<const Vec<D>> velocity;
  std::optional<ParticleView<const double>> strainEnergy;  ///< strain energy [J]

  static BurningParticles from(auto& take, bool keepsStrain) {
    return {.mass = take(requiresOld(p::mass)),
            .temperature = take(requiresNew(p::temperature)),
            .velocity = take(requiresNew(p::velocity<D>)),
            .strainEnergy = take(when(keepsStrain, requiresNew(p::strainEnergy)))};
  }
};

/// Views of the gas that receives the burned mass in a step: of its state at the start, and of its state after the
/// step, before small cells are merged.
template <int D>
struct BurntGas {
  GasInCells<D> before;
  CellView<const double> share, newFree;
  euler::MixtureViews<D, double> held;  ///< for several gases, the volumes instead of the volume fractions
  CellView<const double> burntBefore;
  CellView<double> burnt;

  static BurntGas from(auto& take, std::size_t gases) {
    const auto ofEach = [&](const auto& labels) {
      return viewsOfGases(take, gases, [&](std::size_t k) { return modifies(labels[k]); });
    };
    return {.before = GasInCells<D>::from(take, readsOld, {.state = 1, .mass = 1, .room = 1, .gases = gases}),
            .share = take(requiresNew(c::burntShare)),
            .newFree = take(requiresNew(c::unfilledVolume)),
            .held = {{take(modifies(c::unsharedDensity)), take(modifies(c::unsharedMomentum<D>)),
                      take(modifies(c::unsharedEnergy))},
                     ofEach(c::unsharedMass),
                     ofEach(c::unsharedVolume)},
            .burntBefore = take(requiresOld(c::burntSinceStart)),
            .burnt = take(computes(c::burntSinceStart))};
  }
};

/// The mass, momentum and energy of what burns in a cell in a step, per cell volume.
template <int D>
struct Burnt {
  double mass = 0;
  Vec<D> momentum = Vec<D>::Zero();
  double kinetic = 0, internal = 0;

  /// Sums the burned fraction of the particles in `range`: `factor` times their content, plus the heat of reaction
  /// [J/kg].
  static Burnt of(const BurningParticles<D>& particles, const data::ParticleRange& range, double factor,
                  double specificHeat, double heat) {
    Burnt sum;
    for (const int p : range) {
      const double mass = factor * particles.mass[p];
      sum.mass += mass;
      sum.momentum += mass * particles.velocity[p];
      sum.kinetic += 0.5 * mass * particles.velocity[p].squaredNorm();
      sum.internal += mass * (specificHeat * particles.temperature[p] + heat);
      if (particles.strainEnergy) sum.internal += factor * (*particles.strainEnergy)[p];
    }
    return sum;
  }
};

/// Updates the volumes of several gases in a cell after burned mass has been added to one of them. The new gas occupies
/// the volume that it has at the pressure of the cell; if the cell keeps its gas, all volumes are then scaled to fill
/// the cell.
template <int D>
void makeRoomFor(const Level& level, const Settings& settings, const BurntGas<D>& gas, const Index<D>& cell,
                 double internal) {
  if (areBlended(settings)) return;  // their volumes follow from masses and energy
  const std::size_t product = settings.burning->gas;
  double sum = 0;
  int count = 0;
  const auto addPressure = [&](const Index<D>& at) {
    if (gas.before.isEmpty(at)) return;
    const euler::State<D> w = gas.before.primitive(lawAt<D>(settings, gas.before.held, gas.before.free[at], at), at);
    sum += w[euler::kPressure<D>];
    ++count;
  };
  addPressure(cell);
  for (int d = 0; d < D && count == 0; ++d)
    for (const int side : {-1, 1}) {
      const Index<D> next = side < 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
      if (level.clipCells(cellsAround<D>(next, 0)).size() > 0) addPressure(next);
    }
  for (std::size_t k = 0; k < settings.gases.size(); ++k)
    if (gas.held.masses[k][cell] == 0) gas.held.shares[k][cell] = 0;
  const euler::Gas& law = settings.gases[product].gas;
  if (count > 0)
    gas.held.shares[product][cell] += internal * (law.gamma - 1) / (sum / count + law.gamma * law.pInfinity);
  else
    gas.held.shares[product][cell] = gas.newFree[cell];
  if (gas.newFree[cell] < smallFreeVolume) return;
  double volume = 0;
  for (const auto& share : gas.held.shares) volume += std::max(0.0, share[cell]);
  for (const auto& share : gas.held.shares) share[cell] *= gas.newFree[cell] / volume;
}

/// Adds the burned mass, momentum and energy to the gas of the cell in which they were. The gas also gets the space
/// that becomes free (see measureMotion).
template <int D>
void addBurntGas(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
                 const std::vector<BurningParticles<D>>& bodies, const BurntGas<D>& gas) {
  const Burning& burning = *settings.burning;
  const BurningParticles<D>& body = bodies[burning.body];
  const double specificHeat = materials[burning.body].specificHeat, inverse = 1 / patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    gas.burnt[cell] = gas.burntBefore[cell];
    if (!(gas.share[cell] > 0)) return;
    const auto burnt =
        Burnt<D>::of(body, body.mass.template in<D>(cell), gas.share[cell] * inverse, specificHeat, burning.model.heat);
    if (!(burnt.mass > 0)) return;
    gas.burnt[cell] += burnt.mass;
    gas.held.density[cell] += burnt.mass;
    gas.held.momentum[cell] += burnt.momentum;
    gas.held.totalEnergy[cell] += burnt.kinetic + burnt.internal;
    if (settings.gases.empty()) return;
    gas.held.masses[burning.gas][cell] += burnt.mass;
    makeRoomFor<D>(patch.level(), settings, gas, cell, burnt.internal);
  });
}

/// Sets the unburned fraction of particles to 1 at the start.
inline void startUnburned(const Patch&, const mpm::solid::Material&, ParticleView<const double> mass,
                          ParticleView<double> unburned) {
  for (int p = 0; p < mass.owned(); ++p) unburned[p] = 1;
}

/// Computes the mass that has burned since the start, and the heat of its reaction.
template <int D>
void sumBurnt(const Patch& patch, const Settings& settings, CellView<const double> burnt, Sum& mass, Sum& heat) {
  const double volume = patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    mass.add(volume * burnt[cell]);
    heat.add(settings.burning->model.heat * volume * burnt[cell]);
  });
}

/// Subtracts the heat of the reaction since the start, which burning gives to the gas, from a total [J].
template <int D>
void subtractReactionHeat(const Patch& patch, const Settings& settings, CellView<const double> burnt, Sum& energy) {
  const double perVolume = settings.burning->model.heat * patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { energy.add(-perVolume * burnt[cell]); });
}

}  // namespace tushar::mpmice
