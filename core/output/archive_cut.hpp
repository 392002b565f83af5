#pragma once

#include <filesystem>
#include <string>

namespace tushar::output {

/// The lines of a `.dat` file that belong to times up to `time` [s]; an unfinished last line is left out.
std::string linesUpTo(const std::string& lines, double time);

/// Removes the outputs of steps after `step` from an archive's folder.
void removeOutputsAfter(const std::filesystem::path& folder, int step);

/// The text of an XML file whose outermost tag is `root`; `otherwise` where the file is missing or torn.
std::string xmlOr(const std::filesystem::path& file, const char* root, const std::string& otherwise);

}  // namespace tushar::output
