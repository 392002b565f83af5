#pragma once

#include <vector>

#include "core/data/buffer.hpp"

namespace tushar::data {

/// Memory that variables have released, for later ones. A buffer is not given to a variable that needs much less than
/// it holds, so that each size finds its own buffers again in the next step. Free memory is bounded: the pool and all
/// that it has lent hold at most `bound()` bytes together. Not for several threads at once.
class BufferPool {
 public:
  /// Makes space for `bytes` in a buffer, from the pool if it has one that fits; the first `keep` bytes are preserved.
  void reserve(Buffer& buffer, std::size_t bytes, std::size_t keep = 0);
  /// Lends a buffer of at least `bytes` for a short time; it may be much larger.
  Buffer lend(std::size_t bytes);
  /// Takes back the memory of a buffer, which is then empty.
  void takeBack(Buffer& buffer);
  /// Returns free memory to the system.
  void release();
  /// Starts a step: memory that was free during the whole previous step returns to the system.
  void beginStep();

  /// How often the pool had no buffer that fitted.
  std::size_t allocations() const { return allocations_; }
  /// Free bytes, and bytes in buffers that came from the pool.
  std::size_t free() const { return free_bytes_; }
  std::size_t lent() const { return lent_; }
  /// Limit on the sum of both: slightly more than 5/4 of the largest amount that was lent at the same time in this step
  /// or the last.
  std::size_t bound() const;

 private:
  struct Free {
    Buffer buffer;
    bool isIdle = false;  ///< since the step began
  };
  using Place = std::vector<Free>::iterator;

  /// The smallest free buffer of at least `least` and less than `below` bytes, or the end.
  Place smallest(std::size_t least, std::size_t below);
  Buffer take(Place which);
  void giveUp(Place which);
  void keepBound();
  /// Notes that the size of a buffer has changed from `before` to `after` bytes.
  void note(std::size_t before, std::size_t after);

  std::vector<Free> free_;  ///< in the order in which they were returned
  std::size_t free_bytes_ = 0, lent_ = 0, allocations_ = 0;
  std::size_t most_lent_ = 0, most_lent_before_ = 0;  ///< largest amount at the same time, in this step and the last
};

}  // namespace tushar::data
