#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

#include "components/mpm/solid/constitutive/strain_invariants.hpp"
#include "components/mpm/solid/tensor.hpp"
#include "core/input/refuse.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The parts of a ligament that have not failed.
struct IntactParts {
  bool matrix = true, fibres = true;
};

/// Rubber with fibres along a, such as a ligament; Weiss, Maker & Govindjee, Comput. Methods Appl. Mech. Engrg. 135
/// (1996) 107. With B' = J^(-2/3) F Fᵀ, its invariants I1, I2, and the fibres' stretch l = J^(-1/3) |F a|:
/// W = W_m(I1, I2) + W_f(l) + K/2 ln² J,
/// W_m = c1 (I1 - 3) + c2 (I2 - 3) of Mooney & Rivlin, or c1 (exp(c2 (I1 - 3)) - 1) - c1 c2/2 (I2 - 3) of Veronda &
/// Westmann, J. Biomech. 3 (1970) 111,
/// l dW_f/dl = 0 for l < 1, c3 (exp(c4 (l - 1)) - 1) for l < l*, c5 l + c6 above, c6 such that it has no jump.
struct FibreElasticity {
  enum class Rubber { mooneyRivlin, verondaWestmann };

  double bulkModulus = 0;                ///< bulk modulus K [Pa]
  double c1 = 0, c2 = 0, c3 = 0;         ///< constants of the matrix [Pa]; for VerondaWestmann, c2 is dimensionless
  double c4 = 0;                         ///< c4 [1]
  double c5 = 0;                         ///< c5 [Pa]
  double straight = 1;                   ///< stretch l* at which fibres are straight [1]
  std::array<double, 3> fibre{1, 0, 0};  ///< a, along x, y, z
  Rubber rubber = Rubber::mooneyRivlin;

 protected:
  struct Point {
    Matrix3 b;       ///< B', isochoric left Cauchy-Green tensor
    Matrix3 fibres;  ///< a aᵀ
    double j, first, stretch;

    Point(const FibreElasticity& model, const Matrix3& f) : j(f.determinant()) {
      const double shrunk = 1 / std::cbrt(j);
      b = shrunk * shrunk * (f * f.transpose());
      first = b.trace();
      const Vec3 along = shrunk * (f * Eigen::Map<const Vec3>(model.fibre.data()).normalized());
      stretch = along.norm();
      fibres = along * along.transpose() / (stretch * stretch);
    }
  };

  /// Converts a pointer to a member of this class into a pointer to a member of `Model`, which inherits this class.
  template <class Model, class T>
  static T Model::*in(T FibreElasticity::*member) {
    return member;
  }
  template <class Model>
  static void addTags(input::Schema<Model>& tags) {
    tags.required("bulk_modulus", in<Model>(&FibreElasticity::bulkModulus), "Pa", "K", input::positive())
        .required("c1", in<Model>(&FibreElasticity::c1), "Pa", "first constant of the matrix", input::positive())
        .required("c2", in<Model>(&FibreElasticity::c2), "Pa", "second constant of the matrix", input::nonNegative())
        .required("c3", in<Model>(&FibreElasticity::c3), "Pa",
                  "factor of the stress of fibres while they are being straightened", input::nonNegative())
        .required("c4", in<Model>(&FibreElasticity::c4), "1", "exponential growth of that stress with the stretch",
                  input::nonNegative())
        .required("c5", in<Model>(&FibreElasticity::c5), "Pa", "modulus of straight fibres", input::nonNegative())
        .required("fiber_stretch", in<Model>(&FibreElasticity::straight), "1", "stretch at which fibres are straight",
                  input::atLeast(1))
        .custom("direction_of_symm", readFibre, {"direction_of_symm"},
                "direction of the fibres at the start; its length has no effect")
        .forms({input::typeForm({"direction_of_symm"}, std::string(input::typeName<Vec3>), 1)})
        .ignored("useModifiedEOS", "only the fluid coupling of Uintah uses it");
  }

