#pragma once

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "components/mpm/solid/constitutive/ucnh.hpp"

namespace tushar::mpm::solid {

/// A porous solid whose pores are crushed under pressure; Herrmann, J. Appl. Phys. 40 (1969) 2490. The distension a is
/// the ratio of the density rhoS of the solid without pores to the density rho. It starts at a0 and falls
/// - elastically, with p = K0 (1 - J), until p = Pe at a = aE,
/// - then with a = 1 + (aE - 1) ((Ps - p)/(Ps - Pe))², until the pores are closed at p = Ps and a = 1,
/// - then with the Mie-Gruneisen pressure of the solid, counted from Ps.
/// From its least value a*, a rises along a straight line with Herrmann's slope da/dp = a*²/Ks (1 - 1/h²),
/// h = 1 + (ce/cs - 1)(a* - 1)/(a0 - 1), ce² = K0/rho0, cs² = Ks/rhoS, but not faster than p falls with Ks. In tension,
/// the bulk modulus is Ku. As in Uintah, there may be a deviatoric stress, that of comp_neo_hook_plastic, and the work
/// of crushing becomes heat.
struct PAlpha {
  struct State {
    double alpha;             ///< distension a [1]
    double alphaMin;          ///< its least value a* [1]
    double denseTemperature;  ///< temperature when the pores were closed [K]
    double plasticStrain;     ///< equivalent plastic strain [1]
    Tensor bElBar;            ///< elastic and isochoric left Cauchy-Green tensor [1]
  };
  using Capabilities = CapabilityList<capability::ConstantsOfMaterial, capability::BulkSpeed,
                                      capability::InitialWaveSpeed, capability::TemperatureChange>;
  static constexpr std::array<StateVariable, 5> stateVariables{
      {{"p.alpha", "1", "distension: density of the solid without pores, divided by the density"},
       {"p.alphaMin", "1", "least distension so far"},
       {"p.tempAlpha1", "K", "temperature when the pores were closed"},
       {"p.plasticStrain", "1", "equivalent plastic strain"},
       {"p.bElBar", "1", "isochoric elastic left Cauchy-Green tensor", 9}}};
  static constexpr std::string_view name = "p_alpha";
  static constexpr bool strainEnergyIsRate = true;

  MaterialConstants material;
  double closingPressure = 0;            ///< pressure Ps at which the pores are closed [Pa]
  double elasticLimit = 0;               ///< pressure Pe at which crushing starts [Pa]
  double solidDensity = 0;               ///< density rhoS of the solid [kg/m^3]
  double porousModulus = 0;              ///< bulk modulus K0 with pores [Pa]
  double solidModulus = 0;               ///< bulk modulus Ks without pores [Pa]
  std::optional<double> tensileModulus;  ///< bulk modulus Ku in tension [Pa]; none: K0/10
  double referenceTemperature = 0;       ///< temperature T_0 at the start [K]
  double soundSpeed = 0;                 ///< C_0 [m/s]
  double gruneisen = 0;                  ///< Gamma_0 [1]
  double hugoniotSlope = 0;              ///< S_alpha [1]
  double shearModulus = 0;               ///< shear modulus [Pa]; 0: no deviatoric stress
  std::optional<double> yieldStress;     ///< yield stress [Pa]; none: the deviatoric stress is elastic
  double hardeningModulus = 0;           ///< hardening modulus [Pa]

