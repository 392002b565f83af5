#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/output/byte_sum.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// Bytes of a file with their own checksum, which can be checked while they are read.
struct FilePart {
  std::string file;  ///< its name
  ByteRange bytes;
  std::uint64_t sum = 0;  ///< the ByteSum, for parts from a manifest
};

/// Format of manifests; raised whenever older readers would misread it. Format 1 had hashes of files and of their
/// blocks, 2 sums of files and their parts; neither states its number.
inline constexpr int manifestFormat = 3;

/// Writes the file `manifest` into a folder. Its lines are `format 3`; the sum, the size and the name of each file; and
/// `sum first-last name` for each part of 64 kB and more, whose bytes the sum of its file leaves out. The last line is
/// the XXH64 of those before. The writers share the bytes among themselves. Everything is then on the disk, unless
/// `waitsForDisk` is false. Collective; all have the same parts. FileError on a rank that cannot, FailedElsewhere on
/// the others.
void writeManifest(const std::filesystem::path& folder, const Writers& writers = {},
                   const std::vector<FilePart>& parts = {}, bool waitsForDisk = true);

/// The result of inspecting a folder with a manifest.
struct Inspection {
  std::string damage;             ///< which file is missing, or has a different size or content; empty if none
  bool isNewer = false;           ///< whether a newer version has written it, which `damage` then states
  std::vector<FilePart> parts{};  ///< parts that have not been read
};

/// Inspects a folder; does not read the parts. Ranks share the bytes among themselves. Collective; all get the same.
/// Understands manifests of older versions, which may have no parts, and the XXH64 of files or that of the XXH64 of
/// their blocks of 2^24 bytes.
Inspection inspect(const std::filesystem::path& folder, const mpi::Communicator& ranks = mpi::Communicator::alone());

/// Damage in a folder, including the parts; empty if there is none. Collective; all get the same.
std::string damageOf(const std::filesystem::path& folder, const mpi::Communicator& ranks = mpi::Communicator::alone());

/// A damaged part; the text is that of Inspection::damage.
class DamageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Parts that are checked while ranks read the bytes that they need. Collective; where it throws DamageError, all ranks
/// do.
class CheckedParts {
 public:
  /// `ranks` must outlive it.
  CheckedParts(std::filesystem::path folder, std::vector<FilePart> parts, const mpi::Communicator& ranks);
  /// Calls `read` for the part of a file that begins at a given byte, with a sum to which it adds the bytes that this
  /// rank reads; all ranks together must add every byte once. Passes null if there is no such part, or it has been
  /// checked.
  void read(const std::string& file, std::uint64_t first, const std::function<void(ByteSum*)>& read);
  /// Reads the parts that have not been read.
  void checkOthers();

 private:
  void check(std::size_t part, const std::function<void(ByteSum*)>& read);

  std::filesystem::path folder_;
  std::vector<FilePart> parts_;
  const mpi::Communicator* ranks_;
  std::vector<bool> checked_;
};

}  // namespace tushar::output
