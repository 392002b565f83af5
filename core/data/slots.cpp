#include "core/data/slots.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/data/label.hpp"

namespace tushar::data {

namespace {

/// Slots start at multiples of this number of values, and hence at a cache line, whatever the size of a value.
constexpr std::size_t step = 16;

std::size_t roundedUp(std::size_t count) { return (count + step - 1) / step * step; }

void append(Slots& slots, std::size_t place, std::size_t room) {
  slots.first[place] = slots.end;
  slots.room[place] = room;
  slots.end += room;
}

/// Size of a slot for a number of particles, including spare space.
std::size_t roomFor(std::size_t count) { return roundedUp(count + count / 64 + step); }

SharedSlots laidOutAnew(const std::vector<std::size_t>& counts) {
  Slots slots;
  slots.first.resize(counts.size());
  slots.room.resize(counts.size());
  for (std::size_t place = 0; place < counts.size(); ++place) append(slots, place, roomFor(counts[place]));
  return std::make_shared<const Slots>(std::move(slots));
}

}  // namespace

bool Slots::extends(const Slots& other) const {
  if (first.size() != other.first.size() || end < other.end) return false;
  for (std::size_t place = 0; place < first.size(); ++place) {
    const bool stays = first[place] == other.first[place];
    if (stays ? room[place] > other.room[place] : first[place] < other.end) return false;
  }
  return true;
}

SharedSlots slotsOfGrid(const grid::Grid& grid, const Label& label, int ghost) {
  Slots slots;
  for (const grid::Patch& patch : grid.patches()) {
    slots.stored.push_back(label.centring == Centring::node ? patch.nodesWithin(ghost) : patch.cellsWithin(ghost));
    slots.first.push_back(slots.end);
    slots.end += roundedUp(slots.stored.back().size());
  }
  return std::make_shared<const Slots>(std::move(slots));
}

SharedSlots slotsOfRims(const grid::Grid& grid) {
  Slots slots;
  for (const grid::Patch& patch : grid.patches()) {
    slots.first.push_back(slots.end);
    slots.end += roundedUp(grid::sizeOf(grid.rims(patch.id())));
  }
  return std::make_shared<const Slots>(std::move(slots));
}

SharedSlots slotsThatFit(const SharedSlots& base, const std::vector<std::size_t>& counts) {
  if (!base || base->first.size() != counts.size()) return laidOutAnew(counts);
  if (std::equal(counts.begin(), counts.end(), base->room.begin(), std::less_equal<>())) return base;
  Slots slots = *base;
  std::size_t needed = 0;
  for (std::size_t place = 0; place < counts.size(); ++place) {
    needed += roomFor(counts[place]);
    if (counts[place] > slots.room[place]) append(slots, place, roundedUp(counts[place] + counts[place] / 8 + step));
  }
  if (slots.end > needed + needed / 4) return laidOutAnew(counts);
  return std::make_shared<const Slots>(std::move(slots));
}

}  // namespace tushar::data
