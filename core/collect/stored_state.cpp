#include "core/collect/stored_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/base/error.hpp"
#include "core/collect/collect.hpp"
#include "core/collect/particle_order.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/archive_hdf5_parts.hpp"

namespace tushar::collect {

using data::Centring;
using data::Generation;
using data::Label;
using data::Variable;
using grid::Box;
using grid::Patch;
using output::Array;

namespace {

std::byte* bytesOf(Array::Values& values) {
  return std::visit([](auto& all) { return reinterpret_cast<std::byte*>(all.data()); }, values);
}

std::size_t sizeOf(const Array::Values& values) {
  return std::visit([](const auto& all) { return all.size(); }, values);
}

Array::Values emptyValues(data::Number number) {
  if (number == data::Number::id) return std::vector<std::uint64_t>{};
  if (number == data::Number::integer) return std::vector<std::int32_t>{};
  return std::vector<double>{};
}

/// Returns an array for a variable, without values yet.
Array arrayOf(const Label& label) {
  return {std::string(label.name), std::string(label.unit), std::string(label.description), label.components,
          emptyValues(label.number)};
}

const char* folderOf(Centring centring) {
  switch (centring) {
    case Centring::particle:
      return "/particles/";
    case Centring::node:
      return "/nodes/";
    case Centring::cell:
      return "/cells/";
    default:
      return "/reductions/";
  }
}

GridOrder orderOfState(const grid::Grid& grid, const Label& label) {
  return collect::orderOfState(grid, label.centring == Centring::node);
}

/// The shape of a variable in the file: z, y, x; on several levels, one block after the other.
std::vector<std::uint64_t> shapeOf(const grid::Grid& grid, const Label& label) {
  const bool isNode = label.centring == Centring::node;
  const Box all = grid.levels() > 1 ? Box{{}, grid.blockCells()} : isNode ? grid.level().nodes() : grid.level().cells();
  std::vector<std::uint64_t> shape;
  if (grid.levels() > 1) shape.push_back(grid.tree().leaves().size());
  for (const int axis : {2, 1, 0}) shape.push_back(static_cast<std::uint64_t>(all.extent(axis)));
  return shape;
}

std::size_t wordsOf(std::size_t bytes) { return (bytes + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t); }

/// The common part of writing and reading a state: the variables, and their positions in the file.
class StateWalk {
 public:
  StateWalk(data::Warehouse& warehouse, const StateNames& names)
      : warehouse_(warehouse), table_(warehouse.table()), grid_(warehouse.grid()), names_(names) {}

 protected:
  /// Calls `visit(number, path)` for each variable of the run.
  template <class Visit>
  void forEachVariable(Centring centring, int material, Visit&& visit) const {
    for (const std::string& name : names_.labels) {
      const int number = table_.find(name, material);
      if (number >= 0 && table_[number].label->centring == centring) visit(number, pathOf(centring, name, material));
    }
  }
  /// Calls `visit(number, path)` for each variable on cells and nodes.
  template <class Visit>
  void forEachField(Visit&& visit) const {
    for (int m = -1; m < materials(); ++m)
      for (const Centring centring : {Centring::cell, Centring::node}) forEachVariable(centring, m, visit);
  }
  int materials() const { return static_cast<int>(names_.materials.size()); }
  bool hasParticles(int material) const { return table_.find(data::particleId.name, material) >= 0; }
  std::string perCellPath(int material) const { return pathOf(Centring::particle, "perCell", material); }
  const Label& label(int number) const { return *table_[number].label; }
  Variable variable(int number, const Patch& patch) const {
    return warehouse_.variable(Generation::old, number, patch.id());
  }

  data::Warehouse& warehouse_;
  const data::VariableTable& table_;
  const grid::Grid& grid_;

 private:
  std::string pathOf(Centring centring, const std::string& name, int material) const {
    std::string path = folderOf(centring);
    if (material >= 0) path += output::groupName(names_.materials[material], material) + "/";
    return path + output::nameInPath(name);
  }

  const StateNames& names_;
};

class StateWriter : StateWalk {
 public:
  StateWriter(data::Warehouse& warehouse, const StateNames& names, std::deque<ParticleOrder>& orders,
              std::vector<output::Dataset>& datasets)
      : StateWalk(warehouse, names), orders_(orders), datasets_(datasets) {}

