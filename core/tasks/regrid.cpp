#include "core/tasks/regrid.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/tasks/copy_cells.hpp"
#include "core/tasks/transfer.hpp"

namespace tushar::tasks {

using data::Centring;
using data::Generation;
using data::ParticleSet;
using data::Variable;
using grid::Box;
using grid::Tile;
using mpi::Bytes;

namespace {

/// Cells of a new patch whose values come from one old patch.
struct Piece {
  int from, to;
  Box box;        ///< box of cells of the new patch
  int coarser;    ///< number of levels by which the new cells are coarser; -1: one level finer
  bool isFinest;  ///< whether the new patch is on the finest level
};

/// The pieces of which the new patches consist.
class Pieces {
 public:
  Pieces(const grid::Tiling& before, const grid::Tiling& after, int dimension, int levels)
      : before_(before), after_(after), dimension_(dimension), levels_(levels) {}

  /// Calls `visit(piece)` for each piece of a new patch, in an order that does not depend on the rank. Searches the old
  /// levels from coarse to fine until all cells are found, because a search on the finest level alone would visit too
  /// many blocks.
  template <class Visit>
  void of(int to, const Visit& visit) const {
    const Tile tile = after_.tile(to);
    std::size_t found = 0;
    const auto add = [&](const Tile& old, Box box, int coarser) {
      box = box.intersect(tile.cells);
      found += box.size();
      visit(Piece{old.id, to, box, coarser, tile.level + 1 == levels_});
    };
    if (tile.level > 0)
      for (const Tile& old : before_.overlapping(tile.level - 1, tile.cells.coarsened(dimension_)))
        add(old, old.cells.refined(dimension_), -1);
    Box cells = tile.cells;
    for (int finer = 0; found < tile.cells.size() && tile.level + finer < levels_;
         ++finer, cells = cells.refined(dimension_))
      for (const Tile& old : before_.overlapping(tile.level + finer, cells)) {
        Box box = old.cells;
        for (int k = 0; k < finer; ++k) box = box.coarsened(dimension_);
        add(old, box, finer);
      }
  }

  /// Finds the new patches that need cells of an old one.
  void findReaders(const grid::Patch& old, std::set<int>& readers) const {
    const int level = old.level().number();
    Box cells = old.cells();
    for (int at = level; at >= 0; --at, cells = cells.coarsened(dimension_))
      for (const Tile& tile : after_.overlapping(at, cells)) readers.insert(tile.id);
    if (level + 1 < levels_)
      for (const Tile& tile : after_.overlapping(level + 1, old.cells().refined(dimension_))) readers.insert(tile.id);
  }

 private:
  const grid::Tiling& before_;
  const grid::Tiling& after_;
  int dimension_, levels_;
};

/// Computes the means of cells several levels finer.
Bytes meansOf(const data::Label& label, int dimension, const Piece& piece, const Variable& old) {
  CellValues fine{old.values, old.stored};
  Bytes means;
  for (int level = piece.coarser - 1; level >= 0; --level) {
    Box box = piece.box;
    for (int k = 0; k < level; ++k) box = box.refined(dimension);
    Bytes coarse(box.size() * label.bytes);
    restrictTo(label, dimension, box, fine, {coarse.data(), box});
    means = std::move(coarse);
    fine = {means.data(), box};
  }
  return means;
}

/// Appends the values of the cells of a piece, x fastest. Values in a message need not be aligned, so they are computed
/// in other memory and then copied.
void pack(const data::Label& label, int dimension, const Piece& piece, const Variable& old, Bytes& to) {
  if (piece.coarser == 0) {
    const std::size_t before = to.size();
    to.resize(before + piece.box.size() * label.bytes);
    return copyCells(piece.box, {}, label.bytes, {old.values, old.stored}, {to.data() + before, piece.box});
  }
  if (piece.coarser > 0) {
    const Bytes means = meansOf(label, dimension, piece, old);
    return mpi::append(to, means.data(), means.size());
  }
  thread_local Bytes finer;
  const std::size_t bytes = piece.box.size() * label.bytes;
  if (finer.size() < bytes) finer.resize(bytes);
  prolong(label, dimension, {old.values, old.stored}, piece.box, {finer.data(), piece.box});
  mpi::append(to, finer.data(), bytes);
}

void unpack(const data::Label& label, const Piece& piece, const Variable& to, const std::byte*& from) {
  copyCells(piece.box, {}, label.bytes, {from, piece.box}, {to.values, to.stored});
  from += piece.box.size() * label.bytes;
}

/// The variables to be transferred, and how they are packed; particles are on the finest level only, and remain there.
class MigratedData {
 public:
  MigratedData(data::Warehouse& warehouse, const MigratedVariables& variables)
      : warehouse_(warehouse), materials_(variables.materials) {
    for (const int number : variables.variables) {
      const Centring centring = label(number).centring;
      if (centring != Centring::node && warehouse.isHeld(Generation::old, number))
        (centring == Centring::cell ? cells_ : particles_).push_back(number);
    }
    if (particles_.empty()) materials_ = 0;  // such as gases that share cells: none has sets of particles
  }

