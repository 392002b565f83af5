#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/output/archive.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// Writes a snapshot as an HDF5 file, first under a temporary name. All ranks call it, each with the values that it
/// has. FileError on a rank that cannot, FailedElsewhere on the others.
void writeSnapshot(const std::filesystem::path& file, const Snapshot& snapshot, const ArchiveOptions& options,
                   const Writers& writers = {});

/// The path of a particle array in the HDF5 file: `/particles/gas/p.density`.
std::string pathInFile(const ParticleBlock& block, const Array& array);

/// The path of a field in the HDF5 file: `/cells/c.temperature` or `/nodes/gas/g.mass`.
std::string pathInFile(const FieldBlock& field);

/// Whether the array is part of the file; a variable that is not held at this time has no values.
bool isHeld(const ParticleBlock& block, const Array& array);

/// Number of entries of a field along z, y, x; of one on a grid with boxes, which has no nodes, of all boxes together.
std::vector<std::uint64_t> fieldShape(const GridInfo& grid, Centring centring);

/// Numbers of cells of a box along z, y, x.
std::vector<std::uint64_t> boxShape(const GridBox& box);

/// Number of entries of an array of some shape.
std::uint64_t volumeOf(const std::vector<std::uint64_t>& shape);

/// Cell widths of a level [m].
Vec3 spacingOf(const GridInfo& grid, int level);

/// Axes (0 x, 1 y, 2 z) that the scene uses.
std::vector<int> axesInUse(const GridInfo& grid);

}  // namespace tushar::output
