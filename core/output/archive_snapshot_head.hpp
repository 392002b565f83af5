#pragma once

#include <filesystem>

#include "core/output/archive_index.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::output {

/// The snapshot in an output file, with the number of values, but without the values. `index` has the names of
/// variables, of which a file has only those of its datasets. FileError if the file cannot be read.
Snapshot readHead(const std::filesystem::path& file, const ArchiveIndex& index);

}  // namespace tushar::output
