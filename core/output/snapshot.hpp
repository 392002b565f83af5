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
  int components = 1;  ///< 1: scalar, 3: vector, 9: tensor, row by row
  using Values = std::variant<std::vector<double>, std::vector<std::uint64_t>, std::vector<std::int32_t>>;
  /// Values in the order of the entries: values[entry * components + k].
  Values values;
  /// If set, the source provides the values, and `values` only gives their type.
  std::shared_ptr<const Source> source{};

  /// Number of particles, cells, nodes or rows that have a value, on all ranks.
  std::size_t entries() const {
    if (source) return source->entries();
    const std::size_t numbers = std::visit([](const auto& all) { return all.size(); }, values);
    return numbers / components;
  }
};

/// Loads the values of an array; all its entries must be on this rank.
void load(Array& array);

/// The particles of a material. The first array is always p.x [m], with 3 components; the other arrays have as many
/// entries as p.x, or none if a variable does not exist at this time: such an array is omitted from the archive.
struct ParticleBlock {
  std::string material;
  int materialIndex = 0;
  std::vector<Array> arrays;

  std::size_t count() const { return arrays.empty() ? 0 : arrays.front().entries(); }
};

enum class Centring { cell, node };

/// A field over all cells or nodes of the grid, x fastest; if the grid has boxes, one box after the other.
struct FieldBlock {
  Centring centring = Centring::cell;
  std::string material;    ///< name of the material; empty if the field does not belong to a material
  int materialIndex = -1;  ///< index of the material; -1 if the field does not belong to a material
  Array array;
};

/// A box of cells on one level: [lower, upper), counted from the corner of the domain along x, y, z. Along the axes
/// that the scene uses, their width is GridInfo::spacing divided by 2^level.
struct GridBox {
  int level = 0;
  Index3 lower{}, upper{};
};

/// The geometry of the grid. An axis that the scene does not use has one cell, as wide as the domain, and one node.
struct GridInfo {
  Vec3 lower = Vec3::Zero();    ///< lower corner of the domain [m]
  Vec3 spacing = Vec3::Ones();  ///< cell widths [m]
  Index3 cells = Index3::filled(1);
  int dimension = 0;  ///< number of axes that the scene uses
  /// If the run may have several levels: the boxes of cells that tile the domain, those of the coarsest level first;
  /// otherwise none.
  std::vector<GridBox> boxes{};
  int levels = 1;  ///< number of levels: at least one more than the index of the finest level of any box
  /// If a single level consists of several boxes: these. Values of cells and nodes outside them are 0.
  std::vector<GridBox> inside{};
};

/// The state at one time, gathered from all patches in an order that does not depend on the layout.
struct Snapshot {
  int step = 0;
  double time = 0, delT = 0;  ///< time and time step [s]
  GridInfo grid;
  std::vector<ParticleBlock> particles;
  std::vector<FieldBlock> fields;
  std::vector<Array> totals;     ///< requested global quantities, one entry each; not written to archives
  std::vector<Array> reference;  ///< table of exact values: columns with 1 component each, `x` first; often empty
};

}  // namespace tushar::output
