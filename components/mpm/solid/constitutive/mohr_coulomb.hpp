#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// Linear elasticity with the yield surface of Mohr and Coulomb, (s1 - s3) + (s1 + s3) sin phi = 2 c cos phi with the
/// principal stresses s1 >= s2 >= s3, tension positive; flow by the same with the angle psi of dilation. The stress
/// returns to a face, an edge or the apex: de Souza Neto, Perić & Owen, Computational Methods for Plasticity (2008),
/// section 8.2. The stress rotates with the material; Uintah's does not.
struct MohrCoulomb {
  struct State {};
  using Capabilities = CapabilityList<capability::IgnoresTemperature, capability::BulkSpeed>;
  static constexpr std::string_view name = "MohrCoulomb";
  static constexpr bool strainEnergyIsRate = true;

  double shearModulus = 0;   ///< G, Pa
  double bulkModulus = 0;    ///< K, Pa
  double cohesion = 0;       ///< c, Pa
  double frictionAngle = 0;  ///< phi, degrees
  double dilationAngle = 0;  ///< psi, degrees

  static const input::Schema<MohrCoulomb>& schema() {
    static const input::Schema<MohrCoulomb> schema = [] {
      input::Schema<MohrCoulomb> tags("MohrCoulomb", "Linear elasticity with the yield surface of Mohr and Coulomb.");
      tags.required("G", &MohrCoulomb::shearModulus, "Pa", "shear modulus", input::positive())
          .required("K", &MohrCoulomb::bulkModulus, "Pa", "bulk modulus", input::positive())
          .value("c", &MohrCoulomb::cohesion, 0, "Pa", "cohesion", input::nonNegative())
          .value("Phi", &MohrCoulomb::frictionAngle, 0, "degrees", "angle of friction", input::between(0, 89))
          .value("Psi", &MohrCoulomb::dilationAngle, 0, "degrees", "angle of dilation", input::between(0, 89))
          .check([](const MohrCoulomb& read, const input::Element& element, input::Diagnostics& diagnostics) {
            if (read.dilationAngle > read.frictionAngle)
              diagnostics.error(element, "<Psi> is greater than <Phi>: plastic flow would create energy");
          });
      refuseOtherValues(tags, "Version", {"1", "11", "12"},
                        "stresses return to the nearest point of a surface with corners");
      for (const char* tag :
           {"Usetransition", "Usemodul", "Use_softening", "Use_linear", "Use_regular", "UseWaterRetention",
            "UseRemould", "Use_friction", "Use_pressure_dependence", "Usetransition1", "Use_dilation"})
        refuseSwitch(tags, tag, "strength and stiffness are those of <c>, <Phi>, <G> and <K> throughout");
      for (const char* tag :
           {"A1",         "B1",   "W",       "beta_rate", "strain_ref", "m_modul",   "nuy",       "St",
            "strain_95",  "a",    "y_ref",   "y",         "n",          "tFE",       "tShear",    "n_nonlocalMC",
            "l_nonlocal", "PhiB", "suction", "SpecVol",   "WR_Param1",  "WR_Param2", "WR_Param3", "WR_Param4"})
        tags.ignored(tag, "belongs to what only stands at false");
      return tags;
    }();
    return schema;
  }
  State initialState() const { return {}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State&) const {
    const Corotated step(d, oldStress);
    Matrix3 trial = step.stress + 2 * shearModulus * step.strain;
    trial.diagonal().array() += lambda() * step.strain.trace();
    return step.turned(returned(trial));
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    return stressWork(d, oldStress, stress);
  }
  /// Distance of a stress outside the yield surface, Pa; at most 0 if it is admissible.
  double excess(const Matrix3& stress) const {
    const Eigen::Vector3d s =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress, Eigen::EigenvaluesOnly).eigenvalues();
    return face(s.reverse(), 0, 2);
  }

 private:
  using Principal = Eigen::Vector3d;  ///< principal stresses, Pa, the greatest first

  double lambda() const { return bulkModulus - 2.0 / 3.0 * shearModulus; }
  static double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }
  double strength() const { return 2 * cohesion * std::cos(frictionAngle * std::numbers::pi / 180); }

  /// Normal of the yield face of the i-th and the j-th principal stress.
  static Principal normal(int i, int j, double angle) {
    Principal n = Principal::Zero();
    n[i] = 1 + sine(angle);
    n[j] = -1 + sine(angle);
    return n;
  }
  double face(const Principal& s, int i, int j) const { return normal(i, j, frictionAngle).dot(s) - strength(); }
  /// Stress per unit of plastic flow across a face, Pa.
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
    return strength() / (2 * sine(frictionAngle)) * Principal::Ones();
  }
  /// Return to the edge between the faces (0, 2) and (i, j).
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
