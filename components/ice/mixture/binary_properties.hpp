#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "components/euler/diffusion.hpp"
#include "components/euler/settings.hpp"
#include "core/input/schema.hpp"

// Uintah's BinaryProperties: one gas whose properties are those of a mixture of two.

namespace tushar::ice {

/// A region with an initial mass fraction of the second gas.
struct FractionRegion {
  Location where;  ///< in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  double fraction = 0;
};

/// One of the two gases.
struct BinaryGas {
  double density = 0;       ///< initial density [kg/m³]
  double specificHeat = 0;  ///< specific heat c_v [J/(kg K)]
  double gasConstant = 0;   ///< gas constant R [J/(kg K)]
  double viscosity = 0;     ///< viscosity [Pa s]
  double conductivity = 0;  ///< conductivity [W/(m K)]
};

/// `<Model type="BinaryProperties">`: two ideal gases A and B at one temperature. With the mass fraction f of B, the
/// values of c_v and R are 1 - f times those of A plus f times those of B; the initial density is 1 / ((1 - f) / rho_A
/// + f / rho_B).
struct BinaryProperties {
  Location where;        ///< in the scene
  std::string material;  ///< name of the gas that has these properties
  BinaryGas a, b;
  /// Regions that contain gas B; where they overlap, the last one counts. Outside them, there is only A.
  std::vector<FractionRegion> regions;

  /// A and B as two gases of a mixture. They have the initial velocity and temperature of `common`, the gas of the
  /// scene.
  std::vector<euler::Settings> gases(const euler::Settings& common) const;
  std::vector<euler::Diffusion> diffusions() const {
    return {{a.viscosity, a.conductivity}, {b.viscosity, b.conductivity}};
  }
};

/// Reads the tag that has the name of the model.
BinaryProperties readBinaryProperties(const input::Element& tag, input::Diagnostics& diagnostics);
/// Writes the manual of the model.
void describeBinaryProperties(std::ostream& out, int indent);

}  // namespace tushar::ice
