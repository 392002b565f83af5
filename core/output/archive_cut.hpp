#pragma once

#include <filesystem>
#include <string>

#include "core/output/archive_index.hpp"

namespace tushar::output {

/// The lines of a `.dat` file with times up to `time` [s]; an unfinished last line is left out.
std::string linesUpTo(const std::string& lines, double time);

/// What is wrong with a `.dat` file if `kept`, its lines up to `time` [s], are fewer than a run writes until then: a
/// line that is not a sample, or an early end. Empty if nothing is wrong.
std::string damageBefore(const std::string& lines, const std::string& kept, double time);

/// Removes the outputs in an archive's folder that its index does not list, and unfinished outputs of a killed run.
void removeUnlisted(const std::filesystem::path& folder, const ArchiveIndex& index);

/// Of two indices, returns the text of the one that lists more outputs up to a step: the index in `file`, or its copy
/// `kept` in a checkpoint. After a power failure, the file may be torn or out of date. The copy lacks an output that
/// was written at the same step as the checkpoint, but after it.
std::string fullerIndex(const std::filesystem::path& file, const std::string& kept, int step);

}  // namespace tushar::output
