#include "core/data/buffer_pool.hpp"

#include <limits>
#include <utility>

namespace tushar::data {

void BufferPool::reserve(Buffer& buffer, std::size_t bytes, std::size_t keep) {
  constexpr std::size_t tooSmallToMatter = std::size_t{1} << 16;
  if (bytes <= buffer.capacity()) return;
  const auto best = smallest(bytes, bytes + bytes / 4 + tooSmallToMatter);
  if (keep > 0 || best == free_.end()) {
    ++allocations_;
    if (const auto outgrown = smallest(bytes - bytes / 4, bytes); outgrown != free_.end()) take(outgrown);
    return buffer.reserve(bytes, keep);
  }
  Buffer found = take(best);
  takeBack(buffer);
  buffer = std::move(found);
}

Buffer BufferPool::lend(std::size_t bytes) {
  const auto best = smallest(bytes, std::numeric_limits<std::size_t>::max());
  if (best != free_.end()) return take(best);
  Buffer made;
  reserve(made, bytes);
  return made;
}

std::vector<Buffer>::iterator BufferPool::smallest(std::size_t least, std::size_t below) {
  auto best = free_.end();
  for (auto it = free_.begin(); it != free_.end(); ++it)
    if (it->capacity() >= least && it->capacity() < below && (best == free_.end() || it->capacity() < best->capacity()))
      best = it;
  return best;
}

Buffer BufferPool::take(std::vector<Buffer>::iterator which) {
  Buffer taken = std::move(*which);
  if (which != free_.end() - 1) *which = std::move(free_.back());
  free_.pop_back();
  return taken;
}

void BufferPool::takeBack(Buffer& buffer) {
  if (buffer.capacity() == 0) return;
  free_.push_back(std::move(buffer));
  buffer = Buffer();
}

}  // namespace tushar::data
