#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

namespace tushar::data {

/// Raw memory of one variable on one patch, aligned to a cache line.
///
/// Buffers of the same size would all start at the same offset within a page and evict one another from the
/// first-level cache; each buffer therefore starts some cache lines further in than the one made before.
class Buffer {
 public:
  std::byte* data() { return start_; }
  const std::byte* data() const { return start_; }
  std::size_t capacity() const { return capacity_; }

  /// Makes room for `bytes`; the first `keep` bytes stay as they were, the rest is undefined.
  void reserve(std::size_t bytes, std::size_t keep = 0);
  void release() {
    memory_.reset();
    start_ = nullptr;
    capacity_ = 0;
  }

 private:
  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  std::unique_ptr<void, Free> memory_;
  std::byte* start_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace tushar::data
