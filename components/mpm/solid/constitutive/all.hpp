#pragma once

#include <tuple>

#include "components/mpm/solid/constitutive/arenisca.hpp"
#include "components/mpm/solid/constitutive/arruda_boyce.hpp"
#include "components/mpm/solid/constitutive/cnh_mms.hpp"
#include "components/mpm/solid/constitutive/comp_mooney_rivlin.hpp"
#include "components/mpm/solid/constitutive/comp_neo_hook.hpp"
#include "components/mpm/solid/constitutive/elastic_plastic.hpp"
#include "components/mpm/solid/constitutive/hypo_elastic.hpp"
#include "components/mpm/solid/constitutive/ideal_gas.hpp"
#include "components/mpm/solid/constitutive/jwlpp_mpm.hpp"
#include "components/mpm/solid/constitutive/mohr_coulomb.hpp"
#include "components/mpm/solid/constitutive/mw_visco_elastic.hpp"
#include "components/mpm/solid/constitutive/nonlocal_drucker_prager.hpp"
#include "components/mpm/solid/constitutive/p_alpha.hpp"
#include "components/mpm/solid/constitutive/program_burn.hpp"
#include "components/mpm/solid/constitutive/rigid.hpp"
#include "components/mpm/solid/constitutive/th_water.hpp"
#include "components/mpm/solid/constitutive/trans_iso_hyper.hpp"
#include "components/mpm/solid/constitutive/ucnh.hpp"
#include "components/mpm/solid/constitutive/ucnh_var.hpp"
#include "components/mpm/solid/constitutive/visco_plastic.hpp"
#include "components/mpm/solid/constitutive/visco_scram.hpp"
#include "components/mpm/solid/constitutive/visco_trans_iso_hyper.hpp"
#include "components/mpm/solid/constitutive/water.hpp"

namespace tushar::mpm::solid {

/// All constitutive models that a scene can select, one per line.
using AllModels = std::tuple<Arenisca2,              //
                             Arenisca3,              //
                             Arenisca4,              //
                             ArrudaBoyce8,           //
                             CnhMms,                 //
                             CompMooneyRivlin,       //
                             CompNeoHook,            //
                             CompNeoHookPlastic,     //
                             ElasticPlasticHp,       //
                             ElasticPlasticModel,    //
                             HypoElastic,            //
                             IdealGas,               //
                             JwlppMpm,               //
                             MohrCoulomb,            //
                             MwViscoElastic,         //
                             NonlocalDruckerPrager,  //
                             PAlpha,                 //
                             ProgramBurn,            //
                             Rigid,                  //
                             ThWater,                //
                             TransIsoHyper,          //
                             Ucnh,                   //
                             UcnhVar,                //
                             ViscoPlastic,           //
                             ViscoScram,             //
                             ViscoTransIsoHyper,     //
                             Water>;

}  // namespace tushar::mpm::solid
