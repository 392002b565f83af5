#pragma once

#include <algorithm>

#include "components/mpm/shapes/axis_shapes.hpp"

namespace tushar::mpm {

// Shape functions along the radius of an axisymmetric problem, as in axis_shapes.hpp but per radian: `r` is the
// distance of the particle from the axis, and `lowerNode` the distance of the lower node of its cell, both in cells.
// `hoop` is S_i / r, the contribution of the radial velocity to the hoop strain.

template <class Axis>
struct RadialAxis;

template <>
struct RadialAxis<LinearAxis> {
  static int fill(double r, double lowerNode, double, std::array<double, 2>& s, std::array<double, 2>& ds,
                  std::array<double, 2>& hoop) {
    LinearAxis::fill(r - lowerNode, 1.0, s, ds);
    for (std::size_t k = 0; k < 2; ++k) hoop[k] = s[k] / r;
    return 0;
  }
};

/// Means over the particle's extent, weighted by the radius; Nairn & Guilkey, Int. J. Numer. Meth. Engng 101 (2015)
/// 127.
template <>
struct RadialAxis<GimpAxis> {
  static int fill(double r, double lowerNode, double size, std::array<double, 3>& s, std::array<double, 3>& ds,
                  std::array<double, 3>& hoop) {
    const int first = r - lowerNode < 0.5 ? -1 : 0;
    const double inner = std::max(r - 0.5 * size, 0.0), outer = r + 0.5 * size;
    const double area = 0.5 * (outer * outer - inner * inner);
    for (std::size_t k = 0; k < 3; ++k) {
      const double node = lowerNode + first + static_cast<double>(k);
      s[k] = ds[k] = hoop[k] = 0;
      addPiece(node, -1, std::max(inner, node - 1), std::min(outer, node), s[k], ds[k], hoop[k]);
      addPiece(node, 1, std::max(inner, node), std::min(outer, node + 1), s[k], ds[k], hoop[k]);
      s[k] /= area;
      ds[k] /= area;
      hoop[k] /= area;
    }
    return first;
  }

 private:
  /// Adds the integrals of r S, r dS/dr and S over a piece on one side of the node, where S = 1 - side (r - node).
  static void addPiece(double node, int side, double from, double to, double& s, double& ds, double& hoop) {
    if (to <= from) return;
    const double length = to - from, middle = 0.5 * (from + to);
    const auto hat = [&](double r) { return 1 - side * (r - node); };
    s += length / 6 * (from * hat(from) + 4 * middle * hat(middle) + to * hat(to));  // exact: Simpson, quadratic
    ds -= side * length * middle;
    hoop += length * hat(middle);
  }
};

}  // namespace tushar::mpm
