#include "core/tasks/regrid.hpp"

#include <cstring>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/tasks/transfer.hpp"

namespace tushar::tasks {

using data::Generation;
using data::Variable;
using grid::Box;
using grid::Tile;
using mpi::Bytes;

namespace {

/// Cells of a new patch that one old patch has.
struct Piece {
  int from, to;
  Box box;      ///< in cells of the new patch
  int coarser;  ///< how many levels coarser the new cells are; -1: finer by one
};

/// The pieces that new patches are made of.
class Pieces {
 public:
  Pieces(const grid::Tiling& before, const grid::Tiling& after, int dimension, int levels)
      : before_(before), after_(after), dimension_(dimension), levels_(levels) {}

  /// Calls `visit(piece)` for each of a new patch, in an order that does not depend on the rank.
  template <class Visit>
  void of(int to, const Visit& visit) const {
    const Tile tile = after_.tile(to);
    Box cells = tile.cells;
    for (int level = tile.level, finer = 0; level < levels_; ++level, ++finer, cells = cells.refined(dimension_))
      for (const Tile& old : before_.overlapping(level, cells)) {
        Box box = old.cells;
        for (int k = 0; k < finer; ++k) box = box.coarsened(dimension_);
        visit(Piece{old.id, to, box.intersect(tile.cells), finer});
      }
    if (tile.level > 0)
      for (const Tile& old : before_.overlapping(tile.level - 1, tile.cells.coarsened(dimension_)))
        visit(Piece{old.id, to, old.cells.refined(dimension_).intersect(tile.cells), -1});
  }

  /// New patches that have cells of an old one.
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

/// Appends the values of a piece, x fastest.
void pack(const data::Label& label, int dimension, const Piece& piece, const Variable& old, Bytes& to) {
  const std::size_t before = to.size();
  to.resize(before + piece.box.size() * label.bytes);
  std::byte* values = to.data() + before;
  if (piece.coarser < 0) return prolong(label, dimension, {old.values, old.stored}, piece.box, {values, piece.box});
  if (piece.coarser == 0)
    return grid::forEach<3>(piece.box.rowStarts(), [&](const Index3& first) {
      const std::size_t length = static_cast<std::size_t>(piece.box.extent(0)) * label.bytes;
      std::memcpy(values, old.values + old.stored.offset(first) * label.bytes, length);
      values += length;
    });
  CellValues fine{old.values, old.stored};
  Bytes means;
  for (int level = piece.coarser - 1; level >= 0; --level) {
    Box box = piece.box;
    for (int k = 0; k < level; ++k) box = box.refined(dimension);
    Bytes coarse(box.size() * label.bytes);
    restrictTo(label, dimension, box, fine, coarse.data());
    means = std::move(coarse);
    fine = {means.data(), box};
  }
  std::memcpy(values, means.data(), means.size());
}

void unpack(const data::Label& label, const Piece& piece, const Variable& to, const std::byte*& from) {
  const std::size_t length = static_cast<std::size_t>(piece.box.extent(0)) * label.bytes;
  grid::forEach<3>(piece.box.rowStarts(), [&](const Index3& first) {
    std::memcpy(to.values + to.stored.offset(first) * label.bytes, from, length);
    from += length;
  });
}

/// The variables of cells that there are values of.
std::vector<int> heldOf(data::Warehouse& warehouse, const MigratedVariables& variables) {
  std::vector<int> held;
  for (const int number : variables.variables)
    if (warehouse.table()[number].label->centring == data::Centring::cell && warehouse.isHeld(Generation::old, number))
      held.push_back(number);
  return held;
}

}  // namespace

void regrid(grid::Grid& grid, grid::BlockTree tree, data::Warehouse& warehouse, const MigratedVariables& variables) {
  const mpi::Communicator& ranks = warehouse.ranks();
  const std::vector<int> held = heldOf(warehouse, variables);
  const int dimension = grid.dimension();
  std::unique_ptr<grid::BlockTiling> next = grid.cut(std::move(tree));
  const grid::Partition owners(*next, ranks.size());
  const grid::Partition ownersBefore(grid.tiling(), grid.rankOffsets());
  std::map<int, Bytes> parts;  // by rank that they go to
  std::set<int> readers;
  const auto forEachHeld = [&](const auto& visit) {
    for (const int number : held) visit(number, *warehouse.table()[number].label);
  };
  {
    const Pieces pieces(grid.tiling(), *next, dimension, grid.levels());
    for (const grid::Patch& patch : grid.patches()) pieces.findReaders(patch, readers);
    for (const int reader : readers)
      pieces.of(reader, [&](const Piece& piece) {
        if (!grid.isMine(piece.from)) return;
        Bytes& to = parts[owners.ownerOf(piece.to)];
        forEachHeld([&](int number, const data::Label& label) {
          pack(label, dimension, piece, warehouse.variable(Generation::old, number, piece.from), to);
        });
      });
  }
  mpi::Outbox outbox(ranks);
  for (auto& [rank, bytes] : parts)
    if (rank != ranks.rank()) outbox.send(rank, mpi::Tag::patches, std::move(bytes));
  const std::unique_ptr<grid::Tiling> before = grid.refine(std::move(next));
  warehouse.startAnew(variables.materials);
  forEachHeld([&](int number, const data::Label&) { warehouse.allocateGrid(Generation::old, number); });
  const Pieces pieces(*before, grid.tiling(), dimension, grid.levels());
  std::map<int, std::pair<Bytes, const std::byte*>> messages;
  for (const grid::Patch& patch : grid.patches())
    pieces.of(patch.id(), [&](const Piece& piece) {
      const int rank = ownersBefore.ownerOf(piece.from);
      const auto [entry, isNew] = messages.try_emplace(rank);
      auto& [bytes, at] = entry->second;
      if (isNew) {
        bytes = rank == ranks.rank() ? std::move(parts[rank]) : ranks.receive(rank, mpi::Tag::patches);
        at = bytes.data();
      }
      forEachHeld([&](int number, const data::Label& label) {
        unpack(label, piece, warehouse.variable(Generation::old, number, piece.to), at);
      });
    });
  outbox.wait();
}

}  // namespace tushar::tasks