  /// Computes tau = 2 dev((w1 + I1 w2) B' - w2 B'²) + g dev(a a) + K ln J I [Pa]; w1 and w2 are the derivatives of W_m
  /// with respect to I1 and I2, g = l dW_f/dl, and a is the direction of the deformed fibre. Parts that have failed
  /// have no stress; the matrix carries the pressure.
  Matrix3 elasticStress(const Point& at, const IntactParts& intact = {}) const {
    const RubberSlopes w = rubberSlopes(at.first);
    const Matrix3 fibres = intact.fibres ? Matrix3(fibreForce(at.stretch) * at.fibres) : Matrix3::Zero();
    if (!intact.matrix) return deviator(fibres);
    const Matrix3 matrix = (w.byFirst + at.first * w.bySecond) * at.b - w.bySecond * at.b * at.b;
    Matrix3 stress = deviator(2 * matrix + fibres);
    stress.diagonal().array() += bulkModulus * std::log(at.j);
    return stress;
  }
  /// The change of tau when F changes by h F [Pa].
  Matrix3 elasticChange(const Point& at, const Matrix3& h, const IntactParts& intact = {}) const {
    const RubberSlopes w = rubberSlopes(at.first);
    const double g = intact.fibres ? fibreForce(at.stretch) : 0, slope = intact.fibres ? fibreSlope(at.stretch) : 0;
    const Matrix3 hb = h * at.b, db = hb + hb.transpose() - 2.0 / 3.0 * h.trace() * at.b, bdb = at.b * db;
    const Matrix3 matrix = (w.bySecond + w.curvature) * db.trace() * at.b + (w.byFirst + at.first * w.bySecond) * db -
                           w.bySecond * (bdb + bdb.transpose());
    const Matrix3 turned = h * at.fibres, along = turned + turned.transpose();  // d(a aᵀ) = along - 2 (a . h a) a aᵀ
    const double stretching = 0.5 * along.trace();
    const double dg = slope * at.stretch * (stretching - h.trace() / 3);
    const Matrix3 fibres = (dg - 2 * g * stretching) * at.fibres + g * along;
    if (!intact.matrix) return deviator(fibres);
    Matrix3 change = deviator(2 * matrix + fibres);
    change.diagonal().array() += bulkModulus * h.trace();
    return change;
  }
  /// P-wave modulus of the undeformed body [Pa].
  double initialModulus() const {
    const RubberSlopes w = rubberSlopes(3);
    return bulkModulus + 8.0 / 3.0 * (w.byFirst + w.bySecond) + fibreSlope(1);
  }
  /// An upper bound on the P-wave modulus [Pa]: K, plus 8/9 I1 (w1 + w2 I1/3) + 16/9 I1² d²W_m/dI1² of the matrix, plus
  /// l dg/dl + |g| of the fibres.
  double largestModulus(const Point& at) const {
    const RubberSlopes w = rubberSlopes(at.first);
    const double matrix = 8.0 / 3.0 * (w.byFirst + w.bySecond * at.first / 3) * at.first / 3;
    const double fibres = fibreSlope(at.stretch) * at.stretch + std::abs(fibreForce(at.stretch));
    return bulkModulus + matrix + fibres + 16.0 / 9.0 * w.curvature * at.first * at.first;
  }
  /// The energy W [J/m^3] of the parts that have not failed.
  double elasticEnergy(const Matrix3& f, const IntactParts& intact = {}) const {
    const StrainInvariants strain(f);
    const double logarithm = 0.5 * std::log1p(strain.volume);
    const double fibres = intact.fibres ? fibreEnergy(Point(*this, f).stretch) : 0;
    if (!intact.matrix) return fibres;
    return rubberEnergy(strain.isochoricFirst(), strain.isochoricSecond()) + fibres +
           0.5 * bulkModulus * logarithm * logarithm;
  }

 private:
  /// First derivatives of W_m with respect to I1 and I2, and its second derivative with respect to I1 [Pa].
  struct RubberSlopes {
    double byFirst, bySecond, curvature;
  };
  RubberSlopes rubberSlopes(double first) const {
    if (rubber == Rubber::mooneyRivlin) return {c1, c2, 0};
    const double growing = c1 * c2 * std::exp(c2 * (first - 3));
    return {growing, -0.5 * c1 * c2, c2 * growing};
  }
  /// The energy W_m as a function of I1 - 3 and I2 - 3 [J/m^3].
  double rubberEnergy(double first, double second) const {
    if (rubber == Rubber::mooneyRivlin) return c1 * first + c2 * second;
    return c1 * std::expm1(c2 * first) - 0.5 * c1 * c2 * second;
  }
  static void readFibre(FibreElasticity& read, const input::Element& element, input::Diagnostics& diagnostics) {
    const auto given = element.child("direction_of_symm");
    if (!given) return diagnostics.error(element, "missing tag <direction_of_symm> (along the fibres at the start)");
    const auto value = input::parse<Vec3>(given->text());
    if (!value.problem.empty()) return diagnostics.error(*given, value.problem);
    if (value.value->norm() == 0) return diagnostics.error(*given, "is 0, which is not a direction");
    read.fibre = {(*value.value)[0], (*value.value)[1], (*value.value)[2]};
  }

  double c6() const { return c3 * std::expm1(c4 * (straight - 1)) - c5 * straight; }
  /// The fibre force g [Pa].
  double fibreForce(double l) const {
    if (l < 1) return 0;
    return l < straight ? c3 * std::expm1(c4 * (l - 1)) : c5 * l + c6();
  }
  /// The derivative dg/dl [Pa].
  double fibreSlope(double l) const {
    if (l < 1) return 0;
    return l < straight ? c3 * c4 * std::exp(c4 * (l - 1)) : c5;
  }
  /// The fibre energy W_f = integral of g/l from 1 [J/m^3], by the exponential integral.
  double fibreEnergy(double l) const {
    if (l <= 1) return 0;
    const double end = std::min(l, straight);
    const double crimped = c4 > 0 ? std::exp(-c4) * (std::expint(c4 * end) - std::expint(c4)) - std::log(end) : 0.0;
    return c3 * crimped + (l > end ? c5 * (l - end) + c6() * std::log(l / end) : 0.0);
  }
};

}  // namespace tushar::mpm::solid
