#include "core/data/buffer.hpp"

#include <sys/mman.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

namespace tushar::data {

namespace {

constexpr std::size_t line = 64, places = 16, stride = 3 * line, most = places * stride;
constexpr std::size_t page = 4096, ownPages = std::size_t{1} << 20;

std::size_t nextSkew() {
  static std::atomic<unsigned> made{0};
  return (made++ % places) * stride;
}

std::size_t roundedUp(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }

/// Requests large pages, if the system provides them on request, so that fewer page-table entries are needed. Must be
/// applied to a whole mapping, because memory that grows must consist of pages of one kind.
void adviseLargePages(void* memory, std::size_t bytes) { madvise(memory, bytes, MADV_HUGEPAGE); }

}  // namespace

void Buffer::reserve(std::size_t bytes, std::size_t keep) {
  if (bytes <= capacity_) return;
  if (keep == 0 && mapped_ == 0) release();
  bytes >= ownPages ? map(bytes, keep) : allocate(bytes, keep);
}

void Buffer::allocate(std::size_t bytes, std::size_t keep) {
  const std::size_t skew = nextSkew(), wanted = roundedUp(bytes + bytes / 8, line);
  void* memory = std::aligned_alloc(line, wanted + most);
  if (!memory) throw std::bad_alloc();
  std::byte* start = static_cast<std::byte*>(memory) + skew;
  if (keep > 0) std::memcpy(start, start_, keep);
  release();
  memory_ = memory;
  start_ = start;
  capacity_ = wanted;
}

void Buffer::map(std::size_t bytes, std::size_t keep) {
  const std::size_t wanted = roundedUp(bytes + most, page);
  const bool grows = mapped_ > 0;
  const std::size_t skew = grows ? static_cast<std::size_t>(start_ - static_cast<std::byte*>(memory_)) : nextSkew();
  void* memory = grows ? mremap(memory_, mapped_, wanted, MREMAP_MAYMOVE)
                       : mmap(nullptr, wanted, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  adviseLargePages(memory, wanted);
  std::byte* start = static_cast<std::byte*>(memory) + skew;
  if (!grows && keep > 0) std::memcpy(start, start_, keep);
  if (!grows) release();
  memory_ = memory;
  mapped_ = wanted;
  start_ = start;
  capacity_ = wanted - skew;
}

void Buffer::release() {
  if (mapped_ > 0)
    munmap(memory_, mapped_);
  else
    std::free(memory_);
  memory_ = nullptr;
  mapped_ = 0;
  start_ = nullptr;
  capacity_ = 0;
}

}  // namespace tushar::data