  /// Allocates the cell variables on all patches.
  void allocate() const {
    for (const int number : cells_) warehouse_.allocateGrid(Generation::old, number);
  }
  /// Allocates the particle variables, after their sets have been created.
  void allocateParticles() const {
    for (int material = 0; material < materials_; ++material)
      warehouse_.layOut(Generation::old, material, Generation::old);
    for (const int number : particles_) warehouse_.allocateParticles(Generation::old, number, Generation::old);
  }

  /// Packs the number of particles in each cell of a piece.
  void packCounts(const Piece& piece, Bytes& to) const {
    forEachSet(piece, piece.from, [&](const ParticleSet& set) {
      grid::forEach<3>(piece.box, [&](const Index3& cell) {
        const std::int32_t count = set.in(cell).size();
        mpi::append(to, &count, sizeof(count));
      });
    });
  }
  void packValues(const Piece& piece, Bytes& to) const {
    std::map<int, Bytes> together;  // values of variables that are interpolated together
    if (piece.coarser < 0) interpolateTogether(piece, together);
    for (const int number : cells_)
      if (const auto found = together.find(number); found != together.end())
        mpi::append(to, found->second.data(), found->second.size());
      else
        pack(label(number), warehouse_.grid().dimension(), piece, variable(number, piece.from), to);
    if (!hasParticles(piece)) return;
    for (const int number : particles_)
      forEachRange(piece, piece.from, number,
                   [&](std::byte* values, std::size_t length) { mpi::append(to, values, length); });
  }
  /// Reads the numbers of particles; all must be known before particles get their indices.
  void unpackCounts(const Piece& piece, const std::byte*& from) const {
    forEachSet(piece, piece.to, [&](ParticleSet& set) {
      grid::forEach<3>(piece.box, [&](const Index3& cell) {
        std::int32_t count = 0;
        std::memcpy(&count, from, sizeof(count));
        from += sizeof(count);
        set.put(cell, {0, count});
      });
    });
  }
  void unpackValues(const Piece& piece, const std::byte*& from) const {
    for (const int number : cells_) unpack(label(number), piece, variable(number, piece.to), from);
    if (!hasParticles(piece)) return;
    for (const int number : particles_)
      forEachRange(piece, piece.to, number, [&](std::byte* values, std::size_t length) {
        std::memcpy(values, from, length);
        from += length;
      });
  }

  /// Number of particles in a piece.
  int particlesOf(const Piece& piece) const {
    int count = 0;
    forEachSet(piece, piece.from, [&](const ParticleSet& set) {
      grid::forEach<3>(piece.box, [&](const Index3& cell) { count += set.in(cell).size(); });
    });
    return count;
  }
  bool hasMaterials() const { return materials_ > 0; }
  /// Size of all variables of a cell [bytes].
  std::size_t bytesOfCell() const {
    std::size_t bytes = 0;
    for (const int number : cells_) bytes += label(number).bytes;
    return bytes;
  }

  void beginSets() const {
    for (int material = 0; material < materials_; ++material)
      for (const grid::Patch& patch : warehouse_.grid().patches())
        warehouse_.particles(Generation::old, material, patch.id()).reset(patch, warehouse_.table().reach(material));
  }
  /// Assigns indices to the particles of each patch, cell by cell.
  void endSets() const {
    for (int material = 0; material < materials_; ++material)
      for (const grid::Patch& patch : warehouse_.grid().patches()) {
        ParticleSet& set = warehouse_.particles(Generation::old, material, patch.id());
        int next = 0;
        grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
          const int count = set.in(cell).size();
          set.put(cell, {next, next + count});
          next += count;
        });
        set.setOwned(next);
      }
  }

