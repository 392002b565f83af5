#pragma once

#include <Eigen/Eigenvalues>

#include <cmath>
#include <string_view>
#include <variant>

#include "components/mpm/solid/tensor.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The stress rate of a metal in plastic flow as a function of its strain rate D, in a frame that rotates with the
/// metal:
///
///     K tr D 1 + 2 G dev D - beta (n : D) n,   beta = (2 G)^2 / (2 G + 2 H/3),   n = dev sigma / |dev sigma|.
struct PlasticTangent {
  double bulk = 0;       ///< bulk modulus K [Pa]
  double shear = 0;      ///< shear modulus G [Pa]
  double hardening = 0;  ///< H = d sigma_y / d e_p [Pa]

  double softening() const { return 4 * shear * shear / (2 * shear + 2.0 / 3.0 * hardening); }
  /// The work D : (rate of the stress) [Pa/s^2]; `normal` is n.
  double work(const Matrix3& normal, const Matrix3& rate) const {
    const double trace = rate.trace(), along = normal.cwiseProduct(rate).sum();
    return bulk * trace * trace + 2 * shear * deviator(rate).squaredNorm() - softening() * along * along;
  }
};

/// No check: particles do not lose strength.
struct NoStabilityCheck {
  static constexpr std::string_view name = "none";
  static const input::Schema<NoStabilityCheck>& schema() {
    static const input::Schema<NoStabilityCheck> schema("stability_check", "Plastic flow is not checked.");
    return schema;
  }
  bool fails(const PlasticTangent&, const Matrix3&, const Matrix3&) const { return false; }
};

/// The check of Drucker's postulate, by which the stress rate does positive work on the strain rate.
struct DruckerCheck {
  static constexpr std::string_view name = "drucker";
  static const input::Schema<DruckerCheck>& schema() {
    static const input::Schema<DruckerCheck> schema(
        "stability_check",
        "A particle fails where the product of stress rate and strain rate is not positive (Drucker).");
    return schema;
  }
  /// Whether the check fails; `rate` is the symmetric part of the velocity gradient [1/s].
  bool fails(const PlasticTangent& tangent, const Matrix3& stress, const Matrix3& rate) const {
    const Matrix3 shear = deviator(stress);
    return tangent.work(shear / shear.norm(), rate) <= 0;
  }
};

/// The check whether shear bands may form: R. Becker, Int. J. Solids Struct. 39 (2002) 3555. In the plane of the
/// largest and the smallest principal stress, s_1 and s_3, velocities may jump across a line of slope y^(1/2) if A y^2
/// + B y + C = 0 with
///
///     A = G (2 M_33 - s_3),   C = G (2 M_11 - s_1),
///     B = G (s_1 + s_3 - 4 M_13) + (s_1 + s_3) M_13 - s_1 M_33 - s_3 M_11 + 2 (M_11 M_33 - M_13^2),
///
/// where M_ij is the derivative of stress i with respect to strain j in the axes of the principal stresses. A particle
/// fails if all four slopes are real. (Uintah takes M_ij along x and z, and sorts only the principal stresses.)
struct BeckerCheck {
  static constexpr std::string_view name = "becker";
  static const input::Schema<BeckerCheck>& schema() {
    static const input::Schema<BeckerCheck> schema("stability_check",
                                                   "A particle fails where shear bands may form (Becker 2002).");
    return schema;
  }
  bool fails(const PlasticTangent& tangent, const Matrix3& stress, const Matrix3&) const {
    const Vec3 principal = Eigen::SelfAdjointEigenSolver<Matrix3>(stress, Eigen::EigenvaluesOnly).eigenvalues();
    const double s1 = principal[2], s3 = principal[0], mean = principal.mean(), g = tangent.shear;
    const double size = deviator(stress).norm(), n1 = (s1 - mean) / size, n3 = (s3 - mean) / size;
    const double beta = tangent.softening(), off = tangent.bulk - 2.0 / 3.0 * g;
    const double m11 = off + 2 * g - beta * n1 * n1, m33 = off + 2 * g - beta * n3 * n3, m13 = off - beta * n1 * n3;
    const double a = g * (2 * m33 - s3), c = g * (2 * m11 - s1);
    const double b = g * (s1 + s3 - 4 * m13) + (s1 + s3) * m13 - s1 * m33 - s3 * m11 + 2 * (m11 * m33 - m13 * m13);
    const double discriminant = b * b - 4 * a * c;
    // Both roots y = (-b +- root) / (2 a) are at least 0 if their product and their sum are.
    return a != 0 && discriminant >= 0 && c / a >= 0 && b / a <= 0;
  }
};

/// The check that fails if DruckerCheck or BeckerCheck fails.
struct DruckerBeckerCheck {
  static constexpr std::string_view name = "drucker_becker";
  static const input::Schema<DruckerBeckerCheck>& schema() {
    static const input::Schema<DruckerBeckerCheck> schema(
        "stability_check", "A particle fails by either of the checks drucker and becker.");
    return schema;
  }
  bool fails(const PlasticTangent& tangent, const Matrix3& stress, const Matrix3& rate) const {
    return DruckerCheck().fails(tangent, stress, rate) || BeckerCheck().fails(tangent, stress, rate);
  }
};

/// Checks by which particles in plastic flow fail, if the scene has an `<erosion>`.
using StabilityCheck = std::variant<NoStabilityCheck, DruckerCheck, BeckerCheck, DruckerBeckerCheck>;

}  // namespace tushar::mpm::solid
