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

/// Appends one entry of a variable to the array, vectors widened to x, y, z.
void append(output::Array& array, const Label& label, const grid::Level& level, const std::byte* entry) {
  if (auto* ids = std::get_if<std::vector<std::uint64_t>>(&array.values)) {
    ids->push_back(*reinterpret_cast<const std::uint64_t*>(entry));
  } else if (auto* integers = std::get_if<std::vector<std::int32_t>>(&array.values)) {
    integers->push_back(*reinterpret_cast<const std::int32_t*>(entry));
  } else {
    auto& reals = std::get<std::vector<double>>(array.values);
    const auto* numbers = reinterpret_cast<const double*>(entry);
    if (!label.isVector) {
      reals.insert(reals.end(), numbers, numbers + label.components);
      return;
    }
    Vec3 wide = label.name == data::positionName ? level.expandPoint<1>(Vec<1>::Zero()) : Vec3::Zero();
    for (int d = 0; d < label.components; ++d) wide[level.axis(d)] = numbers[d];
    reals.insert(reals.end(), wide.data(), wide.data() + 3);
  }
}

output::Array emptyArray(const Label& label) {
  output::Array array{std::string(label.name), std::string(label.unit), std::string(label.description),
                      label.isVector ? 3 : label.components, {}};
  if (label.number == data::Number::id) array.values = std::vector<std::uint64_t>{};
  if (label.number == data::Number::integer) array.values = std::vector<std::int32_t>{};
  return array;
}

std::vector<std::byte> valuesOnGrid(data::Warehouse& warehouse, Generation generation, int number) {
  const Label& label = *warehouse.table()[number].label;
  const grid::Level& level = warehouse.level();
  const bool nodes = label.centring == Centring::node;
  const Box all = nodes ? level.nodesOfCells() : level.cells();
  const std::size_t bytes = label.bytes;
  std::vector<std::byte> values(warehouse.ranks().isFirst() ? all.size() * bytes : 0);
  const auto ownOf = [&](const Patch& patch) { return nodes ? patch.nodes().intersect(all) : patch.cells(); };
  const auto lengthOf = [&](const Box& box) { return static_cast<std::size_t>(box.extent(0)) * bytes; };
  collect(
      warehouse,
      [&](const Patch& patch, mpi::Bytes& message) {
        const Variable& from = warehouse.variable(generation, number, patch.id());
        const Box own = ownOf(patch);
        forEachRow(own, [&](const Index3& first) {
          mpi::append(message, from.values.data() + from.stored.offset(first) * bytes, lengthOf(own));
        });
      },
      [&](const Patch& patch, const std::byte* from) {
        const Box own = ownOf(patch);
        std::size_t read = 0;
        forEachRow(own, [&](const Index3& first) {
          std::memcpy(values.data() + all.offset(first) * bytes, from + read, lengthOf(own));
          read += lengthOf(own);
        });
        return read;
      });
  return values;
}

/// The values of all particles, patch by patch, on the first rank.
std::vector<std::byte> valuesOfParticles(data::Warehouse& warehouse, Generation generation, int number) {
  const auto [label, material] = warehouse.table()[number];
  const std::size_t bytes = label->bytes;
  std::vector<std::byte> values;
  const int which = material;
  collect(
      warehouse,
      [&](const Patch& patch, mpi::Bytes& message) {
        const auto owned = static_cast<std::uint64_t>(warehouse.particles(Generation::old, which, patch.id()).owned());
        mpi::append(message, &owned, sizeof(owned));
        mpi::append(message, warehouse.variable(generation, number, patch.id()).values.data(), owned * bytes);
      },
      [&](const Patch&, const std::byte* from) {
        std::uint64_t owned = 0;
        std::memcpy(&owned, from, sizeof(owned));
        mpi::append(values, from + sizeof(owned), owned * bytes);
        return sizeof(owned) + owned * bytes;
      });
  return values;
}

/// Places of the particles of a material, as valuesOfParticles has them, by id.
std::vector<std::size_t> placesById(data::Warehouse& warehouse, int material) {
  const std::vector<std::byte> bytes =
      valuesOfParticles(warehouse, Generation::old, warehouse.table().find(data::particleId.name, material));
  const auto* ids = reinterpret_cast<const ParticleId*>(bytes.data());
  std::vector<std::size_t> places(bytes.size() / sizeof(ParticleId));
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  return places;
}

}  // namespace

output::Array gatherArray(data::Warehouse& warehouse, Generation generation, int number) {
  const auto [label, material] = warehouse.table()[number];
  output::Array array = emptyArray(*label);
  if (label->centring == Centring::reduction || !warehouse.isHeld(generation, number)) return array;
  if (label->centring == Centring::particle) {
    const std::vector<std::byte> values = valuesOfParticles(warehouse, generation, number);
    for (const std::size_t place : placesById(warehouse, material))
      append(array, *label, warehouse.level(), values.data() + place * label->bytes);
    return array;
  }
  const std::vector<std::byte> values = valuesOnGrid(warehouse, generation, number);
  for (std::size_t at = 0; at < values.size(); at += label->bytes)
    append(array, *label, warehouse.level(), values.data() + at);
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
  for (const std::string& label : labels)
    for (int material = -1; material < materials; ++material) {
      const int number = warehouse.table().find(label, material);
      if (number < 0) continue;
      const output::Array array = gatherArray(warehouse, Generation::old, number);
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
