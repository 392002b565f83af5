#pragma once

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/strain_invariants.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"
#include "components/mpm/solid/constitutive/tensor_lanes.hpp"

namespace tushar::mpm::solid {

/// Compressible Mooney-Rivlin rubber of Uintah's `comp_mooney_rivlin`, with the invariants I1, I2, I3 of B = F Fᵀ:
/// W = C1 (I1 - 3) + C2 (I2 - 3) + C3 (1/I3² - 1) + C4 (I3 - 1)²,
/// C3 = C1/2 + C2,   C4 = (C1 (5 nu - 2) + C2 (11 nu - 5)) / (2 - 4 nu).
struct CompMooneyRivlin {
  struct State {};
  using Capabilities =
      CapabilityList<capability::DependsOnDeformationOnly, capability::IgnoresTemperature, capability::Vectorized,
                     capability::NominalTangent, capability::BulkSpeed, capability::InitialWaveSpeed>;
  static constexpr std::string_view name = "comp_mooney_rivlin";
  static constexpr bool strainEnergyIsRate = false;

  double c1 = 0, c2 = 0;    ///< c1 and c2 [Pa]
  double poissonRatio = 0;  ///< Poisson's ratio nu [1]

  static const input::Schema<CompMooneyRivlin>& schema() {
    static const input::Schema<CompMooneyRivlin> schema =
        input::Schema<CompMooneyRivlin>("comp_mooney_rivlin", "Compressible Mooney-Rivlin rubber.")
            .required("he_constant_1", &CompMooneyRivlin::c1, "Pa", "C1", input::positive())
            .required("he_constant_2", &CompMooneyRivlin::c2, "Pa", "C2", input::nonNegative())
            .required("he_PR", &CompMooneyRivlin::poissonRatio, "1", "Poisson's ratio", input::between(-0.999, 0.4999))
            .check(noteUnboundedEnergy);
    return schema;
  }
  State initialState() const { return {}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    return cauchyStress(Invariants(d.deformationGradient));
  }
  template <class Real>
  TensorOf<Real> kirchhoffStress(const TensorOf<Real>& f) const {
    const InvariantsOf<Real> i(f);
    return scaled(cauchyStress(i), i.j);
  }
  /// Computes the tangent d tau = 2 (C2 dI1 B + (C1 + I1 C2) dB - C2 (dB B + B dB) + (dW/dI3 + I3 d²W/dI3²) dI3 I) with
  /// dB = h B + B hᵀ, dI1 = tr dB, dI3 = 2 I3 tr h.
  Matrix9 nominalTangent(const Deformation& d, const Matrix3&, const State&) const {
    const Invariants i(d.deformationGradient);
    const double curvature = 6 * c3() / (i.third * i.third * i.third * i.third) + 2 * c4();
    const Matrix3 tau = i.j * cauchyStress(i);
    return solid::nominalTangent(d.deformationGradient, tau, [&](const Matrix3& h) {
      const Matrix3 hb = h * i.b, db = hb + hb.transpose(), bdb = i.b * db;
      Matrix3 change = c2 * db.trace() * i.b + (c1 + i.first * c2) * db - c2 * (bdb + bdb.transpose());
      change.diagonal().array() += (slope(i.third) + i.third * curvature) * 2 * i.third * h.trace();
      return Matrix3(2 * change);
    });
  }
  /// The wave speed at small strains, as in Uintah, with the modulus 2 mu (1 - nu) / (1 - 2 nu), mu = 2 (C1 + C2).
  double initialWaveSpeed(double initialDensity) const {
    return std::sqrt(4 * (c1 + c2) * (1 - poissonRatio) / ((1 - 2 * poissonRatio) * initialDensity));
  }
  /// An upper bound on the wave speed [m/s], as in Uintah.
  template <class Real>
  Real waveSpeed(double initialDensity, const TensorOf<Real>& f) const {
    using std::max, std::min, std::sqrt;
    const InvariantsOf<Real> i(f);
    const TensorOf<Real> stress = cauchyStress(i);
    const Real least = min(min(stress(0, 0), stress(1, 1)), stress(2, 2));
    const Real stiffness = 4 * (c1 + c2 * i.second) / i.j +
                           8 * (2 * c3() / (i.third * i.third * i.third) + c4() * (2 * i.third - 1)) - least / i.j;
    return sqrt(Real(max(stiffness, Real(0.0)) * i.j / initialDensity));
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return waveSpeed(initialDensity, d.deformationGradient);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(4 * (c1 + c2 * Invariants(d.deformationGradient).second) / initialDensity);
  }
  /// The energy W as above; its part c3 (1/I3² - 1) cancels the terms linear in the strain.
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State&) const {
    return strainEnergyDensity(d.deformationGradient);
  }
  template <class Real>
  Real strainEnergyDensity(const TensorOf<Real>& f) const {
    const StrainInvariantsOf<Real> strain(f);
    const Real v = strain.volume, i3 = 1 + v;
    return c2 * strain.second - 2 * c3() * (strain.second + strain.third) +
           (c3() * (3 + 2 * v) / (i3 * i3) + c4()) * v * v;
  }

