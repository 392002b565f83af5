#include "core/tasks/particle_maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "core/data/views.hpp"

namespace tushar::tasks {

/// The order is empty if the particles have been added in it.
std::vector<std::size_t> ParticleMaker::sortedOrder(const grid::Patch& patch) const {
  std::vector<std::uint32_t> offsets(ids_.size());
  bool isSorted = true;
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    if (!patch.cells().contains(cells_[k]))
      throw data::AccessError(fmt::format("particle {} was made outside the patch", ids_[k]));
    offsets[k] = static_cast<std::uint32_t>(patch.cells().offset(cells_[k]));
    if (k > 0) isSorted &= offsets[k - 1] < offsets[k] || (offsets[k - 1] == offsets[k] && ids_[k - 1] <= ids_[k]);
  }
  std::vector<std::size_t> order;
  if (isSorted) return order;
  order.resize(ids_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return offsets[a] != offsets[b] ? offsets[a] < offsets[b] : ids_[a] < ids_[b];
  });
  return order;
}

void ParticleMaker::makeSet(data::ParticleSet& set, const grid::Patch& patch, int reach) {
  order_ = sortedOrder(patch);
  set.reset(patch, reach);
  const auto cellOf = [&](std::size_t k) -> const Index3& { return cells_[order_.empty() ? k : order_[k]]; };
  for (std::size_t first = 0, end = 0; first < ids_.size(); first = end) {  // the particles of a cell
    const Index3& cell = cellOf(first);
    for (end = first + 1; end < ids_.size() && cellOf(end) == cell;) ++end;
    const bool isLast = end == ids_.size() || cellOf(end)[1] != cell[1] || cellOf(end)[2] != cell[2];
    const int last = static_cast<int>(end), next = isLast ? patch.cells().upper[0] : cellOf(end)[0];
    data::ParticleRange* range = set.openRow(cell);
    range[0] = {static_cast<int>(first), last};
    std::fill(range + 1, range + (next - cell[0]), data::ParticleRange{last, last});
  }
  set.setOwned(static_cast<int>(ids_.size()));
}

void ParticleMaker::check(std::size_t access, const data::Label& label) const {
  if (columns_[access]->size() != ids_.size())
    throw data::AccessError(fmt::format("{} has {} values, but {} new particles were made", label.name,
                                        columns_[access]->size(), ids_.size()));
}

void ParticleMaker::write(std::size_t access, const data::Label& label, std::byte* to) {
  check(access, label);
  const std::byte* values = columns_[access]->bytes();
  if (order_.empty() && !ids_.empty()) std::memcpy(to, values, ids_.size() * label.bytes);
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
  if (order_.empty()) std::copy(ids_.begin(), ids_.end(), to);
  for (std::size_t k = 0; k < order_.size(); ++k) to[k] = ids_[order_[k]];
}

}  // namespace tushar::tasks
