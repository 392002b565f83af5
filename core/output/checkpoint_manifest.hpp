#pragma once

#include <filesystem>
#include <string>

namespace tushar::output {

/// Writes the file `manifest` into a folder: name, size and XXH64 hash of each file there, and in its last line the
/// hash of the lines before. Everything is then on the disk. FileError if it cannot be written.
void writeManifest(const std::filesystem::path& folder);

/// The damage in a folder that has a manifest: which file is missing, shorter, longer or has other bytes. Empty if it
/// is as it was.
std::string damageOf(const std::filesystem::path& folder);

}  // namespace tushar::output
