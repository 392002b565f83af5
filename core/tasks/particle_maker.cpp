#include "core/tasks/particle_maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "core/data/views.hpp"

namespace tushar::tasks {

std::vector<std::size_t> ParticleMaker::sortedOrder(const grid::Patch& patch) const {
  std::vector<std::uint32_t> offsets(ids_.size());
  std::vector<std::size_t> order(ids_.size());
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (!patch.cells().contains(cells_[k]))
      throw data::AccessError(fmt::format("particle {} was made outside the patch", ids_[k]));
    offsets[k] = static_cast<std::uint32_t>(patch.cells().offset(cells_[k]));
  }
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto comesBefore = [&](std::size_t a, std::size_t b) {
    return offsets[a] != offsets[b] ? offsets[a] < offsets[b] : ids_[a] < ids_[b];
  };
  if (!std::is_sorted(order.begin(), order.end(), comesBefore)) std::sort(order.begin(), order.end(), comesBefore);
  return order;
}

void ParticleMaker::makeSet(data::ParticleSet& set, const grid::Patch& patch, int reach) {
  order_ = sortedOrder(patch);
  set.reset(patch, reach);
  std::size_t next = 0;
  grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
    const std::size_t first = next;
    while (next < order_.size() && cells_[order_[next]] == cell) ++next;
    set.put(cell, {static_cast<int>(first), static_cast<int>(next)});
  });
  set.setOwned(static_cast<int>(next));
}

void ParticleMaker::check(std::size_t access, const data::Label& label) const {
  if (columns_[access]->size() != ids_.size())
    throw data::AccessError(fmt::format("{} has {} values, but {} new particles were made", label.name,
                                        columns_[access]->size(), ids_.size()));
}

void ParticleMaker::write(std::size_t access, const data::Label& label, std::byte* to) {
  check(access, label);
  const std::byte* values = columns_[access]->bytes();
  for (std::size_t k = 0, end = 0; k < order_.size(); k = end) {  // particles that were added in this order together
    for (end = k + 1; end < order_.size() && order_[end] == order_[end - 1] + 1;) ++end;
    std::memcpy(to + k * label.bytes, values + order_[k] * label.bytes, (end - k) * label.bytes);
  }
  columns_[access].reset();
}

void ParticleMaker::drop(std::size_t access, const data::Label& label) {
  check(access, label);
  columns_[access].reset();
}

void ParticleMaker::writeIds(ParticleId* to) const {
  for (std::size_t k = 0; k < order_.size(); ++k) to[k] = ids_[order_[k]];
}

}  // namespace tushar::tasks
