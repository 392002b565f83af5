#include "core/data/page_size.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace tushar::data {

void adviseLargePages(void* memory, std::size_t bytes) { madvise(memory, bytes, MADV_HUGEPAGE); }

void adviseSmallPages(void* memory, std::size_t bytes) {
  constexpr std::uintptr_t page = 4096;
  const std::uintptr_t before = reinterpret_cast<std::uintptr_t>(memory) % page;
  madvise(static_cast<std::byte*>(memory) - before, before + bytes, MADV_NOHUGEPAGE);
}

}  // namespace tushar::data
