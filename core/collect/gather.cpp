#include "core/collect/gather.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>

#include "core/collect/collect.hpp"
#include "core/output/pieces.hpp"

namespace tushar::collect {

using data::Centring;
using data::Generation;
using data::Label;
using grid::Box;
using grid::Patch;

namespace {

output::Array emptyArray(const Label& label) {
  output::Array array{std::string(label.name),
                      std::string(label.unit),
                      std::string(label.description),
                      label.isVector ? 3 : label.components,
                      {}};
  if (label.number == data::Number::id) array.values = std::vector<std::uint64_t>{};
  if (label.number == data::Number::integer) array.values = std::vector<std::int32_t>{};
  return array;
}

GridOrder orderOf(const Label& label, const grid::Grid& grid) {
  return collect::orderOf(grid, label.centring == Centring::node);
}

/// The order of the cells in a window of a grid of several levels.
GridOrder orderIn(const grid::Grid& grid, const Window& window) {
  std::vector<Box> boxes{window.cells};
  boxes.insert(boxes.end(), window.finer.begin(), window.finer.end());
  return {grid, mostCellsOfBox, std::move(boxes)};
}

Window windowOf(const grid::Grid& grid, const Layer& layer) {
  const auto at = [&](Box box, int place) {
    box.lower[layer.axis] = place;
    box.upper[layer.axis] = place + 1;
    return box;
  };
  Window window{at(grid.level().cells(), layer.cell), at(grid.level().nodesOfCells(), layer.node)};
  for (std::size_t k = 0; k < layer.finer.size(); ++k)
    window.finer.push_back(at(grid.level(static_cast<int>(k) + 1).cells(), layer.finer[k]));
  return window;
}

struct HashFree {
  void operator()(XXH64_state_t* state) const { XXH64_freeState(state); }
};

/// Returns, on rank 0, the hash of an array, which rank 0 receives piece by piece; 0 on the other ranks.
XXH64_hash_t hashOf(const output::Array& array, XXH64_hash_t seed, const output::Writers& first) {
  const std::size_t bytes = output::entryBytes(array);
  const std::size_t piece = first.ranks().isAlone() ? 1 << 14 : std::max<std::size_t>(1, mostOfPiece(first) / bytes);
  output::Pieces pieces(first);
  std::vector<std::byte> buffer;
  const std::unique_ptr<XXH64_state_t, HashFree> state(XXH64_createState());
  XXH64_reset(state.get(), seed);
  for (output::Piece next; next.first < array.entries(); next.first += next.count) {
    next.count = std::min(piece, array.entries() - next.first);
    const std::span<const std::byte> entries = pieces.bring(array, {&next, 1}, buffer);
    XXH64_update(state.get(), entries.data(), entries.size());
  }
  return first.mine() == 0 ? XXH64_digest(state.get()) : 0;
}

}  // namespace

const Gather::Places& Gather::placesOf(int material) {
  const auto [entry, isNew] = places_.try_emplace(material);
  if (!isNew) return entry->second;
  const int number = warehouse_->table().find(data::particleId.name, material);
  const Parts ids = collectParticles(*warehouse_, Generation::old, number);
  return entry->second = std::make_shared<const ParticlePlaces>(rankedById(warehouse_->ranks(), ids));
}

void Gather::streamParticles(Generation generation, int number, output::Array& array) {
  const auto [label, material] = warehouse_->table()[number];
  array.source = sourceAt(placesOf(material), collectParticles(*warehouse_, generation, number),
                          EntryForm(*label, warehouse_->grid().level()));
}

void Gather::streamGrid(Generation generation, int number, const GridOrder& order, output::Array& array) {
  const Label& label = *warehouse_->table()[number].label;
  const grid::Grid& grid = warehouse_->grid();
  Parts parts = collectGrid(*warehouse_, generation, number);
  auto runs = std::make_shared<const Runs>(runsOfGrid(grid, label, parts, order));
  array.source = sourceInRuns(std::move(runs), order.size(), std::move(parts), EntryForm(label, grid.level()));
}

output::Array Gather::stream(Generation generation, int number) {
  return stream(generation, number, orderOf(*warehouse_->table()[number].label, warehouse_->grid()));
}

output::Array Gather::stream(Generation generation, int number, const GridOrder& order) {
  const Label& label = *warehouse_->table()[number].label;
  output::Array array = emptyArray(label);
  if (label.centring == Centring::reduction || !warehouse_->isHeld(generation, number)) return array;
  label.centring == Centring::particle ? streamParticles(generation, number, array)
                                       : streamGrid(generation, number, order, array);
  return array;
}

output::Array Gather::stream(Generation generation, int number, const Layer& layer) {
  return stream(generation, number, windowOf(warehouse_->grid(), layer));
}

output::Array Gather::stream(Generation generation, int number, const Window& window) {
  const Label& label = *warehouse_->table()[number].label;
  output::Array array = emptyArray(label);
  if (!warehouse_->isHeld(generation, number)) return array;
  const grid::Grid& grid = warehouse_->grid();
  const bool isNode = label.centring == Centring::node;
  if (grid.levels() == 1) {
    streamGrid(generation, number, GridOrder(isNode ? window.nodes : window.cells), array);
  } else if (!isNode) {
    streamGrid(generation, number, orderIn(grid, window), array);
  }
  return array;
}

output::Array Gather::array(Generation generation, int number) {
  output::Array array = stream(generation, number);
  output::load(array);
  return array;
}

output::GridInfo gridInfo(const grid::Level& level) {
  output::GridInfo info;
  info.dimension = level.dimension();
  info.lower = level.domain().lower;
  info.cells = Index3::filled(1);
  info.spacing = level.domain().upper - level.domain().lower;
  for (int d = 0; d < level.dimension(); ++d) {
    info.cells[level.axis(d)] = level.cells().extent(d);
    info.spacing[level.axis(d)] = level.spacing(d);
  }
  for (const grid::Box& box : level.domain().boxes) info.inside.push_back({0, box.lower, box.upper});
  return info;
}

namespace {

output::GridInfo withBoxes(const grid::Grid& grid, const GridOrder& order) {
  const grid::Level& level = grid.level();
  output::GridInfo info = gridInfo(level);
  info.levels = grid.levels();
  for (const grid::Tile& tile : order.boxes()) {
    output::GridBox box{tile.level, {}, Index3::filled(1)};
    for (int d = 0; d < level.dimension(); ++d) {
      box.lower[level.axis(d)] = tile.cells.lower[d];
      box.upper[level.axis(d)] = tile.cells.upper[d];
    }
    info.boxes.push_back(box);
  }
  return info;
}

}  // namespace

output::GridInfo gridInfo(const grid::Grid& grid) {
  return grid.levels() == 1 ? gridInfo(grid.level()) : withBoxes(grid, collect::orderOf(grid, false));
}

output::GridInfo gridInfo(const grid::Grid& grid, const Window& window) {
  return grid.levels() == 1 ? gridInfo(grid.level()) : withBoxes(grid, orderIn(grid, window));
}

output::GridInfo gridInfo(const grid::Grid& grid, const Layer& layer) {
  const grid::Level& level = grid.level();
  output::GridInfo info = gridInfo(grid, windowOf(grid, layer));
  const int axis = level.axis(layer.axis);
  for (output::GridBox& box : info.boxes) {
    box.lower[axis] = 0;
    box.upper[axis] = 1;
  }
  info.lower[axis] = level.nodePosition(layer.axis, layer.cell);
  info.cells[axis] = 1;
  --info.dimension;
  return info;
}

std::string fingerprint(data::Warehouse& warehouse, const std::vector<std::string>& labels, int materials) {
  XXH64_hash_t hash = 0;
  Gather gather(warehouse);
  const output::Writers first(warehouse.ranks(), {0});
  const grid::Grid& grid = warehouse.grid();
  for (const std::string& label : labels)
    for (int material = -1; material < materials; ++material) {
      const int number = warehouse.table().find(label, material);
      if (number < 0) continue;
      const bool isByBlock = grid.levels() > 1 && warehouse.table()[number].label->centring == Centring::cell;
      hash = hashOf(isByBlock ? gather.stream(Generation::old, number, GridOrder(grid, 0))
                              : gather.stream(Generation::old, number),
                    hash, first);
    }
  return fmt::format("{:016x}", hash);
}

long particleCount(data::Warehouse& warehouse, int materials) {
  long count = 0;
  for (int material = 0; material < materials; ++material)
    for (const Patch& patch : warehouse.grid().patches())
      count += warehouse.particles(Generation::old, material, patch.id()).owned();
  return warehouse.ranks().sum(count);
}

}  // namespace tushar::collect
