#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "core/tasks/move_runs.hpp"
#include "core/tasks/relocation.hpp"

// How Relocation makes the moves that it has found: it builds the new particle sets, and variables follow them.

namespace tushar::tasks {

using data::Generation;
using data::ParticleRange;
using data::ParticleSet;
using grid::Patch;

namespace {

/// Makes the old set the new one, unchanged.
void keepSet(data::Warehouse& warehouse, int material, const Patch& patch) {
  ParticleSet& before = warehouse.particles(Generation::old, material, patch.id());
  before.forgetGhosts();
  std::swap(before, warehouse.particles(Generation::fresh, material, patch.id()));
}

}  // namespace

void Relocation::apply(int material, const std::vector<Carried>& carried, Generation to) {
  Moves& moves = movesOf(material);
  moves.migration.run(carried, moves.goFar);
  receiveAll(moves);
  moves.toNewMemory = isFasterInNewMemory(material, moves);
  forEachPatch([&](const Patch& patch) {
    PatchMoves& ofPatch = of(moves, patch.id());
    ofPatch.toNewMemory = moves.toNewMemory;
    if (!ofPatch.staysAsItIs(to)) return rebuild(patch, material, ofPatch);
    keepSet(*warehouse_, material, patch);
    keepAll(ofPatch, warehouse_->particles(Generation::fresh, material, patch.id()).owned());
  });
  warehouse_->layOut(Generation::fresh, material, Generation::old);
  const auto stands = [&](const PatchMoves& ofPatch) { return ofPatch.staysAsItIs(to); };
  if (std::all_of(moves.patches.begin(), moves.patches.end(), stands)) return;
  moves.packed = 0;
  for (PatchMoves& ofPatch : moves.patches) {
    const std::size_t count = ofPatch.keepsIndices() ? 0 : ofPatch.departed.size();
    ofPatch.packed = std::exchange(moves.packed, moves.packed + count);
  }
  for (std::size_t place = 0; place < carried.size(); ++place) carry(carried[place], place, to, material, moves);
}

bool Relocation::isFasterInNewMemory(int material, const Moves& moves) const {
  long particles = 0, crossing = 0;
  for (const Patch& patch : warehouse_->grid().patches())
    particles += warehouse_->particles(Generation::old, material, patch.id()).owned();
  for (const PatchMoves& ofPatch : moves.patches) crossing += ofPatch.crossing;
  return crossing > particles / 8;
}

void Relocation::receiveAll(Moves& moves) {
  const grid::Grid& grid = warehouse_->grid();
  const auto receiveAt = [&](ParticleId id, const Index3& cell, const Arrival& from) {
    const Patch to = grid.patchOf(cell, grid.finest().number());
    if (!grid.isMine(to.id())) return;
    PatchMoves& there = of(moves, to.id());
    there.arrivals.push_back(from);
    receive(to, cell, {id, -static_cast<int>(there.arrivals.size()), -1}, there);
  };
  for (const Patch& patch : grid.patches())
    for (const Outgoing& one : of(moves, patch.id()).outgoing) receiveAt(one.id, one.cell, {patch.id(), one.departed});
  const std::vector<MigratingParticle>& arrived = moves.migration.arrived();
  for (std::size_t k = 0; k < arrived.size(); ++k) receiveAt(arrived[k].id, arrived[k].cell, {-1, static_cast<int>(k)});
}

void Relocation::rebuild(const Patch& patch, int material, PatchMoves& moves) {
  const ParticleSet& before = warehouse_->particles(Generation::old, material, patch.id());
  ParticleSet& after = warehouse_->particles(Generation::fresh, material, patch.id());
  const auto* ids = reinterpret_cast<const ParticleId*>(
      warehouse_->variable(Generation::old, moves_[material].id, patch.id()).values);
  after.reset(patch, warehouse_->table().reach(material));
  after.makeSpaceFor(before);
  moves.runs.clear();
  moves.entries.clear();
  moves.entries.reserve(moves.incoming.size());
  moves.count = 0;
  moves.furthest = -1;
  std::size_t nextDeparted = 0;
  const int rowLength = patch.cells().extent(0);
  grid::forEach<3>(patch.cells().rowStarts(), [&](const Index3& cell) {
    const std::size_t row = patch.cells().rowOf(cell);
    if (!moves.firstIncoming.isOpen(row) && before.occupied(cell, patch.cells().upper[0]).empty()) return;
    const ParticleRange* from = before.row(cell);
    ParticleRange* to = after.openRow(cell);
    const int* firstIncoming = moves.firstIncoming[row];
    const auto changes = [&](int k) {
      return firstIncoming[k] >= 0 ||
             (nextDeparted < moves.departed.size() && moves.departed[nextDeparted] < from[k].last);
    };
    for (int k = 0; k < rowLength;) {
      k += keepCells(moves, {from + k, from + rowLength}, firstIncoming + k, nextDeparted, to + k);
      for (; k < rowLength && changes(k); ++k) {
        const int first = moves.count;
        mergeCell(moves, from[k], firstIncoming[k], ids, nextDeparted);
        to[k] = {first, moves.count};
      }
    }
    after.closeRow(cell);
  });
  after.setOwnedOfClosedRows(moves.count);
}

/// Keeps all particles of a patch at their indices.
void Relocation::keepAll(PatchMoves& moves, int count) {
  moves.runs.clear();
  moves.entries.clear();
  moves.count = 0;
  moves.furthest = -1;
  keep(moves, 0, count);
}

/// Appends particles that stay and were consecutive before; they remain consecutive.
inline void Relocation::keep(PatchMoves& moves, int first, int count) {
  if (count == 0) return;
  Run* last = moves.runs.empty() ? nullptr : &moves.runs.back();
  if (last && last->from + last->count == first && last->to + last->count == moves.count)
    last->count += count;
  else
    moves.runs.push_back({moves.count, first, count});
  moves.count += count;
  moves.furthest = std::max(moves.furthest, first + count - 1);
}

inline int Relocation::keepCells(PatchMoves& moves, std::span<const ParticleRange> from, const int* firstIncoming,
                                 std::size_t nextDeparted, ParticleRange* to) {
  const int leaves =
      nextDeparted < moves.departed.size() ? moves.departed[nextDeparted] : std::numeric_limits<int>::max();
  const int cells = static_cast<int>(from.size());
  int k = 0, count = moves.count, first = 0;
  for (; k < cells && from[k].last <= leaves && firstIncoming[k] < 0; ++k) {
    if (count == moves.count) first = from[k].first;
    to[k].first = count;
    to[k].last = count += from[k].size();
  }
  keep(moves, first, count - moves.count);
  return k;
}

/// Appends an incoming particle. Within the same memory, it is kept where it is if it has come from the patch itself,
/// to the index that it had, and all particles before it have only changed places among themselves: then no other move
/// crosses its place.
inline void Relocation::letIn(PatchMoves& moves, int incoming) {
  const int departed = moves.incoming[incoming].from;
  const int from = departed < 0 ? std::numeric_limits<int>::max() : moves.departed[departed];
  const bool isKept = moves.toNewMemory ? departed >= 0 : from == moves.count && moves.furthest < from;
  if (isKept) return keep(moves, from, 1);
  moves.furthest = std::max(moves.furthest, from);
  moves.entries.push_back({moves.count++, incoming});
}

/// Appends the particles of one cell, in the order of their ids: those that stay, and those that enter.
inline void Relocation::mergeCell(PatchMoves& moves, const ParticleRange& before, int firstIncoming,
                                  const ParticleId* ids, std::size_t& nextDeparted) {
  int waiting = firstIncoming;
  const auto letInOne = [&] {
    letIn(moves, waiting);
    waiting = moves.incoming[waiting].next;
  };
  for (int p = before.first; p < before.last; ++p) {
    if (nextDeparted < moves.departed.size() && moves.departed[nextDeparted] == p) {
      ++nextDeparted;
      continue;
    }
    while (waiting >= 0 && moves.incoming[waiting].id < ids[p]) letInOne();
    keep(moves, p, 1);
  }
  while (waiting >= 0) letInOne();
}

/// Moves a variable to its new slots, within its memory if it is already in generation `to`, the slots allow this, and
/// it is faster.
void Relocation::carry(const Carried& carried, std::size_t place, Generation to, int material, Moves& moves) {
  const data::SharedSlots& after = warehouse_->slotsOfSets(Generation::fresh, material);
  const data::SharedSlots& current = warehouse_->slots(carried.from, carried.variable);
  const data::SharedSlots outdated = current == after ? nullptr : current;
  data::Buffer before;
  if (carried.from != to)
    warehouse_->allocateParticles(to, carried.variable, Generation::fresh);
  else if (moves.toNewMemory)
    before = warehouse_->renew(to, carried.variable, Generation::fresh);
  else
    before = warehouse_->follow(to, carried.variable, Generation::fresh);
  const std::byte* from = before.capacity() > 0 ? before.data() : warehouse_->memory(carried.from, carried.variable);
  const std::size_t bytes = warehouse_->table()[carried.variable].label->bytes;
  Move move{.bytes = bytes,
            .from = from,
            .to = warehouse_->memory(to, carried.variable),
            .before = outdated ? outdated.get() : after.get(),
            .after = after.get(),
            .migrants = moves.migration.values(place),
            .packed = nullptr};
  const bool isSameMemory = from == move.to, isInPlace = isSameMemory && !outdated;
  const auto placeOf = [&](const Patch& patch) {
    return static_cast<std::size_t>(patch.id() - warehouse_->grid().firstPatch());
  };
  const auto keepsIndices = [&](const Patch& patch) { return of(moves, patch.id()).keepsIndices(); };
  data::Buffer packed;
  if (isSameMemory && moves.packed > 0) {
    packed = warehouse_->lend(moves.packed * bytes);
    move.packed = packed.data();
    forEachPatch([&](const Patch& patch) {
      if (!keepsIndices(patch)) pack(move, placeOf(patch), of(moves, patch.id()));
    });
  }
  forEachPatch([&](const Patch& patch) {
    if (!isInPlace || !keepsIndices(patch)) moveOn(move, placeOf(patch), moves);
  });
  warehouse_->takeBack(packed);
  warehouse_->takeBack(before);
}

void Relocation::pack(const Move& move, std::size_t place, const PatchMoves& moves) {
  const std::byte* from = move.ofPatch(place);
  std::byte* to = move.packed + moves.packed * move.bytes;
  withSize(move.bytes, [&](auto bytes) {
    for (const int one : moves.departed) {
      std::memcpy(to, from + static_cast<std::size_t>(one) * bytes, bytes);
      to += bytes;
    }
  });
}

void Relocation::moveOn(const Move& move, std::size_t place, Moves& all) {
  const PatchMoves& moves = all.patches[place];
  std::byte* values = move.to + move.after->first[place] * move.bytes;
  moveRuns(moves.runs, move.ofPatch(place), values, move.bytes);
  const auto departed = [&](std::size_t patch, std::size_t at) {
    const PatchMoves& from = all.patches[patch];
    return move.packed ? move.packed + (from.packed + at) * move.bytes
                       : move.ofPatch(patch) + static_cast<std::size_t>(from.departed[at]) * move.bytes;
  };
  withSize(move.bytes, [&](auto bytes) {
    for (const Entry& entry : moves.entries) {
      const int source = moves.incoming[entry.incoming].from;
      const std::byte* from = nullptr;
      if (source >= 0) {
        from = departed(place, static_cast<std::size_t>(source));
      } else {
        const Arrival& arrival = moves.arrivals[-1 - source];
        const std::size_t at = static_cast<std::size_t>(arrival.place);
        from = arrival.patch < 0
                   ? move.migrants + at * bytes
                   : departed(static_cast<std::size_t>(arrival.patch - warehouse_->grid().firstPatch()), at);
      }
      std::memcpy(values + static_cast<std::size_t>(entry.to) * bytes, from, bytes);
    }
  });
}

}  // namespace tushar::tasks
