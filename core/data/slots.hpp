#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/grid/grid.hpp"

namespace tushar::data {

struct Label;

/// The positions of a rank's patches in the single buffer of a variable, counted in values. Each patch has a slot;
/// copies of particles whose original is on another rank or one period away follow after the last slot.
///
/// A layout never changes: variables with the same layout share it, and if particles need other slots, a new layout is
/// made.
struct Slots {
  std::vector<std::size_t> first;  ///< start of each slot, indexed by the patch on its rank
  std::vector<std::size_t> room;   ///< for particles: capacity of each slot
  std::vector<grid::Box> stored;   ///< for nodes and cells: the box in each slot, including ghosts
  std::size_t end = 0;             ///< end of the last slot

  /// Whether particles can move from the slots `other` to these slots within the same memory, so that no patch
  /// overwrites values that another patch has not moved yet. Each slot must either start where the patch's slot in
  /// `other` starts, and not be larger, or lie behind all slots of `other`.
  bool extends(const Slots& other) const;
};

using SharedSlots = std::shared_ptr<const Slots>;

/// Slots for a node or cell variable that is read with `ghost` layers around each patch.
SharedSlots slotsOfGrid(const grid::Grid& grid, const Label& label, int ghost);
/// Slots for the faces of patches beyond which other levels begin.
SharedSlots slotsOfRims(const grid::Grid& grid);

/// Slots for given numbers of particles on each patch. Slots of `base` (which may be null) stay where the particles
/// fit; a patch that has outgrown its slot gets one behind the others, with room for an eighth more. If the memory
/// would then be more than a quarter larger than necessary, all slots are laid out anew.
SharedSlots slotsThatFit(const SharedSlots& base, const std::vector<std::size_t>& counts);

}  // namespace tushar::data