 private:
  template <class Real>
  struct InvariantsOf {
    TensorOf<Real> b;
    Real j, first, second, third;

    explicit InvariantsOf(const TensorOf<Real>& f)
        : b(leftCauchyGreen(f)), j(solid::determinant(f)), first(solid::trace(b)) {
      second = 0.5 * (first * first - squaredNorm(b));
      third = j * j;
    }
  };
  using Invariants = InvariantsOf<double>;

  /// Computes sigma = 2/J ((C1 + I1 C2) B - C2 B² + I3 dW/dI3 I).
  template <class Real>
  TensorOf<Real> cauchyStress(const InvariantsOf<Real>& i) const {
    TensorOf<Real> stress;
    const Real along = c1 + i.first * c2;
    for (int row = 0; row < 3; ++row)
      for (int k = 0; k < 3; ++k) stress(row, k) = along * i.b(row, k) - squared(i.b, row, k);
    for (int k = 0; k < 3; ++k) stress(k, k) += i.third * slope(i.third);
    return scaled(stress, Real(2 / i.j));
  }
  /// An entry of C2 B², bitwise equal to Eigen's result; Eigen rounds the entries of the first columns only once per
  /// product.
  template <class Real>
  Real squared(const TensorOf<Real>& b, int row, int k) const {
    const Real x = c2 * b(row, 0), y = c2 * b(row, 1), z = c2 * b(row, 2);
    if (k == 2) return x * b(0, 2) + (y * b(1, 2) + z * b(2, 2));
    return fused(z, b(2, k), fused(y, b(1, k), Real(x * b(0, k))));
  }
  template <class Real>
  static Real fused(const Real& a, const Real& b, const Real& c) {
    if constexpr (std::is_same_v<Real, Lanes>) return multiplyAdd(a, b, c);
#if defined(__FMA__)
    else
      return std::fma(a, b, c);
#else
    else
      return a * b + c;
#endif
  }
  template <class Real>
  static TensorOf<Real> scaled(TensorOf<Real> t, const Real& factor) {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) t(i, k) = t(i, k) * factor;
    return t;
  }
  /// dW/dI3
  template <class Real>
  Real slope(const Real& i3) const {
    return -2 * c3() / (i3 * i3 * i3) + 2 * c4() * (i3 - 1);
  }
  double c3() const { return 0.5 * c1 + c2; }
  static void noteUnboundedEnergy(const CompMooneyRivlin& read, const input::Element& element,
                                  input::Diagnostics& diagnostics) {
    const std::optional<input::Element> given = element.child("he_PR");
    if (!given || !(read.c1 > 0) || read.c4() >= 0) return;
    const double least = (2 * read.c1 + 5 * read.c2) / (5 * read.c1 + 11 * read.c2);
    diagnostics.note(
        *given, fmt::format("{:g} makes C4 = {:.3g} Pa negative: the energy falls without limit as the volume grows, "
                            "so large deformations may be unstable; it is not negative from {:.3g} on",
                            read.poissonRatio, read.c4(), least));
  }
  double c4() const {
    return 0.5 * (c1 * (5 * poissonRatio - 2) + c2 * (11 * poissonRatio - 5)) / (1 - 2 * poissonRatio);
  }
};
static_assert(ConstitutiveModel<CompMooneyRivlin>);

}  // namespace tushar::mpm::solid
