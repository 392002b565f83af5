#include "core/grid/several_boxes.hpp"

#include <algorithm>
#include <numeric>

namespace tushar::grid {

namespace {

/// Calls `visit(offset)` for each offset from `lower` to `upper` along the axes in use, except `without`.
template <class Visit>
void forEachOffset(int dimension, int without, int lower, int upper, Visit&& visit) {
  Box offsets{{}, Index3::filled(1)};
  for (int d = 0; d < dimension; ++d) {
    if (d == without) continue;
    offsets.lower[d] = lower;
    offsets.upper[d] = upper + 1;
  }
  forEach<3>(offsets, visit);
}

constexpr int noAxis = -1;

/// Joins boxes of nodes of the same plane that follow one another along an axis and are equal along the others.
std::vector<SeveralBoxes::Nodes> joined(const std::vector<SeveralBoxes::Nodes>& all, int axis) {
  std::vector<SeveralBoxes::Nodes> result;
  for (const SeveralBoxes::Nodes& one : all) {
    const auto before = std::find_if(result.begin(), result.end(), [&](const SeveralBoxes::Nodes& other) {
      Box box = other.box;
      if (other.plane != one.plane || box.upper[axis] != one.box.lower[axis]) return false;
      box.lower[axis] = one.box.lower[axis];
      box.upper[axis] = one.box.upper[axis];
      return box == one.box;
    });
    if (before == result.end())
      result.push_back(one);
    else
      before->box.upper[axis] = one.box.upper[axis];
  }
  return result;
}

}  // namespace

SeveralBoxes::SeveralBoxes(std::vector<Box> boxes, const Box& all, int dimension, int layers)
    : boxes_(std::move(boxes)), all_(all), dimension_(dimension), layers_(layers) {
  for (int axis = 0; axis < dimension; ++axis)
    for (const int side : {0, 1}) findSides(axis, side);
}

bool SeveralBoxes::contains(const Index3& cell) const {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) { return box.contains(cell); });
}

std::uint64_t SeveralBoxes::size() const {
  return std::accumulate(boxes_.begin(), boxes_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Box& box) { return sum + box.size(); });
}

/// Divides the nodes along an axis, including those beyond the sides: each node within two of a bound of a box is
/// alone, all others between them are alike.
std::vector<SeveralBoxes::Range> SeveralBoxes::alike(int axis) const {
  if (axis >= dimension_) return {{0, 1}};
  const int first = all_.lower[axis] - layers_, end = all_.upper[axis] + 1 + layers_;
  std::vector<int> starts{first, end};
  for (const Box& box : boxes_)
    for (const int bound : {box.lower[axis], box.upper[axis]})
      for (int node = bound - 2; node <= bound + 3; ++node) starts.push_back(std::clamp(node, first, end));
  std::sort(starts.begin(), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
  std::vector<Range> ranges;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) ranges.push_back({starts[k], starts[k + 1]});
  return ranges;
}

void SeveralBoxes::findSides(int axis, int side) {
  const auto kind = static_cast<std::size_t>(2 * axis + side);
  const int outwards = side == 0 ? -1 : 1;
  if (layers_ == 0) {
    on_[kind] = collect(axis, 0, [&](const Index3& node) { return isOnSide(axis, side, node); });
    return;
  }
  on_[kind] = collect(axis, 0, [&](const Index3& node) { return isOnSideOrPast(axis, side, node); });
  beyond_[kind] = collect(axis, outwards, [&](const Index3& node) { return isBeyond(axis, side, node); });
}

