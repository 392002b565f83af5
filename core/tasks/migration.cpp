#include "core/tasks/migration.hpp"

#include <cstring>
#include <map>

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

/// Writes what stands on patches: particles by cell, then each variable, behind a byte that says whether there is one.
class Packer {
 public:
  Packer(data::Warehouse& warehouse, const Luggage& luggage) : warehouse_(warehouse), luggage_(luggage) {}

  void add(const Patch& patch, Bytes& to) {
    for (int material = 0; material < luggage_.materials; ++material) addSet(patch, material, to);
    for (const int number : luggage_.variables) addVariable(patch, number, to);
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
    const Variable& from = warehouse_.variable(Generation::old, number, patch.id());
    if (!addWhether(from.held, to)) return;
    if (label->centring == Centring::particle) {
      const int owned = warehouse_.particles(Generation::old, material, patch.id()).owned();
      return mpi::append(to, from.values.data(), static_cast<std::size_t>(owned) * label->bytes);
    }
    const Box own = ownBox(patch, *label);
    const std::size_t length = static_cast<std::size_t>(own.extent(0)) * label->bytes, bytes = label->bytes;
    grid::forEach<3>(own.rowStarts(), [&](const Index3& first) {
      mpi::append(to, from.values.data() + from.stored.offset(first) * bytes, length);
    });
  }

  data::Warehouse& warehouse_;
  const Luggage& luggage_;
};

/// Reads what a Packer has written.
class Unpacker {
 public:
  Unpacker(data::Warehouse& warehouse, const Luggage& luggage, const Bytes& from)
      : warehouse_(warehouse), luggage_(luggage), from_(from.data()) {}

  void take(const Patch& patch) {
    for (int material = 0; material < luggage_.materials; ++material) takeSet(patch, material);
    for (const int number : luggage_.variables) takeVariable(patch, number);
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
      set.at(cell) = {next, next + count};
      next += count;
    });
    set.setOwned(next);
  }
  void takeVariable(const Patch& patch, int number) {
    if (!takeWhether()) return;
    const auto [label, material] = warehouse_.table()[number];
    Variable& to = warehouse_.variable(Generation::old, number, patch.id());
    const std::size_t bytes = label->bytes;
    if (label->centring == Centring::particle) {
      const int owned = warehouse_.particles(Generation::old, material, patch.id()).owned();
      warehouse_.allocateParticles(to, *label, owned);
      return copyTo(to.values.data(), static_cast<std::size_t>(owned) * bytes);
    }
    const Box own = ownBox(patch, *label);
    warehouse_.allocateGrid(to, number, patch);
    grid::forEach<3>(own.rowStarts(), [&](const Index3& first) {
      copyTo(to.values.data() + to.stored.offset(first) * bytes, static_cast<std::size_t>(own.extent(0)) * bytes);
    });
  }

  data::Warehouse& warehouse_;
  const Luggage& luggage_;
  const std::byte* from_;
};

/// Calls `visit(rank, first, end)` for each rank that has some of the patches from `first` to `end`.
template <class Visit>
void forEachOwner(const grid::Firsts& firsts, int first, int end, Visit&& visit) {
  for (std::size_t rank = 0; rank + 1 < firsts.size(); ++rank)
    if (const int from = std::max(first, firsts[rank]), to = std::min(end, firsts[rank + 1]); from < to)
      visit(static_cast<int>(rank), from, to);
}

}  // namespace

void migrate(grid::Level& level, data::Warehouse& warehouse, const Luggage& luggage, const grid::Firsts& firsts) {
  const mpi::Communicator& ranks = warehouse.ranks();
  const auto me = static_cast<std::size_t>(ranks.rank());
  const grid::Firsts before = level.firsts();
  mpi::Outbox outbox(ranks);
  std::map<int, Bytes> parts;
  forEachOwner(firsts, before[me], before[me + 1], [&](int rank, int first, int end) {
    Packer packer(warehouse, luggage);
    for (int patch = first; patch < end; ++patch) packer.add(level.patch(patch), parts[rank]);
  });
  for (auto& [rank, bytes] : parts)
    if (rank != ranks.rank()) outbox.send(rank, mpi::Tag::patches, std::move(bytes));
  level.share(firsts);
  warehouse.startAnew(luggage.materials);
  forEachOwner(before, firsts[me], firsts[me + 1], [&](int rank, int first, int end) {
    const Bytes bytes = rank == ranks.rank() ? std::move(parts[rank]) : ranks.receive(rank, mpi::Tag::patches);
    Unpacker unpacker(warehouse, luggage, bytes);
    for (int patch = first; patch < end; ++patch) unpacker.take(level.patch(patch));
  });
  outbox.wait();
}

}  // namespace tushar::tasks
