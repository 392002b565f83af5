#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/isotropic_moduli.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// Linear elasticity with the yield surface of Mohr and Coulomb, (s1 - s3) + (s1 + s3) sin phi = 2 c cos phi with the
/// principal stresses s1 >= s2 >= s3, tension positive; plastic flow follows from the same function with the dilation
/// angle psi instead of phi. The stress returns to a face, an edge or the apex: de Souza Neto, Perić & Owen,
/// Computational Methods for Plasticity (2008), section 8.2. The stress rotates with the material, unlike in Uintah.
///
/// With <Usetransition>, c = St A1 W^-B1 max(1, g/g_ref)^beta_rate for a water content W and a shear rate g: Boukpeti,
/// White, Randolph & Low, Géotechnique 62 (2012) 483. With <UseWaterRetention>, a suction s adds s tan PhiB to c,
/// Fredlund, Morgenstern & Widger, Can. Geotech. J. 15 (1978) 313; the saturation is S = (1 + (alpha s)^n)^-m, van
/// Genuchten, Soil Sci. Soc. Am. J. 44 (1980) 892, and the water content of the pores is constant.
struct MohrCoulomb : IsotropicModuli {
  struct State {
    double suction;         ///< suction s [Pa]
    double specificVolume;  ///< ratio of the volume of the soil, including pores, to that of its grains [1]
    double cohesion;        ///< cohesion c [Pa]
  };
  using Capabilities = CapabilityList<capability::IgnoresTemperature, capability::BulkSpeed, capability::OptionalState>;
  static constexpr std::array<StateVariable, 3> stateVariables{
      {{"p.Suction", "Pa", "suction of the pore water"},
       {"p.SpecificVol", "1", "specific volume: volume of the soil, including pores, divided by that of its grains"},
       {"p.cohesion", "Pa", "cohesion"}}};
  static constexpr std::string_view name = "MohrCoulomb";
  static constexpr bool strainEnergyIsRate = true;

  double cohesion = 0;       ///< cohesion c [Pa]
  double frictionAngle = 0;  ///< friction angle phi [degrees]
  double dilationAngle = 0;  ///< dilation angle psi [degrees]
  bool isWet = false;        ///< whether the cohesion follows from the water content and the rate
  double strength = 0;       ///< strength A1 [Pa]
  double waterExponent = 0;  ///< water exponent B1 [1]
  double waterContent = 1;   ///< water content W [1]
  double sensitivity = 1;    ///< sensitivity St [1]
  double rateExponent = 0;   ///< rate exponent beta_rate [1]
  double referenceRate = 0;  ///< reference rate g_ref [1/s]
  bool retainsWater = false;
  double retentionM = 0, retentionN = 0;  ///< m and n of the retention curve [1]
  double retentionAlpha = 0;              ///< alpha of the retention curve [1/Pa]
  double suctionAngle = 0;                ///< suction angle PhiB [degrees]
  double initialSuction = 0;              ///< initial suction [Pa]
  double initialSpecificVolume = 0;       ///< initial specific volume [1]

