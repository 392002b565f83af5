#include "core/tasks/ghost_plan.hpp"

namespace tushar::tasks {

using grid::Box;
using grid::Grid;
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

/// The nodes that other patches copy from a patch; a node on a face between patches is copied from the upper patch. The
/// last node of a periodic image along the axis is copied from the next image.
Box nodesGiven(const Patch& patch, const Index3& shift) {
  const Level& level = patch.level();
  Box nodes = patch.nodes();
  for (int d = 0; d < level.dimension(); ++d) {
    const bool isLast = patch.cells().upper[d] == level.cells().upper[d];
    if (!isLast || (level.isPeriodic(d) && !(shift == Index3{}))) nodes.upper[d] = patch.cells().upper[d];
  }
  return nodes;
}

/// The largest distance, in cells of the patch, over which a patch exchanges values for ghosts of a given width. On
/// several levels, this is twice the width, because the neighbour may be coarser, plus two coarse cells for slopes.
int neighbourhoodOf(const Grid& grid, const GhostReach& reach) {
  if (grid.levels() > 1) return 2 * reach.width + 4;
  return reach.width + (reach.centring == data::Centring::node ? 1 : 0);
}

/// The copies that one patch needs.
class PlannerOfPatch {
 public:
  PlannerOfPatch(const Grid& grid, const GhostReach& reach, const Patch& patch)
      : grid_(grid),
        reach_(reach),
        patch_(patch),
        level_(patch.level()),
        isNode_(reach.centring == data::Centring::node) {}

  void run() {
    if (reach_.centring == data::Centring::rim) return addFinerFluxes();
    addSameLevel();
    if (reach_.centring != data::Centring::cell || grid_.levels() == 1) return;
    addMeans(level_, patch_.cellsWithin(reach_.width), patch_.cells(), -1);
    addCoarse();
  }

  std::vector<GhostCopy> copies;
  std::vector<CoarseGhosts> coarse;

 private:
  void add(const Patch& from, const Box& box, const Index3& shift, bool isMean, int coarseCells) {
    copies.push_back({from.id(), patch_.id(), grid_.ownerOf(from.id()), box, shift, isMean, coarseCells});
  }

  /// Adds copies of the mean fluxes of finer patches.
  void addFinerFluxes() {
    const std::vector<grid::RimPiece> pieces = grid::rimsOf(grid_, patch_);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const grid::RimPiece& piece = pieces[k];
      if (!piece.isFiner) continue;
      copies.push_back({piece.other, patch_.id(), grid_.ownerOf(piece.other), piece.cells, piece.shift, true, -1,
                        static_cast<int>(k), piece.axis, piece.side});
    }
  }

  void addSameLevel() {
    const Box own = isNode_ ? patch_.nodes() : patch_.cells();
    const Box wanted = isNode_ ? patch_.nodesWithin(reach_.width) : patch_.cellsWithin(reach_.width);
    // The last node along a periodic axis is the image of the first, but with different rounding. A node of the grid is
    // therefore never taken from an image, whatever the patches are.
    const Box all = isNode_ ? level_.nodes() : level_.cells();
    grid_.forEachOverlapping(
        level_, patch_.cellsWithin(reach_.width + (isNode_ ? 1 : 0)), [&](const Patch& other, const Index3& shift) {
          const Box has = isNode_ ? nodesGiven(other, shift) : other.cells();
          const Box given = has.shifted(shift).intersect(wanted);
          if (given.empty() || (other.id() == patch_.id() && shift == Index3{})) return;
          forEachPartOutside(given, own, [&](const Box& part) {
            if (shift == Index3{}) return add(other, part, shift, false, -1);
            forEachPartOutside(part, all, [&](const Box& beyond) { add(other, beyond, shift, false, -1); });
          });
        });
  }

  /// Adds copies of means for the refined cells in a box of a level, except for those in a hole.
  void addMeans(const Level& level, const Box& wanted, const Box& hole, int coarseCells) {
    if (level.number() + 1 == grid_.levels()) return;
    const int dimension = level.dimension();
    grid_.forEachOverlapping(
        grid_.level(level.number() + 1), wanted.refined(dimension), [&](const Patch& other, Index3 shift) {
          for (int d = 0; d < dimension; ++d) shift[d] /= 2;
          const Box given = other.cells().coarsened(dimension).shifted(shift).intersect(wanted);
          if (!given.empty())
            forEachPartOutside(given, hole, [&](const Box& part) { add(other, part, shift, true, coarseCells); });
        });
  }

