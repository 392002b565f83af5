#include "core/collect/sources.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "core/collect/rows.hpp"
#include "core/collect/sums_before.hpp"

namespace tushar::collect {

using grid::Box;
using grid::Level;

namespace {

/// Appends `count` entries from `first` on, as a new stretch or at the end of the last one.
void addStretch(std::vector<output::Stretch>& all, std::size_t first, std::size_t count) {
  if (!all.empty() && all.back().first + all.back().count == first)
    all.back().count += static_cast<std::uint32_t>(count);
  else
    all.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
}

class InRuns : public output::Source {
 public:
  InRuns(std::shared_ptr<const Runs> runs, std::size_t entries, Parts parts, const EntryForm& form)
      : runs_(std::move(runs)), entries_(entries), parts_(std::move(parts)), form_(form) {}

  std::size_t entries() const override { return entries_; }

  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    forEachPart(first, count, [&](const std::byte* from, std::size_t place, std::size_t taken) {
      form_.copy(from, taken, to + (place - first) * form_.bytesOut());
    });
  }

  std::vector<output::Stretch> stretches(std::size_t first, std::size_t count) const override {
    std::vector<output::Stretch> all;
    forEachPart(first, count,
                [&](const std::byte*, std::size_t place, std::size_t taken) { addStretch(all, place - first, taken); });
    return all;
  }

  void pack(std::size_t first, std::size_t count, std::byte* to) const override {
    forEachPart(first, count, [&](const std::byte* from, std::size_t, std::size_t taken) {
      form_.copy(from, taken, to);
      to += taken * form_.bytesOut();
    });
  }

 private:
  /// Calls `visit(values, position of the first, count)` for the part of each run that lies within a range of entries.
  template <class Visit>
  void forEachPart(std::size_t first, std::size_t count, Visit&& visit) const {
    const auto isBefore = [](std::size_t place, const Run& run) { return place < run.place + run.count; };
    auto run = std::upper_bound(runs_->begin(), runs_->end(), first, isBefore);
    for (const std::size_t end = first + count; run != runs_->end() && run->place < end; ++run) {
      const std::size_t from = std::max(first, run->place), to = std::min(end, run->place + run->count);
      visit(parts_.of[run->patch].values + (run->first + from - run->place) * form_.bytes(), from, to - from);
    }
  }

  std::shared_ptr<const Runs> runs_;
  std::size_t entries_;
  Parts parts_;
  EntryForm form_;
};

class AtPlaces : public output::Source {
 public:
  AtPlaces(std::shared_ptr<const ParticlePlaces> places, Parts parts, const EntryForm& form)
      : places_(std::move(places)), parts_(std::move(parts)), form_(form) {}

  std::size_t entries() const override { return places_->count; }

  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    if (places_->ranked.empty() && !places_->places.empty()) return gather(first, count, to);
    const auto [from, end] = own(first, count);
    for (std::size_t k = from; k < end; ++k) gather(k, 1, to + (places_->ranked[k] - first) * form_.bytesOut());
  }

  std::vector<output::Stretch> stretches(std::size_t first, std::size_t count) const override {
    std::vector<output::Stretch> all;
    const auto [from, end] = own(first, count);
    for (std::size_t k = from; k < end; ++k) addStretch(all, places_->ranked[k] - first, 1);
    return all;
  }

  void pack(std::size_t first, std::size_t count, std::byte* to) const override {
    const auto [from, end] = own(first, count);
    gather(from, end - from, to);
  }

 private:
  void gather(std::size_t first, std::size_t count, std::byte* to) const {
    form_.gather(parts_.of, std::span(places_->places).subspan(first, count), to);
  }
  /// The range [first, end) of this rank's positions that lie within these entries.
  std::pair<std::size_t, std::size_t> own(std::size_t first, std::size_t count) const {
    const auto begin = places_->ranked.begin(), end = places_->ranked.end();
    const auto from = std::lower_bound(begin, end, first);
    return {from - begin, std::lower_bound(from, end, first + count) - begin};
  }

  std::shared_ptr<const ParticlePlaces> places_;
  Parts parts_;
  EntryForm form_;
};

