#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/strain_invariants.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// Ligament: Mooney-Rivlin rubber with fibres along a; Weiss, Maker & Govindjee, Comput. Methods Appl. Mech. Engrg. 135
/// (1996) 107. With B' = J^(-2/3) F Fᵀ, its invariants I1, I2, and the fibres' stretch l = J^(-1/3) |F a|:
/// W = c1 (I1 - 3) + c2 (I2 - 3) + W_f(l) + K/2 ln² J,
/// l dW_f/dl = 0 for l < 1, c3 (exp(c4 (l - 1)) - 1) for l < l*, c5 l + c6 above, c6 such that it has no jump.
struct TransIsoHyper {
  struct State {
    double stretch;  ///< stretch of the fibres, 1
  };
  using Capabilities = CapabilityList<capability::AbsentVariables, capability::IgnoresTemperature,
                                      capability::NominalTangent, capability::BulkSpeed, capability::InitialWaveSpeed>;
  static constexpr std::array<StateVariable, 1> stateVariables{{{"p.stretch", "1", "stretch of the fibres"}}};
  static constexpr std::array<StateVariable, 1> absentVariables{{{"p.fail", "1", "0: nothing fails"}}};
  static constexpr std::string_view name = "trans_iso_hyper";
  static constexpr bool strainEnergyIsRate = false;

  double bulkModulus = 0;                ///< K, Pa
  double c1 = 0, c2 = 0, c3 = 0;         ///< Pa
  double c4 = 0;                         ///< 1
  double c5 = 0;                         ///< Pa
  double straight = 1;                   ///< l*, 1
  std::array<double, 3> fibre{1, 0, 0};  ///< a, along x, y, z

  static const input::Schema<TransIsoHyper>& schema() {
    static const input::Schema<TransIsoHyper> schema = makeSchema();
    return schema;
  }
  State initialState() const { return {1}; }

  /// sigma = (2 dev((c1 + I1 c2) B' - c2 B'²) + g dev(a a) + K ln J I) / J, g = l dW_f/dl, a along the
  /// deformed fibre
  Matrix3 updateStress(const Deformation& d, const Matrix3&, State& state) const {
    const Point at(*this, d.deformationGradient);
    state.stretch = at.stretch * std::cbrt(at.j);
    return kirchhoffStressOf(at) / at.j;
  }
  Matrix9 nominalTangent(const Deformation& d, const Matrix3&, const State&) const {
    const Point at(*this, d.deformationGradient);
    const double g = fibreForce(at.stretch), slope = fibreSlope(at.stretch);
    return solid::nominalTangent(d.deformationGradient, kirchhoffStressOf(at), [&](const Matrix3& h) {
      const Matrix3 hb = h * at.b, db = hb + hb.transpose() - 2.0 / 3.0 * h.trace() * at.b, bdb = at.b * db;
      const Matrix3 matrix = c2 * db.trace() * at.b + (c1 + at.first * c2) * db - c2 * (bdb + bdb.transpose());
      const Matrix3 turned = h * at.fibres, along = turned + turned.transpose();  // d(a aᵀ) = along - 2 (a . h a) a aᵀ
      const double stretching = 0.5 * along.trace();
      const double dg = slope * at.stretch * (stretching - h.trace() / 3);
      Matrix3 change = deviator(2 * matrix + (dg - 2 * g * stretching) * at.fibres + g * along);
      change.diagonal().array() += bulkModulus * h.trace();
      return change;
    });
  }
  double initialWaveSpeed(double initialDensity) const {
    return std::sqrt((bulkModulus + 8.0 / 3.0 * (c1 + c2) + fibreSlope(1)) / initialDensity);
  }
  /// A bound: of the matrix, 4/3 of twice c1 + c2 I1/3 times I1/3, and of the fibres dg/dl l + |g|.
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const Point at(*this, d.deformationGradient);
    const double matrix = 8.0 / 3.0 * (c1 + c2 * at.first / 3) * at.first / 3;
    const double fibres = fibreSlope(at.stretch) * at.stretch + std::abs(fibreForce(at.stretch));
    return std::sqrt((bulkModulus + matrix + fibres) * at.j / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State&) const {
    const StrainInvariants strain(d.deformationGradient);
    const double logarithm = 0.5 * std::log1p(strain.volume),
                 fibres = fibreEnergy(Point(*this, d.deformationGradient).stretch);
    return c1 * strain.isochoricFirst() + c2 * strain.isochoricSecond() + fibres +
           0.5 * bulkModulus * logarithm * logarithm;
  }

