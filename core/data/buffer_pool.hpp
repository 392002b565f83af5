#pragma once

#include <vector>

#include "core/data/buffer.hpp"

namespace tushar::data {

/// Memory that variables of a patch have given back, for the next ones. Not for several threads at once.
class alignas(64) BufferPool {
 public:
  /// Makes room for `bytes` in a buffer, from the pool where it has enough; the first `keep` bytes stay as they were.
  void reserve(Buffer& buffer, std::size_t bytes, std::size_t keep = 0);
  /// Leaves the buffer empty.
  void takeBack(Buffer& buffer);
  /// Times that the pool had not enough.
  std::size_t allocations() const { return allocations_; }

 private:
  std::vector<Buffer> free_;
  std::size_t allocations_ = 0;
};

}  // namespace tushar::data
