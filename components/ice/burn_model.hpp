#pragma once

#include <cmath>
#include <string>
#include <variant>

#include "core/input/diagnostics.hpp"
#include "core/input/schema.hpp"

namespace tushar::ice {

/// The conditions on which a surface burns.
struct AtSurface {
  double pressure = 0;         ///< of the gas at the surface, Pa
  double bodyTemperature = 0;  ///< of the body below its surface, K
  double bodyDensity = 0;      ///< kg/m³
};

/// A rate by the pressure alone, as Uintah's Simple_Burn has it.
struct SimpleBurn {
  double coefficient = 0;        ///< kg/(m² s) at the reference pressure
  double referencePressure = 0;  ///< Pa

  /// kg/(m² s)
  double rate(const AtSurface& at) const {
    constexpr double exponent = 0.778;  // of Uintah's model, for the explosive PBX 9501
    return coefficient * std::pow(at.pressure / referencePressure, exponent);
  }
};

/// `<Model type="Test">` of a body: a part of all that is left of it becomes gas per time, wherever it is.
struct Decay {
  double perTime = 0;    ///< 1/s
  double startTime = 0;  ///< s
};

/// A body that turns into a gas.
struct BurnModel {
  Location where;                  ///< in the scene
  std::string from, to;            ///< the materials
  double ignitionTemperature = 0;  ///< K
  double leastPressure = 0;        ///< below it, nothing burns, Pa
  double heat = 0;                 ///< of the reaction, J/kg
  std::variant<SimpleBurn, Decay> law;

  /// Whether surfaces burn, rather than the whole.
  bool burnsAtSurface() const { return !std::holds_alternative<Decay>(law); }
  /// Rate of a surface that is alight, kg/(m² s).
  double rate(const AtSurface& at) const {
    return std::visit(
        [&](const auto& model) {
          if constexpr (requires { model.rate(at); })
            return model.rate(at);
          else
            return 0.0;
        },
        law);
  }
};

/// `<Simple_Burn>`.
struct SimpleBurnSection {
  Location where;
  bool isActive = true;
  std::string from, to;
  double thresholdTemperature = 0, thresholdPressure = 0, enthalpy = 0, coefficient = 0, reference = 0;

  BurnModel model() const {
    return {where, from, to, thresholdTemperature, thresholdPressure, enthalpy, SimpleBurn{coefficient, reference}};
  }
};
const input::Schema<SimpleBurnSection>& simpleBurnSchema();

}  // namespace tushar::ice
