#pragma once

#include "components/ice/uintah_words.hpp"

// The names of the variables of a gas beside bodies in scenes of Uintah's MPMICE, where they differ from those of ICE.

namespace tushar::mpmice {

/// Variables that have another name in Tushar.
inline const simulation::OtherNames uintahsNames{{"rho_micro_CC", "c.gasDensity"},
                                                 {"vol_frac_CC", "c.freeVolume"},
                                                 {"totalMassBurned", "BurntMass"},
                                                 {"totalHeatReleased", "ReactionHeat"},
                                                 {"UnsteadyBurn.SurfTemp", "c.surfaceTemperature"},
                                                 {"UnsteadyBurn.SurfTempGrad", "c.surfaceGradient"},
                                                 {"UnsteadyBurn.PartSurfTemp", "p.surfaceTemperature"},
                                                 {"UnsteadyBurn.PartSurfTempGrad", "p.surfaceGradient"},
                                                 {"p.mass+", "p.mass"},
                                                 {"p.volume+", "p.volume"},
                                                 {"p.velocity+", "p.velocity"},
                                                 {"p.temperature+", "p.temperature"}};

/// Variables of Uintah's MPMICE and its burn models that no task of Tushar computes, or only if a body burns.
inline const std::vector<std::string> uintahsLabels{"Tdot",
                                                    "p.pressure",
                                                    "vel_CCTransposed",
                                                    "meanFreePath",
                                                    "isSurfaceCell",
                                                    "surfaceNorm",
                                                    "burning",
                                                    "BurningCriteria",
                                                    "onSurface",
                                                    "surfaceTemp",
                                                    "detonating",
                                                    "detLocalTo",
                                                    "F",
                                                    "delF",
                                                    "crackedEnough",
                                                    "inductionTime",
                                                    "countTime",
                                                    "SteadyBurn.numPPC",
                                                    "SteadyBurn.BurningCell",
                                                    "UnsteadyBurn.BurningCell",
                                                    "BurntMass",
                                                    "ReactionHeat",
                                                    "totalMassExchanged",
                                                    "totalIntEngExchanged"};

}  // namespace tushar::mpmice
