#pragma once

#include <memory>

#include "core/base/vec.hpp"

namespace tushar::input {

/// A box with edges along the axes [m]; empty if `max` is not above `min`.
struct Box3 {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();

  bool isEmpty() const { return !((max - min).array() > 0).all(); }
  /// The smallest box that contains both boxes.
  Box3 hull(const Box3& other) const { return {min.cwiseMin(other.min), max.cwiseMax(other.max)}; }
  /// The intersection of both boxes; may be empty.
  Box3 common(const Box3& other) const { return {min.cwiseMax(other.min), max.cwiseMin(other.max)}; }
};

/// A region of space [m].
class GeometryPiece {
 public:
  virtual ~GeometryPiece() = default;
  /// Whether a body has a particle at a point, according to Uintah's rule: faces belong to the body (except for
  /// `Parallelepiped` and `Torus`).
  virtual bool contains(const Vec3& point) const = 0;
  /// Like contains(), but excluding the upper flat faces: a point on a face between two pieces belongs to exactly one
  /// of them.
  virtual bool owns(const Vec3& point) const { return contains(point); }
  /// A box that contains the piece.
  virtual Box3 bounds() const = 0;
};

/// Pieces never change after they have been read, so they can be shared.
using PiecePtr = std::shared_ptr<const GeometryPiece>;

}  // namespace tushar::input
