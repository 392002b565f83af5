#include "core/grid/box_conflicts.hpp"

#include <algorithm>

namespace tushar::grid {

namespace {

/// Number of cells of a box, of which there may be too many for an integer.
double sizeOf(const Box& box) { return 1.0 * box.extent(0) * box.extent(1) * box.extent(2); }

/// Distances of two boxes along the axes, in cells; negative where they overlap.
Index3 gapsBetween(const Box& a, const Box& b) {
  Index3 gaps;
  for (int d = 0; d < 3; ++d) gaps[d] = std::max(b.lower[d] - a.upper[d], a.lower[d] - b.upper[d]);
  return gaps;
}

/// Whether two boxes share faces of cells.
bool shareFaces(const Box& a, const Box& b) {
  const Index3 gaps = gapsBetween(a, b);
  int touching = 0, overlapping = 0;
  for (int d = 0; d < 3; ++d) {
    touching += gaps[d] == 0;
    overlapping += gaps[d] < 0;
  }
  return touching == 1 && overlapping == 2;
}

/// Whether steps through faces of cells inside, within a window, lead from one cell to another.
bool isWayThrough(const std::vector<Box>& boxes, const Box& window, const Index3& from, const Index3& to) {
  const auto isInside = [&](const Index3& cell) {
    return window.contains(cell) &&
           std::any_of(boxes.begin(), boxes.end(), [&](const Box& box) { return box.contains(cell); });
  };
  std::vector<Index3> reached{from};
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (int d = 0; d < 3; ++d)
      for (const Index3& next : {reached[k] + Index3::unit(d), reached[k] + (Index3{} - Index3::unit(d))})
        if (isInside(next) && std::find(reached.begin(), reached.end(), next) == reached.end()) reached.push_back(next);
  return std::find(reached.begin(), reached.end(), to) != reached.end();
}

/// Largest distance of cells at which wide shape functions of particles in both reach the same nodes.
constexpr int closeBy = 2;

/// Whether two boxes that do not share faces come close to one another, with no way through other boxes from cell to
/// cell.
bool areTooClose(const std::vector<Box>& boxes, const Box& a, const Box& b) {
  const Index3 gaps = gapsBetween(a, b);
  if (shareFaces(a, b) || gaps[0] > closeBy || gaps[1] > closeBy || gaps[2] > closeBy) return false;
  std::vector<Box> near;
  for (const Box& box : boxes)
    if (!box.intersect(a.grown(closeBy, 3)).empty()) near.push_back(box);
  Box places;  // along axes on which the boxes overlap, all places; otherwise one
  for (int d = 0; d < 3; ++d) {
    places.lower[d] = gaps[d] < 0 ? std::max(a.lower[d], b.lower[d]) : 0;
    places.upper[d] = gaps[d] < 0 ? std::min(a.upper[d], b.upper[d]) : 1;
  }
  bool isClose = false;
  forEach<3>(places, [&](const Index3& place) {
    if (isClose) return;
    Index3 from = place, to = place;
    Box window;
    for (int d = 0; d < 3; ++d) {
      const bool isBelow = a.upper[d] <= b.lower[d];
      if (gaps[d] >= 0) {
        from[d] = isBelow ? a.upper[d] - 1 : a.lower[d];
        to[d] = isBelow ? b.lower[d] : b.upper[d] - 1;
      }
      window.lower[d] = std::min(from[d], to[d]);
      window.upper[d] = std::max(from[d], to[d]) + 1;
    }
    isClose = !isWayThrough(near, window, from, to);
  });
  return isClose;
}

/// The first box to which no chain of boxes that share faces leads from the first one; none if there is no such box.
std::optional<BoxConflict> apartFromFirst(const std::vector<Box>& boxes) {
  std::vector<bool> isReached(boxes.size());
  std::vector<std::size_t> reached{0};
  isReached[0] = true;
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (std::size_t next = 0; next < boxes.size(); ++next)
      if (!isReached[next] && shareFaces(boxes[reached[k]], boxes[next])) {
        isReached[next] = true;
        reached.push_back(next);
      }
  const auto found = std::find(isReached.begin(), isReached.end(), false);
  if (found == isReached.end()) return {};
  return BoxConflict{BoxConflict::Kind::apart, static_cast<std::size_t>(found - isReached.begin()), 0};
}

}  // namespace

Box boundingBoxOf(const std::vector<Box>& boxes) {
  Box all = boxes.front();
  for (const Box& box : boxes)
    for (int d = 0; d < 3; ++d) {
      all.lower[d] = std::min(all.lower[d], box.lower[d]);
      all.upper[d] = std::max(all.upper[d], box.upper[d]);
    }
  return all;
}

bool fillTheirBoundingBox(const std::vector<Box>& boxes) {
  double inside = 0;
  for (const Box& box : boxes) inside += sizeOf(box);
  return inside == sizeOf(boundingBoxOf(boxes));
}

std::optional<BoxConflict> conflictOf(const std::vector<Box>& boxes) {
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (!boxes[a].intersect(boxes[b]).empty()) return BoxConflict{BoxConflict::Kind::overlap, b, a};
  if (fillTheirBoundingBox(boxes)) return {};
  if (const auto apart = apartFromFirst(boxes)) return apart;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (areTooClose(boxes, boxes[a], boxes[b])) return BoxConflict{BoxConflict::Kind::close, b, a};
  return {};
}

}  // namespace tushar::grid