/// Returns runs in the order of their positions, without entries that an earlier run contains: nodes on a face between
/// two patches belong to both.
Runs withoutOverlaps(Runs runs) {
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.place < b.place; });
  std::size_t end = 0;
  for (Run& run : runs) {
    const auto covered = static_cast<std::uint32_t>(std::min<std::size_t>(run.count, end - std::min(end, run.place)));
    run.place += covered;
    run.first += covered;
    run.count -= covered;
    end = std::max(end, run.place + run.count);
  }
  std::erase_if(runs, [](const Run& run) { return run.count == 0; });
  return runs;
}

/// Calls `visit(id, place)` for each particle.
template <class Visit>
void forEachId(const Parts& ids, Visit&& visit) {
  for (std::uint32_t patch = 0; patch < ids.of.size(); ++patch)
    for (std::uint32_t k = 0; k < ids.of[patch].count; ++k) {
      std::uint64_t id = 0;
      std::memcpy(&id, ids.of[patch].values + k * sizeof(id), sizeof(id));
      visit(id, Place{patch, k});
    }
}

/// Packs the bits in which the ids differ into small keys with the same order as the ids.
class Packing {
 public:
  explicit Packing(std::uint64_t differing) {
    for (int from = 0; from < 64 && differing >> from != 0;) {
      from += std::countr_zero(differing >> from);
      const int length = std::countr_one(differing >> from);
      groups_.push_back({~std::uint64_t{0} >> (64 - length) << from, from - bits_});
      bits_ += length;
      from += length;
    }
  }
  int bits() const { return bits_; }
  std::uint64_t operator()(std::uint64_t id) const {
    std::uint64_t key = 0;
    for (const Group& group : groups_) key |= (id & group.mask) >> group.shift;
    return key;
  }

 private:
  struct Group {
    std::uint64_t mask;
    int shift;
  };
  std::vector<Group> groups_;
  int bits_ = 0;
};

/// Sorts with a table of all possible keys (counting sort). Of particles with the same id, one remains.
std::vector<Place> sortedByTable(const Parts& ids, const Packing& keyOf) {
  constexpr std::uint32_t nobody = ~std::uint32_t{0};
  std::vector<Place> places(std::size_t{1} << keyOf.bits(), Place{nobody, 0});
  forEachId(ids, [&](std::uint64_t id, const Place& place) { places[keyOf(id)] = place; });
  std::erase_if(places, [](const Place& place) { return place.patch == nobody; });
  return places;
}

struct Keyed {
  std::uint64_t key;
  Place place;
};

/// Sorts by digits of 11 bits, lowest digit first (radix sort). Of particles with the same id, one remains.
std::vector<Place> sortedByDigits(const Parts& ids, const Packing& keyOf, std::size_t count) {
  constexpr int bits = 11;
  constexpr std::size_t digits = std::size_t{1} << bits;
  std::vector<Keyed> all, other(count);
  all.reserve(count);
  forEachId(ids, [&](std::uint64_t id, const Place& place) { all.push_back({keyOf(id), place}); });
  std::array<std::size_t, digits + 1> next;
  for (int shift = 0; shift < keyOf.bits(); shift += bits) {
    const auto digitOf = [&](std::uint64_t key) { return key >> shift & (digits - 1); };
    next.fill(0);
    for (const Keyed& one : all) ++next[digitOf(one.key) + 1];
    for (std::size_t k = 0; k < digits; ++k) next[k + 1] += next[k];
    for (const Keyed& one : all) other[next[digitOf(one.key)]++] = one;
    all.swap(other);
  }
  const auto isSame = [](const Keyed& a, const Keyed& b) { return a.key == b.key; };
  all.erase(std::unique(all.begin(), all.end(), isSame), all.end());
  std::vector<Place> places(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) places[k] = all[k].place;
  return places;
}

template <std::size_t bytes, class EntryAt>
void gatherFixed(const EntryAt& entryAt, std::size_t count, std::byte* to) {
  for (std::size_t k = 0; k < count; ++k) std::memcpy(to + k * bytes, entryAt(k), bytes);
}

}  // namespace

Runs runsOfGrid(const grid::Grid& grid, const data::Label& label, const Parts& parts, const GridOrder& order) {
  Runs runs;
  for (std::size_t k = 0; k < parts.of.size(); ++k) {
    const grid::Patch& patch = grid.patches()[k];
    order.forEachRow(patch.level().number(), ownBox(patch, label),
                     [&](std::size_t place, const Index3& first, int count) {
                       runs.push_back({place, static_cast<std::uint32_t>(k),
                                       static_cast<std::uint32_t>(parts.of[k].stored.offset(first)),
                                       static_cast<std::uint32_t>(count)});
                     });
  }
  return withoutOverlaps(std::move(runs));
}

