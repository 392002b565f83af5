#include "core/output/archive_snapshot.hpp"

#include <algorithm>
#include <system_error>

#include "core/output/archive_files.hpp"
#include "core/output/archive_hdf5.hpp"

namespace tushar::output {

namespace {

void writeHeader(Hdf5File& out, const Snapshot& snapshot, const std::string& version) {
  out.attribute("/", "step", snapshot.step);
  out.attribute("/", "time", snapshot.time);
  out.attribute("/", "delT", snapshot.delT);
  out.attribute("/", "version", version);
  out.group("/grid");
  out.attribute("/grid", "lower", snapshot.grid.lower);
  out.attribute("/grid", "spacing", snapshot.grid.spacing);
  out.attribute("/grid", "cells", snapshot.grid.cells);
  out.attribute("/grid", "dimension", snapshot.grid.dimension);
}

void writeParticles(Hdf5File& out, const ParticleBlock& block) {
  const std::string group = "/particles/" + groupName(block.material, block.materialIndex);
  out.group(group);
  out.attribute(group, "index", block.materialIndex);
  for (const Array& array : block.arrays)
    if (isHeld(block, array)) out.dataset(pathInFile(block, array), array, {array.entries()});
}

/// Modules that compare with the same solution hand over the same table: the first of each column is kept.
void writeReference(Hdf5File& out, const std::vector<Array>& columns) {
  std::vector<std::string> written;
  for (const Array& column : columns) {
    if (std::find(written.begin(), written.end(), column.label) != written.end()) continue;
    written.push_back(column.label);
    out.dataset("/reference/" + nameInPath(column.label), column, {column.entries()});
  }
}

void writeAll(const std::filesystem::path& file, const Snapshot& snapshot, const ArchiveOptions& options) {
  Hdf5File out(file, options.doubleAsFloat, options.compression);
  writeHeader(out, snapshot, options.version);
  for (const ParticleBlock& block : snapshot.particles) writeParticles(out, block);
  for (const FieldBlock& field : snapshot.fields)
    out.dataset(pathInFile(field), field.array, fieldShape(snapshot.grid, field.centring));
  writeReference(out, snapshot.reference);
  out.close();
}

}  // namespace

void writeSnapshot(const std::filesystem::path& file, const Snapshot& snapshot, const ArchiveOptions& options) {
  const std::filesystem::path temporary = temporaryOf(file);
  try {
    writeAll(temporary, snapshot, options);
    moveInto(temporary, file);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

std::string pathInFile(const ParticleBlock& block, const Array& array) {
  return "/particles/" + groupName(block.material, block.materialIndex) + "/" + nameInPath(array.label);
}

std::string pathInFile(const FieldBlock& field) {
  std::string path = field.centring == Centring::cell ? "/cells/" : "/nodes/";
  if (field.materialIndex >= 0) path += groupName(field.material, field.materialIndex) + "/";
  return path + nameInPath(field.array.label);
}

bool isHeld(const ParticleBlock& block, const Array& array) { return array.entries() == block.count(); }

std::vector<int> axesInUse(const GridInfo& grid) {
  std::vector<int> axes;
  for (const bool several : {true, false})
    for (int axis = 0; axis < 3; ++axis)
      if ((grid.cells[axis] > 1) == several && static_cast<int>(axes.size()) < grid.dimension) axes.push_back(axis);
  std::sort(axes.begin(), axes.end());
  return axes;
}

std::vector<std::uint64_t> fieldShape(const GridInfo& grid, Centring centring) {
  Index3 entries = grid.cells;
  if (centring == Centring::node)
    for (const int axis : axesInUse(grid)) ++entries[axis];
  return {static_cast<std::uint64_t>(entries[2]), static_cast<std::uint64_t>(entries[1]),
          static_cast<std::uint64_t>(entries[0])};
}

}  // namespace tushar::output
