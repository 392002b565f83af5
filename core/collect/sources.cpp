#include "core/collect/sources.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/collect/rows.hpp"

namespace tushar::collect {

using grid::Box;
using grid::Level;

namespace {

class InRuns : public output::Source {
 public:
  InRuns(std::shared_ptr<const Runs> runs, std::size_t entries, Parts parts, const EntryForm& form)
      : runs_(std::move(runs)), entries_(entries), parts_(std::move(parts)), form_(form) {}

  std::size_t entries() const override { return entries_; }
  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    const auto isBefore = [](std::size_t place, const Run& run) { return place < run.place; };
    auto run = std::upper_bound(runs_->begin(), runs_->end(), first, isBefore) - 1;
    for (const std::size_t end = first + count; first < end; ++run) {
      const std::size_t runEnd = run + 1 == runs_->end() ? entries_ : (run + 1)->place;
      const std::size_t taken = std::min(runEnd, end) - first;
      form_.copy(parts_.of[run->patch].values + (run->first + first - run->place) * form_.bytes(), taken, to);
      to += taken * form_.bytesOut();
      first += taken;
    }
  }

 private:
  std::shared_ptr<const Runs> runs_;
  std::size_t entries_;
  Parts parts_;
  EntryForm form_;
};

class AtPlaces : public output::Source {
 public:
  AtPlaces(std::shared_ptr<const std::vector<Place>> places, Parts parts, const EntryForm& form)
      : places_(std::move(places)), parts_(std::move(parts)), form_(form) {}

  std::size_t entries() const override { return places_->size(); }
  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    form_.gather(parts_.of, std::span(*places_).subspan(first, count), to);
  }

 private:
  std::shared_ptr<const std::vector<Place>> places_;
  Parts parts_;
  EntryForm form_;
};

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

/// The bits in which ids differ, pushed together: the order of the ids stays, and where they are dense the keys are
/// small.
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

/// By a table of all keys that there may be.
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

/// By digits of 11 bits, the lowest first.
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
  std::vector<Place> places(count);
  for (std::size_t k = 0; k < count; ++k) places[k] = all[k].place;
  return places;
}

template <std::size_t bytes, class EntryAt>
void gatherFixed(const EntryAt& entryAt, std::size_t count, std::byte* to) {
  for (std::size_t k = 0; k < count; ++k) std::memcpy(to + k * bytes, entryAt(k), bytes);
}

}  // namespace

Runs runsOfGrid(const grid::Grid& grid, const data::Label& label, const Parts& parts, const GridOrder& order) {
  Runs runs;
  for (std::size_t id = 0; id < parts.of.size(); ++id) {
    const grid::Patch patch = grid.patch(static_cast<int>(id));
    order.forEachRow(patch.level().number(), ownBox(patch, label), [&](std::size_t place, const Index3& first, int) {
      runs.push_back(
          {place, static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(parts.of[id].stored.offset(first))});
    });
  }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.place < b.place; });
  return runs;
}

std::vector<Place> placesById(const Parts& ids) {
  std::size_t count = 0;
  for (const Part& part : ids.of) count += part.count;
  std::uint64_t all = 0, common = ~std::uint64_t{0};
  forEachId(ids, [&](std::uint64_t id, const Place&) {
    all |= id;
    common &= id;
  });
  const Packing keyOf(all & ~common);
  const bool dense = keyOf.bits() < 48 && std::uint64_t{1} << keyOf.bits() <= 4 * count;
  return dense ? sortedByTable(ids, keyOf) : sortedByDigits(ids, keyOf, count);
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

std::shared_ptr<const output::Source> sourceAt(std::shared_ptr<const std::vector<Place>> places, Parts parts,
                                               const EntryForm& form) {
  return std::make_shared<AtPlaces>(std::move(places), std::move(parts), form);
}

}  // namespace tushar::collect
