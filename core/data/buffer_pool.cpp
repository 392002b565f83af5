#include "core/data/buffer_pool.hpp"

#include <algorithm>

namespace tushar::data {

void BufferPool::reserve(Buffer& buffer, std::size_t bytes, std::size_t keep) {
  if (bytes <= buffer.capacity()) return;
  const auto fits = std::find_if(free_.rbegin(), free_.rend(), [&](const Buffer& b) { return b.capacity() >= bytes; });
  if (keep > 0 || fits == free_.rend()) {
    ++allocations_;
    return buffer.reserve(bytes, keep);
  }
  std::swap(buffer, *fits);
  if (fits->capacity() > 0) return;
  std::swap(*fits, free_.back());
  free_.pop_back();
}

void BufferPool::takeBack(Buffer& buffer) {
  if (buffer.capacity() == 0) return;
  free_.push_back(std::move(buffer));
  buffer = Buffer();
}

}  // namespace tushar::data
