#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/strain_invariants.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"

namespace tushar::mpm::solid {

/// Rubber with chains of limited stretch: the eight-chain network model of Arruda & Boyce, J. Mech. Phys. Solids 41
/// (1993) 389, eq. 33. The inverse of Langevin's function is a series of five terms; it is applied to the isochoric
/// part of the deformation, and the pressure is that of comp_neo_hook. With I the trace of J^(-2/3) F Fᵀ and l the
/// locking stretch of the chains, W = G sum_k c_k (I^k - 3^k) / l^(2k-2) + K/2 ((J² - 1)/2 - ln J), c = 1/2, 1/20,
/// 11/1050, 19/7000, 519/673750.
struct ArrudaBoyce8 {
  struct State {};
  using Capabilities = CapabilityList<capability::DependsOnDeformationOnly, capability::IgnoresTemperature,
                                      capability::NominalTangent, capability::BulkSpeed>;
  static constexpr std::string_view name = "ArrudaBoyce8";
  static constexpr bool strainEnergyIsRate = false;

  double bulkModulus = 0;     ///< bulk modulus K [Pa]
  double shearModulus = 0;    ///< G for chains that never lock [Pa]
  double lockingStretch = 0;  ///< l, locking stretch [1]

  static const input::Schema<ArrudaBoyce8>& schema() {
    static const input::Schema<ArrudaBoyce8> schema =
        input::Schema<ArrudaBoyce8>("ArrudaBoyce8", "Rubber as a network of eight chains that lock.")
            .required("bulk_modulus", &ArrudaBoyce8::bulkModulus, "Pa", "K", input::positive())
            .required("shear_modulus", &ArrudaBoyce8::shearModulus, "Pa", "G for chains that never lock",
                      input::positive())
            .required("beta", &ArrudaBoyce8::lockingStretch, "1", "stretch at which chains lock", input::positive());
    return schema;
  }
  State initialState() const { return {}; }

  /// Computes J sigma = K/2 (J² - 1) I + G s(I) dev(J^(-2/3) F Fᵀ), s = 2/G dW/dI.
  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    const Network n(d.deformationGradient);
    return tauOf(n) / n.j;
  }
  /// Computes the tangent d tau = K J² tr h I + G s dev(db) + G ds/dI dI dev b with b = J^(-2/3) F Fᵀ, db = h b + b hᵀ
  /// - 2/3 tr h b, dI = tr db.
  Matrix9 nominalTangent(const Deformation& d, const Matrix3&, const State&) const {
    const Network n(d.deformationGradient);
    return solid::nominalTangent(d.deformationGradient, tauOf(n), [&](const Matrix3& h) {
      const Matrix3 hb = h * n.b, db = hb + hb.transpose() - 2.0 / 3.0 * h.trace() * n.b;
      Matrix3 change =
          shearModulus * (stiffening(n.first) * deviator(db) + stiffeningSlope(n.first) * db.trace() * deviator(n.b));
      change.diagonal().array() += bulkModulus * n.j * n.j * h.trace();
      return change;
    });
  }
  /// The wave speed: c² = (K + 4/3 G (s + 2 I ds/dI)) J / rho_0, at least as large as Uintah's, which is computed with
  /// G.
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const Network n(d.deformationGradient);
    const double shear = shearModulus * (stiffening(n.first) + 2 * n.first * stiffeningSlope(n.first));
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shear) * n.j / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  /// The energy W as above; I^k - 3^k is computed with the factor I - 3, which is exact at small strains.
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State&) const {
    const StrainInvariants strain(d.deformationGradient);
    const double growth = strain.isochoricFirst(), first = 3 + growth;
    double sum = 0, quotient = 1, power = 1;  // (I^k - 3^k) / (I - 3), 3^(k-1)
    for (std::size_t k = 0; k < terms.size(); ++k) {
      sum += terms[k] * quotient / std::pow(lockingStretch, 2.0 * double(k));
      power *= 3;
      quotient = quotient * first + power;
    }
    return bulkModulus * strain.dilatation() + shearModulus * sum * growth;
  }

 private:
  static constexpr std::array<double, 5> terms{1.0 / 2, 1.0 / 20, 11.0 / 1050, 19.0 / 7000, 519.0 / 673750};

  struct Network {
    double j;
    Matrix3 b;  ///< J^(-2/3) F Fᵀ
    double first;

    explicit Network(const Matrix3& f)
        : j(f.determinant()), b(f * f.transpose() / std::cbrt(j * j)), first(b.trace()) {}
  };
  Matrix3 tauOf(const Network& n) const {
    Matrix3 tau = shearModulus * stiffening(n.first) * deviator(n.b);
    tau.diagonal().array() += bulkModulus / 2 * (n.j * n.j - 1);
    return tau;
  }
  /// The stiffening factor s = sum_k 2 k c_k (I / l²)^(k-1).
  double stiffening(double first) const {
    const double x = first / (lockingStretch * lockingStretch);
    double sum = 0;
    for (std::size_t k = terms.size(); k > 0; --k) sum = sum * x + 2 * double(k) * terms[k - 1];
    return sum;
  }
  /// The derivative ds/dI.
  double stiffeningSlope(double first) const {
    const double square = lockingStretch * lockingStretch, x = first / square;
    double sum = 0;
    for (std::size_t k = terms.size(); k > 1; --k) sum = sum * x + 2 * double(k) * double(k - 1) * terms[k - 1];
    return sum / square;
  }
};
static_assert(ConstitutiveModel<ArrudaBoyce8>);

}  // namespace tushar::mpm::solid
