#include "core/scene/scene_boxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/grid/box_conflicts.hpp"

namespace tushar::scene {

using input::Diagnostics, input::Element;

namespace {

/// Largest difference of cell widths, and of distances in cells, that round-off explains.
constexpr double slackOfCells = 1e-6;

/// Reads several boxes as boxes of the cells of the first one.
class BoxReader {
 public:
  BoxReader(const Element& level, const LevelSection& read, Diagnostics& diagnostics)
      : elements_(level.children("Box")), level_(read), diagnostics_(diagnostics) {}

  /// The boxes, in cells along x, y, z from the lower corner of the first one.
  std::vector<grid::Box> boxes() {
    std::vector<grid::Box> boxes;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      grid::Box box;
      const Index3 cells = resolutionOf(level_.boxes[k], level_, elements_[k], diagnostics_);
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = k == 0 ? 0 : cellsFromFirst(k, cells, axis);
        box.upper[axis] = box.lower[axis] + cells[axis];
      }
      boxes.push_back(box);
    }
    return boxes;
  }

 private:
  double widthOf(std::size_t k, const Index3& cells, int axis) const {
    return (level_.boxes[k].upper[axis] - level_.boxes[k].lower[axis]) / cells[axis];
  }

  /// The distance of the lower corner of a box from that of the first one.
  int cellsFromFirst(std::size_t k, const Index3& cells, int axis) {
    const Index3 first = resolutionOf(level_.boxes[0], level_, elements_[0], diagnostics_);
    const double width = widthOf(k, cells, axis), expected = widthOf(0, first, axis);
    if (!(std::abs(width - expected) <= slackOfCells * expected)) {
      diagnostics_.error(elements_[k], fmt::format("its cells are {:g} m wide along {}, but those of the first Box, at "
                                                   "{}, {:g} m; all boxes of a Level have cells of one size",
                                                   width, "xyz"[axis], elements_[0].where().text(), expected));
      return 0;
    }
    const double apart = level_.boxes[k].lower[axis] - level_.boxes[0].lower[axis];
    const double distance = expected > 0 ? apart / expected : apart == 0 ? 0.0 : 0.5;
    if (std::abs(distance) > mostCells ||
        std::abs(distance - std::round(distance)) > slackOfCells * (1 + std::abs(distance)))
      diagnostics_.error(elements_[k],
                         fmt::format("its lower corner is {:g} m from that of the first Box along {}, at {}; expected "
                                     "a multiple of the cell width, {:g} m",
                                     apart, "xyz"[axis], elements_[0].where().text(), expected));
    return static_cast<int>(std::lround(std::clamp(distance, -mostCells, mostCells)));
  }

  std::vector<Element> elements_;
  const LevelSection& level_;
  Diagnostics& diagnostics_;
};

void refuseConflict(const std::vector<Element>& elements, const grid::BoxConflict& conflict, Diagnostics& diagnostics) {
  const std::string other = elements[conflict.other].where().text();
  using Kind = grid::BoxConflict::Kind;
  switch (conflict.kind) {
    case Kind::overlap:
      return diagnostics.error(elements[conflict.box], fmt::format("overlaps the Box at {}", other));
    case Kind::apart:
      return diagnostics.error(elements[conflict.box],
                               fmt::format("is apart from the Box at {}: no chain of boxes that share faces of cells "
                                           "leads from one to the other",
                                           other));
    case Kind::close:
      return diagnostics.error(elements[conflict.box],
                               fmt::format("comes too close to the Box at {}: wide shape functions would reach from "
                                           "one into the other; between boxes that share no faces, leave at least 3 "
                                           "cells",
                                           other));
  }
}

void refusePeriodic(const Element& level, const LevelSection& read, Diagnostics& diagnostics) {
  if (!(read.periodic == Index3{}))
    diagnostics.error(level.child("periodic").value_or(level),
                      fmt::format("found {}, expected [0,0,0]: a Level of several boxes cannot be periodic",
                                  input::toText(read.periodic)));
}

}  // namespace

void readBoxes(const Element& level, const LevelSection& read, grid::Domain& domain, Diagnostics& diagnostics) {
  const std::vector<Element> elements = level.children("Box");
  domain.lower = read.boxes.front().lower;
  domain.upper = read.boxes.front().upper;
  domain.resolution = resolutionOf(read.boxes.front(), read, elements.front(), diagnostics);
  if (elements.size() == 1) return;
  const std::size_t before = diagnostics.size();
  std::vector<grid::Box> boxes = BoxReader(level, read, diagnostics).boxes();
  if (diagnostics.size() > before) return;
  if (const auto conflict = grid::conflictOf(boxes)) return refuseConflict(elements, *conflict, diagnostics);
  const grid::Box all = grid::boundingBoxOf(boxes);
  for (int axis = 0; axis < 3; ++axis) {
    domain.resolution[axis] = all.extent(axis);
    for (const GridBox& box : read.boxes) {
      domain.lower[axis] = std::min(domain.lower[axis], box.lower[axis]);
      domain.upper[axis] = std::max(domain.upper[axis], box.upper[axis]);
    }
  }
  if (grid::fillTheirBoundingBox(boxes)) return;
  for (grid::Box& box : boxes) box = box.shifted(Index3{} - all.lower);
  refusePeriodic(level, read, diagnostics);
  domain.boxes = std::move(boxes);
}

GridBox patchesOfBoxes(const Element& level, const LevelSection& read, Diagnostics& diagnostics) {
  if (read.boxes.size() == 1) return read.boxes.front();
  GridBox all = read.boxes.front();
  all.patches.reset();
  all.autoPatch.reset();
  double patches = 0;
  for (const GridBox& box : read.boxes) {
    if (!box.patches && !box.autoPatch) return all;
    patches += box.patches ? 1.0 * (*box.patches)[0] * (*box.patches)[1] * (*box.patches)[2] : *box.autoPatch;
  }
  all.autoPatch = static_cast<int>(std::min(patches, 1e9));
  diagnostics.note(level.children("Box").front(),
                   fmt::format("the boxes of a Level are divided together, into about {:g} patches", patches));
  return all;
}

}  // namespace tushar::scene
