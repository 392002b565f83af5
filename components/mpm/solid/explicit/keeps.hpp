#pragma once

#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// The optional particle variables of a scene, which depend on its materials.
struct Keeps {
  KeptSizes sizes;  ///< how p.size or p.domain is stored, if particles have different initial sizes
  /// Whether p.stress and p.volume are stored (if some stress is not a function of F alone).
  bool stress = false;
  bool temperature = false;        ///< whether p.temperature is stored (if some stress depends on it)
  bool temperatureChange = false;  ///< whether the work of a step changes the temperature
  bool failure = false;            ///< whether p.localizedMPM is stored (if particles may fail)
  bool viscosity = false;          ///< whether p.q is stored (with artificial viscosity)
  bool externalForce = false;      ///< whether p.externalforce is stored (if loads act)
  int stateSize = 0;               ///< number of values per particle in `state`; 0 if this variable does not exist
  const ParticleLabel<double>* state = nullptr;  ///< label of p.modelState; must outlive the tasks

  bool hasState() const { return stateSize > 0; }
};

}  // namespace tushar::mpm::solid
