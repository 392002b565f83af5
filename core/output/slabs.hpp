#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/output/snapshot.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// Bytes of a file: [first, last).
struct ByteRange {
  std::uint64_t first = 0, last = 0;
  std::uint64_t size() const { return last - first; }
};

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

/// Puts arrays into a file that the first rank has made: each writer the slab that is its own. Collective. Throws
/// FileError on a rank that cannot write, FailedElsewhere on the others.
void writeSlabs(const Writers& writers, const std::filesystem::path& file, const std::vector<Slab>& slabs);

}  // namespace tushar::output
