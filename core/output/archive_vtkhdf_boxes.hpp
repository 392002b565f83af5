#pragma once

#include <pugixml.hpp>
#include <vector>

#include "core/output/archive_files.hpp"
#include "core/output/archive_hdf5.hpp"
#include "core/output/archive_vtkhdf_items.hpp"

namespace tushar::output {

/// The boxes of the outputs of a refined grid; the cells of each box are listed in a scratch file.
class ShownBoxes {
 public:
  /// `scratch` must outlive this object.
  explicit ShownBoxes(Scratch& scratch) : scratch_(&scratch) {}

  /// Adds the boxes of an output, given by a spatial collection in XDMF or by one uniform grid.
  void add(const pugi::xml_node& grid, ShownOutput& output);
  /// Whether any output contained a spatial collection.
  bool any() const { return any_; }
  /// Writes a VTKHDF file of type OverlappingAMR (layout: VTKHDF 2.2) that consists of virtual datasets. Despite the
  /// name of the type, boxes do not overlap: where cells are refined, there are no coarser cells. `outputs` must be
  /// sorted by time.
  void write(Hdf5File& file, const std::vector<const ShownOutput*>& outputs) const;

 private:
  Scratch* scratch_;
  bool any_ = false;
  std::vector<double> corner_;                    ///< lower corner x, y, z of the grid [m]
  std::map<int, std::vector<double>> spacing_{};  ///< cell widths of each level [m]
};

}  // namespace tushar::output