 private:
  const data::Label& label(int number) const { return *warehouse_.table()[number].label; }
  Variable variable(int number, int patch) const { return warehouse_.variable(Generation::old, number, patch); }
  bool hasParticles(const Piece& piece) const { return piece.coarser == 0 && piece.isFinest; }
  /// Interpolates the variables of joints in the cells of a piece.
  void interpolateTogether(const Piece& piece, std::map<int, Bytes>& values) const {
    for (const data::VariableTable::Joint& joint : warehouse_.table().joints()) {
      std::vector<CellValues> coarse;
      for (const int number : joint.variables)
        if (std::find(cells_.begin(), cells_.end(), number) != cells_.end())
          coarse.push_back({variable(number, piece.from).values, variable(number, piece.from).stored});
      if (coarse.size() != joint.variables.size()) continue;
      const auto& fine = prolongTogether(joint, warehouse_.grid().dimension(), coarse, piece.box);
      for (std::size_t k = 0; k < fine.size(); ++k) {
        const std::size_t bytes = label(joint.variables[k]).bytes;
        Bytes& packed = values[joint.variables[k]];
        packed.resize(piece.box.size() * bytes);
        copyCells(piece.box, {}, bytes, fine[k], {packed.data(), piece.box});
      }
    }
  }
  template <class Visit>
  void forEachSet(const Piece& piece, int patch, const Visit& visit) const {
    for (int material = 0; hasParticles(piece) && material < materials_; ++material)
      visit(warehouse_.particles(Generation::old, material, patch));
  }
  /// Calls `visit(values, bytes)` for the particles of each cell of a piece.
  template <class Visit>
  void forEachRange(const Piece& piece, int patch, int number, const Visit& visit) const {
    const std::size_t bytes = label(number).bytes;
    const ParticleSet& set = warehouse_.particles(Generation::old, warehouse_.table()[number].material, patch);
    std::byte* values = variable(number, patch).values;
    grid::forEach<3>(piece.box, [&](const Index3& cell) {
      const data::ParticleRange range = set.in(cell);
      if (!range.empty())
        visit(values + static_cast<std::size_t>(range.first) * bytes, static_cast<std::size_t>(range.size()) * bytes);
    });
  }

  data::Warehouse& warehouse_;
  int materials_;
  std::vector<int> cells_, particles_;
};

/// The messages to other ranks: first the numbers of particles in all pieces, then all values.
std::map<int, Bytes> packed(const grid::Grid& grid, const grid::Tiling& next, const grid::Partition& owners,
                            const MigratedData& migrated) {
  const Pieces pieces(grid.patchTiling(), next, grid.dimension(), grid.levels());
  std::set<int> readers;
  for (const grid::Patch& patch : grid.patches()) pieces.findReaders(patch, readers);
  std::map<int, Bytes> parts;
  const int here = grid.share().rank, first = owners.firstOf(here), end = owners.firstOf(here + 1);
  const std::uint64_t cells = next.cellsBefore(end) - next.cellsBefore(first);
  parts[here].reserve(cells * migrated.bytesOfCell());  // most values stay
  const auto forEachPiece = [&](const auto& visit) {
    for (const int reader : readers)
      pieces.of(reader, [&](const Piece& piece) {
        if (grid.isMine(piece.from)) visit(piece, parts[owners.ownerOf(piece.to)]);
      });
  };
  if (migrated.hasMaterials()) forEachPiece([&](const Piece& piece, Bytes& to) { migrated.packCounts(piece, to); });
  forEachPiece([&](const Piece& piece, Bytes& to) { migrated.packValues(piece, to); });
  return parts;
}

