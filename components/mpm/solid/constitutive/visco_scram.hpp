#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/maxwell.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// Plastic-bonded explosive: five Maxwell elements in series with penny-shaped cracks of radius c; Bennett, Haberman,
/// Johnson, Asay & Henson, J. Mech. Phys. Solids 46 (1998) 2303. With s = sum_n s_n, G = sum_n G_n:
/// ds_n/dt = 2 G_n dev D - s_n/tau_n - G_n/G d((c/a)³ s)/dt, dp/dt = -K tr D, K = 2 G (1 + nu)/(3 (1 - 2 nu)).
/// The step is implicit in s, so that it is stable for any time step; without cracks it is exact.
struct ViscoScram {
  struct State {
    double crackRadius;               ///< crack radius c [m]
    double viscousHeating;            ///< viscous heating [K/s]
    double crackHeating;              ///< crack heating [K/s]
    double volumeHeating;             ///< cooling by expansion [K/s]
    std::array<Tensor, 5> deviators;  ///< deviators s_n [Pa]
  };
  using Capabilities = CapabilityList<capability::ConstantsOfMaterial, capability::BulkSpeed,
                                      capability::InitialWaveSpeed, capability::TemperatureChange>;
  static constexpr std::array<StateVariable, 9> stateVariables{
      {{"p.crackRad", "m", "radius of the cracks"},
       {"p.veHeatRate", "K/s", "heating by viscosity"},
       {"p.crHeatRate", "K/s", "heating by the growth of cracks"},
       {"p.volHeatRate", "K/s", "cooling by expansion"},
       {"p.maxwellStress1", "Pa", "stress deviator of the Maxwell element 1", 9},
       {"p.maxwellStress2", "Pa", "stress deviator of the Maxwell element 2", 9},
       {"p.maxwellStress3", "Pa", "stress deviator of the Maxwell element 3", 9},
       {"p.maxwellStress4", "Pa", "stress deviator of the Maxwell element 4", 9},
       {"p.maxwellStress5", "Pa", "stress deviator of the Maxwell element 5", 9}}};
  static constexpr std::string_view name = "visco_scram";
  static constexpr bool strainEnergyIsRate = true;

  MaterialConstants material;
  double poissonRatio = 0;                                       ///< Poisson's ratio nu [1]
  double crackScale = 0;                                         ///< crack scale a [m]
  double crackPower = 0;                                         ///< crack power m [1]
  double greatestCrackSpeed = 0;                                 ///< largest crack speed [m/s]
  double toughness = 0;                                          ///< toughness K_0 [Pa m^(1/2)]
  double crackFriction = 0;                                      ///< crack friction mu [1]
  double initialCrackRadius = 0;                                 ///< initial crack radius [m]
  double tensileSpeedUp = 0;                                     ///< factor of the crack speed in tension [1]
  double g1 = 0, g2 = 0, g3 = 0, g4 = 0, g5 = 0;                 ///< G_n [Pa]
  double rate1 = 0, rate2 = 0, rate3 = 0, rate4 = 0, rate5 = 0;  ///< 1/tau_n [1/s]
  double gruneisen = 0;                                          ///< Grüneisen parameter [1]
  bool ratesFollowTemperature = false;
  double shiftTemperature = 298;  ///< T_0 of Williams, Landel & Ferry [K]
  double shift1 = 6.5;            ///< shift1 C_1 [1]
  double shift2 = 120;            ///< shift2 C_2 [K]
  /// Coefficient of linear expansion [1/K]; if it is not 0, the model is ExpandingViscoScram.
  double thermalExpansion = 0;

