#pragma once

#include <memory>
#include <string>
#include <vector>

#include "components/euler/gas.hpp"
#include "core/input/schema.hpp"

namespace tushar::ice {

/// The `<EOS>` of a gas.
struct EquationOfState {
  enum class Kind { ideal, stiffened, jwl, jwlc, murnaghan, water };

  Kind kind = Kind::ideal;
  double pInfinity = 0;        ///< Pa
  euler::ColdCurve cold = {};  ///< of JWL, JWLC and Murnaghan's
  euler::Water::Numbers water = {};

  /// The law of a gas of a specific heat [J/(kg K)]; none if it is a stiffened gas.
  std::shared_ptr<const euler::Gas::Law> law(double specificHeat) const;
};

/// Reads the `<EOS>` of a `<material>`. Every problem goes to the diagnostics.
EquationOfState readEquationOfState(const input::Element& material, input::Diagnostics& diagnostics);

/// Its types, with Uintah's names except for stiffened_gas.
const std::vector<std::string>& equationsOfState();

}  // namespace tushar::ice
