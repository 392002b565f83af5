#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace tushar {

/// Merges the value at `from` into the value at `into` by `into.merge(from)`; the addresses need not be aligned.
template <class T>
void mergeInMemory(const std::byte* from, std::byte* into) {
  static_assert(std::is_trivially_copyable_v<T>,
                "only trivially copyable values can be merged in messages and checkpoints");
  T one, other;
  std::memcpy(&one, into, sizeof(T));
  std::memcpy(&other, from, sizeof(T));
  one.merge(other);
  std::memcpy(into, &one, sizeof(T));
}

}  // namespace tushar
