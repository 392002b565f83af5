#pragma once

#include <optional>
#include <string>

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `slice`: saves cell and node variables on planes, more often than the other outputs. Each plane has a separate
/// archive inside that of the run, such as `sod.uda/slice/z=0`, with a grid that is one cell thick. It contains the
/// unchanged values of the cells that the plane cuts, and of the nodes nearest to the plane. If nodes on both sides are
/// equally near, it contains those with the smaller coordinate.
simulation::AnalysisKind sliceKind();

/// A plane perpendicular to an axis of the scene (0: x, 1: y, 2: z), at the coordinate `at` [m].
struct Plane {
  int axis;
  double at;
};

/// Parses a plane such as `z = 0.5`; returns none for any other text.
std::optional<Plane> planeOf(const std::string& text);

/// The layer of the grid at a plane. `level` is the finest level; the grid must use the plane's axis, and the plane
/// must be within the sides of the grid.
collect::Layer layerAt(const Plane& plane, const grid::Level& level);

}  // namespace tushar::analysis
