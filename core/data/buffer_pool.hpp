#pragma once

#include <vector>

#include "core/data/buffer.hpp"

namespace tushar::data {

/// Memory that variables of a patch have given back, for the next ones. A buffer goes to nobody who needs much less
/// than it holds, so that each size finds its own again in the next step; one that has been outgrown a little is given
/// up when a larger one is made. Not for several threads at once.
class alignas(64) BufferPool {
 public:
  /// Makes room for `bytes` in a buffer, from the pool where it has one that fits; the first `keep` bytes stay as they were.
  void reserve(Buffer& buffer, std::size_t bytes, std::size_t keep = 0);
  /// A buffer of at least `bytes`, for a moment: it may be one that holds much more.
  Buffer lend(std::size_t bytes);
  /// Leaves the buffer empty.
  void takeBack(Buffer& buffer);
  /// Gives what is free back to the system.
  void release() { free_.clear(); }
  /// Times that the pool had not enough.
  std::size_t allocations() const { return allocations_; }

 private:
  /// The smallest free buffer of at least `least` and less than `below` bytes, or the end.
  std::vector<Buffer>::iterator smallest(std::size_t least, std::size_t below);
  Buffer take(std::vector<Buffer>::iterator which);

  std::vector<Buffer> free_;
  std::size_t allocations_ = 0;
};

}  // namespace tushar::data
