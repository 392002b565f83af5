#pragma once

#include <filesystem>
#include <string>

#include "core/output/archive_index.hpp"

namespace tushar::output {

/// The lines of a `.dat` file with times up to `time` [s]; an unfinished last line is left out.
std::string linesUpTo(const std::string& lines, double time);

/// Removes the outputs in an archive's folder that its index does not list, and unfinished outputs of a killed run.
void removeUnlisted(const std::filesystem::path& folder, const ArchiveIndex& index);

/// The longer one of two indices of outputs up to a step: the index in a file, and its copy in a checkpoint. The file
/// may be torn, or out of date after a power cut; the checkpoint has no output that was made after it at the same step.
std::string fullerIndex(const std::filesystem::path& file, const std::string& kept, int step);

}  // namespace tushar::output
