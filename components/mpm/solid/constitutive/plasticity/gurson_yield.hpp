#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "components/mpm/solid/constitutive/root_between.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The von Mises yield condition, q = sigma_y.
struct VonMisesYield {
  static constexpr std::string_view name = "vonMises";
  static const input::Schema<VonMisesYield>& schema() {
    static const input::Schema<VonMisesYield> schema(
        "yield_condition", "The material yields if the equivalent stress reaches the yield stress.");
    return schema;
  }
};

/// Porous metals, (q/sigma_y)² + 2 q1 f* cosh(3 q2 p / (2 sigma_y)) = 1 + q3 f*² with the equivalent stress q, the mean
/// stress p (tension positive) and the porosity f, f* = f up to f_c and f_c + k (f - f_c) beyond: Gurson, J. Eng.
/// Mater. Technol. 99 (1977) 2; Tvergaard & Needleman, Acta Metall. 32 (1984) 157.
struct GursonYield {
  static constexpr std::string_view name = "gurson";
  double q1 = 1.5, q2 = 1, q3 = 2.25;
  double acceleration = 4;         ///< acceleration k [1]
  double criticalPorosity = 0.05;  ///< critical porosity f_c [1]

  static const input::Schema<GursonYield>& schema() {
    static const input::Schema<GursonYield> schema =
        input::Schema<GursonYield>("yield_condition", "Porous metals: Gurson, Tvergaard and Needleman.")
            .required("q1", &GursonYield::q1, "1", "factor of the porosity", input::positive())
            .required("q2", &GursonYield::q2, "1", "factor of the mean stress", input::positive())
            .required("q3", &GursonYield::q3, "1", "factor of the square of the porosity, usually q1^2",
                      input::nonNegative())
            .required("k", &GursonYield::acceleration, "1", "factor of the porosity above f_c, where pores coalesce",
                      input::positive())
            .required("f_c", &GursonYield::criticalPorosity, "1", "porosity at which pores begin to coalesce",
                      input::between(0, 1));
    return schema;
  }
  /// The effective porosity f* [1]; at most greatest(), because beyond it, by the formula, the strength would rise with
  /// the porosity.
  double effective(double f) const {
    return std::min(f > criticalPorosity ? criticalPorosity + acceleration * (f - criticalPorosity) : f, greatest());
  }
  /// The largest f*, at which no strength is left: the smallest root of 1 + q3 f*² = 2 q1 f*, which is 1/q1 if q3 =
  /// q1², or, if there is no root, the f* at which the strength is least.
  double greatest() const { return q3 > q1 * q1 ? q1 / q3 : 1 / (q1 + std::sqrt(q1 * q1 - q3)); }
  /// (q/sigma_y)² on the yield surface as a function of p / sigma_y; negative where the surface supports no q.
  double square(double p, double f) const {
    const double pores = effective(f);
    return 1 + q3 * pores * pores - 2 * q1 * pores * std::cosh(argument(p));
  }
  double strength(double p, double f) const { return std::sqrt(std::max(square(p, f), 0.0)); }
  /// The derivative sigma_y d Phi/dp as a function of p / sigma_y.
  double dilatancy(double p, double f) const { return 3 * q1 * q2 * effective(f) * std::sinh(argument(p)); }

 private:
  /// The argument of cosh, limited so that it does not overflow, to a value above the strength of any metal.
  double argument(double p) const { return std::clamp(1.5 * q2 * p, -300.0, 300.0); }
};

/// Largest porosity: some metal must remain, because the equations divide by 1 - f.
inline constexpr double greatestPorosity = 0.999;

/// Return to Gurson's surface with associated flow: Aravas, Int. J. Numer. Meth. Engng 24 (1987) 1395. `yieldStress(x)`
/// is sigma_y after a plastic strain x of the metal [Pa]; `meanStress(t)` is the mean stress after a plastic dilatation
/// t [Pa].
template <class YieldStress, class MeanStress>
class GursonReturn {
 public:
  /// The state of the material point after the step.
  struct Result {
    double plasticStrain = 0;  ///< increment of the plastic strain of the metal [1]
    double dilatation = 0;     ///< increment of the plastic dilatation [1]
    double equivalent = 0;     ///< q at the end of the step [Pa]
    double mean = 0;           ///< p at the end of the step [Pa]
    double work = 0;           ///< plastic work [J/m^3]
  };