  static const input::Schema<PAlpha>& schema() {
    using Self = PAlpha;
    static const input::Schema<Self> schema =
        input::Schema<Self>(name, "A porous solid whose pores are crushed under pressure.")
            .required("Ps", &Self::closingPressure, "Pa", "pressure at which the pores are closed", input::positive())
            .required("Pe", &Self::elasticLimit, "Pa", "pressure at which crushing starts", input::positive())
            .required("rhoS", &Self::solidDensity, "kg/m^3", "density without pores", input::positive())
            .required("K0", &Self::porousModulus, "Pa", "bulk modulus until crushing starts", input::positive())
            .required("Ks", &Self::solidModulus, "Pa", "bulk modulus of the solid without pores", input::positive())
            .optional("Ku", &Self::tensileModulus, "Pa", "bulk modulus in tension; a tenth of <K0> by default",
                      input::positive())
            .required("T_0", &Self::referenceTemperature, "K", "temperature at the start", input::positive())
            .required("C_0", &Self::soundSpeed, "m/s", "speed of sound in the solid", input::positive())
            .required("Gamma_0", &Self::gruneisen, "1", "Gruneisen's gamma of the solid", input::nonNegative())
            .required("S_alpha", &Self::hugoniotSlope, "1", "slope of the shock velocity over the particle velocity",
                      input::nonNegative())
            .value("shear_modulus", &Self::shearModulus, 0, "Pa", "0: no deviatoric stress", input::nonNegative())
            .optional("yield_stress", &Self::yieldStress, "Pa",
                      "yield stress in uniaxial tension; without it, the deviatoric stress is elastic",
                      input::positive())
            .value("hardening_modulus", &Self::hardeningModulus, 0, "Pa",
                   "growth of the yield stress with the plastic strain", input::nonNegative())
            .ignored("alpha0", "the distension at the start follows from <rhoS> and the density")
            .check(checkLimits);
    return schema;
  }
  State initialState() const {
    return {initialDistension(), initialDistension(), referenceTemperature, 0, identityTensor};
  }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State& state) const {
    state.alpha = distension(d.deformationGradient);
    if (state.alphaMin >= 1) state.denseTemperature = d.temperature;
    state.alphaMin = std::min(state.alphaMin, state.alpha);
    Matrix3 stress = deviatoricStress(d, state);
    stress.diagonal().array() -= pressure(state, d.temperature);
    return stress;
  }
  double initialWaveSpeed(double initialDensity) const {
    return std::sqrt((porousModulus + 4.0 / 3.0 * shearModulus) / initialDensity);
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State& state) const {
    const double modulus = tangentModulus(state, d.temperature) + 4.0 / 3.0 * shearModulus;
    return std::sqrt(modulus * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State& state) const {
    return std::sqrt(tangentModulus(state, d.temperature) * d.deformationGradient.determinant() / initialDensity);
  }
  /// The work of crushing, -p dv / c_v, and the adiabatic heating of the solid, -Gamma_0 rhoS/rho T dv/v [K].
  double temperatureChange(const Deformation& d, const Matrix3& stress, const State& state) const {
    const double growth = 1 - distension(d.oldDeformationGradient) / state.alpha;
    if (state.alphaMin < 1) return -d.temperature * gruneisen * state.alpha * growth;
    const bool isCrushed = state.alpha == state.alphaMin && state.alpha < distensionAtLimit();
    const double density = solidDensity / state.alpha;
    return isCrushed ? stress.trace() / 3 * growth / (density * material.specificHeat) : 0;
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    return stressWork(d, oldStress, stress);
  }

 private:
  double initialDistension() const { return solidDensity / material.density; }
  double distension(const Matrix3& f) const { return initialDistension() * f.determinant(); }
  /// The distension aE at which crushing starts.
  double distensionAtLimit() const { return initialDistension() * (1 - elasticLimit / porousModulus); }
  double tension() const { return tensileModulus.value_or(0.1 * porousModulus); }

  /// The pressure at the least distension a* of a solid with open pores [Pa].
  double crushPressure(double least) const {
    const double limit = distensionAtLimit();
    if (least >= limit) return porousModulus * (1 - least / initialDistension());
    return closingPressure - (closingPressure - elasticLimit) * std::sqrt((least - 1) / (limit - 1));
  }
  /// The slope -dp/da from the least distension a* with open pores [Pa].
  double unloadingSlope(double least) const {
    if (least >= distensionAtLimit()) return porousModulus / initialDistension();
    const double ratio = std::sqrt(porousModulus * solidDensity / (material.density * solidModulus));
    const double h = 1 + (ratio - 1) * (least - 1) / (initialDistension() - 1);
    const double slope = least * least * (1 / (h * h) - 1);  // Ks times Herrmann's -da/dp
    return solidModulus / std::max(slope, 1.0);
  }
  double pressure(const State& state, double temperature) const {
    if (state.alphaMin < 1) {
      const double p = densePressure(state, temperature);
      return p < 0 ? p * tension() / (solidDensity * soundSpeed * soundSpeed) : p;
    }
    const double crushed = crushPressure(state.alphaMin), slope = unloadingSlope(state.alphaMin);
    const double p = crushed - slope * (state.alpha - state.alphaMin);
    const double free = state.alphaMin + crushed / slope;  // distension without pressure
    return p < 0 ? tension() * (1 - state.alpha / free) : p;
  }

  /// Compression zeta = rho/rhoS - 1 of the solid, kept short of that at which its pressure becomes infinite.
  double compression(const State& state) const {
    const double zeta = 1 / state.alpha - 1;
    return hugoniotSlope > 1 ? std::min(zeta, 0.9 / (hugoniotSlope - 1)) : zeta;
  }
  double densePressure(const State& state, double temperature) const {
    const double zeta = compression(state), left = 1 - (hugoniotSlope - 1) * zeta;
    const double cold =
        solidDensity * soundSpeed * soundSpeed * zeta * (1 + (1 - gruneisen / 2) * zeta) / (left * left);
    const double heat = solidDensity * material.specificHeat * (temperature - state.denseTemperature);
    return closingPressure + cold + gruneisen * heat;
  }
  /// The bulk modulus for fast waves [Pa]: that of unloading while pores are open.
  double tangentModulus(const State& state, double temperature) const {
    if (state.alphaMin >= 1) return state.alpha * std::max(unloadingSlope(state.alphaMin), tension() / state.alpha);
    const double zeta = compression(state), b = hugoniotSlope - 1, left = 1 - b * zeta;
    const double cold =
        solidDensity * soundSpeed * soundSpeed * (1 + (b + 2 - gruneisen) * zeta) / (left * left * left);
    const double thermal = gruneisen * gruneisen * solidDensity * material.specificHeat * temperature;
    return std::max((1 + zeta) * cold + thermal, tension());
  }

  Matrix3 deviatoricStress(const Deformation& d, State& state) const {
    if (shearModulus == 0) return Matrix3::Zero();
    CompNeoHookPlastic body;
    body.shearModulus = shearModulus;
    body.isPlastic = yieldStress.has_value();
    body.yieldStress = yieldStress;
    body.hardeningModulus = hardeningModulus;
    CompNeoHookPlastic::State shear{state.plasticStrain, state.bElBar};
    const Matrix3 stress = body.updateStress(d, Matrix3::Zero(), shear);
    state.plasticStrain = shear.plasticStrain;
    state.bElBar = shear.bElBar;
    return stress;
  }
  static void checkLimits(const PAlpha& read, const input::Element& element, input::Diagnostics& diagnostics) {
    if (read.elasticLimit >= read.closingPressure)
      diagnostics.error(element.child("Pe").value(), "is not less than <Ps>");
    const auto density = element.parent()->child("density");
    const auto given = density ? input::parse<double>(density->text()).value : std::nullopt;
    if (!given || !(*given > 0) || read.porousModulus <= 0) return;
    const double limit = read.solidDensity / *given * (1 - read.elasticLimit / read.porousModulus);
    if (limit <= 1)
      diagnostics.error(element.child("rhoS").value(),
                        fmt::format("must be greater than {:g} kg/m^3, the density at which crushing starts: the "
                                    "<density> of the material over 1 - Pe/K0",
                                    *given / (1 - read.elasticLimit / read.porousModulus)));
  }
};
static_assert(ConstitutiveModel<PAlpha>);

}  // namespace tushar::mpm::solid
