#pragma once

#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// The optional particle variables of a scene, which depend on its materials.
struct Keeps {
  KeptSizes sizes;                 ///< p.size or p.domain: particles start with different sizes
  bool stress = false;             ///< p.stress and p.volume: some stress is not a function of F alone
  bool temperature = false;        ///< p.temperature: some stress depends on it
  bool temperatureChange = false;  ///< the work of a step changes the temperature
  bool failure = false;            ///< p.localizedMPM: particles may fail
  bool viscosity = false;          ///< p.q: artificial viscosity
  bool externalForce = false;      ///< p.externalforce: loads act
  int stateSize = 0;               ///< number of values per particle in `state`; 0 if there is no such variable
  const ParticleLabel<double>* state = nullptr;  ///< p.modelState; must outlive the tasks

  bool hasState() const { return stateSize > 0; }
};

}  // namespace tushar::mpm::solid
