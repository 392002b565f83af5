#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// The volume fraction of a cell that the gas or a body in it must exceed to ignite a surface, as in Uintah.
inline constexpr double leastVisible = 0.2;

/// Views of cell values of the burning body and of the other bodies, computed from the particles that are in the cell
/// at the start of the step.
template <class T>
struct ReactantFields {
  CellView<T> mass, volume, temperature, others, hottest;

  static ReactantFields from(auto& take, auto access) {
    return {.mass = take(access(c::reactantMass)),
            .volume = take(access(c::reactantVolume)),
            .temperature = take(access(c::reactantTemperature)),
            .others = take(access(c::otherVolume)),
            .hottest = take(access(c::hottestBody))};
  }
};
struct NewReactant : ReactantFields<double> {
  static NewReactant from(auto& take) {
    return {ReactantFields<double>::from(take, [](const auto& label) { return computes(label); })};
  }
};
struct Reactant : ReactantFields<const double> {
  static Reactant from(auto& take, int ghost) {
    return {ReactantFields<const double>::from(take, [&](const auto& label) { return requiresNew(label, ghost); })};
  }
  /// The fraction of the volume of all bodies in two cells that belongs to the burning body.
  template <int D>
  double shareIn(const Index<D>& a, const Index<D>& b) const {
    const double own = volume[a] + volume[b];
    return own > 0 ? own / (own + others[a] + others[b]) : 0;
  }
};

/// Views of the particles of a body at the start of a step.
struct ParticlesAtStart {
  ParticleView<const double> mass, temperature;
  ParticleView<const mpm::solid::Matrix3> deformation;

  static ParticlesAtStart from(auto& take) {
    return {.mass = take(requiresOld(p::mass)),
            .temperature = take(requiresOld(p::temperature)),
            .deformation = take(requiresOld(p::deformationMeasure))};
  }
};

/// Computes masses, volumes and temperatures of bodies in each cell.
template <int D>
void measureReactant(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
                     const std::vector<ParticlesAtStart>& bodies, const NewReactant& found) {
  const double inverse = 1 / patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    found.mass[cell] = found.volume[cell] = found.temperature[cell] = found.others[cell] = found.hottest[cell] = 0;
    for (std::size_t m = 0; m < bodies.size(); ++m) {
      const ParticlesAtStart& body = bodies[m];
      double mass = 0, volume = 0, heat = 0;
      for (const int p : body.mass.template in<D>(cell)) {
        mass += body.mass[p];
        volume += body.mass[p] / materials[m].undeformedDensity() * body.deformation[p].determinant();
        heat += body.mass[p] * body.temperature[p];
      }
      if (!(mass > 0)) continue;
      volume *= inverse;
      if (volume > leastVisible) found.hottest[cell] = std::max(found.hottest[cell], heat / mass);
      if (m != settings.burning->body) {
        found.others[cell] += volume;
        continue;
      }
      found.mass[cell] = mass * inverse;
      found.volume[cell] = volume;
      found.temperature[cell] = heat / mass;
    }
  });
}

}  // namespace tushar::mpmice
