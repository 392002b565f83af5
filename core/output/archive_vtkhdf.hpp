#pragma once

#include <filesystem>
#include <list>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "core/output/archive_files.hpp"
#include "core/output/archive_vtkhdf_boxes.hpp"
#include "core/output/archive_vtkhdf_items.hpp"

namespace tushar::output {

/// The VTKHDF files that show an archive, next to its XDMF file `sod.xdmf` and derived from that file's entries:
/// `sod.vtkhdf` contains an image of the cells and nodes, or the boxes of a refined grid; `sod.<material>.vtkhdf`
/// contains the particles of a material as points. They hold times, counts and virtual datasets of the outputs `t*.h5`;
/// no value is copied. An output takes some 100 bytes of memory here. Layout: VTKHDF 2.0,
/// https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format.
class VtkHdfIndex {
 public:
  /// `scratch` must outlive this object.
  explicit VtkHdfIndex(Scratch& scratch) : boxes_(scratch) {}

  /// Adds an output of a block (`cells`, `nodes`, or a material), described by its XDMF grid; replaces an earlier
  /// output of the same step.
  void add(const std::string& block, int step, const pugi::xml_node& grid);
  /// Forgets all outputs.
  void forget();
  /// Writes the files, each of which replaces its predecessor atomically. Throws FileError on failure.
  void write(const std::filesystem::path& xdmfFile) const;

  /// The corners of the cells of a uniform grid.
  struct Image {
    std::vector<std::uint64_t> points;        ///< number of corners along z, y, x
    std::vector<double> origin{}, spacing{};  ///< corner and cell width along x, y, z [m]
  };

 private:
  struct Block {
    std::string name;
    bool isMesh;  ///< whether the block is a mesh; otherwise it contains particles
    Image image;
    std::vector<ShownOutput> outputs;
  };
  Block& blockOf(const std::string& name, const pugi::xml_node& grid);
  const Items* kindOf(Items items);

  std::list<Block> blocks_;
  /// Kinds of output, without duplicates; there are few, because outputs differ mostly in numbers of entries.
  std::list<Items> kinds_;
  ShownBoxes boxes_;
};

}  // namespace tushar::output
