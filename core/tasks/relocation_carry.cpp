#include <cstring>

#include "core/tasks/move_runs.hpp"
#include "core/tasks/relocation.hpp"

// How Relocation brings variables along.

namespace tushar::tasks {

using data::Generation;
using grid::Patch;

/// What is in its generation already moves within its memory, where the slots allow it.
void Relocation::carry(const Carried& carried, std::size_t place, Generation to, int material, Moves& moves) {
  const data::SharedSlots before = warehouse_->slots(carried.from, carried.variable);
  const data::SharedSlots after = warehouse_->slotsOfSets(Generation::fresh, material);
  data::Buffer outgrown;
  if (carried.from == to)
    outgrown = warehouse_->follow(to, carried.variable, Generation::fresh);
  else
    warehouse_->allocateParticles(to, carried.variable, Generation::fresh);
  const std::size_t bytes = warehouse_->table()[carried.variable].label->bytes;
  data::Buffer packed = warehouse_->lend(moves.departed * bytes);
  const std::byte* from =
      outgrown.capacity() > 0 ? outgrown.data() : warehouse_->memory(carried.from, carried.variable);
  const Move move{.bytes = bytes,
                  .from = from,
                  .to = warehouse_->memory(to, carried.variable),
                  .before = before.get(),
                  .after = after.get(),
                  .migrants = moves.migration.values(place),
                  .packed = packed.data()};
  const bool isInPlace = from == move.to;
  const auto placeOf = [&](const Patch& patch) {
    return static_cast<std::size_t>(patch.id() - warehouse_->level().firstPatch());
  };
  const auto stands = [&](const Patch& patch) { return isInPlace && of(moves, patch.id()).staysAsItIs(to); };
  if (moves.departed > 0) forEachPatch([&](const Patch& patch) { pack(move, placeOf(patch), of(moves, patch.id())); });
  forEachPatch([&](const Patch& patch) {
    if (!stands(patch)) moveOn(move, placeOf(patch), moves);
  });
  warehouse_->takeBack(packed);
  warehouse_->takeBack(outgrown);
}

void Relocation::pack(const Move& move, std::size_t place, const PatchMoves& moves) {
  const std::byte* from = move.from + move.before->first[place] * move.bytes;
  std::byte* to = move.packed + moves.packed * move.bytes;
  for (const int one : moves.departed) {
    std::memcpy(to, from + static_cast<std::size_t>(one) * move.bytes, move.bytes);
    to += move.bytes;
  }
}

void Relocation::moveOn(const Move& move, std::size_t place, Moves& all) {
  const PatchMoves& moves = all.patches[place];
  std::byte* values = move.to + move.after->first[place] * move.bytes;
  moveRuns(moves.runs, move.from + move.before->first[place] * move.bytes, values, move.bytes);
  for (const Entry& entry : moves.entries) {
    const int source = moves.incoming[entry.incoming].from;
    const std::byte* from = nullptr;
    if (source >= 0) {
      from = move.packed + (moves.packed + static_cast<std::size_t>(source)) * move.bytes;
    } else {
      const Arrival& arrival = moves.arrivals[-1 - source];
      const auto at = static_cast<std::size_t>(arrival.place);
      from = arrival.patch < 0 ? move.migrants + at * move.bytes
                               : move.packed + (of(all, arrival.patch).packed + at) * move.bytes;
    }
    std::memcpy(values + static_cast<std::size_t>(entry.to) * move.bytes, from, move.bytes);
  }
}

}  // namespace tushar::tasks
