#pragma once

#include <algorithm>
#include <compare>
#include <map>
#include <set>
#include <vector>

#include "core/data/label.hpp"
#include "core/grid/grid.hpp"

namespace tushar::tasks {

/// Ghosts of a patch that come from one other patch, or from the patch itself at its periodic image.
struct GhostCopy {
  int from, to;            ///< indices of the source and destination patch
  int rank;                ///< rank of the source patch
  grid::Box box;           ///< cells or nodes around the destination patch
  Index3 shift;            ///< shift of a periodic image in cells: the values for `box` are at `box` - shift on `from`
  bool isMean = false;     ///< whether each value is the mean of finer cells on `from`
  int coarse = -1;         ///< index of the coarse cells that the copy fills, among those of `to`; -1: it fills ghosts
  int rim = -1;            ///< for fluxes: index of the rim piece of `to` that the copy fills
  int axis = 0, side = 0;  ///< axis and side of that rim piece
};

/// Ghosts of a patch that lie in coarser cells: they are interpolated from these cells and their neighbours.
struct CoarseGhosts {
  grid::Box ghosts;  ///< the ghosts, as cells on the level of the patch
  grid::Box cells;   ///< cells of the coarser level
};

/// The copies and messages between patches that fill ghosts, planned once for a layout. Every rank computes its part
/// from the geometry: a receiver and a sender list the copies between them in the same order, without a message.
///
/// All values come from cells that patches own, so that one round of messages is enough for all levels.
struct GhostPlan {
  std::vector<std::vector<GhostCopy>> into;       ///< copies into each patch of this rank
  std::vector<std::vector<CoarseGhosts>> coarse;  ///< interpolated ghosts of each patch of this rank
  /// For each patch of this rank: whether no ghost comes from another rank.
  std::vector<bool> isLocal;
  std::map<int, std::vector<GhostCopy>> outgoing;  ///< copies to be sent, by destination rank
  std::set<int> incoming;                          ///< ranks from which copies come
};

/// The ghosts that a patch needs. Particles and nodes come from patches of the same level only.
struct GhostReach {
  data::Centring centring;
  int width;
  int level = -1;  ///< the only level whose patches need ghosts; -1: all levels

  friend auto operator<=>(const GhostReach&, const GhostReach&) = default;
};

/// The smallest number of cells of a block along each axis, on several levels, with which `width` layers of ghosts lie
/// in adjacent blocks of the next finer or coarser level. Ghosts in finer cells must lie within half a block of this
/// level; ghosts in coarser cells, and the cells for their slopes, must lie within half a block of the coarser level.
constexpr int fewestCellsOfBlock(int width) { return 2 * std::max(width, (width + 1) / 2 + 1); }

/// Plans ghosts: each comes from one patch, or is interpolated from the coarser cells around it.
GhostPlan planGhosts(const grid::Grid& grid, const GhostReach& reach);

/// For each patch of this rank: copies of the nodes that it does not own, from their owners.
std::vector<std::vector<GhostCopy>> planFaces(const grid::Grid& grid);

/// The plans for a layout, each made when it is first needed.
class GhostPlans {
 public:
  const GhostPlan& of(const grid::Grid& grid, GhostReach reach);
  /// Discards all plans. Must be called when the distribution of patches has changed.
  void forget() { plans_.clear(); }

 private:
  std::map<GhostReach, GhostPlan> plans_;
};

}  // namespace tushar::tasks