  /// `nucleation` is the porosity that nucleates per plastic strain [1]; without a value, the pores do not change.
  GursonReturn(const GursonYield& surface, YieldStress yieldStress, MeanStress meanStress, double shearModulus,
               double porosity, std::optional<double> nucleation)
      : surface_(surface),
        yield_stress_(yieldStress),
        mean_stress_(meanStress),
        shear_modulus_(shearModulus),
        porosity_(porosity),
        nucleation_(nucleation) {}

  /// Performs the return for the equivalent trial stress [Pa].
  Result operator()(double trial) const {
    const double mean = mean_stress_(0.0), yield = yield_stress_(0.0);
    const double square = surface_.square(mean / yield, porosity_);
    if (square >= 0 && trial <= yield * std::sqrt(square)) return {0, 0, trial, mean, 0};
    const auto residual = [&](double dilatation) { return associated(at(trial, dilatation), trial); };
    if (residual(0) == 0) return at(trial, 0);
    return at(trial, rootBetween(residual, 0.0, farthest(mean)));
  }
  /// The porosity f after additional plastic dilatation and strain: pores grow with the dilatation, and new pores open
  /// with the strain in tension.
  double porosity(double dilatation, double strain) const {
    if (!nucleation_) return porosity_;
    return std::clamp(1 - (1 - porosity_) * std::exp(-dilatation) + *nucleation_ * strain, 0.0, greatestPorosity);
  }

 private:
  /// The plastic dilatation that removes all mean stress or, in compression, closes the pores.
  double farthest(double mean) const {
    const double least = nucleation_ ? std::log1p(-porosity_) : -1;
    double end = mean > 0 ? 1e-6 : std::max(-1e-6, least);
    while (end > least && end < 1 && (mean_stress_(end) > 0) == (mean > 0)) end = std::max(2 * end, least);
    return end;
  }
  /// The point on the surface after a plastic dilatation: the strain of the metal follows from the plastic work (1 - f)
  /// sigma_y x = q z + p t, z being the plastic strain of the deviator.
  Result at(double trial, double dilatation) const {
    const double mean = mean_stress_(dilatation);
    const auto after = [&](double strain) {
      const double yield = yield_stress_(strain), f = porosity(dilatation, strain);
      const double equivalent = std::min(yield * surface_.strength(mean / yield, f), trial);
      const double work = equivalent * (trial - equivalent) / (3 * shear_modulus_) + mean * dilatation;
      return std::pair(Result{strain, dilatation, equivalent, mean, work}, (1 - f) * yield * strain - work);
    };
    const auto [start, lack] = after(0);
    if (lack >= 0) return start;
    double end = start.work / yield_stress_(0.0);
    while (end < 1e3 && after(end).second < 0) end *= 2;
    return after(rootBetween([&](double strain) { return after(strain).second; }, 0.0, end)).first;
  }
  /// The residual of the flow rule: 0 if the dilatation t and the plastic strain z of the deviator are related by the
  /// normal of the surface, 2 t q/sigma_y = z sigma_y dPhi/dp, or where the surface ends without any deviator.
  double associated(const Result& result, double trial) const {
    const double yield = yield_stress_(result.plasticStrain), f = porosity(result.dilatation, result.plasticStrain);
    const double p = result.mean / yield, strain = (trial - result.equivalent) / (3 * shear_modulus_);
    const double square = surface_.square(p, f), along = strain * surface_.dilatancy(p, f);
    if (square < 0) return std::copysign(square, -p) - along;
    return 2 * result.dilatation * std::sqrt(square) - along;
  }

  const GursonYield& surface_;
  YieldStress yield_stress_;
  MeanStress mean_stress_;
  double shear_modulus_, porosity_;
  std::optional<double> nucleation_;
};

}  // namespace tushar::mpm::solid
