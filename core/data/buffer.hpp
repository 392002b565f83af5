#pragma once

#include <cstddef>
#include <utility>

namespace tushar::data {

/// Raw memory for one variable, aligned to a cache line.
///
/// Buffers of the same size would all start at the same offset within a page and evict one another from the first-level
/// cache; therefore each buffer starts some cache lines further in than the previous one. Large buffers consist of
/// pages of their own, which the system allocates and releases one by one, so that enlarging a buffer copies nothing.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Buffer() { release(); }

  std::byte* data() { return start_; }
  const std::byte* data() const { return start_; }
  std::size_t capacity() const { return capacity_; }

  /// Makes space for `bytes` bytes; the first `keep` bytes are preserved, the rest is undefined. Throws std::bad_alloc.
  void reserve(std::size_t bytes, std::size_t keep = 0);
  void release();

 private:
  void swap(Buffer& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(mapped_, other.mapped_);
    std::swap(start_, other.start_);
    std::swap(capacity_, other.capacity_);
  }
  void map(std::size_t bytes, std::size_t keep);
  void allocate(std::size_t bytes, std::size_t keep);

  void* memory_ = nullptr;
  std::size_t mapped_ = 0;  ///< size of the memory-mapped pages [bytes]; 0 if the memory is from the heap
  std::byte* start_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace tushar::data
