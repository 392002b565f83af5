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
  forEachPatch([&](const Patch& patch) {
    PatchMoves& ofPatch = of(moves, patch.id());
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
    for (int k = 0; k < rowLength; ++k) {
      k += keepCells(moves, {from + k, from + rowLength}, firstIncoming + k, nextDeparted, to + k);
      if (k == rowLength) break;
      const int first = moves.count;
      mergeCell(moves, from[k], firstIncoming[k], ids, nextDeparted);
      to[k] = {first, moves.count};
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
void Relocation::keep(PatchMoves& moves, int first, int count) {
  if (count == 0) return;
  Run* last = moves.runs.empty() ? nullptr : &moves.runs.back();
  if (last && last->from + last->count == first && last->to + last->count == moves.count)
    last->count += count;
  else
    moves.runs.push_back({moves.count, first, count});
  moves.count += count;
  moves.furthest = std::max(moves.furthest, first + count - 1);
}

int Relocation::keepCells(PatchMoves& moves, std::span<const ParticleRange> from, const int* firstIncoming,
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

/// Appends an incoming particle. It is kept where it is if it has come from the patch itself, to the index that it had,
/// and all particles before it have only changed places among themselves: then no other move crosses its place.
void Relocation::letIn(PatchMoves& moves, int incoming) {
  const int departed = moves.incoming[incoming].from;
  const int from = departed < 0 ? std::numeric_limits<int>::max() : moves.departed[departed];
  if (from == moves.count && moves.furthest < from) return keep(moves, from, 1);
  moves.furthest = std::max(moves.furthest, from);
  moves.entries.push_back({moves.count++, incoming});
}

/// Appends the particles of one cell, in the order of their ids: those that stay, and those that enter.
void Relocation::mergeCell(PatchMoves& moves, const ParticleRange& before, int firstIncoming, const ParticleId* ids,
                           std::size_t& nextDeparted) {
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

/// Moves a variable to its new slots, within its memory if it is already in generation `to` and the slots allow this.
void Relocation::carry(const Carried& carried, std::size_t place, Generation to, int material, Moves& moves) {
  const data::SharedSlots& after = warehouse_->slotsOfSets(Generation::fresh, material);
  const data::SharedSlots& current = warehouse_->slots(carried.from, carried.variable);
  const data::SharedSlots outdated = current == after ? nullptr : current;
  data::Buffer outgrown;
  if (carried.from == to)
    outgrown = warehouse_->follow(to, carried.variable, Generation::fresh);
  else
    warehouse_->allocateParticles(to, carried.variable, Generation::fresh);
  const std::size_t bytes = warehouse_->table()[carried.variable].label->bytes;
  data::Buffer packed;
  if (moves.packed > 0) packed = warehouse_->lend(moves.packed * bytes);
  const std::byte* from =
      outgrown.capacity() > 0 ? outgrown.data() : warehouse_->memory(carried.from, carried.variable);
  const Move move{.bytes = bytes,
                  .from = from,
                  .to = warehouse_->memory(to, carried.variable),
                  .before = outdated ? outdated.get() : after.get(),
                  .after = after.get(),
                  .migrants = moves.migration.values(place),
                  .packed = packed.data()};
  const bool isInPlace = from == move.to && !outdated;
  const auto placeOf = [&](const Patch& patch) {
    return static_cast<std::size_t>(patch.id() - warehouse_->grid().firstPatch());
  };
  const auto keepsIndices = [&](const Patch& patch) { return of(moves, patch.id()).keepsIndices(); };
  if (moves.packed > 0)
    forEachPatch([&](const Patch& patch) {
      if (!keepsIndices(patch)) pack(move, placeOf(patch), of(moves, patch.id()));
    });
  forEachPatch([&](const Patch& patch) {
    if (!isInPlace || !keepsIndices(patch)) moveOn(move, placeOf(patch), moves);
  });
  warehouse_->takeBack(packed);
  warehouse_->takeBack(outgrown);
}

void Relocation::pack(const Move& move, std::size_t place, const PatchMoves& moves) {
  const std::byte* from = move.from + move.before->first[place] * move.bytes;
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
  moveRuns(moves.runs, move.from + move.before->first[place] * move.bytes, values, move.bytes);
  const std::byte* packed = move.packed + moves.packed * move.bytes;
  withSize(move.bytes, [&](auto bytes) {
    for (const Entry& entry : moves.entries) {
      const int source = moves.incoming[entry.incoming].from;
      const std::byte* from = nullptr;
      if (source >= 0) {
        from = packed + static_cast<std::size_t>(source) * bytes;
      } else {
        const Arrival& arrival = moves.arrivals[-1 - source];
        const std::size_t at = arrival.place;
        from =
            arrival.patch < 0 ? move.migrants + at * bytes : move.packed + (of(all, arrival.patch).packed + at) * bytes;
      }
      std::memcpy(values + static_cast<std::size_t>(entry.to) * bytes, from, bytes);
    }
  });
}

}  // namespace tushar::tasks
