#pragma once

#include <filesystem>
#include <string>

namespace tushar {

/// The folder of the framework's shared library and of the libraries that are loaded on demand.
std::filesystem::path libraryFolder();

/// Builds the target `tushar_NAME` if it was left out of the first build and the program is in a build folder (one with
/// the script `build_missing`). Does nothing elsewhere. Throws std::runtime_error if the build fails.
void buildMissing(const std::string& name);

/// Wall time that this process has spent waiting for such builds [s].
double secondsOfBuilds();

}  // namespace tushar
