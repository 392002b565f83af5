#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <optional>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/explosive.hpp"

namespace tushar::mpm::solid {

/// An explosive that burns where it is compressed, dF/dt = G (1 - F) p^b, JWL++: Souers & al., Propellants,
/// Explos., Pyrotech. 25 (2000) 54. A particle burns in steps at whose start its pressure exceeds an ignition pressure.
/// sigma = -p I, where p combines the pressures of Murnaghan and of Jones, Wilkins and Lee (see mixedPressure).
struct JwlppMpm {
  struct State {
    double burned;  ///< F, burned fraction [1]
    double growth;  ///< growth of F in the latest step [1]
  };
  using Capabilities =
      CapabilityList<capability::IgnoresTemperature, capability::ConstantsOfMaterial, capability::InitialVolumeRatio,
                     capability::BulkSpeed, capability::InitialWaveSpeed>;
  static constexpr std::array<StateVariable, 2> stateVariables{
      {{"p.progressF", "1", "burned fraction"},
       {"p.progressdelF", "1", "increase of the burned fraction in the step"}}};
  static constexpr std::string_view name = "jwlpp_mpm";
  static constexpr bool strainEnergyIsRate = true;

  MaterialConstants material;
  double ignitionPressure = 0;               ///< ignition pressure [Pa]
  double compressibility = 0, exponent = 0;  ///< kappa [1/Pa] and n [1] of the explosive
  double a = 0, b = 0, c = 0;                ///< A, B, C of the products [Pa]
  double r1 = 0, r2 = 0, omega = 0;          ///< R1, R2, omega of the products [1]
  double rate = 0;                           ///< rate G [1/(s Pa^b)]
  double power = 0;                          ///< power b [1]
  double greatestFraction = 1;               ///< largest value of F [1]
  bool startsUnderPressure = false;
  double initialPressure = 0;  ///< initial pressure [Pa]

  static const input::Schema<JwlppMpm>& schema() {
    static const input::Schema<JwlppMpm> schema = makeSchema();
    return schema;
  }
  Murnaghan explosive() const { return {compressibility, exponent}; }
  Jwl products() const { return {a, b, c, r1, r2, omega}; }

