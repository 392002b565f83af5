#include "core/simulation/gather.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>

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

void gatherGrid(data::Warehouse& warehouse, Generation generation, int number, output::Array& array) {
  const Label& label = *warehouse.table()[number].label;
  const grid::Level& level = warehouse.level();
  const bool nodes = label.centring == Centring::node;
  grid::forEach<3>(nodes ? level.nodesOfCells() : level.cells(), [&](const Index3& at) {
    Index3 cell = at;
    for (int d = 0; d < 3; ++d) cell[d] = std::min(cell[d], level.cells().upper[d] - 1);
    const Variable& variable = warehouse.variable(generation, number, level.patchOf(cell).id());
    append(array, label, level, variable.values.data() + variable.stored.offset(at) * label.bytes);
  });
}

void gatherParticles(data::Warehouse& warehouse, Generation generation, int number, output::Array& array) {
  const auto [label, material] = warehouse.table()[number];
  for (const ParticlePlace& particle : particlesById(warehouse, material)) {
    const Variable& variable = warehouse.variable(generation, number, particle.patch);
    append(array, *label, warehouse.level(),
           variable.values.data() + static_cast<std::size_t>(particle.place) * label->bytes);
  }
}

}  // namespace

std::vector<ParticlePlace> particlesById(data::Warehouse& warehouse, int material) {
  std::vector<ParticlePlace> particles;
  const int number = warehouse.table().find(data::particleId.name, material);
  for (int patch = 0; patch < warehouse.patches(); ++patch) {
    const auto* ids =
        reinterpret_cast<const ParticleId*>(warehouse.variable(Generation::old, number, patch).values.data());
    const int owned = warehouse.particles(Generation::old, material, patch).owned();
    for (int p = 0; p < owned; ++p) particles.push_back({ids[p], patch, p});
  }
  std::sort(particles.begin(), particles.end(),
            [](const ParticlePlace& a, const ParticlePlace& b) { return a.id < b.id; });
  return particles;
}

output::Array gatherArray(data::Warehouse& warehouse, Generation generation, int number) {
  const Label& label = *warehouse.table()[number].label;
  output::Array array = emptyArray(label);
  if (!warehouse.variable(generation, number, 0).held) return array;
  if (label.centring == Centring::particle)
    gatherParticles(warehouse, generation, number, array);
  else
    gatherGrid(warehouse, generation, number, array);
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
    for (int patch = 0; patch < warehouse.patches(); ++patch)
      count += warehouse.particles(Generation::old, material, patch).owned();
  return count;
}

}  // namespace tushar::simulation
