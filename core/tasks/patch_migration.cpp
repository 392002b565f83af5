#include "core/tasks/patch_migration.hpp"

#include <cstring>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::tasks {

using data::Centring;
using data::Generation;
using data::ParticleRange;
using data::ParticleSet;
using data::Variable;
using grid::Box;
using grid::Patch;
using mpi::Bytes;

namespace {

/// Packs the values of patches: the particles of all patches by cell, then each variable, preceded by a byte that is
/// set if it has values.
class PatchPacker {
 public:
  PatchPacker(data::Warehouse& warehouse, const MigratedVariables& migrated)
      : warehouse_(warehouse), migrated_(migrated) {}

  void add(const std::vector<Patch>& patches, Bytes& to) {
    for (const Patch& patch : patches)
      for (int material = 0; material < migrated_.materials; ++material) addSet(patch, material, to);
    for (const Patch& patch : patches)
      for (const int number : migrated_.variables) addVariable(patch, number, to);
  }

 private:
  static bool addWhether(bool is, Bytes& to) {
    to.push_back(std::byte{is});
    return is;
  }
  void addSet(const Patch& patch, int material, Bytes& to) {
    const ParticleSet& set = warehouse_.particles(Generation::old, material, patch.id());
    if (!addWhether(set.ownedCells() == patch.cells(), to)) return;
    grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
      const std::int32_t count = set.in(cell).size();
      mpi::append(to, &count, sizeof(count));
    });
  }
  void addVariable(const Patch& patch, int number, Bytes& to) {
    const auto [label, material] = warehouse_.table()[number];
    const Variable from = warehouse_.variable(Generation::old, number, patch.id());
    if (!addWhether(from.held, to)) return;
    if (label->centring == Centring::particle) {
      const int owned = warehouse_.particles(Generation::old, material, patch.id()).owned();
      return mpi::append(to, from.values, static_cast<std::size_t>(owned) * label->bytes);
    }
    const Box own = ownBox(patch, *label);
    const std::size_t length = static_cast<std::size_t>(own.extent(0)) * label->bytes, bytes = label->bytes;
    grid::forEach<3>(own.rowStarts(), [&](const Index3& first) {
      mpi::append(to, from.values + from.stored.offset(first) * bytes, length);
    });
  }

  data::Warehouse& warehouse_;
  const MigratedVariables& migrated_;
};

/// Reads the output of a PatchPacker.
class Unpacker {
 public:
  Unpacker(data::Warehouse& warehouse, const MigratedVariables& migrated, std::vector<Patch> patches, Bytes message)
      : warehouse_(warehouse),
        migrated_(migrated),
        patches_(std::move(patches)),
        message_(std::move(message)),
        from_(message_.data()) {}

  void takeSets() {
    for (const Patch& patch : patches_)
      for (int material = 0; material < migrated_.materials; ++material) takeSet(patch, material);
  }
  /// Reads the variables, after the particles of all patches of the rank have received slots.
  void takeVariables() {
    for (const Patch& patch : patches_)
      for (const int number : migrated_.variables) takeVariable(patch, number);
  }

 private:
  void copyTo(void* to, std::size_t length) {
    std::memcpy(to, from_, length);
    from_ += length;
  }
  bool takeWhether() { return *from_++ != std::byte{0}; }
  void takeSet(const Patch& patch, int material) {
    if (!takeWhether()) return;
    ParticleSet& set = warehouse_.particles(Generation::old, material, patch.id());
    set.reset(patch, warehouse_.table().reach(material));
    int next = 0;
    grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
      std::int32_t count = 0;
      copyTo(&count, sizeof(count));
      set.put(cell, {next, next + count});
      next += count;
    });
    set.setOwned(next);
  }
  void takeVariable(const Patch& patch, int number) {
    if (!takeWhether()) return;
    const auto [label, material] = warehouse_.table()[number];
    const bool isParticle = label->centring == Centring::particle;
    if (!warehouse_.variable(Generation::old, number, patch.id()).held)
      isParticle ? warehouse_.allocateParticles(Generation::old, number, Generation::old)
                 : warehouse_.allocateGrid(Generation::old, number);
    const Variable to = warehouse_.variable(Generation::old, number, patch.id());
    const std::size_t bytes = label->bytes;
    if (isParticle) {
      const int owned = warehouse_.particles(Generation::old, material, patch.id()).owned();
      return copyTo(to.values, static_cast<std::size_t>(owned) * bytes);
    }
    const Box own = ownBox(patch, *label);
    grid::forEach<3>(own.rowStarts(), [&](const Index3& first) {
      copyTo(to.values + to.stored.offset(first) * bytes, static_cast<std::size_t>(own.extent(0)) * bytes);
    });
  }

  data::Warehouse& warehouse_;
  const MigratedVariables& migrated_;
  std::vector<Patch> patches_;
  Bytes message_;
  const std::byte* from_;
};

/// Calls `visit(rank, first, end)` for each rank that has any of the patches from `first` to `end`.
template <class Visit>
void forEachOwner(const grid::RankOffsets& offsets, int first, int end, Visit&& visit) {
  for (std::size_t rank = 0; rank + 1 < offsets.size(); ++rank)
    if (const int from = std::max(first, offsets[rank]), to = std::min(end, offsets[rank + 1]); from < to)
      visit(static_cast<int>(rank), from, to);
}

std::vector<Patch> patchesFrom(const grid::Grid& grid, int first, int end) {
  std::vector<Patch> patches;
  for (int patch = first; patch < end; ++patch) patches.push_back(grid.patch(patch));
  return patches;
}

}  // namespace

void migratePatches(grid::Grid& grid, data::Warehouse& warehouse, const MigratedVariables& migrated,
                    const grid::RankOffsets& offsets) {
  const mpi::Communicator& ranks = warehouse.ranks();
  const std::size_t me = ranks.rank();
  const grid::RankOffsets before = grid.rankOffsets();
  mpi::Outbox outbox(ranks);
  std::map<int, Bytes> parts;
  forEachOwner(offsets, before[me], before[me + 1], [&](int rank, int first, int end) {
    PatchPacker(warehouse, migrated).add(patchesFrom(grid, first, end), parts[rank]);
  });
  for (auto& [rank, bytes] : parts)
    if (rank != ranks.rank()) outbox.send(rank, mpi::Tag::patches, std::move(bytes));
  grid.share(offsets);
  warehouse.startAnew(migrated.materials);
  std::deque<Unpacker> unpackers;
  forEachOwner(before, offsets[me], offsets[me + 1], [&](int rank, int first, int end) {
    Bytes bytes = rank == ranks.rank() ? std::move(parts[rank]) : ranks.receive(rank, mpi::Tag::patches);
    unpackers.emplace_back(warehouse, migrated, patchesFrom(grid, first, end), std::move(bytes));
    unpackers.back().takeSets();
  });
  for (int material = 0; material < migrated.materials; ++material)
    warehouse.layOut(Generation::old, material, Generation::old);
  for (Unpacker& unpacker : unpackers) unpacker.takeVariables();
  outbox.wait();
}

}  // namespace tushar::tasks
