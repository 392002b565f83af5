#pragma once

#include <filesystem>

#include "core/output/archive_index.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::output {

/// The snapshot of an output's file, with the numbers of its values but without them. `index` has the names of
/// variables, of which a file has only those of its datasets. FileError if the file cannot be read.
Snapshot readHead(const std::filesystem::path& file, const ArchiveIndex& index);

}  // namespace tushar::output