  State initialState() const { return {0, 0}; }
  double initialVolumeRatio() const { return startsUnderPressure ? explosive().relativeVolume(initialPressure) : 1; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const double before = state.burned;
    if (-oldStress.trace() / 3 > ignitionPressure && before < greatestFraction)
      state.burned = std::min(burn(before, d), greatestFraction);
    state.growth = state.burned - before;
    return -pressure(state.burned, d.deformationGradient.determinant()) * Matrix3::Identity();
  }
  /// Wave speed of the unburned explosive [m/s] at J = 1, where its density is that of the material.
  double initialWaveSpeed(double initialDensity) const { return speed(material.density / initialDensity); }
  /// Wave speed of the unburned explosive [m/s], even after it has burned, as in Uintah; waves in the products may be
  /// three times as fast.
  double waveSpeed(double, const Deformation& d, const Matrix3&, const State&) const {
    return speed(d.deformationGradient.determinant());
  }
  /// Bulk wave speed: c_b² = J / (kappa rho_0), as in Uintah.
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(d.deformationGradient.determinant() / (compressibility * initialDensity));
  }
  /// Returns 0 as in Uintah, so that StrainEnergy can be compared.
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }

 private:
  double pressure(double fraction, double j) const { return mixedPressure(explosive(), products(), fraction, j); }
  double speed(double j) const { return j * std::sqrt(explosive().stiffness(j) / material.density); }

  /// Computes F at the end of a step in which J grows at a constant rate, to 1e-9: with u = -ln(1 - F), du/dt = G p^b,
  /// by the fourth-order method of Kutta, Z. Math. Phys. 46 (1901) 435, with steps halved as often as needed.
  double burn(double before, const Deformation& d) const {
    constexpr double wanted = 1e-9, done = 30;  // exp(-done) of it is left: nothing
    const double start = d.oldDeformationGradient.determinant();
    const double growth = std::log(d.deformationGradient.determinant() / start);
    const auto slope = [&](double s, double u) {
      const double p = pressure(-std::expm1(-u), start * std::exp(growth * s));
      return d.timeStep * rate * std::pow(std::max(p, 0.0), power);
    };
    double u = -std::log1p(-before), s = 0, h = 1;
    while (s < 1 && u < done) {
      h = std::min(h, 1 - s);
      const double once = kutta(slope, s, u, h), twice = kutta(slope, s + h / 2, kutta(slope, s, u, h / 2), h / 2);
      const double error = std::abs(std::exp(-once) - std::exp(-twice)) / 15;
      if (error > wanted && h > smallestStep) {
        h /= 2;
        continue;
      }
      s += h;
      u = twice;
      if (error < wanted / 64) h *= 2;
    }
    return u < done ? -std::expm1(-u) : 1;
  }
  static constexpr double smallestStep = 1e-12;
  template <class Slope>
  static double kutta(const Slope& slope, double s, double u, double h) {
    const double k1 = slope(s, u), k2 = slope(s + h / 2, u + h / 2 * k1), k3 = slope(s + h / 2, u + h / 2 * k2);
    return u + h / 6 * (k1 + 2 * k2 + 2 * k3 + slope(s + h, u + h * k3));
  }

  static input::Schema<JwlppMpm> makeSchema() {
    using Self = JwlppMpm;
    input::Schema<Self> tags("jwlpp_mpm", "An explosive that burns where it is compressed: JWL++.");
    tags.required("ignition_pressure", &Self::ignitionPressure, "Pa", "pressure above which a particle burns",
                  input::positive())
        .required("murnaghan_K", &Self::compressibility, "1/Pa", "compressibility of the explosive", input::positive())
        .required("murnaghan_n", &Self::exponent, "1", "explosive: exponent of the density", input::positive())
        .required("jwl_A", &Self::a, "Pa", "products: factor of exp(-R1 V)", input::nonNegative())
        .required("jwl_B", &Self::b, "Pa", "products: factor of exp(-R2 V)")
        .required("jwl_C", &Self::c, "Pa", "products: factor of V^-(1 + om)", input::nonNegative())
        .required("jwl_R1", &Self::r1, "1", "constant in the equation of state of the products", input::positive())
        .required("jwl_R2", &Self::r2, "1", "constant in the equation of state of the products", input::positive())
        .required("jwl_om", &Self::omega, "1", "constant in the equation of state of the products",
                  input::nonNegative())
        .required("reaction_G", &Self::rate, "1/(s Pa^b)", "factor of the burn rate", input::nonNegative())
        .required("reaction_b", &Self::power, "1", "exponent of the pressure in the burn rate", input::nonNegative())
        .value("max_burned_fraction", &Self::greatestFraction, 1, "1", "fraction at which burning stops",
               input::between(0, 1))
        .value("useInitialStress", &Self::startsUnderPressure, false, "1", "bodies start under <initial_pressure>")
        .value("initial_pressure", &Self::initialPressure, 0, "Pa", "pressure at the start", input::nonNegative())
        .ignored("jwl_rho0", "the material's density is used, as in Uintah");
    for (const char* tag : {"max_burn_timestep_size", "doFastStressCompute", "tolerance_for_Newton_iterations",
                            "max_number_of_Newton_iterations"})
      tags.ignored(tag, "the burned fraction is integrated to an accuracy of 1e-9, in as many substeps as necessary");
    for (const char* tag : {"useTaylorSeriesForDefGrad", "num_taylor_terms"})
      tags.ignored(tag, "as in Uintah, <minimum_subcycles_for_F> determines how F is integrated");
    return tags;
  }
};
static_assert(ConstitutiveModel<JwlppMpm>);

}  // namespace tushar::mpm::solid