 private:
  struct Point {
    Matrix3 b;       ///< B'
    Matrix3 fibres;  ///< a aᵀ
    double j, first, stretch;

    Point(const TransIsoHyper& model, const Matrix3& f) : j(f.determinant()) {
      const double shrunk = 1 / std::cbrt(j);
      b = shrunk * shrunk * (f * f.transpose());
      first = b.trace();
      const Vec3 along = shrunk * (f * Eigen::Map<const Vec3>(model.fibre.data()).normalized());
      stretch = along.norm();
      fibres = along * along.transpose() / (stretch * stretch);
    }
  };

  static input::Schema<TransIsoHyper> makeSchema() {
    using Self = TransIsoHyper;
    input::Schema<Self> tags{std::string(name), "Rubber with fibres in one direction, such as a ligament."};
    tags.required("bulk_modulus", &Self::bulkModulus, "Pa", "K", input::positive())
        .required("c1", &Self::c1, "Pa", "first constant of the matrix", input::positive())
        .required("c2", &Self::c2, "Pa", "second constant of the matrix", input::nonNegative())
        .required("c3", &Self::c3, "Pa", "of the fibres while they straighten", input::nonNegative())
        .required("c4", &Self::c4, "1", "how fast they straighten", input::nonNegative())
        .required("c5", &Self::c5, "Pa", "modulus of straight fibres", input::nonNegative())
        .required("fiber_stretch", &Self::straight, "1", "stretch at which fibres are straight", input::atLeast(1))
        .custom("direction_of_symm", readFibre, {"direction_of_symm"},
                "along the fibres at the start; its length does not matter")
        .forms({input::typeForm({"direction_of_symm"}, std::string(input::typeName<Vec3>), 1)})
        .ignored("max_fiber_strain", "only Uintah's failure_option 1 looks at it")
        .ignored("max_matrix_strain", "only Uintah's failure_option 1 looks at it")
        .ignored("useModifiedEOS", "only Uintah's coupled fluid reads it");
    refuseSwitch(tags, "failure_option", "nothing fails");
    return tags;
  }
  static void readFibre(TransIsoHyper& read, const input::Element& element, input::Diagnostics& diagnostics) {
    const auto given = element.child("direction_of_symm");
    if (!given) return diagnostics.error(element, "missing tag <direction_of_symm> (along the fibres at the start)");
    const auto value = input::parse<Vec3>(given->text());
    if (!value.problem.empty()) return diagnostics.error(*given, value.problem);
    if (value.value->norm() == 0) return diagnostics.error(*given, "must not be 0");
    read.fibre = {(*value.value)[0], (*value.value)[1], (*value.value)[2]};
  }

  Matrix3 kirchhoffStressOf(const Point& at) const {
    const Matrix3 matrix = (c1 + at.first * c2) * at.b - c2 * at.b * at.b;
    Matrix3 stress = deviator(2 * matrix + fibreForce(at.stretch) * at.fibres);
    stress.diagonal().array() += bulkModulus * std::log(at.j);
    return stress;
  }
  double c6() const { return c3 * std::expm1(c4 * (straight - 1)) - c5 * straight; }
  /// g, Pa
  double fibreForce(double l) const {
    if (l < 1) return 0;
    return l < straight ? c3 * std::expm1(c4 * (l - 1)) : c5 * l + c6();
  }
  /// dg/dl, Pa
  double fibreSlope(double l) const {
    if (l < 1) return 0;
    return l < straight ? c3 * c4 * std::exp(c4 * (l - 1)) : c5;
  }
  /// W_f = integral of g/l from 1, J/m^3, by the exponential integral.
  double fibreEnergy(double l) const {
    if (l <= 1) return 0;
    const double end = std::min(l, straight);
    const double crimped = c4 > 0 ? std::exp(-c4) * (std::expint(c4 * end) - std::expint(c4)) - std::log(end) : 0.0;
    return c3 * crimped + (l > end ? c5 * (l - end) + c6() * std::log(l / end) : 0.0);
  }
};
static_assert(ConstitutiveModel<TransIsoHyper>);

}  // namespace tushar::mpm::solid
