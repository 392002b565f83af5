#pragma once

#include <tuple>

#include "components/mpm/solid/materials/cnh_mms.hpp"
#include "components/mpm/solid/materials/comp_mooney_rivlin.hpp"
#include "components/mpm/solid/materials/comp_neo_hook.hpp"
#include "components/mpm/solid/materials/elastic_plastic.hpp"
#include "components/mpm/solid/materials/hypo_elastic.hpp"
#include "components/mpm/solid/materials/ideal_gas.hpp"
#include "components/mpm/solid/materials/mohr_coulomb.hpp"
#include "components/mpm/solid/materials/rigid.hpp"
#include "components/mpm/solid/materials/trans_iso_hyper.hpp"
#include "components/mpm/solid/materials/ucnh.hpp"
#include "components/mpm/solid/materials/water.hpp"

namespace tushar::mpm::solid {

/// Every constitutive model that a scene can pick: THE table, one line each.
using AllModels = std::tuple<CnhMms,               //
                             CompMooneyRivlin,     //
                             CompNeoHook,          //
                             CompNeoHookPlastic,   //
                             ElasticPlasticHp,     //
                             ElasticPlasticModel,  //
                             HypoElastic,          //
                             IdealGas,             //
                             MohrCoulomb,          //
                             Rigid,                //
                             TransIsoHyper,        //
                             Ucnh,                 //
                             Water>;

}  // namespace tushar::mpm::solid