/// The nodes for which `isOne` is true, at the distance `shift` from planes along an axis on which a box ends inside
/// the bounding box.
template <class IsOne>
std::vector<SeveralBoxes::Nodes> SeveralBoxes::collect(int axis, int shift, const IsOne& isOne) const {
  std::vector<int> planes;
  for (const Box& box : boxes_)
    for (const int plane : {box.lower[axis], box.upper[axis]})
      if (plane > all_.lower[axis] && plane < all_.upper[axis]) planes.push_back(plane);
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  std::array<std::vector<Range>, 3> along{alike(0), alike(1), alike(2)};
  std::vector<Nodes> found;
  for (const int plane : planes) {
    along[static_cast<std::size_t>(axis)] = {{plane + shift, plane + shift + 1}};
    Box pieces;
    for (int d = 0; d < 3; ++d) pieces.upper[d] = static_cast<int>(along[static_cast<std::size_t>(d)].size());
    forEach<3>(pieces, [&](const Index3& piece) {
      Box box;
      for (int d = 0; d < 3; ++d) {
        const Range& range = along[static_cast<std::size_t>(d)][static_cast<std::size_t>(piece[d])];
        box.lower[d] = range.lower;
        box.upper[d] = range.upper;
      }
      if (isOne(box.lower)) found.push_back({box, plane});
    });
  }
  for (int d = 0; d < dimension_; ++d) found = joined(found, d);
  return found;
}

bool SeveralBoxes::isNode(const Index3& node) const {
  bool is = false;
  forEachOffset(dimension_, noAxis, -1, 0, [&](const Index3& offset) { is = is || contains(node + offset); });
  return is;
}

/// Whether a node belongs to a cell inside on one side of its plane, but to none on the other.
bool SeveralBoxes::isOnSide(int axis, int side, const Index3& node) const {
  const Index3 down = Index3{} - Index3::unit(axis);
  bool within = false, past = false;
  forEachOffset(dimension_, axis, -1, 0, [&](const Index3& offset) {
    const bool below = contains(node + offset + down), above = contains(node + offset);
    within = within || (side == 0 ? above : below);
    past = past || (side == 0 ? below : above);
  });
  return within && !past;
}

/// Whether a node is on a side, or in its plane next to it and outside all boxes, beyond another side.
bool SeveralBoxes::isOnSideOrPast(int axis, int side, const Index3& node) const {
  if (isOnSide(axis, side, node)) return true;
  if (isNode(node)) return false;
  bool isNext = false;
  forEachOffset(dimension_, axis, -1, 1,
                [&](const Index3& offset) { isNext = isNext || isOnSide(axis, side, node + offset); });
  return isNext;
}

/// Whether a node lies in the layer beyond a side, but not next to nodes of cells inside, those of another wall.
bool SeveralBoxes::isBeyond(int axis, int side, const Index3& node) const {
  const Index3 inwards = side == 0 ? Index3::unit(axis) : Index3{} - Index3::unit(axis);
  if (!isOnSideOrPast(axis, side, node + inwards)) return false;
  bool isAlone = true;
  forEachOffset(dimension_, axis, -1, 1, [&](const Index3& offset) { isAlone = isAlone && !isNode(node + offset); });
  return isAlone;
}

bool SeveralBoxes::mayCut(int axis, int node) const {
  for (const int side : {0, 1})
    for (const Nodes& nodes : onSide(axis, side))
      if (std::abs(node - nodes.plane) <= 1) return false;
  return true;
}

std::vector<int> SeveralBoxes::allowedCuts(int axis, const std::vector<int>& cuts) const {
  const int first = cuts.front(), last = cuts.back();
  std::vector<int> allowed{first, last};
  for (const int cut : cuts) {
    if (cut == first || cut == last) continue;
    for (int away = 0; away < last - first; ++away) {
      const bool down = cut - away > first && mayCut(axis, cut - away);
      const bool up = cut + away < last && mayCut(axis, cut + away);
      if (!down && !up) continue;
      allowed.push_back(down ? cut - away : cut + away);
      break;
    }
  }
  std::sort(allowed.begin(), allowed.end());
  allowed.erase(std::unique(allowed.begin(), allowed.end()), allowed.end());
  return allowed;
}

}  // namespace tushar::grid
