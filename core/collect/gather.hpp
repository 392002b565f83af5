#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/collect/sources.hpp"
#include "core/data/warehouse.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::collect {

/// The cells between two neighbouring planes of nodes across a kernel axis, and the nodes of one of the two; on a grid
/// of several levels, the cells of each level between two planes of its nodes, and no nodes.
struct Layer {
  int axis = 0, cell = 0, node = 0;
  std::vector<int> finer{};  ///< index of the layer among the cells of levels 1, 2, …
};

/// A box of cells and a box of nodes; on a grid of several levels, a box of the cells of each level, and no nodes.
struct Window {
  grid::Box cells, nodes;
  std::vector<grid::Box> finer{};  ///< box of cells on levels 1, 2, …
};

/// Variables over the whole grid, in an order that does not depend on the layout: particles by id, nodes and cells with
/// x fastest. Vectors come out in x, y, z. All ranks make the same calls, between which the state does not change.
class Gather {
 public:
  explicit Gather(data::Warehouse& warehouse) : warehouse_(&warehouse) {}

  /// Returns a copy of the values of a variable; empty if it has none. Only for a run on one rank.
  output::Array array(data::Generation generation, int variable);
  /// Gives access to the values of a variable without copying them; valid until the state changes.
  /// None if no rank has any.
  output::Array stream(data::Generation generation, int variable);
  /// Like the function above, in a given order.
  output::Array stream(data::Generation generation, int variable, const GridOrder& order);
  /// Gives access to the values of a cell or node variable in a layer, without copying; no other part is read.
  output::Array stream(data::Generation generation, int variable, const Layer& layer);
  /// Gives access to the values in a window, without copying.
  output::Array stream(data::Generation generation, int variable, const Window& window);

 private:
  using Places = std::shared_ptr<const ParticlePlaces>;

  /// The memory locations of the particles of a material, sorted by id.
  const Places& placesOf(int material);
  void streamParticles(data::Generation generation, int number, output::Array& array);
  void streamGrid(data::Generation generation, int number, const GridOrder& order, output::Array& array);

  data::Warehouse* warehouse_;
  std::map<int, Places> places_;  ///< index: material
};

/// The geometry of the grid, in the form for the archive.
output::GridInfo gridInfo(const grid::Grid& grid);
output::GridInfo gridInfo(const grid::Level& level);
/// The geometry of a layer: the axis across it has one cell and is not in use.
output::GridInfo gridInfo(const grid::Grid& grid, const Layer& layer);
/// The geometry of the grid; for several levels, with the boxes of cells that are in the window.
output::GridInfo gridInfo(const grid::Grid& grid, const Window& window);

/// Hash of the old values of the named variables of all materials, in the order above: 16 hexadecimal digits. Two runs
/// agree in it only if they agree in every bit. Only rank 0 has it. Collective.
std::string fingerprint(data::Warehouse& warehouse, const std::vector<std::string>& labels, int materials);

/// Number of particles of all materials on all ranks. Collective.
long particleCount(data::Warehouse& warehouse, int materials);

}  // namespace tushar::collect
