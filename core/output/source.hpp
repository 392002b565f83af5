#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tushar::output {

/// Consecutive entries: the first, counted from the start of a piece, and how many.
struct Stretch {
  std::uint32_t first, count;
};

/// Makes the values of an array while they are written, so that they are never in memory all at once. If an array is
/// spread over several ranks, each has a source for its own entries.
class Source {
 public:
  virtual ~Source() = default;
  /// Number of entries, on all ranks together.
  virtual std::size_t entries() const = 0;
  /// Writes the entries from `first` to `first + count` to `to`: those on this rank, each to its place; the places
  /// between stay as they are.
  virtual void read(std::size_t first, std::size_t count, std::byte* to) const = 0;
  /// The entries among these that are on this rank, ascending: all, unless a source says otherwise.
  virtual std::vector<Stretch> stretches(std::size_t, std::size_t count) const {
    return {{0, static_cast<std::uint32_t>(count)}};
  }
  /// Writes those on this rank to `to`, without gaps.
  virtual void pack(std::size_t first, std::size_t count, std::byte* to) const { read(first, count, to); }
};

}  // namespace tushar::output
