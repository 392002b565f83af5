#pragma once

#include <filesystem>

#include "core/output/archive_index.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::output {

/// Reads the snapshot in an output file: the number of values, but not the values. `index` has the names of all
/// variables; the file contains only some of them. Throws FileError if the file cannot be read.
Snapshot readHead(const std::filesystem::path& file, const ArchiveIndex& index);

}  // namespace tushar::output