  /// Adds ghosts that lie in coarser cells, and copies of these cells and their neighbours.
  void addCoarse() {
    if (level_.number() == 0) return;
    const Level& below = grid_.level(level_.number() - 1);
    const int dimension = level_.dimension();
    const Box wanted = patch_.cellsWithin(reach_.width);
    grid_.forEachOverlapping(below, wanted.coarsened(dimension), [&](const Patch& other, const Index3& shift) {
      const Box ghosts = other.cells().shifted(shift).refined(dimension).intersect(wanted);
      if (ghosts.empty()) return;
      const Box cells = below.clipCells(ghosts.coarsened(dimension).grown(1, dimension));
      const int place = static_cast<int>(coarse.size());
      coarse.push_back({ghosts, cells});
      grid_.forEachOverlapping(below, cells, [&](const Patch& source, const Index3& by) {
        const Box given = source.cells().shifted(by).intersect(cells);
        if (!given.empty()) add(source, given, by, false, place);
      });
      addMeans(below, cells, {}, place);
    });
  }

  const Grid& grid_;
  const GhostReach& reach_;
  const Patch& patch_;
  const Level& level_;
  bool isNode_;
};

class Planner {
 public:
  Planner(const Grid& grid, const GhostReach& reach) : grid_(grid), reach_(reach) {}

  GhostPlan run() const {
    GhostPlan plan;
    std::set<int> readers;
    for (const Patch& patch : grid_.patches()) {
      PlannerOfPatch ofPatch(grid_, reach_, patch);
      if (needs(patch)) ofPatch.run();
      plan.into.push_back(std::move(ofPatch.copies));
      plan.coarse.push_back(std::move(ofPatch.coarse));
      plan.isLocal.push_back(true);
      for (const GhostCopy& copy : plan.into.back()) {
        if (copy.rank == grid_.share().rank) continue;
        plan.incoming.insert(copy.rank);
        plan.isLocal.back() = false;
      }
      if (grid_.share().ranks > 1) noteReaders(patch, readers);
    }
    for (const int reader : readers) {
      const Patch patch = grid_.patch(reader);
      if (!needs(patch)) continue;
      PlannerOfPatch ofReader(grid_, reach_, patch);
      ofReader.run();
      for (const GhostCopy& copy : ofReader.copies)
        if (grid_.isMine(copy.from)) plan.outgoing[grid_.ownerOf(reader)].push_back(copy);
    }
    return plan;
  }

 private:
  bool needs(const Patch& patch) const { return reach_.level < 0 || reach_.level == patch.level().number(); }
  /// Notes the patches of other ranks that may need values from this patch.
  void noteReaders(const Patch& patch, std::set<int>& readers) const {
    const Level& level = patch.level();
    const Box near = patch.cellsWithin(neighbourhoodOf(grid_, reach_));
    const auto note = [&](const Patch& other, const Index3&) {
      if (!grid_.isMine(other.id())) readers.insert(other.id());
    };
    grid_.forEachOverlapping(level, near, note);
    if (level.number() > 0)
      grid_.forEachOverlapping(grid_.level(level.number() - 1), near.coarsened(level.dimension()), note);
    if (level.number() + 1 < grid_.levels())
      grid_.forEachOverlapping(grid_.level(level.number() + 1), near.refined(level.dimension()), note);
  }

  const Grid& grid_;
  const GhostReach& reach_;
};

}  // namespace

GhostPlan planGhosts(const Grid& grid, const GhostReach& reach) { return Planner(grid, reach).run(); }

std::vector<std::vector<GhostCopy>> planFaces(const Grid& grid) {
  std::vector<std::vector<GhostCopy>> faces;
  for (const Patch& patch : grid.patches()) {
    std::vector<GhostCopy>& into = faces.emplace_back();
    const Box own = grid.ownNodes(patch.id());
    for (const Patch& other : grid.patchesOverlapping(patch.cellsWithin(1), patch.level().number())) {
      if (other.id() == patch.id() || !grid.isMine(other.id())) continue;
      const Box given = grid.ownNodes(other.id()).intersect(patch.nodes());
      if (given.empty()) continue;
      forEachPartOutside(given, own, [&](const Box& part) {
        into.push_back({other.id(), patch.id(), grid.share().rank, part, Index3{}});
      });
    }
  }
  return faces;
}

const GhostPlan& GhostPlans::of(const grid::Grid& grid, GhostReach reach) {
  const bool isAsForCells = reach.centring == data::Centring::particle && grid.levels() == 1;
  if (isAsForCells) reach.centring = data::Centring::cell;
  if (grid.share().ranks == 1) reach.level = -1;  // without messages, the plan for all levels serves each
  const auto [plan, isNew] = plans_.try_emplace(reach);
  if (isNew) plan->second = planGhosts(grid, reach);
  return plan->second;
}

}  // namespace tushar::tasks
