#pragma once

#include <pugixml.hpp>
#include <string>

#include "core/output/archive.hpp"

namespace tushar::output {

/// The XDMF file that shows an archive to ParaView: a temporal collection; at each time a point cloud per material and
/// a uniform grid for the cells and one for the nodes. The numbers stay in the HDF5 files.
class XdmfIndex {
 public:
  XdmfIndex(const std::string& name, bool doubleAsFloat);

  /// Adds a time, or replaces that of the same step.
  void add(const Snapshot& snapshot);
  /// The whole file.
  std::string text() const;

 private:
  pugi::xml_document document_;
  pugi::xml_node times_;
  bool double_as_float_;
};

}  // namespace tushar::output
