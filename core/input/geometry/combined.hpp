#pragma once

#include <vector>

#include "core/input/geometry/piece.hpp"

namespace tushar::input {

/// The empty set: Uintah's `null`, the shape of a material that has no particles at the start.
class Nothing : public GeometryPiece {
 public:
  bool contains(const Vec3&) const override { return false; }
  Box3 bounds() const override { return {}; }
};

/// The points inside at least one of its pieces.
class Union : public GeometryPiece {
 public:
  /// Constructs the union of at least one piece.
  explicit Union(std::vector<PiecePtr> pieces) : pieces_(std::move(pieces)) {}
  bool contains(const Vec3& point) const override;
  bool owns(const Vec3& point) const override;
  Box3 bounds() const override;

 private:
  std::vector<PiecePtr> pieces_;
};

/// The points inside all of its pieces.
class Intersection : public GeometryPiece {
 public:
  /// Constructs the intersection of at least one piece.
  explicit Intersection(std::vector<PiecePtr> pieces) : pieces_(std::move(pieces)) {}
  bool contains(const Vec3& point) const override;
  bool owns(const Vec3& point) const override;
  Box3 bounds() const override;

 private:
  std::vector<PiecePtr> pieces_;
};

/// The points inside the first piece and outside the second; the faces of the second piece do not belong to the
/// difference.
class Difference : public GeometryPiece {
 public:
  Difference(PiecePtr from, PiecePtr taken) : from_(std::move(from)), taken_(std::move(taken)) {}
  bool contains(const Vec3& point) const override { return from_->contains(point) && !taken_->contains(point); }
  bool owns(const Vec3& point) const override { return from_->owns(point) && !taken_->owns(point); }
  Box3 bounds() const override { return from_->bounds(); }

 private:
  PiecePtr from_;
  PiecePtr taken_;
};

}  // namespace tushar::input
