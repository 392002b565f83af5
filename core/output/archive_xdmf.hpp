#pragma once

#include <pugixml.hpp>
#include <string>

#include "core/output/archive.hpp"

namespace tushar::output {

/// The XDMF file that shows an archive to ParaView: a temporal collection for each material, of point clouds, and one
/// each for the cells and the nodes, of uniform grids; of a refined grid, of spatial collections with a uniform grid
/// for each box. The numbers stay in the HDF5 files.
class XdmfIndex {
 public:
  static constexpr const char* rootName = "Xdmf";

  explicit XdmfIndex(bool doubleAsFloat);
  /// Continues from the text of another, without its times after `step`.
  XdmfIndex(bool doubleAsFloat, const std::string& text, int step);

  /// Adds a time, or replaces that of the same step.
  void add(const Snapshot& snapshot);
  /// How many outputs the text of an XDMF file shows, up to a step.
  static std::size_t sizeOf(const std::string& text, int step);
  /// The whole file.
  std::string text() const;
  /// The grids that show the outputs.
  const pugi::xml_node& domain() const { return domain_; }

 private:
  pugi::xml_node addTime(const std::string& block, const Snapshot& snapshot, const char* type);
  void addParticles(const Snapshot& snapshot, const ParticleBlock& block);
  void addFields(const Snapshot& snapshot, Centring centring);

  bool double_as_float_;
  pugi::xml_document document_;
  pugi::xml_node domain_;
};

}  // namespace tushar::output
