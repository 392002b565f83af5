#include "core/input/geometry/combined.hpp"

#include <algorithm>

namespace tushar::input {

bool Union::contains(const Vec3& point) const {
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const PiecePtr& piece) { return piece->contains(point); });
}

bool Union::owns(const Vec3& point) const {
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const PiecePtr& piece) { return piece->owns(point); });
}

Box3 Union::bounds() const {
  Box3 box = pieces_.front()->bounds();
  for (const PiecePtr& piece : pieces_) box = box.hull(piece->bounds());
  return box;
}

bool Intersection::contains(const Vec3& point) const {
  return std::all_of(pieces_.begin(), pieces_.end(), [&](const PiecePtr& piece) { return piece->contains(point); });
}

bool Intersection::owns(const Vec3& point) const {
  return std::all_of(pieces_.begin(), pieces_.end(), [&](const PiecePtr& piece) { return piece->owns(point); });
}

Box3 Intersection::bounds() const {
  Box3 box = pieces_.front()->bounds();
  for (const PiecePtr& piece : pieces_) box = box.common(piece->bounds());
  return box;
}

}  // namespace tushar::input
