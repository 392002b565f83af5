#pragma once

#include <compare>
#include <map>
#include <set>
#include <vector>

#include "core/grid/level.hpp"

namespace tushar::tasks {

/// Ghosts of a patch that one other patch has, or the patch itself at its periodic image.
struct GhostCopy {
  int from, to;   ///< patches
  int rank;       ///< that has `from`
  grid::Box box;  ///< cells or nodes around `to`
  Index3 shift;   ///< in cells: what stands at `box` stands at `box` - shift on `from`
};

/// What moves between patches so that each has its ghosts, settled once for a layout. Every rank works out its part
/// from the geometry: a receiver and a sender list the copies between them in the same order, without a message.
struct GhostPlan {
  std::vector<std::vector<GhostCopy>> into;        ///< by patch of this rank
  std::vector<bool> isLocal;                       ///< by patch of this rank: whether it needs no other rank
  std::map<int, std::vector<GhostCopy>> outgoing;  ///< by rank that they go to
  std::set<int> incoming;                          ///< ranks that others come from
};

/// For cells (particles among them) or nodes within `width` of each patch. Each ghost comes from one patch.
GhostPlan planGhosts(const grid::Level& level, bool nodes, int width);

/// Nodes that patches of this rank have and do not own, by patch: each from one that does.
std::vector<std::vector<GhostCopy>> planFaces(const grid::Level& level);

/// Which ghosts a patch needs.
struct GhostReach {
  bool nodes;
  int width;

  friend auto operator<=>(const GhostReach&, const GhostReach&) = default;
};

/// The plans of a layout, each made when it is asked for.
class GhostPlans {
 public:
  const GhostPlan& of(const grid::Level& level, const GhostReach& reach);
  /// To be called when the distribution of patches has changed.
  void forget() { plans_.clear(); }

 private:
  std::map<GhostReach, GhostPlan> plans_;
};

}  // namespace tushar::tasks
