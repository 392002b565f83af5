#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/base/vec.hpp"
#include "core/output/source.hpp"

namespace tushar::output {

/// A named array of numbers for the archive.
struct Array {
  std::string label, unit, description;
  int components = 1;  ///< 1 scalar, 3 vector, 9 tensor by rows
  using Values = std::variant<std::vector<double>, std::vector<std::uint64_t>, std::vector<std::int32_t>>;
  /// Entry by entry: values[entry * components + k].
  Values values;
  /// If set, it provides the values, and `values` gives only their type.
  std::shared_ptr<const Source> source{};

  /// Number of particles, cells, nodes or rows with a value, on all ranks.
  std::size_t entries() const {
    if (source) return source->entries();
    const std::size_t numbers = std::visit([](const auto& all) { return all.size(); }, values);
    return numbers / components;
  }
};

/// Loads the values of an array whose entries are all on this rank.
void load(Array& array);

/// The particles of a material. The first array is p.x [m], with 3 components always; the others have as many entries
/// as it has, or none if a variable is not held at this time: such an array is left out of the archive.
struct ParticleBlock {
  std::string material;
  int materialIndex = 0;
  std::vector<Array> arrays;

  std::size_t count() const { return arrays.empty() ? 0 : arrays.front().entries(); }
};

enum class Centring { cell, node };

/// A field over all cells or nodes of the grid, x fastest; where the grid has boxes, box by box.
struct FieldBlock {
  Centring centring = Centring::cell;
  std::string material;    ///< empty if the field belongs to none
  int materialIndex = -1;  ///< -1 if the field belongs to none
  Array array;
};

/// Cells of one level, counted from the corner of the domain along x, y, z in cells of that level: [lower, upper).
/// Their width is that of the grid over 2^level along the axes that the scene uses.
struct GridBox {
  int level = 0;
  Index3 lower{}, upper{};
};

/// The geometry of the grid. An axis that the scene leaves out has one cell, as wide as the domain, and one node.
struct GridInfo {
  Vec3 lower = Vec3::Zero();    ///< corner of the domain, m
  Vec3 spacing = Vec3::Ones();  ///< cell widths, m
  Index3 cells = Index3::filled(1);
  int dimension = 0;  ///< number of axes that the scene uses
  /// If the run may have several levels, the boxes of cells that tile the domain, those of the coarsest level first;
  /// otherwise none.
  std::vector<GridBox> boxes{};
  int levels = 1;  ///< number of levels: at least one more than the finest level of any box
};

/// The state at one time, gathered over patches in an order that does not depend on the layout.
struct Snapshot {
  int step = 0;
  double time = 0, delT = 0;  ///< s
  GridInfo grid;
  std::vector<ParticleBlock> particles;
  std::vector<FieldBlock> fields;
  std::vector<Array> totals;     ///< requested numbers of the whole grid, one entry each; not for archives
  std::vector<Array> reference;  ///< table of exact values: columns of 1 component, `x` first; often empty
};

}  // namespace tushar::output
