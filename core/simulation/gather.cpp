#include "core/simulation/gather.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/simulation/collect.hpp"
#include "core/simulation/particle_order.hpp"

namespace tushar::simulation {

using data::Centring;
using data::Generation;
using data::Label;
using data::Variable;
using grid::Box;
using grid::Patch;

namespace {

output::Array emptyArray(const Label& label) {
  output::Array array{std::string(label.name), std::string(label.unit), std::string(label.description),
                      label.isVector ? 3 : label.components, {}};
  if (label.number == data::Number::id) array.values = std::vector<std::uint64_t>{};
  if (label.number == data::Number::integer) array.values = std::vector<std::int32_t>{};
  return array;
}

/// The places 0, 1, … in ascending order of their keys, which are all different: by digits of 11 bits, the lowest first.
std::vector<std::size_t> sortedPlaces(std::vector<std::uint64_t> keys) {
  constexpr int bits = 11;
  constexpr std::size_t digits = std::size_t{1} << bits;
  std::vector<std::size_t> places(keys.size()), otherPlaces(keys.size());
  std::vector<std::uint64_t> otherKeys(keys.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const std::uint64_t greatest = keys.empty() ? 0 : *std::max_element(keys.begin(), keys.end());
  for (int shift = 0; shift < 64 && greatest >> shift > 0; shift += bits) {
    std::vector<std::size_t> next(digits + 1);
    const auto digitOf = [&](std::uint64_t key) { return key >> shift & (digits - 1); };
    for (const std::uint64_t key : keys) ++next[digitOf(key) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const std::size_t to = next[digitOf(keys[k])]++;
      otherKeys[to] = keys[k];
      otherPlaces[to] = places[k];
    }
    keys.swap(otherKeys);
    places.swap(otherPlaces);
  }
  return places;
}

/// Where entries of a variable go in an array, vectors widened to x, y, z.
class Filler {
 public:
  Filler(output::Array& array, const Label& label, const grid::Level& level, std::size_t entries)
      : bytes_(label.bytes),
        stride_(label.bytes / static_cast<std::size_t>(label.components) * static_cast<std::size_t>(array.components)) {
    std::visit([&](auto& values) { resize(values, entries * static_cast<std::size_t>(array.components)); }, array.values);
    if (!label.isVector || label.components == array.components) return;
    for (int d = 0; d < label.components; ++d) axes_.push_back(static_cast<std::size_t>(level.axis(d)));
    if (label.name != data::positionName) return;
    const Vec3 middle = level.expandPoint<1>(Vec<1>::Zero());
    for (std::size_t k = 0; k < 3 * entries; ++k) reinterpret_cast<double*>(to_)[k] = middle[static_cast<int>(k % 3)];
  }

  /// Takes entry `at` of the array.
  void fill(std::size_t at, const std::byte* entry) {
    std::byte* to = to_ + at * stride_;
    if (axes_.empty()) return static_cast<void>(std::memcpy(to, entry, bytes_));
    for (std::size_t d = 0; d < axes_.size(); ++d)
      std::memcpy(to + axes_[d] * sizeof(double), entry + d * sizeof(double), sizeof(double));
  }

 private:
  template <class Values>
  void resize(Values& values, std::size_t count) {
    values.resize(count);
    to_ = reinterpret_cast<std::byte*>(values.data());
  }

  std::byte* to_ = nullptr;
  std::size_t bytes_, stride_;     ///< of an entry of the variable and of the array
  std::vector<std::size_t> axes_;  ///< of the numbers of an entry; empty where it stays as it is
};

}  // namespace

const std::vector<std::size_t>& Gather::positionsById(int material) {
  const auto [entry, isNew] = positions_.try_emplace(material);
  if (!isNew) return entry->second;
  const int number = warehouse_->table().find(data::particleId.name, material);
  std::vector<std::uint64_t> ids;
  collectParticles(Generation::old, number, [&](std::size_t first, const std::byte* values, std::size_t count) {
    ids.resize(first + count);
    std::memcpy(ids.data() + first, values, count * sizeof(std::uint64_t));
  });
  const std::vector<std::size_t> places = sortedPlaces(std::move(ids));
  entry->second.resize(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) entry->second[places[k]] = k;
  return entry->second;
}

template <class Take>
void Gather::collectParticles(Generation generation, int number, Take&& take) {
  const auto [label, material] = warehouse_->table()[number];
  const std::size_t bytes = label->bytes;
  const int which = material;
  std::size_t first = 0;
  collect(
      *warehouse_,
      [&](const Patch& patch, mpi::Bytes& message) {
        const auto owned = static_cast<std::uint64_t>(warehouse_->particles(Generation::old, which, patch.id()).owned());
        mpi::append(message, &owned, sizeof(owned));
        mpi::append(message, warehouse_->variable(generation, number, patch.id()).values.data(), owned * bytes);
      },
      [&](const Patch&, const std::byte* from) {
        std::uint64_t owned = 0;
        std::memcpy(&owned, from, sizeof(owned));
        take(first, from + sizeof(owned), static_cast<std::size_t>(owned));
        first += owned;
        return sizeof(owned) + owned * bytes;
      });
}

void Gather::fillParticles(Generation generation, int number, output::Array& array) {
  const auto [label, material] = warehouse_->table()[number];
  const std::size_t bytes = label->bytes;
  const std::vector<std::size_t>& positions = positionsById(material);
  Filler filler(array, *label, warehouse_->level(), positions.size());
  collectParticles(generation, number, [&](std::size_t first, const std::byte* values, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) filler.fill(positions[first + k], values + k * bytes);
  });
}

void Gather::fillGrid(Generation generation, int number, output::Array& array) {
  const Label& label = *warehouse_->table()[number].label;
  const grid::Level& level = warehouse_->level();
  const bool nodes = label.centring == Centring::node;
  const Box all = nodes ? level.nodesOfCells() : level.cells();
  const std::size_t bytes = label.bytes;
  Filler filler(array, label, level, warehouse_->ranks().isFirst() ? all.size() : 0);
  const auto ownOf = [&](const Patch& patch) { return nodes ? patch.nodes().intersect(all) : patch.cells(); };
  const auto lengthOf = [](const Box& box) { return static_cast<std::size_t>(box.extent(0)); };
  collect(
      *warehouse_,
      [&](const Patch& patch, mpi::Bytes& message) {
        const Variable& from = warehouse_->variable(generation, number, patch.id());
        const Box own = ownOf(patch);
        forEachRow(own, [&](const Index3& first) {
          mpi::append(message, from.values.data() + from.stored.offset(first) * bytes, lengthOf(own) * bytes);
        });
      },
      [&](const Patch& patch, const std::byte* from) {
        const Box own = ownOf(patch);
        std::size_t read = 0;
        forEachRow(own, [&](const Index3& first) {
          for (std::size_t k = 0; k < lengthOf(own); ++k) filler.fill(all.offset(first) + k, from + (read++) * bytes);
        });
        return read * bytes;
      });
}

output::Array Gather::array(Generation generation, int number) {
  const Label& label = *warehouse_->table()[number].label;
  output::Array array = emptyArray(label);
  if (label.centring == Centring::reduction || !warehouse_->isHeld(generation, number)) return array;
  label.centring == Centring::particle ? fillParticles(generation, number, array) : fillGrid(generation, number, array);
  return array;
}

output::GridInfo gridInfo(const grid::Level& level) {
  output::GridInfo info;
  info.dimension = level.dimension();
  info.lower = level.domain().lower;
  info.cells = Index3::filled(1);
  info.spacing = level.domain().upper - level.domain().lower;
  for (int d = 0; d < level.dimension(); ++d) {
    info.cells[level.axis(d)] = level.cells().extent(d);
    info.spacing[level.axis(d)] = level.spacing(d);
  }
  return info;
}

std::string fingerprint(data::Warehouse& warehouse, const std::vector<std::string>& labels, int materials) {
  XXH64_hash_t hash = 0;
  Gather gather(warehouse);
  for (const std::string& label : labels)
    for (int material = -1; material < materials; ++material) {
      const int number = warehouse.table().find(label, material);
      if (number < 0) continue;
      const output::Array array = gather.array(Generation::old, number);
      std::visit([&](const auto& values) { hash = XXH64(values.data(), values.size() * sizeof(values[0]), hash); },
                 array.values);
    }
  return fmt::format("{:016x}", hash);
}

long particleCount(data::Warehouse& warehouse, int materials) {
  long count = 0;
  for (int material = 0; material < materials; ++material)
    for (const Patch& patch : warehouse.level().patches())
      count += warehouse.particles(Generation::old, material, patch.id()).owned();
  return warehouse.ranks().sum(count);
}

}  // namespace tushar::simulation