  void run() {
    forEachField([&](int number, const std::string& path) {
      if (isHeld(number)) addField(number, path);
    });
    for (int m = 0; m < materials(); ++m)
      if (hasParticles(m)) addParticles(m);
    forEachVariable(Centring::reduction, -1, [&](int number, const std::string& path) { addReduction(number, path); });
  }

 private:
  bool isHeld(int number) const { return warehouse_.isHeld(Generation::old, number); }

  void addField(int number, const std::string& path) {
    const GridOrder order = orderOfState(grid_, label(number));
    Parts parts = collectGrid(warehouse_, Generation::old, number);
    auto runs = std::make_shared<Runs>(runsOfGrid(grid_, label(number), parts, order));
    Array array = arrayOf(label(number));
    array.source = sourceInRuns(std::move(runs), order.size(), std::move(parts), EntryForm(label(number)));
    datasets_.push_back({path, std::move(array), shapeOf(grid_, label(number))});
  }

  void addParticles(int material) {
    const ParticleOrder& order = orders_.emplace_back(warehouse_, material);
    datasets_.push_back({perCellPath(material),
                         {"perCell", "1", "particles of each cell", 1, std::vector<std::int32_t>{}, order.perCell()},
                         {grid_.cellCount()}});
    const auto runs = std::make_shared<const Runs>(order.runs());
    forEachVariable(Centring::particle, material, [&](int number, const std::string& path) {
      if (!isHeld(number)) return;
      Array array = arrayOf(label(number));
      array.source = sourceInRuns(runs, order.count(), collectParticles(warehouse_, Generation::old, number),
                                  EntryForm(label(number)));
      datasets_.push_back({path, std::move(array), {order.count()}});
    });
  }

  void addReduction(int number, const std::string& path) {
    const std::span<const std::byte> bytes = warehouse_.reductionBytes(number);
    if (bytes.empty()) return;
    std::vector<std::uint64_t> words(wordsOf(bytes.size()));
    std::memcpy(words.data(), bytes.data(), bytes.size());
    Array array = arrayOf(label(number));
    array.values = std::move(words);
    const std::uint64_t count = array.entries();
    datasets_.push_back({path, std::move(array), {count}});
  }

  std::deque<ParticleOrder>& orders_;
  std::vector<output::Dataset>& datasets_;
};

class StateReader : StateWalk {
 public:
  StateReader(const output::Hdf5Input& file, data::Warehouse& warehouse, const StateNames& names,
              const std::vector<std::string>& required, output::CheckedParts& checks)
      : StateWalk(warehouse, names), file_(file), required_(required), checks_(checks) {}

  void run() {
    forEachField([&](int number, const std::string& path) {
      if (isStored(label(number), path)) readField(number, path);
    });
    for (int m = 0; m < materials(); ++m)
      if (hasParticles(m) && isStored(data::particleId, perCellPath(m))) readParticles(m);
    checks_.checkOthers();
    forEachVariable(Centring::reduction, -1, [&](int number, const std::string& path) {
      if (isStored(label(number), path)) readReduction(number, path);
    });
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError({{{file_.path().string(), 0, 0}, "", what + "; undo the changes made to the scene since then"}});
  }

  bool isStored(const Label& label, const std::string& path) const {
    if (file_.has(path)) return true;
    if (std::find(required_.begin(), required_.end(), label.name) != required_.end())
      refuse(fmt::format("the checkpoint has no {}, which the scene needs", path));
    return false;
  }

  /// Refuses a dataset whose size or type differs from what the scene needs.
  void check(const std::string& path, const Array::Values& found, std::size_t size, const Array::Values& type,
             std::size_t count) const {
    if (found.index() != type.index())
      refuse(fmt::format("the checkpoint stores {} with a different type of numbers", path));
    if (size != count)
      refuse(fmt::format("the checkpoint has {} values of {}, but the scene needs {}", size, path, count));
  }

  /// Describes a dataset with a given number of values of a type.
  Array::Values stored(const std::string& path, const Array::Values& type, std::size_t count) const {
    Array::Values values = file_.dataset(path);
    check(path, values, sizeOf(values), type, count);
    return values;
  }

