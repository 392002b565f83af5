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

/// A layer of the grid normal to a kernel axis: the cells between two neighbouring planes of nodes, and the nodes on
/// one of these planes. On a grid of several levels, it contains a layer of cells of each level, and no nodes.
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
/// x fastest. Vectors have components along x, y, z. All ranks make the same calls, between which the state does not
/// change.
class Gather {
 public:
  explicit Gather(data::Warehouse& warehouse) : warehouse_(&warehouse) {}

  /// Returns a copy of the values of a variable; empty if it has none. Only for a run on one rank.
  output::Array array(data::Generation generation, int variable);
  /// Gives access to the values of a variable without copying them; valid until the state changes. The array is empty
  /// if no rank has values.
  output::Array stream(data::Generation generation, int variable);
  /// Like the function above, but with the values in a given order.
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

/// The geometry of the grid, in the form in which the archive stores it.
output::GridInfo gridInfo(const grid::Grid& grid);
output::GridInfo gridInfo(const grid::Level& level);
/// The geometry of a layer. Along the normal of the layer there is one cell, and this axis counts as not in use.
output::GridInfo gridInfo(const grid::Grid& grid, const Layer& layer);
/// The geometry of the grid; for several levels, with the boxes of cells that are in the window.
output::GridInfo gridInfo(const grid::Grid& grid, const Window& window);

/// Returns, on rank 0, a hash of the old values of the named variables of all materials, in the order of Gather, as 16
/// hexadecimal digits. Two runs have the same fingerprint only if these values agree in every bit. Collective.
std::string fingerprint(data::Warehouse& warehouse, const std::vector<std::string>& labels, int materials);

/// Number of particles of all materials on all ranks. Collective.
long particleCount(data::Warehouse& warehouse, int materials);

}  // namespace tushar::collect
