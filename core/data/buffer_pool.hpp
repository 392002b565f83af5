#pragma once

#include <vector>

#include "core/data/buffer.hpp"

namespace tushar::data {

/// Memory released by variables, kept for later variables. A buffer is not reused for a variable that is much smaller
/// than the buffer, so that in the next step each size finds its own buffers again. Memory is bounded: free and used
/// buffers of the pool have at most `bound()` bytes together. Not thread-safe.
class BufferPool {
 public:
  /// Enlarges a buffer to `bytes`, with memory from the pool if there is enough; the first `keep` bytes are preserved.
  void reserve(Buffer& buffer, std::size_t bytes, std::size_t keep = 0);
  /// Lends a buffer of at least `bytes` for a short time; it may be much larger.
  Buffer lend(std::size_t bytes);
  /// Takes back the memory of a buffer, which is then empty.
  void takeBack(Buffer& buffer);
  /// Returns free memory to the system.
  void release();
  /// Starts a step: memory that stayed free during the last few whole steps is returned to the system. One step is too
  /// few, because some memory is needed in every second step only, such as that for particles that change their cells.
  void beginStep();

  /// Number of requests for which the pool had no suitable buffer.
  std::size_t allocations() const { return allocations_; }
  /// Number of bytes in free buffers; `lent`: number of bytes in buffers that the pool has given out.
  std::size_t free() const { return free_bytes_; }
  std::size_t lent() const { return lent_; }
  /// Limit on free() + lent(): slightly more than 5/4 of the largest amount lent at any time in this step or the
  /// previous one.
  std::size_t bound() const;

 private:
  struct Free {
    Buffer buffer;
    int starts = 0;  ///< number of steps that have begun since it is free
  };
  using Place = std::vector<Free>::iterator;

  /// The smallest free buffer of at least `least` and less than `below` bytes; the end of the list if there is none.
  Place smallest(std::size_t least, std::size_t below);
  Buffer take(Place which);
  void giveUp(Place which);
  void keepBound();
  /// Notes that the size of a buffer has changed from `before` to `after` bytes.
  void note(std::size_t before, std::size_t after);

  std::vector<Free> free_;  ///< free buffers, in the order in which they were returned
  std::size_t free_bytes_ = 0, lent_ = 0, allocations_ = 0;
  /// Largest amount of memory lent at the same time, in this step and in the previous one [bytes].
  std::size_t most_lent_ = 0, most_lent_before_ = 0;
};

}  // namespace tushar::data