  static const input::Schema<ViscoScram>& schema() {
    static const input::Schema<ViscoScram> schema = makeSchema();
    return schema;
  }
  State initialState() const { return {initialCrackRadius, 0, 0, 0, {}}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    return updateStress(d, oldStress, state, 0);
  }
  /// Computes the stress at the end of the step, where the strain `free` along each axis causes no stress [1].
  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state, double free) const {
    Corotated step(d, oldStress);
    step.strain.diagonal().array() -= free;
    const double mean = step.stress.trace() / 3;
    const CrackLoad load = crackLoadOf(step, d.timeStep);
    const double before = cracked(state.crackRadius);
    state.crackRadius += growthOf(load, state.crackRadius, d.timeStep);
    const Elements elements = elementsAt(d.temperature);
    const Matrix3 old = deviator(step.stress), stress = advance(step, d, elements, before, state);
    heat(step, d, elements, cracked(state.crackRadius) * stress - before * old, stress, state);
    Matrix3 total = stress;
    total.diagonal().array() += mean + bulkModulus() * step.strain.trace();
    return step.turned(total);
  }
  double initialWaveSpeed(double initialDensity) const { return std::sqrt(waveModulus() / initialDensity); }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(waveModulus() * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus() * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    return stressWork(d, oldStress, stress);
  }
  /// Temperature change after Hackett & Bennett, Int. J. Numer. Methods Engrg. 49 (2000) 1191.
  double temperatureChange(const Deformation& d, const Matrix3&, const State& state) const {
    return (state.viscousHeating + state.crackHeating - state.volumeHeating) * d.timeStep;
  }

 private:
  struct Element {
    double modulus;  ///< modulus G_n [Pa]
    double rate;     ///< 1/tau_n [1/s]
  };
  using Elements = std::array<Element, 5>;
  /// The load in a step that opens the cracks.
  struct CrackLoad {
    double pressure;       ///< pressure on the faces of the cracks [Pa]; 0 in tension
    double stress;         ///< (s:s)^(1/2) in compression, (sigma:sigma)^(1/2) in tension [Pa]
    double greatestSpeed;  ///< largest speed [m/s]
  };

  double shearModulus() const { return g1 + g2 + g3 + g4 + g5; }
  double bulkModulus() const { return 2 * shearModulus() * (1 + poissonRatio) / (3 * (1 - 2 * poissonRatio)); }
  double waveModulus() const { return bulkModulus() + 4.0 / 3.0 * shearModulus(); }
  /// The crack factor (c/a)³.
  double cracked(double radius) const {
    const double relative = radius / crackScale;
    return relative * relative * relative;
  }
  /// The elements at a temperature: all relaxation times shift according to Williams, Landel & Ferry, J. Am. Chem. Soc.
  /// 77 (1955) 3701.
  Elements elementsAt(double temperature) const {
    const double warm = temperature - shiftTemperature;
    const double faster = ratesFollowTemperature ? std::exp(shift1 * warm / (shift2 + warm)) : 1;
    return {
        {{g1, rate1 * faster}, {g2, rate2 * faster}, {g3, rate3 * faster}, {g4, rate4 * faster}, {g5, rate5 * faster}}};
  }

  /// The load in a step. The largest crack speed depends on the strain rate, exp(-2.90178468) (1.5^(1/2) |dev
  /// D|)^.90564746, with Uintah's numbers for PBX 9501.
  CrackLoad crackLoadOf(const Corotated& step, double timeStep) const {
    const double mean = step.stress.trace() / 3, rate = std::sqrt(1.5) * deviator(step.strain).norm() / timeStep;
    double speed = rate > 1e-8 ? std::exp(0.90564746 * std::log(rate) - 2.90178468) : 0;
    if (mean > 0) speed *= tensileSpeedUp;
    return {std::max(-mean, 0.0), mean > 0 ? step.stress.norm() : deviator(step.stress).norm(),
            std::min(speed, greatestCrackSpeed)};
  }
  /// The crack speed dc/dt = v (K/K_1)^m for K < K', and v (1 - (K_0'/K)²) otherwise, eqs. 24-31: K = (3/2 pi c)^(1/2)
  /// sigma, K_0' the toughness with friction on the faces of the crack, K' = K_0' (1 + 2/m)^(1/2), K_1 = K' (1 +
  /// m/2)^(1/m).
  double crackSpeed(const CrackLoad& load, double radius) const {
    const double intensity = std::sqrt(1.5 * std::numbers::pi * radius) * load.stress;
    if (intensity <= 0) return 0;
    const double slip = std::sqrt(45 / (2 * (3 - 2 * crackFriction * crackFriction))) * crackFriction;
    const double held = slip * load.pressure * std::sqrt(radius) / toughness;
    const double resistance = toughness * std::sqrt(1 + std::numbers::pi * held * (1 + held));
    const double change = resistance * std::sqrt(1 + 2 / crackPower);
    if (intensity < change) {
      const double scale = change * std::pow(1 + crackPower / 2, 1 / crackPower);
      return load.greatestSpeed * std::pow(intensity / scale, crackPower);
    }
    return load.greatestSpeed * (1 - resistance * resistance / (intensity * intensity));
  }
  /// Growth of the crack radius in a step [m], by the fourth-order Runge-Kutta method.
  double growthOf(const CrackLoad& load, double radius, double timeStep) const {
    const double k1 = crackSpeed(load, radius), k2 = crackSpeed(load, radius + 0.5 * timeStep * k1);
    const double k3 = crackSpeed(load, radius + 0.5 * timeStep * k2), k4 = crackSpeed(load, radius + timeStep * k3);
    return timeStep / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  /// The stress deviator at the end of the step, in the rotated axes. With B = (c/a)³:
  /// s_n <- kept_n s_n + gained_n (2 G_n dev D dt - G_n/G (B s - B_old s_old)), a linear equation for s, their sum.
  Matrix3 advance(const Corotated& step, const Deformation& d, const Elements& elements, double crackedBefore,
                  State& state) const {
    const Matrix3 strain = deviator(step.strain), old = deviator(step.stress);
    const double cracks = cracked(state.crackRadius);
    std::array<Matrix3, 5> free;
    std::array<double, 5> gained;
    Matrix3 sum = Matrix3::Zero();
    double share = 0;
    for (int n = 0; n < 5; ++n) {
      const MaxwellStep element(elements[n].rate * d.timeStep);
      gained[n] = element.gained;
      free[n] = element.kept * step.seen(matrixOf(state.deviators[n])) + gained[n] * 2 * elements[n].modulus * strain;
      sum += free[n];
      share += gained[n] * elements[n].modulus / shearModulus();
    }
    const Matrix3 stress = (sum + share * crackedBefore * old) / (1 + share * cracks);
    const Matrix3 opened = cracks * stress - crackedBefore * old;
    for (int n = 0; n < 5; ++n)
      state.deviators[n] = tensorOf(step.turned(free[n] - gained[n] * elements[n].modulus / shearModulus() * opened));
    return stress;
  }
  /// Computes the heating rates [K/s]: sum_n s_n:s_n/(2 G_n tau_n), s : d((c/a)³ s)/dt / (2 G), each over rho c_v, and
  /// Gamma T tr D.
  void heat(const Corotated& step, const Deformation& d, const Elements& elements, const Matrix3& opened,
            const Matrix3& stress, State& state) const {
    const double capacity = material.density / d.deformationGradient.determinant() * material.specificHeat;
    double work = 0;
    for (int n = 0; n < 5; ++n)
      if (elements[n].modulus > 0)
        work += matrixOf(state.deviators[n]).squaredNorm() * elements[n].rate / (2 * elements[n].modulus);
    state.viscousHeating = work / capacity;
    state.crackHeating = stress.cwiseProduct(opened).sum() / (2 * shearModulus() * d.timeStep) / capacity;
    state.volumeHeating = gruneisen * d.temperature * step.strain.trace() / d.timeStep;
  }

  static input::Schema<ViscoScram> makeSchema() {
    using Self = ViscoScram;
    input::Schema<Self> tags{name, "Plastic-bonded explosive, with relaxation and growing cracks."};
    tags.required("PR", &Self::poissonRatio, "1", "Poisson's ratio", input::between(-0.999, 0.4999))
        .required("CrackParameterA", &Self::crackScale, "m", "a: cracks of this radius halve the stiffness",
                  input::positive())
        .required("CrackPowerValue", &Self::crackPower, "1", "m: exponent of slow crack growth", input::positive())
        .required("CrackMaxGrowthRate", &Self::greatestCrackSpeed, "m/s", "largest speed of crack growth",
                  input::nonNegative())
        .required("StressIntensityF", &Self::toughness, "Pa m^(1/2)", "K_0: toughness without friction",
                  input::positive())
        .required("CrackFriction", &Self::crackFriction, "1", "friction coefficient of crack faces",
                  input::between(0, 1.2))
        .required("InitialCrackRadius", &Self::initialCrackRadius, "m", "crack radius at the start",
                  input::nonNegative())
        .required("CrackGrowthRate", &Self::tensileSpeedUp, "1", "factor by which crack growth is faster in tension",
                  input::nonNegative())
        .required("Gamma", &Self::gruneisen, "1", "Grüneisen parameter, for heating by compression",
                  input::nonNegative());
    addElements(tags);
    tags.value("use_time_temperature_equation", &Self::ratesFollowTemperature, false, "1",
               "whether relaxation is faster at higher temperatures")
        .value("T0", &Self::shiftTemperature, 298, "K", "temperature to which the given relaxation rates apply")
        .value("C1", &Self::shift1, 6.5, "1", "first constant of Williams, Landel & Ferry")
        .value("C2", &Self::shift2, 120, "K", "second constant of Williams, Landel & Ferry", input::positive())
        .value("CoeffThermalExpansion", &Self::thermalExpansion, 0, "1/K", "thermal expansion coefficient (of lengths)",
               input::nonNegative())
        .ignored("Beta", "Uintah does not use it either")
        .ignored("DCp_DTemperature", "Uintah does not use it either")
        .ignored("useModifiedEOS", "only the fluid coupling of Uintah uses it")
        .ignored("useObjectiveRate", "stresses always rotate with the material");
    for (const char* tag : {"Chi", "delH", "Z", "EoverR", "dynamic_coeff_friction", "volfracHE"})
      tags.ignored(tag, "belongs to the hot spots in Uintah's visco_scram_hs");
    refuseSwitch(tags, "randomize_parameters", "all particles have the given moduli");
    for (const char* tag : {"useMurnahanEOS", "useMurnaghanEOS", "useBirchMurnaghanEOS", "useJWLEOS", "useJWLCEOS",
                            "gamma", "P0", "bulkPrime", "A", "B", "C", "R1", "R2", "om", "Cv", "rho0"})
      tags.ignored(tag, "only the fluid coupling of Uintah uses it");
    return tags;
  }
  static void addElements(input::Schema<ViscoScram>& tags) {
    using Self = ViscoScram;
    const std::array<std::pair<double Self::*, double Self::*>, 5> members{{{&Self::g1, &Self::rate1},
                                                                            {&Self::g2, &Self::rate2},
                                                                            {&Self::g3, &Self::rate3},
                                                                            {&Self::g4, &Self::rate4},
                                                                            {&Self::g5, &Self::rate5}}};
    for (int n = 0; n < 5; ++n) {
      const std::string number = std::to_string(n + 1);
      tags.required("G" + number, members[n].first, "Pa", "shear modulus of a Maxwell element", input::nonNegative());
      tags.required("RTau" + number, members[n].second, "1/s", "relaxation rate of this element", input::nonNegative());
    }
    tags.check([](const Self& read, const input::Element& element, input::Diagnostics& diagnostics) {
      if (read.shearModulus() <= 0) diagnostics.error(element, "none of <G1> to <G5> is positive");
    });
  }
};
static_assert(ConstitutiveModel<ViscoScram>);

