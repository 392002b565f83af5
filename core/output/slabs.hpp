#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/output/behind.hpp"
#include "core/output/byte_range.hpp"
#include "core/output/shared_file.hpp"
#include "core/output/snapshot.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// The slabs of a file start at multiples of this number of bytes, so that no page or stripe is written by two writers.
inline constexpr std::uint64_t slabCut = std::uint64_t{1} << 20;

/// The part of a range that a given writer writes. The parts are contiguous, and as equal as the cuts allow.
ByteRange slabOf(const ByteRange& all, int writer, int writers);

/// An array with a source, and its position in a file.
struct Slab {
  std::string name;          ///< name of the dataset
  const Array* array;        ///< the array; it contains real numbers if `asFloat` is set
  std::uint64_t offset = 0;  ///< offset of the first number in the file
  bool asFloat = false;      ///< whether the file stores real numbers in 4 bytes
};

/// The range of bytes of a slab's numbers in the file.
ByteRange rangeOf(const Slab& slab);

/// Writes arrays to a file that rank 0 has created: each writer writes its own slab. The constructor copies the values;
/// `behind` then writes them. Collective.
class SlabsInFlight {
 public:
  SlabsInFlight(const Writers& writers, Behind& behind, const std::filesystem::path& file,
                const std::vector<Slab>& slabs);
  /// Waits until all slabs are written. Collective on `ranks`. Throws FileError on a rank that could not write,
  /// FailedElsewhere on the others.
  void finish(const mpi::Communicator& ranks);

 private:
  Behind& behind_;
  std::shared_ptr<SharedFile> file_;  ///< the file; only on writers
};

}  // namespace tushar::output
