#include "core/data/buffer.hpp"

#include <atomic>

namespace tushar::data {

void Buffer::reserve(std::size_t bytes, std::size_t keep) {
  if (bytes <= capacity_) return;
  constexpr std::size_t line = 64, places = 16, stride = 3 * line;
  static std::atomic<unsigned> made{0};
  const std::size_t skew = (made++ % places) * stride;
  const std::size_t wanted = (bytes + bytes / 4 + line - 1) / line * line;
  void* memory = std::aligned_alloc(line, wanted + places * stride);
  if (!memory) throw std::bad_alloc();
  std::byte* start = static_cast<std::byte*>(memory) + skew;
  if (keep > 0) std::memcpy(start, start_, keep);
  memory_.reset(memory);
  start_ = start;
  capacity_ = wanted;
}

}  // namespace tushar::data
