#pragma once

#include <filesystem>
#include <string>

#include "core/output/writers.hpp"

namespace tushar::output {

/// Writes the file `manifest` into a folder: hash, size and name of each file there, and in its last line the hash of
/// the lines before. The hash of a file is the XXH64 of the XXH64 of its blocks of 2^24 bytes, which the writers share
/// among themselves; of a file of one block, of that alone. Everything is then on the disk. Collective. FileError on a
/// rank that cannot, FailedElsewhere on the others.
void writeManifest(const std::filesystem::path& folder, const Writers& writers = {});

/// The damage in a folder that has a manifest: which file is missing, shorter, longer or has other bytes. Empty if it
/// is as it was. Ranks share the blocks among themselves. Collective; all get the same.
std::string damageOf(const std::filesystem::path& folder, const mpi::Communicator& ranks = mpi::Communicator::alone());

}  // namespace tushar::output
