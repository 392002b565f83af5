#include "components/ice/mixture/pressure_burn.hpp"

namespace tushar::ice {

const input::Schema<PressureBurn>& pressureBurnSchema() {
  static const input::Schema<PressureBurn> schema =
      input::Schema<PressureBurn>("JWLpp", "An explosive becomes gas at a rate that depends on the pressure.")
          .location(&PressureBurn::where)
          .required("fromMaterial", &PressureBurn::from, "1", "the gas that burns")
          .required("toMaterial", &PressureBurn::to, "1", "the gas that it becomes")
          .required("G", &PressureBurn::factor, "1/(s Pa^b)", "factor of the rate dF/dt = G p^b (1 - F)",
                    input::nonNegative())
          .required("b", &PressureBurn::exponent, "1", "exponent of the pressure in the rate", input::nonNegative())
          .required("E0", &PressureBurn::heat, "J/kg", "heat of the reaction")
          .required("rho0", &PressureBurn::density, "kg/m^3",
                    "density of the explosive; a step converts at most a fifth of it", input::positive())
          .required("ThresholdPressure", &PressureBurn::leastPressure, "Pa", "pressure above which the gas burns")
          .value("ThresholdVolFrac", &PressureBurn::leastShare, 0.01, "1",
                 "volume fraction of the explosive above which it burns");
  return schema;
}

}  // namespace tushar::ice
