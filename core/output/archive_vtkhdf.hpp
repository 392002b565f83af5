#pragma once

#include <filesystem>
#include <pugixml.hpp>

namespace tushar::output {

/// Writes the VTKHDF files that show an archive, beside its XDMF file `sod.xdmf` and from the `Domain` of that:
/// `sod.vtkhdf` with the cells and nodes, an image, or with the boxes of a refined grid, and `sod.<material>.vtkhdf`
/// for each material, points. They hold times, counts and virtual datasets of the outputs `t*.h5`; no value is copied.
/// Each is put in place whole. FileError if it cannot. Layout: VTKHDF 2.0,
/// https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format.
void writeVtkHdf(const std::filesystem::path& xdmfFile, const pugi::xml_node& domain);

}  // namespace tushar::output