/// ViscoScram with thermal expansion: the strain rate that causes stress is D - alpha dT/dt I. As in Uintah, dT/dt
/// follows from the temperatures at the start of this step and of the previous one.
struct ExpandingViscoScram {
  struct State {
    ViscoScram::State scram;
    double temperature;  ///< temperature at the start of the previous step [K]; -1 in the first step
  };
  using Capabilities =
      CapabilityList<capability::BulkSpeed, capability::InitialWaveSpeed, capability::TemperatureChange>;
  static constexpr auto stateVariables = [] {
    std::array<StateVariable, ViscoScram::stateVariables.size() + 1> all;
    std::copy(ViscoScram::stateVariables.begin(), ViscoScram::stateVariables.end(), all.begin());
    all.back() = {"p.temperatureOfStrain", "K", "temperature for which the thermal expansion has been applied"};
    return all;
  }();
  static constexpr std::string_view name = ViscoScram::name;
  static constexpr bool strainEnergyIsRate = ViscoScram::strainEnergyIsRate;

  ViscoScram scram;

  static const input::Schema<ExpandingViscoScram>& schema() {
    static const input::Schema<ExpandingViscoScram> schema{name, "Read as visco_scram."};
    return schema;
  }
  State initialState() const { return {scram.initialState(), -1}; }
  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const double rise = state.temperature >= 0 ? d.temperature - state.temperature : 0;
    state.temperature = d.temperature;
    return scram.updateStress(d, oldStress, state.scram, scram.thermalExpansion * rise);
  }
  double initialWaveSpeed(double initialDensity) const { return scram.initialWaveSpeed(initialDensity); }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state) const {
    return scram.waveSpeed(initialDensity, d, stress, state.scram);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state) const {
    return scram.bulkSpeed(initialDensity, d, stress, state.scram);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State& state) const {
    return scram.strainEnergyDensity(d, oldStress, stress, state.scram);
  }
  double temperatureChange(const Deformation& d, const Matrix3& stress, const State& state) const {
    return scram.temperatureChange(d, stress, state.scram);
  }
};
static_assert(ConstitutiveModel<ExpandingViscoScram>);

}  // namespace tushar::mpm::solid
