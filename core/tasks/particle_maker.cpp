#include "core/tasks/particle_maker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/data/views.hpp"
#include "core/tasks/move_runs.hpp"

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

void ParticleMaker::makeSet(data::ParticleSet& set, const grid::Patch& patch, int reach, const ParticleId* ids) {
  order_ = sortedOrder(patch);
  keepsSome() ? mergeSet(set, patch, reach, ids) : makeSetOfAdded(set, patch, reach);
}

void ParticleMaker::makeSetOfAdded(data::ParticleSet& set, const grid::Patch& patch, int reach) const {
  set.reset(patch, reach);
  const auto cellOf = [&](std::size_t k) -> const Index3& { return cells_[addedAt(k)]; };
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

/// Merges particles that are kept and added ones, cell by cell, in the order of their ids.
class ParticleMaker::Merge {
 public:
  Merge(ParticleMaker& maker, const ParticleId* ids) : maker_(&maker), ids_(ids) {}

  int count() const { return count_; }
  /// Whether the next added particle is in a row along the first axis.
  bool adds(const Index3& row) const { return hasNext() && cell()[1] == row[1] && cell()[2] == row[2]; }
  /// Appends the particles of a cell, which had the particles `before`; returns their new range.
  data::ParticleRange append(const Index3& cell, const data::ParticleRange& before) {
    const int first = count_;
    const bool isPlain = !hasNext() || this->cell() != cell;
    if (isPlain && before.empty()) return {first, first};
    passRuns(before.first);
    if (isPlain && keeps(before.first) && before.last <= run().last)
      keep(before.first, before.size());
    else
      merge(cell, before);
    return {first, count_};
  }

 private:
  bool hasNext() const { return next_ < maker_->ids_.size(); }
  const Index3& cell() const { return maker_->cells_[maker_->addedAt(next_)]; }
  ParticleId nextId() const { return maker_->ids_[maker_->addedAt(next_)]; }
  const data::ParticleRange& run() const { return maker_->kept_[run_]; }
  /// Passes the runs of kept particles that end before a particle.
  void passRuns(int particle) {
    while (run_ + 1 < maker_->kept_.size() && run().last <= particle) ++run_;
  }
  bool keeps(int particle) const { return particle >= run().first && particle < run().last; }
  void merge(const Index3& cell, const data::ParticleRange& before) {
    const auto isNextHere = [&] { return hasNext() && this->cell() == cell; };
    for (const int p : before) {
      passRuns(p);
      if (!keeps(p)) continue;
      while (isNextHere() && nextId() < ids_[p]) add();
      keep(p, 1);
    }
    while (isNextHere()) add();
  }
  void add() {
    maker_->places_.push_back(count_++);
    ++next_;
  }
  void keep(int first, int count) {
    std::vector<Run>& runs = maker_->runs_;
    if (!runs.empty() && runs.back().from + runs.back().count == first && runs.back().to + runs.back().count == count_)
      runs.back().count += count;
    else
      runs.push_back({count_, first, count});
    count_ += count;
  }

  ParticleMaker* maker_;
  const ParticleId* ids_;
  std::size_t run_ = 0, next_ = 0;  ///< the current run of kept particles; the next added particle
  int count_ = 0;
};

void ParticleMaker::mergeSet(data::ParticleSet& set, const grid::Patch& patch, int reach, const ParticleId* ids) {
  const data::ParticleSet before = std::exchange(set, data::ParticleSet());
  set.reset(patch, reach);
  set.makeSpaceFor(before);
  Merge merge(*this, ids);
  const int rowLength = patch.cells().extent(0);
  grid::forEach<3>(patch.cells().rowStarts(), [&](const Index3& row) {
    if (before.occupied(row, patch.cells().upper[0]).empty() && !merge.adds(row)) return;
    const data::ParticleRange* from = before.row(row);
    data::ParticleRange* to = set.openRow(row);
    Index3 cell = row;
    for (int k = 0; k < rowLength; ++k, ++cell[0]) to[k] = merge.append(cell, from[k]);
    set.closeRow(row);
  });
  set.setOwnedOfClosedRows(merge.count());
}

void ParticleMaker::check(std::size_t access, const data::Label& label) const {
  const std::size_t values = columns_[access] ? columns_[access]->size() : 0;
  if (values != ids_.size())
    throw data::AccessError(
        fmt::format("{} has {} values, but {} new particles were made", label.name, values, ids_.size()));
}

void ParticleMaker::write(std::size_t access, const data::Label& label, const std::byte* before, std::byte* to) {
  check(access, label);
  writeValues(before, columns_[access] ? columns_[access]->bytes() : nullptr, label.bytes, to);
  columns_[access].reset();
}

void ParticleMaker::writeValues(const std::byte* before, const std::byte* added, std::size_t bytes,
                                std::byte* to) const {
  if (keepsSome()) {
    moveRuns(runs_, before, to, bytes);
    for (std::size_t k = 0; k < places_.size(); ++k)
      std::memcpy(to + static_cast<std::size_t>(places_[k]) * bytes, added + addedAt(k) * bytes, bytes);
    return;
  }
  if (order_.empty() && !ids_.empty()) std::memcpy(to, added, ids_.size() * bytes);
  for (std::size_t k = 0, end = 0; k < order_.size(); k = end) {  // particles that were added in this order together
    for (end = k + 1; end < order_.size() && order_[end] == order_[end - 1] + 1;) ++end;
    std::memcpy(to + k * bytes, added + order_[k] * bytes, (end - k) * bytes);
  }
}

void ParticleMaker::drop(std::size_t access, const data::Label& label) {
  check(access, label);
  columns_[access].reset();
}

void ParticleMaker::writeIds(const ParticleId* before, ParticleId* to) const {
  writeValues(reinterpret_cast<const std::byte*>(before), reinterpret_cast<const std::byte*>(ids_.data()),
              sizeof(ParticleId), reinterpret_cast<std::byte*>(to));
}

}  // namespace tushar::tasks
