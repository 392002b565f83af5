#include "core/output/archive_snapshot_head.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "core/output/archive_files.hpp"
#include "core/output/archive_hdf5_input.hpp"
#include "core/output/archive_snapshot.hpp"

namespace tushar::output {

namespace {

/// The array of a dataset, without values but with its number of entries.
Array arrayOf(const Hdf5Input& file, const std::string& path, const std::string& label, std::size_t entries) {
  Array array{label, "", "", 1, {}};
  const Hdf5Input::Placed placed = file.placed(path);
  if (entries > 0) array.components = static_cast<int>(placed.count / entries);
  array.values = placed.type;
  array.source = valuesElsewhere(entries);
  return array;
}

/// The names in a group, in order of creation.
std::vector<std::string> namesIn(const Hdf5Input& file, const std::string& group) {
  std::vector<std::pair<std::uint64_t, std::string>> places;
  for (const std::string& name : file.names(group)) places.emplace_back(file.placeOf(group + "/" + name), name);
  std::sort(places.begin(), places.end());
  std::vector<std::string> names;
  for (auto& place : places) names.push_back(std::move(place.second));
  return names;
}

std::vector<ParticleBlock> particlesOf(const Hdf5Input& file, const ArchiveIndex& index) {
  constexpr const char* positions = "p.x";
  std::vector<ParticleBlock> blocks;
  for (const std::string& material : namesIn(file, "/particles")) {
    const std::string group = "/particles/" + material;
    ParticleBlock block{material, file.integer(group, "index"), {}};
    const std::size_t count = file.has(group + "/" + positions) ? file.placed(group + "/" + positions).count / 3 : 0;
    for (const std::string& name : namesIn(file, group))
      block.arrays.push_back(arrayOf(file, group + "/" + name, index.labelOf(name), count));
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Fields sorted by their offset in the file, which is the order in which they were created.
using PlacedFields = std::map<std::uint64_t, FieldBlock>;

/// Adds the fields in an HDF5 group: those of a material or, for the root group, the fields without material and those
/// in each subgroup.
void addFields(const Hdf5Input& file, const ArchiveIndex& index, const FieldBlock& like, const std::string& group,
               PlacedFields& all) {
  for (const std::string& name : file.names(group)) {
    const std::string path = group + "/" + name;
    FieldBlock field = like;
    if (file.isGroup(path)) {
      field.material = name;
      field.materialIndex = 0;
      addFields(file, index, field, path, all);
    } else {
      field.array = arrayOf(file, path, index.labelOf(name), like.array.entries());
      all.emplace(file.placeOf(path), std::move(field));
    }
  }
}

void addFields(const Hdf5Input& file, const ArchiveIndex& index, Centring centring, Snapshot& snapshot) {
  FieldBlock none;
  none.centring = centring;
  none.array.source = valuesElsewhere(volumeOf(fieldShape(snapshot.grid, centring)));
  PlacedFields all;
  addFields(file, index, none, centring == Centring::cell ? "/cells" : "/nodes", all);
  for (auto& field : all) snapshot.fields.push_back(std::move(field.second));
}

/// Adds the boxes of a refined grid, from the datasets /grid/boxes and /grid/levels.
void addBoxes(const Hdf5Input& file, GridInfo& grid) {
  const auto numbers = std::get<std::vector<std::int32_t>>(file.dataset("/grid/boxes"));
  for (std::size_t k = 0; k + 7 <= numbers.size(); k += 7)
    grid.boxes.push_back({numbers[k],
                          {{numbers[k + 1], numbers[k + 2], numbers[k + 3]}},
                          {{numbers[k + 4], numbers[k + 5], numbers[k + 6]}}});
  grid.levels = static_cast<int>(file.placed("/grid/levels").count / 3);
}

}  // namespace

Snapshot readHead(const std::filesystem::path& path, const ArchiveIndex& index) {
  const Hdf5Input file(path);
  Snapshot snapshot;
  snapshot.step = file.integer("/", "step");
  snapshot.time = file.real("/", "time");
  snapshot.delT = file.real("/", "delT");
  snapshot.grid = {file.vector("/grid", "lower"), file.vector("/grid", "spacing"), file.index("/grid", "cells"),
                   file.integer("/grid", "dimension")};
  if (file.has("/grid/boxes")) addBoxes(file, snapshot.grid);
  snapshot.particles = particlesOf(file, index);
  addFields(file, index, Centring::cell, snapshot);
  if (snapshot.grid.boxes.empty()) addFields(file, index, Centring::node, snapshot);
  return snapshot;
}

}  // namespace tushar::output
