#include "core/data/page_size.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace tushar::data {

void adviseLargePages(void* memory, std::size_t bytes) { madvise(memory, bytes, MADV_HUGEPAGE); }

void adviseSmallPages(void* memory, std::size_t bytes) {
  constexpr std::uintptr_t page = 4096;
  const auto start = reinterpret_cast<std::uintptr_t>(memory), first = start / page * page;
  madvise(reinterpret_cast<void*>(first), start + bytes - first, MADV_NOHUGEPAGE);
}

}  // namespace tushar::data
