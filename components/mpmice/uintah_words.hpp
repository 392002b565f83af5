#pragma once

#include "components/ice/uintah_words.hpp"

// The names of the variables of a gas beside bodies in scenes of Uintah's MPMICE, where they differ from those of ICE.

namespace tushar::mpmice {

/// Variables that have another name here.
inline const simulation::OtherNames uintahsNames{{"rho_micro_CC", "c.gasDensity"},
                                                 {"vol_frac_CC", "c.freeVolume"},
                                                 {"totalMassBurned", "BurntMass"},
                                                 {"totalHeatReleased", "ReactionHeat"},
                                                 {"p.mass+", "p.mass"},
                                                 {"p.volume+", "p.volume"},
                                                 {"p.velocity+", "p.velocity"},
                                                 {"p.temperature+", "p.temperature"}};

}  // namespace tushar::mpmice
