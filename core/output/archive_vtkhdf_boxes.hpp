#pragma once

#include <pugixml.hpp>

#include "core/output/archive_hdf5.hpp"

namespace tushar::output {

/// Whether a temporal collection of XDMF shows the boxes of a refined grid at any time.
bool hasBoxes(const pugi::xml_node& times);

/// Writes such a collection as a VTKHDF file of type OverlappingAMR, of virtual datasets. No box lies over another:
/// where cells are refined, there are no coarser ones. Layout: VTKHDF 2.2.
void writeBoxes(Hdf5File& file, const pugi::xml_node& times);

}  // namespace tushar::output