namespace {

std::size_t countOf(const Parts& ids) {
  std::size_t count = 0;
  for (const Part& part : ids.of) count += part.count;
  return count;
}

/// Throws TaskError on all ranks if particles of any of them have the same id, so that not all have a place.
/// Collective.
void refuseRepeatedIds(const mpi::Communicator& ranks, const Parts& ids, const ParticlePlaces& ranked) {
  if (ranks.any(ranked.places.size() < countOf(ids))) throw TaskError(repeatedIds);
}

}  // namespace

std::vector<Place> placesById(const Parts& ids) {
  const std::size_t count = countOf(ids);
  std::uint64_t all = 0, common = ~std::uint64_t{0};
  forEachId(ids, [&](std::uint64_t id, const Place&) {
    all |= id;
    common &= id;
  });
  const Packing keyOf(all & ~common);
  const bool dense = keyOf.bits() < 48 && std::uint64_t{1} << keyOf.bits() <= 4 * count;
  return dense ? sortedByTable(ids, keyOf) : sortedByDigits(ids, keyOf, count);
}

ParticlePlaces rankedById(const mpi::Communicator& ranks, const Parts& ids) {
  ParticlePlaces ranked{placesById(ids)};
  ranked.count = ranked.places.size();
  refuseRepeatedIds(ranks, ids, ranked);
  if (ranks.isAlone()) return ranked;
  std::vector<std::uint64_t> sorted(ranked.places.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const auto [patch, index] = ranked.places[k];
    std::memcpy(&sorted[k], ids.of[patch].values + index * sizeof(std::uint64_t), sizeof(std::uint64_t));
  }
  ranked.ranked = sumsBefore(ranks, sorted);
  ranked.count = static_cast<std::size_t>(ranks.sum(static_cast<long>(sorted.size())));
  return ranked;
}

EntryForm::EntryForm(const data::Label& label, const Level& level) : bytes_(label.bytes) {
  if (!label.isVector || label.components == 3) return;
  axes_ = label.components;
  for (int d = 0; d < axes_; ++d) axis_[d] = level.axis(d);
  const Vec3 middle = level.expandPoint<1>(Vec<1>::Zero());
  if (label.name == data::positionName)
    for (int d = 0; d < 3; ++d) rest_[d] = middle[d];
}

template <class EntryAt>
void EntryForm::widen(const EntryAt& entryAt, std::size_t count, std::byte* to) const {
  for (std::size_t k = 0; k < count; ++k, to += sizeof(rest_)) {
    const std::byte* from = entryAt(k);
    std::memcpy(to, rest_, sizeof(rest_));
    for (int d = 0; d < axes_; ++d)
      std::memcpy(to + static_cast<std::size_t>(axis_[d]) * sizeof(double), from + d * sizeof(double), sizeof(double));
  }
}

void EntryForm::copy(const std::byte* from, std::size_t count, std::byte* to) const {
  if (axes_ == 0) return static_cast<void>(std::memcpy(to, from, count * bytes_));
  widen([&](std::size_t k) { return from + k * bytes_; }, count, to);
}

void EntryForm::gather(const std::vector<Part>& parts, std::span<const Place> places, std::byte* to) const {
  const auto entryAt = [&](std::size_t k) { return parts[places[k].patch].values + places[k].index * bytes_; };
  if (axes_ > 0) return widen(entryAt, places.size(), to);
  if (bytes_ == sizeof(double)) return gatherFixed<sizeof(double)>(entryAt, places.size(), to);
  for (std::size_t k = 0; k < places.size(); ++k) std::memcpy(to + k * bytes_, entryAt(k), bytes_);
}

std::shared_ptr<const output::Source> sourceInRuns(std::shared_ptr<const Runs> runs, std::size_t entries, Parts parts,
                                                   const EntryForm& form) {
  return std::make_shared<InRuns>(std::move(runs), entries, std::move(parts), form);
}

std::shared_ptr<const output::Source> sourceAt(std::shared_ptr<const ParticlePlaces> places, Parts parts,
                                               const EntryForm& form) {
  return std::make_shared<AtPlaces>(std::move(places), std::move(parts), form);
}

}  // namespace tushar::collect
