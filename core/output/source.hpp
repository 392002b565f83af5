#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tushar::output {

/// A range of consecutive entries: the first, counted from the start of a piece, and their number.
struct Stretch {
  std::uint32_t first, count;
};

/// Generates the values of an array while they are written, so that they are never all in memory. If an array is spread
/// over several ranks, each has a source for its own entries.
class Source {
 public:
  virtual ~Source() = default;
  /// Number of entries on all ranks together.
  virtual std::size_t entries() const = 0;
  /// Writes the entries from `first` to `first + count` that are on this rank to their positions in `to`; other
  /// positions are left unchanged.
  virtual void read(std::size_t first, std::size_t count, std::byte* to) const = 0;
  /// Which of the entries of a piece are on this rank, as ascending stretches; by default all.
  virtual std::vector<Stretch> stretches(std::size_t, std::size_t count) const {
    return {{0, static_cast<std::uint32_t>(count)}};
  }
  /// Writes the entries of a piece that are on this rank to `to`, without gaps.
  virtual void pack(std::size_t first, std::size_t count, std::byte* to) const { read(first, count, to); }
};

}  // namespace tushar::output
