#include "core/tasks/ghost_plan.hpp"

namespace tushar::tasks {

using grid::Box;
using grid::Level;
using grid::Patch;

namespace {

/// The parts of `box` outside `hole`: below and above it, axis by axis.
template <class Visit>
void forEachPartOutside(Box box, const Box& hole, Visit&& visit) {
  for (int d = 2; d >= 0; --d) {
    Box below = box, above = box;
    below.upper[d] = std::min(box.upper[d], hole.lower[d]);
    above.lower[d] = std::max(box.lower[d], hole.upper[d]);
    if (!below.empty()) visit(below);
    if (!above.empty()) visit(above);
    box.lower[d] = std::max(box.lower[d], hole.lower[d]);
    box.upper[d] = std::min(box.upper[d], hole.upper[d]);
  }
}

/// Calls `visit(patch, shift)` for each patch and each of its images that holds cells of a box.
template <class Visit>
void forEachSource(const Level& level, const Box& cells, Visit&& visit) {
  for (const Index3& shift : level.imagesOverlapping(cells))
    for (const Patch& patch : level.patchesOverlapping(cells.shifted(Index3{} - shift))) visit(patch, shift);
}

/// The nodes that others take from a patch: a node between patches from the one above. On an image the last node of a
/// periodic axis is left to the next image.
Box nodesGiven(const Level& level, const Patch& patch, const Index3& shift) {
  Box nodes = patch.nodes();
  for (int d = 0; d < level.dimension(); ++d) {
    const bool isLast = patch.cells().upper[d] == level.cells().upper[d];
    if (!isLast || (level.isPeriodic(d) && !(shift == Index3{}))) nodes.upper[d] = patch.cells().upper[d];
  }
  return nodes;
}

class Planner {
 public:
  Planner(const Level& level, bool nodes, int width) : level_(level), nodes_(nodes), width_(width) {}

  GhostPlan run() const {
    GhostPlan plan;
    std::set<int> readers;
    for (const Patch& patch : level_.patches()) {
      plan.into.push_back(copiesInto(patch));
      plan.isLocal.push_back(true);
      for (const GhostCopy& copy : plan.into.back()) {
        if (copy.rank == level_.share().rank) continue;
        plan.incoming.insert(copy.rank);
        plan.isLocal.back() = false;
      }
      if (level_.share().ranks > 1)
        forEachSource(level_, reach(patch), [&](const Patch& other, const Index3&) {
          if (!level_.isMine(other.id())) readers.insert(other.id());
        });
    }
    for (const int reader : readers)
      for (const GhostCopy& copy : copiesInto(level_.patch(reader)))
        if (level_.isMine(copy.from)) plan.outgoing[level_.ownerOf(reader)].push_back(copy);
    return plan;
  }

 private:
  Box reach(const Patch& patch) const { return patch.cellsWithin(width_ + (nodes_ ? 1 : 0)); }

  std::vector<GhostCopy> copiesInto(const Patch& patch) const {
    std::vector<GhostCopy> copies;
    const Box own = nodes_ ? patch.nodes() : patch.cells();
    const Box wanted = nodes_ ? patch.nodesWithin(width_) : patch.cellsWithin(width_);
    // The last node of a periodic axis is the image of the first, with other rounding: a node of the grid is never
    // taken from an image, whatever the patches.
    const Box grid = nodes_ ? level_.nodes() : level_.cells();
    forEachSource(level_, reach(patch), [&](const Patch& other, const Index3& shift) {
      const Box given = (nodes_ ? nodesGiven(level_, other, shift) : other.cells()).shifted(shift).intersect(wanted);
      if (given.empty() || (other.id() == patch.id() && shift == Index3{})) return;
      const auto add = [&](const Box& box) {
        copies.push_back({other.id(), patch.id(), level_.ownerOf(other.id()), box, shift});
      };
      forEachPartOutside(given, own, [&](const Box& part) {
        if (shift == Index3{}) return add(part);
        forEachPartOutside(part, grid, add);
      });
    });
    return copies;
  }

  const Level& level_;
  bool nodes_;
  int width_;
};

}  // namespace

GhostPlan planGhosts(const Level& level, bool nodes, int width) { return Planner(level, nodes, width).run(); }

std::vector<std::vector<GhostCopy>> planFaces(const Level& level) {
  std::vector<std::vector<GhostCopy>> faces;
  for (const Patch& patch : level.patches()) {
    std::vector<GhostCopy>& into = faces.emplace_back();
    const Box own = level.ownNodes(patch.id());
    for (const Patch& other : level.patchesOverlapping(patch.cellsWithin(1))) {
      if (other.id() == patch.id() || !level.isMine(other.id())) continue;
      const Box given = level.ownNodes(other.id()).intersect(patch.nodes());
      if (given.empty()) continue;
      forEachPartOutside(given, own, [&](const Box& part) {
        into.push_back({other.id(), patch.id(), level.share().rank, part, Index3{}});
      });
    }
  }
  return faces;
}

const GhostPlan& GhostPlans::of(const grid::Level& level, const GhostReach& reach) {
  const auto [plan, isNew] = plans_.try_emplace(reach);
  if (isNew) plan->second = planGhosts(level, reach.nodes, reach.width);
  return plan->second;
}

}  // namespace tushar::tasks