  static const input::Schema<MohrCoulomb>& schema() {
    static const input::Schema<MohrCoulomb> schema = makeSchema();
    return schema;
  }
  bool keepsState() const { return isWet || retainsWater; }
  State initialState() const { return {initialSuction, initialSpecificVolume, cohesion}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const Corotated step(d, oldStress);
    Matrix3 trial = step.stress + 2 * shearModulus * step.strain;
    trial.diagonal().array() += lambda() * step.strain.trace();
    if (!keepsState()) return step.turned(returned(trial));
    MohrCoulomb now = *this;
    if (isWet) now.cohesion = wetCohesion(step.strain / d.timeStep);
    if (retainsWater) {
      squeeze(step.strain.trace(), state);
      now.cohesion += state.suction * std::tan(radians(suctionAngle));
    }
    state.cohesion = now.cohesion;
    return step.turned(now.returned(trial));
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State&) const {
    return IsotropicModuli::waveSpeed(initialDensity, d, stress, {});
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State&) const {
    return IsotropicModuli::bulkSpeed(initialDensity, d, stress, {});
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    return stressWork(d, oldStress, stress);
  }
  /// Amount by which a stress exceeds the yield surface [Pa]; at most 0 if the stress is admissible.
  double excess(const Matrix3& stress) const {
    const Eigen::Vector3d s =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress, Eigen::EigenvaluesOnly).eigenvalues();
    return face(s.reverse(), 0, 2);
  }

 private:
  using Principal = Eigen::Vector3d;  ///< principal stresses [Pa], the largest first

  double lambda() const { return bulkModulus - 2.0 / 3.0 * shearModulus; }
  static double radians(double degrees) { return degrees * std::numbers::pi / 180; }
  static double sine(double degrees) { return std::sin(radians(degrees)); }
  double bearable() const { return 2 * cohesion * std::cos(radians(frictionAngle)); }

  /// The cohesion [Pa] at a strain rate [1/s]. As in Uintah the rate of shear is (1/2 sum (D_i - D_j)² + 3/4 sum
  /// D_ij²)^(1/2).
  double wetCohesion(const Matrix3& rate) const {
    const double normal = std::pow(rate(0, 0) - rate(1, 1), 2) + std::pow(rate(0, 0) - rate(2, 2), 2) +
                          std::pow(rate(1, 1) - rate(2, 2), 2);
    const double oblique = std::pow(rate(0, 1), 2) + std::pow(rate(1, 2), 2) + std::pow(rate(2, 0), 2);
    const double shear = std::sqrt(0.5 * normal + 0.75 * oblique);
    const double faster = shear > referenceRate ? std::pow(shear / referenceRate, rateExponent) : 1;
    return sensitivity * strength * std::pow(waterContent, -waterExponent) * faster;
  }
  /// The fraction of the pores that water fills at a suction [Pa].
  double saturation(double suction) const {
    return std::pow(1 + std::pow(retentionAlpha * suction, retentionN), -retentionM);
  }
  /// Updates the suction [Pa] after a dilatation. The amount of water is constant, so it fills a larger fraction of
  /// smaller pores; pores that are closed before or after the step count as full.
  void squeeze(double dilatation, State& state) const {
    constexpr double full = 0.99999;
    const double before = state.specificVolume, now = before * (1 + dilatation);
    const double water = saturation(state.suction) * (before - 1) / before;
    const double filled = std::min(before, now) > 1 ? std::clamp(water * now / (now - 1), 1e-4, full) : full;
    state.specificVolume = now;
    state.suction = std::pow(std::pow(filled, -1 / retentionM) - 1, 1 / retentionN) / retentionAlpha;
  }

  static input::Schema<MohrCoulomb> makeSchema() {
    using Self = MohrCoulomb;
    input::Schema<Self> tags("MohrCoulomb", "Linear elasticity with the Mohr-Coulomb yield surface.");
    tags.required("G", input::memberOf<Self>(&Self::shearModulus), "Pa", "shear modulus", input::positive())
        .required("K", input::memberOf<Self>(&Self::bulkModulus), "Pa", "bulk modulus", input::positive())
        .value("c", &Self::cohesion, 0, "Pa", "cohesion", input::nonNegative())
        .value("Phi", &Self::frictionAngle, 0, "degrees", "friction angle", input::between(0, 89))
        .value("Psi", &Self::dilationAngle, 0, "degrees", "dilation angle", input::between(0, 89));
    declareWater(tags);
    tags.check(checkConstants);
    refuseOtherValues(tags, "Version", {"1", "11", "12"},
                      "stresses return to the nearest point of a surface with corners");
    for (const char* tag : {"Usemodul", "Use_softening", "Use_linear", "Use_regular", "UseRemould", "Use_friction",
                            "Use_pressure_dependence", "Usetransition1", "Use_dilation"})
      refuseSwitch(tags, tag, "<G> and <K> are constant, and the strength does not soften");
    for (const char* tag : {"m_modul", "nuy", "strain_95", "a", "y_ref", "y", "n", "tFE", "tShear", "n_nonlocalMC",
                            "l_nonlocal", "WR_Param4"})
      tags.ignored(tag, "belongs to an option that must be false");
    tags.ignored("beta", "Uintah does not use it either: the exponent of the rate is <beta_rate>");
    return tags;
  }
  static void declareWater(input::Schema<MohrCoulomb>& tags) {
    using Self = MohrCoulomb;
    declareSwitch(tags, "Usetransition", &Self::isWet,
                  "the cohesion follows from <A1>, <B1>, <W> and the strain rate, instead of <c>");
    tags.value("A1", &Self::strength, 0, "Pa", "with Usetransition: cohesion at a water content of 1",
               input::nonNegative())
        .value("B1", &Self::waterExponent, 0, "1", "with Usetransition: exponent of the water content")
        .value("W", &Self::waterContent, 1, "1", "with Usetransition: water content", input::positive())
        .value("St", &Self::sensitivity, 1, "1", "with Usetransition: factor of the cohesion", input::nonNegative())
        .value("beta_rate", &Self::rateExponent, 0, "1", "with Usetransition: exponent of the shear rate")
        .value("strain_ref", &Self::referenceRate, 0, "1/s",
               "with Usetransition: shear rate below which the cohesion does not depend on the rate",
               input::nonNegative());
    declareSwitch(tags, "UseWaterRetention", &Self::retainsWater, "the suction of the pore water adds to the cohesion");
    tags.value("WR_Param1", &Self::retentionM, 0, "1", "with UseWaterRetention: van Genuchten's m")
        .value("WR_Param2", &Self::retentionN, 0, "1", "with UseWaterRetention: van Genuchten's n")
        .value("WR_Param3", &Self::retentionAlpha, 0, "1/Pa", "with UseWaterRetention: van Genuchten's alpha")
        .value("PhiB", &Self::suctionAngle, 0, "degrees",
               "with UseWaterRetention: friction angle with respect to suction", input::between(0, 89))
        .value("suction", &Self::initialSuction, 0, "Pa", "with UseWaterRetention: suction at the start",
               input::nonNegative())
        .value("SpecVol", &Self::initialSpecificVolume, 0, "1",
               "with UseWaterRetention: volume of the soil divided by that of its grains, at the start");
  }
  /// Declares a flag that Uintah reads as a number: true if the number is greater than 0.
  static void declareSwitch(input::Schema<MohrCoulomb>& tags, const std::string& tag, bool MohrCoulomb::*member,
                            const std::string& sentence) {
    const auto read = [=](MohrCoulomb& object, const input::Element& element, input::Diagnostics& diagnostics) {
      const auto given = element.child(tag);
      if (!given || given->text() == "false") return;
      const auto number = input::parse<double>(given->text()).value;
      object.*member = given->text() == "true" || number == 1.0;
      if (!(object.*member || number == 0.0))
        diagnostics.error(*given, "found '" + given->text() + "', expected 0 or 1");
    };
    tags.custom(tag, read, {tag}, "0 or 1: " + sentence)
        .forms({input::choiceForm({tag}, {"0", "1", "0.0", "1.0", "false", "true"})});
  }
  static void checkConstants(const MohrCoulomb& read, const input::Element& element, input::Diagnostics& diagnostics) {
    if (read.dilationAngle > read.frictionAngle)
      diagnostics.error(element, "<Psi> is greater than <Phi>: plastic flow would create energy");
    if (read.isWet && read.rateExponent != 0 && read.referenceRate == 0)
      diagnostics.error(element, "<beta_rate> needs <strain_ref>");
    const double least = std::min({read.retentionM, read.retentionN, read.retentionAlpha});
    if (read.retainsWater && (least <= 0 || read.initialSpecificVolume <= 1))
      diagnostics.error(element,
                        "<UseWaterRetention> needs <WR_Param1>, <WR_Param2> and <WR_Param3> above 0, and <SpecVol> "
                        "above 1");
  }

  /// Normal of the yield surface's face for the i-th and the j-th principal stress.
  static Principal normal(int i, int j, double angle) {
    Principal n = Principal::Zero();
    n[i] = 1 + sine(angle);
    n[j] = -1 + sine(angle);
    return n;
  }
  double face(const Principal& s, int i, int j) const { return normal(i, j, frictionAngle).dot(s) - bearable(); }
  /// Change of stress per unit of plastic flow across a face [Pa].
  Principal correction(int i, int j) const {
    const Principal flow = normal(i, j, dilationAngle);
    return 2 * shearModulus * flow + lambda() * flow.sum() * Principal::Ones();
  }
  static bool isOrdered(const Principal& s, double tolerance) {
    return s[0] >= s[1] - tolerance && s[1] >= s[2] - tolerance;
  }

  Matrix3 returned(const Matrix3& trial) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(trial);
    const Principal s = solver.eigenvalues().reverse();
    if (face(s, 0, 2) <= 0) return trial;
    const Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();
    return axes * returned(s).asDiagonal() * axes.transpose();
  }
  Principal returned(const Principal& s) const {
    const double tolerance = 1e-12 * s.cwiseAbs().maxCoeff();
    const Principal away = correction(0, 2);
    const Principal onFace = s - face(s, 0, 2) / normal(0, 2, frictionAngle).dot(away) * away;
    if (isOrdered(onFace, 0)) return onFace;
    const bool firstTwoMeet = onFace[1] > onFace[0];
    for (const bool atFirst : {firstTwoMeet, !firstTwoMeet}) {
      const Principal onEdge = atFirst ? returnedToEdge(s, 1, 2) : returnedToEdge(s, 0, 1);
      if (isOrdered(onEdge, tolerance)) return onEdge;
    }
    return bearable() / (2 * sine(frictionAngle)) * Principal::Ones();
  }
  /// Returns a stress to the edge between the faces (0, 2) and (i, j).
  Principal returnedToEdge(const Principal& s, int i, int j) const {
    const Principal a = normal(0, 2, frictionAngle), b = normal(i, j, frictionAngle);
    const Principal awayA = correction(0, 2), awayB = correction(i, j);
    Eigen::Matrix2d matrix;
    matrix << a.dot(awayA), a.dot(awayB), b.dot(awayA), b.dot(awayB);
    const Eigen::Vector2d slip = matrix.inverse() * Eigen::Vector2d(face(s, 0, 2), face(s, i, j));
    return s - slip[0] * awayA - slip[1] * awayB;
  }
};
static_assert(ConstitutiveModel<MohrCoulomb>);

}  // namespace tushar::mpm::solid
