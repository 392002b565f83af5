#include "core/data/buffer.hpp"

#include <sys/mman.h>

#include <atomic>
#include <bit>
#include <cstdint>

namespace tushar::data {

namespace {

/// Asks for large pages where the system has them for who asks: much memory is then found with few table entries.
void adviseLargePages(void* memory, std::size_t bytes) {
  constexpr std::size_t page = 4096, worthwhile = std::size_t{4} << 20;
  if (bytes < worthwhile) return;
  const std::uintptr_t first = (std::bit_cast<std::uintptr_t>(memory) + page - 1) / page * page;
  const std::uintptr_t last = (std::bit_cast<std::uintptr_t>(memory) + bytes) / page * page;
  madvise(std::bit_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

}  // namespace

void Buffer::reserve(std::size_t bytes, std::size_t keep) {
  if (bytes <= capacity_) return;
  constexpr std::size_t line = 64, places = 16, stride = 3 * line;
  static std::atomic<unsigned> made{0};
  const std::size_t skew = (made++ % places) * stride;
  const std::size_t wanted = (bytes + bytes / 8 + line - 1) / line * line;
  void* memory = std::aligned_alloc(line, wanted + places * stride);
  if (!memory) throw std::bad_alloc();
  adviseLargePages(memory, wanted + places * stride);
  std::byte* start = static_cast<std::byte*>(memory) + skew;
  if (keep > 0) std::memcpy(start, start_, keep);
  memory_.reset(memory);
  start_ = start;
  capacity_ = wanted;
}

}  // namespace tushar::data
