#include "components/reference/gas_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "components/reference/gas_fields.hpp"

namespace tushar::reference {

namespace {

constexpr double kTolerance = 1e-12;
constexpr int kMostHalvings = 40;

/// Computes means over a box by nested quadrature: the mean over each axis is a quadrature of the means over the later
/// axes.
class BoxMean {
 public:
  BoxMean(const GasReference& gas, const Vec3& lower, const Vec3& upper, double t)
      : gas_(gas), lower_(lower), upper_(upper), time_(t) {}

  /// Mean over the axes from `axis` on; the coordinates along the earlier axes are those of `x`.
  Fields over(int axis, Vec3 x) const {
    if (axis == 3) return toFields(gas_.at(x, time_));
    if (upper_[axis] > lower_[axis]) return overPieces(axis, x);
    x[axis] = lower_[axis];
    return over(axis + 1, x);
  }

 private:
  Fields overPieces(int axis, const Vec3& x) const {
    Fields sum = Fields::Zero();
    double from = lower_[axis];
    const auto add = [&](double to) {
      if (to <= from) return;
      sum += (to - from) * adaptive(axis, x, from, to, gauss(axis, x, from, to), 0);
      from = to;
    };
    for (double at : gas_.breaks(axis, time_)) add(std::min(at, upper_[axis]));
    add(upper_[axis]);
    return sum / (upper_[axis] - lower_[axis]);
  }

  /// Mean over [a, b]. `whole` is its value by Gauss's rule; [a, b] is the fraction 2^-depth of an undivided interval.
  /// Halves [a, b] as long as this changes the mean over the undivided interval. Values that overflow are not refined.
  Fields adaptive(int axis, const Vec3& x, double a, double b, const Fields& whole, int depth) const {
    const double middle = 0.5 * (a + b);
    const Fields left = gauss(axis, x, a, middle);
    const Fields right = gauss(axis, x, middle, b);
    const Fields both = 0.5 * (left + right);
    const bool agree = ((both - whole).abs() <= std::ldexp(kTolerance, depth) * sizes(left, right)).all();
    if (agree || !both.allFinite() || depth == kMostHalvings || middle <= a || middle >= b) return both;
    return 0.5 * (adaptive(axis, x, a, middle, left, depth + 1) + adaptive(axis, x, middle, b, right, depth + 1));
  }

  /// The scale to which errors are relative: the field itself; for velocities, also the speed of sound.
  static Fields sizes(const Fields& left, const Fields& right) {
    Fields size = left.abs() + right.abs();
    size.segment<3>(1) = size.segment<3>(1).maxCoeff() + std::sqrt(size[5]);
    return size;
  }

  Fields gauss(int axis, Vec3 x, double a, double b) const {
    Fields sum = Fields::Zero();
    for (const QuadraturePoint& point : kGauss8) {
      x[axis] = a + (b - a) * point.at;
      sum += point.weight * over(axis + 1, x);
    }
    return sum;
  }

  const GasReference& gas_;
  Vec3 lower_;
  Vec3 upper_;
  double time_;
};

}  // namespace

void checkBox(const Vec3& lower, const Vec3& upper) {
  if (!(upper.array() >= lower.array()).all()) {
    throw std::invalid_argument(fmt::format(
        "There is no mean over the box [{}, {}, {}] to [{}, {}, {}]: its upper corner is below its lower corner.",
        lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]));
  }
}

std::vector<double> GasReference::breaks(int, double) const { return {}; }

GasState GasReference::average(const Vec3& lower, const Vec3& upper, double t) const {
  checkBox(lower, upper);
  return toState(BoxMean(*this, lower, upper, t).over(0, lower));
}

GasState GasReference::averageAlong(int axis, const Vec3& lower, const Vec3& upper, double t) const {
  Vec3 end = lower;
  end[axis] = upper[axis];
  return GasReference::average(lower, end, t);
}

}  // namespace tushar::reference
