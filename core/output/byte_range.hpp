#pragma once

#include <cstdint>

namespace tushar::output {

/// A range of bytes in a file: [first, last).
struct ByteRange {
  std::uint64_t first = 0, last = 0;
  std::uint64_t size() const { return last - first; }
};

}  // namespace tushar::output
