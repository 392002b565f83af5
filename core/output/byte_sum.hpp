#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/output/byte_range.hpp"

namespace tushar::output {

/// A checksum of the bytes of a file. Several ranks compute it together, each from the bytes that it has read, in any
/// order: the sum of w_k r^k modulo the prime 2^61 - 1, where w_k is the k-th 8-byte word of the file, with zeros for
/// bytes that another rank has read. The sums of the ranks therefore add up to the sum of the whole file. A single
/// changed byte always changes the checksum; of other changes, one in 2e18 is not detected (Karp and Rabin, Efficient
/// randomized pattern-matching algorithms, IBM J. Res. Dev. 31 (1987) 249-260).
class ByteSum {
 public:
  /// Adds consecutive bytes of the file, starting at position `at`. Fastest if positions increase by equal steps.
  void add(std::uint64_t at, std::span<const std::byte> bytes);
  std::uint64_t value() const { return total_; }

 private:
  void addWord(std::uint64_t number, std::span<const std::byte> bytes, std::uint64_t before);
  std::uint64_t power(std::uint64_t number);

  std::uint64_t total_ = 0;
  std::uint64_t last_ = 0, last_power_ = 1;  ///< exponent of the last power used, and that power
  std::uint64_t step_ = 0, step_power_ = 1;  ///< difference of the last two exponents, and its power
};

/// Identifies one of several ranks that share work evenly.
struct ShareOf {
  int one = 0, several = 1;
};

/// The checksum of one rank's share of the bytes in ranges of a file. Throws FileError if they cannot be read.
std::uint64_t sumOfFile(const std::filesystem::path& file, std::span<const ByteRange> ranges, const ShareOf& share);

/// Adds up the numbers of all ranks, modulo 2^61 - 1; all ranks get the sums. Collective.
std::vector<std::uint64_t> sumsOfRanks(const mpi::Communicator& ranks, std::span<const std::uint64_t> mine);

}  // namespace tushar::output
