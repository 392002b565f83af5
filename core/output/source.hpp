#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tushar::output {

/// Entries that follow one another: the first, counted from the start of a piece, and how many.
struct Stretch {
  std::uint32_t first, count;
};

/// Makes the values of an array while they are written, so that they are never in memory all at once. Where several
/// ranks have an array together, each has a source of the entries that are its own.
class Source {
 public:
  virtual ~Source() = default;
  /// Number of entries, on all ranks together.
  virtual std::size_t entries() const = 0;
  /// Puts `count` entries, from `first` on, one after the other to `to`; those that this rank has, each to its place,
  /// and nothing to the places between.
  virtual void read(std::size_t first, std::size_t count, std::byte* to) const = 0;
  /// Which of these entries this rank has, ascending: all, unless a source says otherwise.
  virtual std::vector<Stretch> stretches(std::size_t, std::size_t count) const {
    return {{0, static_cast<std::uint32_t>(count)}};
  }
  /// Puts those that this rank has to `to`, without the places between.
  virtual void pack(std::size_t first, std::size_t count, std::byte* to) const { read(first, count, to); }
};

}  // namespace tushar::output
