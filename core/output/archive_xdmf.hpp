#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "core/output/archive.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/archive_index.hpp"
#include "core/output/archive_vtkhdf.hpp"

namespace tushar::output {

/// The XDMF file with which ParaView shows an archive: a temporal collection of point clouds for each material, one of
/// uniform grids for the cells, and one for the nodes. On a refined grid, these are collections of spatial collections,
/// with a uniform grid for each box. The values stay in the HDF5 files. The text of each output is kept in a scratch
/// file until the whole file is written. Also keeps what the VTKHDF files show.
class XdmfIndex {
 public:
  /// `file` is the path of the XDMF file.
  XdmfIndex(std::filesystem::path file, bool doubleAsFloat);

  /// Continues with those outputs of the existing file that are listed in an index. Outputs that the file lacks, as
  /// after a power cut, are taken from the heads of their own files, where they can be read.
  void resume(const ArchiveIndex& index);
  /// Adds an output; replaces an earlier output of the same step.
  void add(const Snapshot& snapshot);
  /// Writes the whole file.
  void write() const;
  /// Writes the VTKHDF files.
  void writeVtkHdf() const { vtkhdf_.write(file_); }
  const std::filesystem::path& file() const { return file_; }

 private:
  /// The text of an output, stored in the scratch file.
  struct Text {
    int step;
    std::uint64_t first, size;
  };
  struct Block {
    std::string name;
    std::vector<Text> outputs;
  };
  void addTime(const std::string& block, const Snapshot& snapshot, const char* type,
               const std::function<void(pugi::xml_node)>& fill);
  void keep(const std::string& block, int step, const pugi::xml_node& grid);
  void addParticles(const Snapshot& snapshot, const ParticleBlock& block);
  void addFields(const Snapshot& snapshot, Centring centring);
  void forget();

  std::filesystem::path file_;
  bool double_as_float_;
  Scratch scratch_;
  std::vector<Block> blocks_;
  VtkHdfIndex vtkhdf_;
};

}  // namespace tushar::output
