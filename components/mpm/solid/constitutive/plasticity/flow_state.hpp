#pragma once

namespace tushar::mpm::solid {

/// What the yield stress depends on.
struct FlowState {
  double plasticStrain;          ///< equivalent plastic strain, 1
  double strainRate;             ///< equivalent strain rate, 1/s
  double temperature;            ///< K
  double shearModulus;           ///< Pa
  double density = 0;            ///< kg/m^3
  double meltTemperature = 0;    ///< K
  double plasticStrainRate = 0;  ///< mean of the step, 1/s
};

}  // namespace tushar::mpm::solid
