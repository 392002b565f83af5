#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/output/byte_sum.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// A range of bytes of a file with its own checksum, which can be checked while the bytes are read.
struct FilePart {
  std::string file;  ///< name of the file
  ByteRange bytes;
  std::uint64_t sum = 0;  ///< checksum (ByteSum), for parts listed in a manifest
};

/// Format of manifests, raised whenever older readers would misread them. Format 1 contained hashes of files and of
/// their blocks, format 2 sums of files and of their parts; neither states its own number.
inline constexpr int manifestFormat = 3;

/// Writes the file `manifest` into a folder. Its lines are `format 3`; the sum, the size and the name of each file; and
/// `sum first-last name` for each part of 64 kB or more, whose bytes are not included in the sum of the file. The last
/// line is the XXH64 of all lines before it. The writers divide the bytes among themselves. On return, everything is on
/// the disk, unless `waitsForDisk` is false. Collective; all ranks pass the same parts. Throws FileError on a rank that
/// fails, and FailedElsewhere on the others.
void writeManifest(const std::filesystem::path& folder, const Writers& writers = {},
                   const std::vector<FilePart>& parts = {}, bool waitsForDisk = true);

/// The result of inspecting a folder with a manifest.
struct Inspection {
  /// Which file is missing, or has a different size or content; empty if there is no damage.
  std::string damage;
  bool isNewer = false;           ///< whether a newer version has written the folder; `damage` then says so
  std::vector<FilePart> parts{};  ///< parts that have not been checked yet
};

/// Inspects a folder, but does not read the parts. Ranks divide the bytes among themselves. Collective; all ranks get
/// the same result. Also reads manifests of older versions, which have no parts, and contain the XXH64 of each file or
/// the XXH64 of the XXH64s of its blocks of 2^24 bytes.
Inspection inspect(const std::filesystem::path& folder, const mpi::Communicator& ranks = mpi::Communicator::alone());

/// Inspects a folder, including the parts, and describes the damage; empty if there is none. Collective; all ranks get
/// the same result.
std::string damageOf(const std::filesystem::path& folder, const mpi::Communicator& ranks = mpi::Communicator::alone());

/// Exception for a damaged part; its text is that of Inspection::damage.
class DamageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Parts of files that are checked while ranks read the bytes that they need. All functions are collective; if one
/// throws DamageError, it does so on all ranks.
class CheckedParts {
 public:
  /// `ranks` must outlive this object.
  CheckedParts(std::filesystem::path folder, std::vector<FilePart> parts, const mpi::Communicator& ranks);
  /// Calls `read` for the part of a file that begins at a given byte, with a sum to which `read` adds the bytes that
  /// this rank reads; all ranks together must add every byte once. Passes null if there is no such part, or it has been
  /// checked.
  void read(const std::string& file, std::uint64_t first, const std::function<void(ByteSum*)>& read);
  /// Reads and checks all parts that have not been read yet.
  void checkOthers();

 private:
  void check(std::size_t part, const std::function<void(ByteSum*)>& read);

  std::filesystem::path folder_;
  std::vector<FilePart> parts_;
  const mpi::Communicator* ranks_;
  std::vector<bool> checked_;
};

}  // namespace tushar::output
