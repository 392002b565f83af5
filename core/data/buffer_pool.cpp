#include "core/data/buffer_pool.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace tushar::data {

namespace {
constexpr std::size_t tooSmallToMatter = std::size_t{1} << 16;
constexpr int patience = 3;  // number of whole steps in which a buffer may stay free
}  // namespace

std::size_t BufferPool::bound() const {
  const std::size_t most = std::max(most_lent_, most_lent_before_);
  return most + most / 4 + tooSmallToMatter;
}

void BufferPool::reserve(Buffer& buffer, std::size_t bytes, std::size_t keep) {
  if (bytes <= buffer.capacity()) return;
  const std::size_t before = buffer.capacity();
  if (const Place best = smallest(bytes, bytes + bytes / 4 + tooSmallToMatter); best != free_.end()) {
    Buffer found = take(best);
    if (keep > 0) std::memcpy(found.data(), buffer.data(), keep);
    takeBack(buffer);
    buffer = std::move(found);
    return;
  }
  ++allocations_;
  if (const Place outgrown = smallest(bytes - bytes / 4, bytes); outgrown != free_.end() && keep == 0) {
    Buffer nearly = take(outgrown);
    takeBack(buffer);
    std::swap(buffer, nearly);
    const std::size_t had = buffer.capacity();
    buffer.reserve(bytes);
    note(had, buffer.capacity());
  } else {
    buffer.reserve(bytes, keep);
    note(before, buffer.capacity());
  }
  keepBound();
}

Buffer BufferPool::lend(std::size_t bytes) {
  const Place best = smallest(bytes, std::numeric_limits<std::size_t>::max());
  if (best != free_.end()) return take(best);
  Buffer made;
  reserve(made, bytes);
  return made;
}

BufferPool::Place BufferPool::smallest(std::size_t least, std::size_t below) {
  Place best = free_.end();
  for (Place it = free_.begin(); it != free_.end(); ++it) {
    const std::size_t capacity = it->buffer.capacity();
    if (capacity >= least && capacity < below && (best == free_.end() || capacity < best->buffer.capacity())) best = it;
  }
  return best;
}

Buffer BufferPool::take(Place which) {
  Buffer taken = std::move(which->buffer);
  free_.erase(which);
  free_bytes_ -= taken.capacity();
  note(0, taken.capacity());
  return taken;
}

void BufferPool::takeBack(Buffer& buffer) {
  if (buffer.capacity() == 0) return;
  note(buffer.capacity(), 0);
  free_bytes_ += buffer.capacity();
  free_.push_back({std::move(buffer)});
  buffer = Buffer();
  keepBound();
}

void BufferPool::note(std::size_t before, std::size_t after) {
  lent_ = lent_ + after - before;
  most_lent_ = std::max(most_lent_, lent_);
}

void BufferPool::giveUp(Place which) {
  free_bytes_ -= which->buffer.capacity();
  free_.erase(which);
}

/// Releases free buffers until the limit is satisfied, starting with those that have been free longest.
void BufferPool::keepBound() {
  while (!free_.empty() && free_bytes_ + lent_ > bound()) giveUp(free_.begin());
}

void BufferPool::release() {
  free_.clear();
  free_bytes_ = 0;
}

void BufferPool::beginStep() {
  for (Free& one : free_) ++one.starts;
  std::erase_if(free_, [this](const Free& one) {
    const bool isIdle = one.starts > patience;
    if (isIdle) free_bytes_ -= one.buffer.capacity();
    return isIdle;
  });
  most_lent_before_ = std::exchange(most_lent_, lent_);
  keepBound();
}

}  // namespace tushar::data
