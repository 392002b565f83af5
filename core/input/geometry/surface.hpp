#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/geometry/piece.hpp"

namespace tushar::input {

/// The corners of triangles [m].
using Triangles = std::vector<std::array<Vec3, 3>>;

/// The points inside a surface of triangles.
///
/// A line along x through an inside point crosses a closed surface an odd number of times on each side. An edge shared
/// by two triangles is cut in the same way for both, so that no line slips through between them. Where corners of
/// adjacent triangles differ, as in meshes whose caps and walls were made separately, lines may slip through; then a
/// majority of the three lines along x, y and z decides.
class Surface : public GeometryPiece {
 public:
  /// Constructs a surface from at least one triangle. `isClosed`: whether each edge belongs to an even number of
  /// triangles.
  explicit Surface(Triangles triangles, bool isClosed = true);
  bool contains(const Vec3& point) const override;
  Box3 bounds() const override { return bounds_; }
  /// The fraction of the points of a lattice in the bounds at which lines along x, y and z, in both directions,
  /// disagree on whether the point is inside.
  double disagreement() const;

 private:
  /// Triangles, sorted by the lines along an axis that may cross them. Their coordinates are turned so that this axis
  /// is the first.
  struct Lines {
    Triangles triangles;
    std::vector<std::vector<int>> crossing;  ///< indices of the triangles in each bin
  };
  Lines linesAlong(int axis) const;
  /// Number of times that a line along an axis through a point crosses the surface.
  struct Crossings {
    std::size_t ahead = 0, behind = 0;
  };
  Crossings crossingsAlong(int axis, const Vec3& point) const;
  std::size_t binOf(int axis, double coordinate) const;

  Triangles triangles_;
  Box3 bounds_;
  std::size_t bins_;          ///< number of bins across the lines, along each axis
  std::vector<Lines> lines_;  ///< lines along x; where the surface is open, also along y and z
};

/// Why triangles do not form a closed surface: a sentence about an edge that an odd number of them share; otherwise
/// empty.
std::string whyOpen(const Triangles& triangles);

/// The triangles of a file: STL, as text or binary, if its name ends in `.stl`; otherwise those of NAME.tri, three
/// indices of points per line, counted from 0, and the points of NAME.pts, three coordinates per line. If a line is
/// malformed, or a file is missing or ends early, reports an error with its name at `tag` and returns no triangles.
Triangles readTriangles(const std::string& path, const Element& tag, Diagnostics& diagnostics);

/// The inside of the triangles of a file. If they are so open that lines along x, y and z disagree about the inside,
/// reports an error and returns null; smaller gaps give a note.
std::shared_ptr<const Surface> readSurface(const std::string& path, const Element& tag, Diagnostics& diagnostics);

}  // namespace tushar::input
