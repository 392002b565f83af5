#pragma once

#include "core/input/refuse.hpp"
#include "core/simulation/settings.hpp"

// Tags of Uintah's <MPM> section that neither explicit nor implicit steps have in Tushar.

namespace tushar::mpm::solid {

/// Flags of Uintah that are not available, with the alternatives.
inline const std::vector<std::pair<std::string, std::string>> lackingSwitches{
    {"refine_particles", "use a larger <res> to give the body more particles"},
    {"do_scalar_diffusion", "heat conduction obeys the same equation"},
    {"coupled_flow_analysis", "there is only one phase"},
    {"AMR", "solids are on one level: choose a higher <resolution>"},
    {"DoCapDensity", "remove it: density is not capped"},
    {"DoDefGradAveraging", "use a wider <interpolator>, such as gimp or 3rdorderBS, against locking"},
    {"use_volume_integral", "remove it: particles represent their volume"},
    {"restartOnLargeNodalVelocity", "recompute_timestep in <Time> repeats a step that fails"},
    {"delete_rogue_particles", "remove it: no particle is taken out for its speed or temperature"},
};

/// Tags of Uintah that have no effect in Tushar, with the reasons.
inline const std::vector<std::pair<std::string, std::string>> meaninglessTags{
    {"boundary_traction_faces", "BndyForce_… and BndyContactArea_… of every face can be saved without it"},
    {"create_new_particles", "particles are not split or merged"},
    {"GranularMPMVcrix", "Uintah does not use it either: <critical_density> determines which particles touch"},
    {"GranularMPMVcriy", "Uintah does not use it either: <critical_density> determines which particles touch"},
    {"GranularMPMVcriz", "Uintah does not use it either: <critical_density> determines which particles touch"},
    {"CanAddMPMMaterial", "all materials exist from the start"},
    {"DeleteGeometryObjects", "shapes are not stored"},
    {"computeNodalHeatFlux", "it has no effect"},
    {"testForNegTemps_mpm", "it has no effect"},
    {"DoThermalExpansion", "only models that Uintah does not build read it"},
    {"water_damping_coef", "belongs to coupled_flow_analysis"},
    {"solid_damping_coef", "belongs to coupled_flow_analysis"},
    {"PorePressureFilter", "belongs to coupled_flow_analysis"},
    {"do_auto_cycle_bc", "belongs to do_scalar_diffusion"},
    {"auto_cycle_use_minmax", "belongs to do_scalar_diffusion"},
    {"auto_cycle_max", "belongs to do_scalar_diffusion"},
    {"auto_cycle_min", "belongs to do_scalar_diffusion"},
};

/// Variables that Uintah's MPM computes, under the names with which scenes save them.
inline const std::vector<std::string> uintahsLabels{"AccStrainEnergy",
                                                    "g.surfnorm",
                                                    "g.normtraction",
                                                    "g.position",
                                                    "g.velocity_star",
                                                    "g.displacement",
                                                    "g.externalforce",
                                                    "g.externalHeatRate",
                                                    "g.temperatureStar",
                                                    "g.thermalContactTemperatureRate",
                                                    "dispNew",
                                                    "p.tempPrevious",
                                                    "p.externalHeatRate",
                                                    "p.JThermal",
                                                    "p.volumedeformed",
                                                    "p.temperatureGradient",
                                                    "p.currentsize",
                                                    "p.Suction",
                                                    "p.SpecificVol",
                                                    "p.cohesion",
                                                    "frictionalWork",
                                                    "RigidReactionTorque",
                                                    "SumTransmittedForce",
                                                    "CenterOfMassVelocity",
                                                    "p.damage",
                                                    "p.plasticStrain",
                                                    "p.plasticTemp",
                                                    "p.evp",
                                                    "p.eve",
                                                    "p.Kappa",
                                                    "particleCount",
                                                    "czCount",
                                                    "cz.tang",
                                                    "BndyTraction_xminus",
                                                    "BndyTraction_xplus",
                                                    "BndyTraction_yminus",
                                                    "BndyTraction_yplus",
                                                    "BndyTraction_zminus",
                                                    "BndyTraction_zplus",
                                                    "BndyContactCellArea_xminus",
                                                    "BndyContactCellArea_xplus",
                                                    "BndyContactCellArea_yminus",
                                                    "BndyContactCellArea_yplus",
                                                    "BndyContactCellArea_zminus",
                                                    "BndyContactCellArea_zplus"};

/// Variables of some models and contacts, which scenes go on to save when they have others.
inline const std::vector<std::string> labelsOfSomeScenes{"KrylovIterations",
                                                         "NewtonIterations",
                                                         "NewtonResidual",
                                                         "g.color",
                                                         "g.frictionHeat",
                                                         "g.matlProminence",
                                                         "g.normAlphaToBeta",
                                                         "p.CapX",
                                                         "p.ElasticStress",
                                                         "p.PorePressure",
                                                         "p.StressQS",
                                                         "p.Zeta",
                                                         "p.acceleration",
                                                         "p.alpha",
                                                         "p.alphaMin",
                                                         "p.bElBar",
                                                         "p.backstress",
                                                         "p.bulkModulus",
                                                         "p.color",
                                                         "p.crHeatRate",
                                                         "p.crackRad",
                                                         "p.czArea",
                                                         "p.czBotMat",
                                                         "p.czDispBottom",
                                                         "p.czDispTop",
                                                         "p.czFailed",
                                                         "p.czForce",
                                                         "p.czNorm",
                                                         "p.czSeparation",
                                                         "p.czTopMat",
                                                         "p.drag",
                                                         "p.energy",
                                                         "p.ep",
                                                         "p.epsf",
                                                         "p.eta",
                                                         "p.externalHeatFlux",
                                                         "p.fail",
                                                         "p.hardeningModulus",
                                                         "p.localized",
                                                         "p.plasticDilatation",
                                                         "p.plasticStrainRate",
                                                         "p.plasticWork",
                                                         "p.porosity",
                                                         "p.progressF",
                                                         "p.progressdelF",
                                                         "p.shearModulus",
                                                         "p.strainRate",
                                                         "p.stretch",
                                                         "p.surface",
                                                         "p.timeofloc",
                                                         "p.varf",
                                                         "p.veHeatRate",
                                                         "p.volHeatRate",
                                                         "p.yield",
                                                         "p.yieldStress"};

/// Particle variables that Uintah's MohrCoulomb saves under names without `p.`, those of cohesive zones, and older
/// names of variables of Arenisca and of the position.
inline const simulation::OtherNames olderLabels{{"p.xx", "p.x"},
                                                {"Suction", "p.Suction"},
                                                {"SpecificVol", "p.SpecificVol"},
                                                {"c", "p.cohesion"},
                                                {"p.plasticStrainVol", "p.evp"},
                                                {"p.elasticStrainVol", "p.eve"},
                                                {"p.kappa", "p.Kappa"},
                                                {"p.arenisca_kappa", "p.Kappa"},
                                                {"cz.area", "p.czArea"},
                                                {"cz.norm", "p.czNorm"},
                                                {"cz.disptop", "p.czDispTop"},
                                                {"cz.dispbottom", "p.czDispBottom"},
                                                {"cz.separation", "p.czSeparation"},
                                                {"cz.force", "p.czForce"},
                                                {"cz.topmat", "p.czTopMat"},
                                                {"cz.botmat", "p.czBotMat"},
                                                {"cz.failed", "p.czFailed"},
                                                {"cz.CZID", "p.particleID"}};

template <class S>
void addForeignTags(input::Schema<S>& mpm) {
  for (const auto& [tag, why] : meaninglessTags) mpm.ignored(tag, why);
  for (const auto& [tag, instead] : lackingSwitches) refuseSwitch(mpm, tag, instead);
  refuseOtherValues(mpm, "ForceBC_force_increment_factor", {"1", "1.0", "1."}, "multiply the <force> itself");
}

}  // namespace tushar::mpm::solid
