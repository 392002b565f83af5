#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/output/byte_sum.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// Bytes of a file of a folder whose sum is apart from that of the rest, so that it can be checked while they are read.
struct FilePart {
  std::string file;  ///< its name
  ByteRange bytes;
  std::uint64_t sum = 0;  ///< as ByteSum has it, of such that are in a manifest
};

/// Of manifests; raised whenever older readers would go wrong. 1 had hashes of files and of their blocks, 2 sums of
/// files and their parts; both are without the number.
inline constexpr int manifestFormat = 3;

/// Writes the file `manifest` into a folder: the line `format 3`; for each file there a line with the sum of its bytes,
/// its size and its name; for each of the parts of 64 kB and more a line of its own, `sum first-last name`, and those
/// bytes are left out of the line of the file; and in its last line the XXH64 of the lines before. The writers share
/// the bytes among themselves. Everything is then on the disk. Collective; all have the same parts. FileError on a rank
/// that cannot, FailedElsewhere on the others.
void writeManifest(const std::filesystem::path& folder, const Writers& writers = {},
                   const std::vector<FilePart>& parts = {});

/// The damage of a folder that has a manifest.
struct Inspection {
  std::string damage;             ///< which file is missing, shorter, longer or has other bytes; empty if none
  bool isNewer = false;           ///< a newer version has written it, as `damage` says
  std::vector<FilePart> parts{};  ///< which have not been read
};

/// Reads all but the parts. Ranks share the bytes among themselves. Collective; all get the same. Understands manifests
/// of older versions, which may have no parts, and the XXH64 of files or that of the XXH64 of their blocks of 2^24
/// bytes.
Inspection inspect(const std::filesystem::path& folder, const mpi::Communicator& ranks = mpi::Communicator::alone());

/// The damage in a folder, parts included. Collective; all get the same.
std::string damageOf(const std::filesystem::path& folder, const mpi::Communicator& ranks = mpi::Communicator::alone());

/// The damage of a part, as in Inspection.
class DamageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Parts that are checked when ranks read what they need of them. Collective; where it throws DamageError, all ranks
/// do.
class CheckedParts {
 public:
  /// `ranks` must outlive it.
  CheckedParts(std::filesystem::path folder, std::vector<FilePart> parts, const mpi::Communicator& ranks);
  /// Calls `read` with a sum, to which it adds the bytes that this rank reads of the part of a file that begins at a
  /// byte; all ranks together add every byte once. Passes null if there is no such part, or it has been checked.
  void read(const std::string& file, std::uint64_t first, const std::function<void(ByteSum*)>& read);
  /// Reads those that have not been.
  void checkOthers();

 private:
  void check(std::size_t part, const std::function<void(ByteSum*)>& read);

  std::filesystem::path folder_;
  std::vector<FilePart> parts_;
  const mpi::Communicator* ranks_;
  std::vector<bool> checked_;
};

}  // namespace tushar::output
