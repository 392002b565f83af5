#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/geometry/piece.hpp"

namespace tushar::input {

/// Corners of triangles (m).
using Triangles = std::vector<std::array<Vec3, 3>>;

/// The points within a closed surface of triangles.
///
/// A line along x through the point crosses the surface an odd number of times on one side. Edges that triangles share
/// are cut in the same way for both, so that no line slips through between them.
class Surface : public GeometryPiece {
 public:
  /// At least one triangle.
  explicit Surface(Triangles triangles);
  bool contains(const Vec3& point) const override;
  Box3 bounds() const override { return bounds_; }

 private:
  std::size_t binOf(int axis, double coordinate) const;

  Triangles triangles_;
  Box3 bounds_;
  std::size_t bins_;                        ///< along y and along z
  std::vector<std::vector<int>> crossing_;  ///< triangles in each bin of lines along x
};

/// Why triangles do not form a closed surface: a sentence about an edge that an odd number of them share; otherwise
/// empty.
std::string whyOpen(const Triangles& triangles);

/// The triangles of a file: STL, as text or binary, where its name ends in `.stl`; else those of NAME.tri, three
/// numbers of points a line, counted from 0, and the points of NAME.pts, three coordinates a line. If a line is
/// malformed, or a file is missing or ends early, reports an error with its name at `tag` and returns no triangles.
Triangles readTriangles(const std::string& path, const Element& tag, Diagnostics& diagnostics);

}  // namespace tushar::input
