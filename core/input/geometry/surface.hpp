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
/// A line along x through a point inside crosses a closed surface an odd number of times on each side of the point. An
/// edge shared by two triangles is cut in the same way for both, so that no line slips through between them. Where
/// corners of adjacent triangles differ, as in meshes whose caps and walls were made separately, lines may slip
/// through; then a majority of the three lines along x, y and z decides.
class Surface : public GeometryPiece {
 public:
  /// Constructs a surface from at least one triangle. `isClosed`: whether each edge belongs to an even number of
  /// triangles.
  explicit Surface(Triangles triangles, bool isClosed = true);
  bool contains(const Vec3& point) const override;
  Box3 bounds() const override { return bounds_; }
  /// Tests the points of a lattice in the bounding box. Returns the fraction of points for which lines along x, y and
  /// z, in both directions, disagree on whether the point is inside.
  double disagreement() const;

 private:
  /// Triangles for lines along one axis. Each bin covers some of these lines and lists the triangles that they may
  /// cross. The coordinates are permuted so that the axis of the lines comes first.
  struct Lines {
    Triangles triangles;
    std::vector<std::vector<int>> crossing;  ///< indices of the triangles in each bin
  };
  Lines linesAlong(int axis) const;
  /// How often a line along an axis crosses the surface, ahead of a point on the line and behind it.
  struct Crossings {
    std::size_t ahead = 0, behind = 0;
  };
  Crossings crossingsAlong(int axis, const Vec3& point) const;
  std::size_t binOf(int axis, double coordinate) const;

  Triangles triangles_;
  Box3 bounds_;
  std::size_t bins_;          ///< number of bins along each axis perpendicular to the lines
  std::vector<Lines> lines_;  ///< lines along x; where the surface is open, also along y and z
};

/// The reason why triangles do not form a closed surface: a sentence about an edge that an odd number of them share;
/// empty if the surface is closed.
std::string whyOpen(const Triangles& triangles);

/// Reads triangles from files. If `path` ends in `.stl`, it names a text or binary STL file. Otherwise, the triangles
/// are in the file `path`.tri, with three indices of points per line, counted from 0, and the points in the file
/// `path`.pts, with three coordinates per line. If a line is malformed, or a file is missing or ends early, reports an
/// error at `tag` that names the file, and returns no triangles.
Triangles readTriangles(const std::string& path, const Element& tag, Diagnostics& diagnostics);

/// Reads a surface of triangles from files. If its gaps are so large that lines along x, y and z disagree on what is
/// inside, reports an error and returns null; smaller gaps give a note.
std::shared_ptr<const Surface> readSurface(const std::string& path, const Element& tag, Diagnostics& diagnostics);

}  // namespace tushar::input
