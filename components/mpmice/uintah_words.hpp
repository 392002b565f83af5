#pragma once

#include "components/ice/uintah_words.hpp"

// What scenes of Uintah's MPMICE call the variables of a gas beside bodies, where it is not as for a gas alone.

namespace tushar::mpmice {

/// Variables that are here by another name.
inline const simulation::OtherNames uintahsNames{{"rho_micro_CC", "c.gasDensity"}, {"vol_frac_CC", "c.freeVolume"}};

}  // namespace tushar::mpmice
