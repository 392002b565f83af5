#pragma once

#include <algorithm>
#include <vector>

#include "components/reference/gas_fields.hpp"

namespace tushar::reference {

/// A plane across which fields or their slopes jump.
struct Plane {
  static constexpr bool curved = false;
  Vec3 normal;          ///< normal of any length except 0
  double distance = 0;  ///< the plane is where normal . x = distance

  /// Whether the plane passes through the interior of the box [lower, upper] [m].
  bool cuts(const Vec3& lower, const Vec3& upper) const;
  /// Adds to `breaks` the positions along `axis` at which the plane enters or leaves that part of the box in which the
  /// coordinates along the earlier axes are those of `x`.
  void addBreaks(int axis, const Vec3& lower, const Vec3& upper, const Vec3& x, std::vector<double>& breaks) const;
};

/// A sphere across which fields or their slopes jump. With fewer axes in `round`, it is a circle or a pair of points,
/// extended along the other axes.
struct Sphere {
  static constexpr bool curved = true;
  Vec3 centre;        ///< centre [m]
  double radius = 0;  ///< radius [m]
  Vec3 round;         ///< 1 along the axes in which the distance from the centre is measured, 0 along the others

  bool cuts(const Vec3& lower, const Vec3& upper) const;
  void addBreaks(int axis, const Vec3& lower, const Vec3& upper, const Vec3& x, std::vector<double>& breaks) const;
};

/// Means over a box of a gas that is smooth except at some surfaces (Plane or Sphere), by nested quadrature.
template <class Surface>
class PiecewiseMean {
 public:
  PiecewiseMean(const GasReference& gas, const std::vector<Surface>& surfaces, const Vec3& lower, const Vec3& upper,
                double t)
      : gas_(gas), lower_(lower), upper_(upper), time_(t) {
    for (const Surface& surface : surfaces)
      if (surface.cuts(lower, upper)) surfaces_.push_back(surface);
  }

  /// Mean over the axes from `axis` on; the coordinates along the earlier axes are those of `x`.
  Fields over(int axis, Vec3 x) const {
    if (axis == 3) return toFields(gas_.at(x, time_));
    if (surfaces_.empty() && upper_[axis] > lower_[axis]) return overWhole(axis, x);
    if (upper_[axis] > lower_[axis]) return overPieces(axis, x);
    x[axis] = lower_[axis];
    return over(axis + 1, x);
  }

 private:
  Fields overWhole(int axis, Vec3 x) const {
    Fields sum = Fields::Zero();
    for (const QuadraturePoint& point : kGauss5) {
      x[axis] = lower_[axis] + (upper_[axis] - lower_[axis]) * point.at;
      sum += point.weight * over(axis + 1, x);
    }
    return sum;
  }

  Fields overPieces(int axis, Vec3 x) const {
    std::vector<double> breaks;
    for (const Surface& surface : surfaces_) surface.addBreaks(axis, lower_, upper_, x, breaks);
    breaks.push_back(upper_[axis]);
    std::sort(breaks.begin(), breaks.end());
    Fields sum = Fields::Zero();
    double from = lower_[axis];
    for (const double to : breaks) {
      if (to <= from || to > upper_[axis]) continue;
      for (const QuadraturePoint& point : kGauss8) {
        const QuadraturePoint mapped = Surface::curved ? smoothEnds(point) : point;
        x[axis] = from + (to - from) * mapped.at;
        sum += (to - from) * mapped.weight * over(axis + 1, x);
      }
      from = to;
    }
    return sum / (upper_[axis] - lower_[axis]);
  }

  /// The quadrature point after the substitution x = s²(3 - 2s), dx = 6s(1 - s) ds, which makes a function smooth in s
  /// if it behaves like a square root of x at an end.
  static QuadraturePoint smoothEnds(const QuadraturePoint& point) {
    const double s = point.at;
    return {s * s * (3 - 2 * s), 6 * s * (1 - s) * point.weight};
  }

  const GasReference& gas_;
  std::vector<Surface> surfaces_;
  Vec3 lower_, upper_;
  double time_;
};

/// Mean of each field over the box [lower, upper] [m] at time `t` [s], for a gas that is smooth except at `surfaces`.
/// Along an axis without extent, the box is a point. Gauss-Legendre with 5 points per axis; in a box that a surface
/// cuts, with 8 points in each piece. For planes, it is exact for polynomials up to degree 13 over all axes; for
/// spheres, the error is about 1e-8 of the jump. Throws std::invalid_argument if upper < lower.
template <class Surface>
GasState piecewiseMean(const GasReference& gas, const std::vector<Surface>& surfaces, const Vec3& lower,
                       const Vec3& upper, double t) {
  checkBox(lower, upper);
  return toState(PiecewiseMean<Surface>(gas, surfaces, lower, upper, t).over(0, lower));
}

}  // namespace tushar::reference
