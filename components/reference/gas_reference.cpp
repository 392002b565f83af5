#include "components/reference/gas_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace tushar::reference {

namespace {

/// Density, the three velocities, pressure, energy.
using Fields = Eigen::Array<double, 6, 1, Eigen::DontAlign>;

constexpr double kTolerance = 1e-12;
constexpr int kMostHalvings = 40;

// Abramowitz & Stegun, Handbook of Mathematical Functions, table 25.4, n = 8.
constexpr std::array<double, 4> kGaussPoint{0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                            0.96028985649753623168};
constexpr std::array<double, 4> kGaussWeight{0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                             0.10122853629037625915};

Fields toFields(const GasState& state) {
  Fields fields;
  fields << state.density, state.velocity.array(), state.pressure, state.energy;
  return fields;
}

GasState toState(const Fields& fields) { return {fields[0], fields.segment<3>(1).matrix(), fields[4], fields[5]}; }

/// Means over a box, one axis inside the other.
class BoxMean {
 public:
  BoxMean(const GasReference& gas, const Vec3& lower, const Vec3& upper, double t)
      : gas_(gas), lower_(lower), upper_(upper), time_(t) {}

  /// Mean over the axes from `axis` on, the earlier coordinates being those of `x`.
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

  /// Mean over [a, b], whose Gauss mean is `whole`: halves it for as long as that changes the mean
  /// over the undivided piece, of which [a, b] is the part 2^-depth.
  Fields adaptive(int axis, const Vec3& x, double a, double b, const Fields& whole, int depth) const {
    const double middle = 0.5 * (a + b);
    const Fields left = gauss(axis, x, a, middle);
    const Fields right = gauss(axis, x, middle, b);
    const Fields both = 0.5 * (left + right);
    const bool agree = ((both - whole).abs() <= std::ldexp(kTolerance, depth) * sizes(left, right)).all();
    if (agree || depth == kMostHalvings || middle <= a || middle >= b) return both;
    return 0.5 * (adaptive(axis, x, a, middle, left, depth + 1) + adaptive(axis, x, middle, b, right, depth + 1));
  }

  /// What an error is measured against: each field itself, and for velocities the speed of sound too.
  static Fields sizes(const Fields& left, const Fields& right) {
    Fields size = left.abs() + right.abs();
    size.segment<3>(1) = size.segment<3>(1).maxCoeff() + std::sqrt(size[5]);
    return size;
  }

  Fields gauss(int axis, Vec3 x, double a, double b) const {
    const double middle = 0.5 * (a + b);
    const double half = 0.5 * (b - a);
    Fields sum = Fields::Zero();
    for (std::size_t k = 0; k < kGaussPoint.size(); ++k) {
      for (double side : {-1.0, 1.0}) {
        x[axis] = middle + side * half * kGaussPoint[k];
        sum += 0.5 * kGaussWeight[k] * over(axis + 1, x);
      }
    }
    return sum;
  }

  const GasReference& gas_;
  Vec3 lower_;
  Vec3 upper_;
  double time_;
};

}  // namespace

std::vector<double> GasReference::breaks(int, double) const { return {}; }

GasState GasReference::average(const Vec3& lower, const Vec3& upper, double t) const {
  if (!(upper.array() >= lower.array()).all()) {
    throw std::invalid_argument(fmt::format("No mean over the box [{}, {}, {}] to [{}, {}, {}]: upper is below lower.",
                                            lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]));
  }
  return toState(BoxMean(*this, lower, upper, t).over(0, lower));
}

GasState GasReference::averageAlong(int axis, const Vec3& lower, const Vec3& upper, double t) const {
  Vec3 end = lower;
  end[axis] = upper[axis];
  return GasReference::average(lower, end, t);
}

}  // namespace tushar::reference