/// The distribution with the most equal costs of ranks. Empty if there are no particles, because patches are then
/// distributed by numbers of cells.
grid::RankOffsets sharesOf(const grid::Grid& grid, const grid::Tiling& next, const mpi::Communicator& ranks,
                           const MigratedData& migrated, const PatchCosts& costs) {
  if (ranks.isAlone() || !migrated.hasMaterials()) return {};
  std::vector<double> ofPatches(static_cast<std::size_t>(next.count()));
  const Pieces pieces(grid.patchTiling(), next, grid.dimension(), grid.levels());
  std::set<int> readers;
  for (const grid::Patch& patch : grid.patches())
    if (grid.isFinest(patch)) pieces.findReaders(patch, readers);
  for (const int reader : readers)
    pieces.of(reader, [&](const Piece& piece) {
      if (grid.isMine(piece.from)) ofPatches[reader] += migrated.particlesOf(piece);
    });
  ranks.sum(ofPatches);
  for (int patch = 0; patch < next.count(); ++patch) {
    double& cost = ofPatches[patch];
    cost = costs.ofParticle * cost + costs.ofCell * static_cast<double>(next.tile(patch).cells.size());
  }
  return grid::evenShares(ofPatches, ranks.size());
}

/// The messages of all ranks, each received when it is first read, from front to back.
class Messages {
 public:
  Messages(const mpi::Communicator& ranks, std::map<int, Bytes>& own) : ranks_(ranks), own_(own) {}

  const std::byte*& of(int rank) {
    const auto [entry, isNew] = messages_.try_emplace(rank);
    auto& [bytes, at] = entry->second;
    if (isNew) {
      bytes = rank == ranks_.rank() ? std::move(own_[rank]) : ranks_.receive(rank, mpi::Tag::patches);
      at = bytes.data();
    }
    return at;
  }

 private:
  const mpi::Communicator& ranks_;
  std::map<int, Bytes>& own_;
  std::map<int, std::pair<Bytes, const std::byte*>> messages_;
};

/// Replaces the patches of a grid by those of `next`, and transfers their values. `replace(shares)` makes the grid take
/// these patches and returns the previous ones.
template <class Replace>
void changePatches(grid::Grid& grid, const grid::Tiling& next, data::Warehouse& warehouse,
                   const MigratedVariables& variables, const PatchCosts& costs, Replace&& replace) {
  const mpi::Communicator& ranks = warehouse.ranks();
  const MigratedData migrated(warehouse, variables);
  grid::RankOffsets shares = sharesOf(grid, next, ranks, migrated, costs);
  const grid::Partition owners = shares.empty() ? grid::Partition(next, ranks.size()) : grid::Partition(next, shares);
  const grid::Partition ownersBefore(grid.patchTiling(), grid.rankOffsets());
  std::map<int, Bytes> parts = packed(grid, next, owners, migrated);  // by rank that they go to
  mpi::Outbox outbox(ranks);
  for (auto& [rank, bytes] : parts)
    if (rank != ranks.rank()) outbox.send(rank, mpi::Tag::patches, std::move(bytes));
  const std::unique_ptr<grid::Tiling> before = replace(std::move(shares));
  warehouse.startAnew(variables.materials);
  migrated.allocate();
  const Pieces pieces(*before, grid.patchTiling(), grid.dimension(), grid.levels());
  Messages messages(ranks, parts);
  const auto forEachPiece = [&](const auto& visit) {
    for (const grid::Patch& patch : grid.patches())
      pieces.of(patch.id(), [&](const Piece& piece) { visit(piece, messages.of(ownersBefore.ownerOf(piece.from))); });
  };
  migrated.beginSets();
  if (migrated.hasMaterials())
    forEachPiece([&](const Piece& piece, const std::byte*& from) { migrated.unpackCounts(piece, from); });
  migrated.endSets();
  migrated.allocateParticles();
  forEachPiece([&](const Piece& piece, const std::byte*& from) { migrated.unpackValues(piece, from); });
  outbox.wait();
}

}  // namespace

void regrid(grid::Grid& grid, grid::BlockTree tree, data::Warehouse& warehouse, const MigratedVariables& variables,
            const PatchCosts& costs) {
  std::unique_ptr<grid::BlockTiling> next = grid.cut(std::move(tree));
  const grid::Tiling& tiling = *next;
  changePatches(grid, tiling, warehouse, variables, costs,
                [&](grid::RankOffsets shares) { return grid.refine(std::move(next), std::move(shares)); });
}

void recut(grid::Grid& grid, std::unique_ptr<grid::Tiling> next, data::Warehouse& warehouse,
           const MigratedVariables& variables, const PatchCosts& costs) {
  const grid::Tiling& tiling = *next;
  changePatches(grid, tiling, warehouse, variables, costs,
                [&](grid::RankOffsets shares) { return grid.recut(std::move(next), std::move(shares)); });
}

}  // namespace tushar::tasks
