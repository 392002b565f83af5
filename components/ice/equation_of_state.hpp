#pragma once

#include <memory>
#include <string>
#include <vector>

#include "components/euler/gas.hpp"
#include "core/input/schema.hpp"

namespace tushar::ice {

/// The `<EOS>` of a gas.
struct EquationOfState {
  enum class Kind { ideal, stiffened, jwl, jwlc, murnaghan, gruneisen, water, tst, hardSpheres };

  Kind kind = Kind::ideal;
  double pInfinity = 0;        ///< p_inf [Pa]
  euler::ColdCurve cold = {};  ///< cold curve of JWL, JWLC, Murnaghan and Gruneisen
  double perKelvin = 0;        ///< parameter B of Gruneisen [Pa/K]
  euler::Water::Numbers water = {};
  euler::RealGas::Numbers real = {};  ///< for TST and hard spheres, except R and c_v
  double gammaOfThinGas = 0;          ///< for TST

  /// Whether <gamma> has an effect.
  bool hasGamma() const { return kind == Kind::ideal || kind == Kind::stiffened || kind == Kind::hardSpheres; }
  /// The law of a gas with a given specific heat [J/(kg K)] and, if it has one, ratio of specific heats; null for a
  /// stiffened gas.
  std::shared_ptr<const euler::Gas::Law> law(double specificHeat, double gamma) const;
};

/// Reads the `<EOS>` of a `<material>`. Reports every problem to the diagnostics.
EquationOfState readEquationOfState(const input::Element& material, input::Diagnostics& diagnostics);

/// The types of equations of state; all but stiffened_gas have Uintah's names.
const std::vector<std::string>& equationsOfState();

}  // namespace tushar::ice
