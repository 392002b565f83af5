#pragma once

#include <filesystem>
#include <string>

namespace tushar {

/// The folder that contains the framework's shared library and those that are loaded on demand.
std::filesystem::path libraryFolder();

/// Builds the target `tushar_NAME`, which the first build has left out, if the program is in a build folder, which
/// contains the script `build_missing`. Does nothing elsewhere. Throws std::runtime_error if the build fails.
void buildMissing(const std::string& name);

/// Wall time that this process has waited for such builds, s.
double secondsOfBuilds();

}  // namespace tushar
