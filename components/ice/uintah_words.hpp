#pragma once

#include <string>
#include <vector>

#include "core/simulation/settings.hpp"

// The names of the variables of a gas in scenes of Uintah's ICE.

namespace tushar::ice {

inline constexpr const char* thinWallsPath = "CFD/ICE/thin_walls";
inline constexpr const char* exchangePath = "MaterialProperties/exchange_properties/exchange_coefficients";

/// Variables of Uintah that have another name in Tushar.
inline const simulation::OtherNames uintahsNames{
    {"rho_CC", "c.density"},           {"rho_micro_CC", "c.density"},     {"press_CC", "c.pressure"},
    {"press_equil_CC", "c.pressure"},  {"vel_CC", "c.velocity"},          {"temp_CC", "c.temperature"},
    {"sp_vol_CC", "c.specificVolume"}, {"speedSound_CC", "c.soundSpeed"}, {"mach", "c.mach"}};

/// Variables of Uintah that no task of Tushar computes.
inline const std::vector<std::string> uintahsLabels{"vol_frac_CC",
                                                    "sp_vol_L_CC",
                                                    "delP_Dilatate",
                                                    "delP_MassX",
                                                    "sum_imp_delP",
                                                    "rhs",
                                                    "term2",
                                                    "press_force",
                                                    "mom_L_ME_CC",
                                                    "eng_L_ME_CC",
                                                    "mass_L_CC",
                                                    "mom_L_CC",
                                                    "int_eng_L_CC",
                                                    "uvel_FC",
                                                    "vvel_FC",
                                                    "wvel_FC",
                                                    "uvel_FCME",
                                                    "vvel_FCME",
                                                    "wvel_FCME",
                                                    "pressX_FC",
                                                    "pressY_FC",
                                                    "pressZ_FC",
                                                    "tau_X_FC",
                                                    "tau_Y_FC",
                                                    "tau_Z_FC",
                                                    "mom_source_CC",
                                                    "intE_source_CC",
                                                    "viscous_src_CC",
                                                    "sp_vol_src_CC",
                                                    "modelMass_src",
                                                    "modelMom_src",
                                                    "modelEng_src",
                                                    "modelVol_src",
                                                    "specific_heat",
                                                    "gamma",
                                                    "viscosity",
                                                    "thermalCond",
                                                    "total_viscosity_CC",
                                                    "refineFlag",
                                                    "mag_grad_rho_CC",
                                                    "mag_grad_temp_CC",
                                                    "mag_grad_press_CC",
                                                    "mag_div_vel_CC",
                                                    "mag_grad_vol_frac_CC",
                                                    "vorticity",
                                                    "grad_dp_XFC",
                                                    "grad_dp_YFC",
                                                    "grad_dp_ZFC",
                                                    "Li1",
                                                    "Li2",
                                                    "Li3",
                                                    "Li4",
                                                    "Li5",
                                                    "turb_viscosity_CC",
                                                    "eng_exch_error",
                                                    "mom_exch_error",
                                                    "Totaldensity_src",
                                                    "TotalMom_src",
                                                    "TotalEng_src",
                                                    "mass_adv",
                                                    "mom_adv",
                                                    "eng_adv",
                                                    "sp_vol_adv",
                                                    "sum_rho_CC",
                                                    "F",
                                                    "delF",
                                                    "mag_grad_Fr"};

}  // namespace tushar::ice
