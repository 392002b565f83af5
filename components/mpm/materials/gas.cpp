#include "components/mpm/materials/gas.hpp"

namespace tushar::mpm {

void refuseStiffness(const Level& level, const Gas& gas, bool isConserving) {
  if (gas.pInfinity == 0) return;
  const auto fail = [&](const char* why) {
    throw InputError({{gas.where, "MaterialProperties/MPM/material/constitutive_model", why}});
  };
  if (!isConserving) fail("type: <gas_dynamics> takes an ideal_gas alone; use <conserving_gas_dynamics>");
  for (int d = 0; d < level.dimension(); ++d)
    for (const int side : {0, 1})
      if (!level.isPeriodic(d) && !level.isSymmetry(d, side))
        fail("type: a stiffened_gas needs a grid whose sides are symmetry planes or periodic");
}

}  // namespace tushar::mpm