  /// Gives access to the values of a variable, part by part.
  output::Hdf5Parts partsOf(const std::string& path, const Label& label, std::size_t entries) const {
    output::Hdf5Parts parts(file_, path, &checks_);
    check(path, parts.type(), parts.count(), emptyValues(label.number),
          entries * static_cast<std::size_t>(label.components));
    return parts;
  }

  /// Reads a field without its ghosts, which the first exchange fills.
  void readField(int number, const std::string& path) {
    const Label& field = label(number);
    const GridOrder order = orderOfState(grid_, field);
    const output::Hdf5Parts file = partsOf(path, field, order.size());
    std::vector<output::Hdf5Parts::Part> rows;
    warehouse_.allocateGrid(Generation::old, number);
    for (const Patch& patch : grid_.patches()) {
      const Variable to = variable(number, patch);
      order.forEachRow(patch.level().number(), ownBox(patch, field),
                       [&](std::size_t place, const Index3& first, int count) {
                         rows.push_back(partOf(field, place, static_cast<std::size_t>(count),
                                               to.values + to.stored.offset(first) * field.bytes));
                         if (field.centring == Centring::node)
                           rows.back().others = othersOfRow(patch, first, count) * field.components;
                       });
    }
    file.read(std::move(rows));
  }

  /// Number of nodes at the end of a row that also belong to the next patch, where they are added to the checksum.
  static std::size_t othersOfRow(const Patch& patch, const Index3& first, int count) {
    const Box &cells = patch.cells(), &all = patch.level().cells();
    const auto isNext = [&](int d, int node) { return node == cells.upper[d] && node < all.upper[d]; };
    if (isNext(1, first[1]) || isNext(2, first[2])) return static_cast<std::size_t>(count);
    return isNext(0, first[0] + count - 1) ? 1 : 0;
  }

  /// Consecutive entries of a variable, starting at a position in the file.
  static output::Hdf5Parts::Part partOf(const Label& label, std::size_t place, std::size_t count, std::byte* to) {
    const std::size_t components = label.components;
    return {place * components, count * components, to};
  }

  void readParticles(int material) {
    const std::string perCell = perCellPath(material);
    const output::Hdf5Parts counts(file_, perCell, &checks_);
    check(perCell, counts.type(), counts.count(), std::vector<std::int32_t>{}, grid_.cellCount());
    ParticleOrder order(warehouse_, material, [&](const std::vector<ParticleOrder::Wanted>& wanted) {
      std::vector<output::Hdf5Parts::Part> parts;
      for (const auto& [first, count, to] : wanted) parts.push_back({first, count, reinterpret_cast<std::byte*>(to)});
      counts.read(std::move(parts));
    });
    order.install();
    forEachVariable(Centring::particle, material, [&](int number, const std::string& path) {
      if (isStored(label(number), path)) readColumn(number, path, order);
    });
  }

  void readColumn(int number, const std::string& path, const ParticleOrder& order) {
    const Label& column = label(number);
    const output::Hdf5Parts file = partsOf(path, column, order.count());
    std::vector<output::Hdf5Parts::Part> rows;
    warehouse_.allocateParticles(Generation::old, number, Generation::old);
    for (const Run& run : order.runs())
      rows.push_back(partOf(column, run.place, run.count,
                            variable(number, grid_.patches()[run.patch]).values + run.first * column.bytes));
    file.read(std::move(rows));
  }

  void readReduction(int number, const std::string& path) {
    const std::size_t bytes = label(number).bytes;
    Array::Values words = stored(path, std::vector<std::uint64_t>{}, wordsOf(bytes));
    warehouse_.restoreReduction(number, {bytesOf(words), bytesOf(words) + bytes});
  }

  const output::Hdf5Input& file_;
  const std::vector<std::string>& required_;
  output::CheckedParts& checks_;
};

}  // namespace

StoredState::StoredState(data::Warehouse& warehouse, const StateNames& names) {
  StateWriter(warehouse, names, orders_, datasets_).run();
}

void readState(const output::Hdf5Input& file, data::Warehouse& warehouse, const StateNames& names,
               const std::vector<std::string>& required, output::CheckedParts& checks) {
  StateReader(file, warehouse, names, required, checks).run();
}

}  // namespace tushar::collect
