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

/// Where in a file writers change over: at multiples of so many bytes, so that no page and no stripe has two writers.
inline constexpr std::uint64_t slabCut = std::uint64_t{1} << 20;

/// The part of a range that one of the writers writes. The parts of all follow one another, and are as long as the cuts
/// let them be.
ByteRange slabOf(const ByteRange& all, int writer, int writers);

/// An array with a source, and where in a file there is room for it.
struct Slab {
  std::string name;          ///< of the dataset
  const Array* array;        ///< of real numbers, if `asFloat`
  std::uint64_t offset = 0;  ///< of the first number in the file
  bool asFloat = false;      ///< real numbers take 4 bytes there
};

/// The bytes of all its numbers in the file.
ByteRange rangeOf(const Slab& slab);

/// Arrays on their way into a file that the first rank has made: each writer puts there the slab that is its own. When
/// one is made, the values have been taken over, and `behind` brings them to the file. Collective.
class SlabsInFlight {
 public:
  SlabsInFlight(const Writers& writers, Behind& behind, const std::filesystem::path& file,
                const std::vector<Slab>& slabs);
  /// Waits until they are there. Collective on `ranks`. Throws FileError on a rank that could not write,
  /// FailedElsewhere on the others.
  void finish(const mpi::Communicator& ranks);

 private:
  Behind& behind_;
  std::shared_ptr<SharedFile> file_;  ///< of a writer
};

}  // namespace tushar::output
