#include "core/output/archive_snapshot.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>
#include <system_error>

#include "core/output/archive_files.hpp"
#include "core/output/inside_boxes.hpp"
#include "core/output/pieces.hpp"
#include "core/output/shared_hdf5.hpp"

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

/// Writes each box as its level, lower corner x, y, z and upper corner x, y, z, and each level as its cell widths.
void writeBoxes(Hdf5File& out, const GridInfo& grid) {
  std::vector<std::int32_t> boxes;
  for (const GridBox& box : grid.boxes) {
    boxes.push_back(box.level);
    for (const Index3* corner : {&box.lower, &box.upper})
      boxes.insert(boxes.end(), corner->at.begin(), corner->at.end());
  }
  out.dataset("/grid/boxes", {"boxes", "", "level, lower x, y, z, upper x, y, z in cells of that level", 7, boxes},
              {grid.boxes.size()});
  std::vector<double> widths;
  for (int level = 0; level < grid.levels; ++level) {
    const Vec3 spacing = spacingOf(grid, level);
    widths.insert(widths.end(), spacing.data(), spacing.data() + 3);
  }
  out.dataset("/grid/levels", {"levels", "m", "cell widths of each level along x, y, z", 3, widths},
              {static_cast<std::uint64_t>(grid.levels)}, Precision::full);
}

void writeGroup(Hdf5File& out, const ParticleBlock& block) {
  const std::string group = "/particles/" + groupName(block.material, block.materialIndex);
  out.group(group);
  out.attribute(group, "index", block.materialIndex);
}

/// Adds the reference table. If several modules compare with the same solution, they provide the same table; the first
/// of each column is kept.
void addReference(std::vector<Dataset>& all, const std::vector<Array>& columns) {
  std::vector<std::string> added;
  for (const Array& column : columns) {
    if (std::find(added.begin(), added.end(), column.label) != added.end()) continue;
    added.push_back(column.label);
    all.push_back({"/reference/" + nameInPath(column.label), column, {column.entries()}});
  }
}

std::vector<Dataset> datasetsOf(const Snapshot& snapshot) {
  std::vector<Dataset> all;
  for (const ParticleBlock& block : snapshot.particles)
    for (const Array& array : block.arrays)
      if (isHeld(block, array)) all.push_back({pathInFile(block, array), array, {array.entries()}});
  for (const FieldBlock& field : snapshot.fields)
    all.push_back({pathInFile(field), field.array, fieldShape(snapshot.grid, field.centring)});
  addReference(all, snapshot.reference);
  return all;
}

void writeFirst(Hdf5File& out, const Snapshot& snapshot, const std::string& version) {
  writeHeader(out, snapshot, version);
  if (!snapshot.grid.boxes.empty()) writeBoxes(out, snapshot.grid);
  writeInside(out, snapshot.grid);
  for (const ParticleBlock& block : snapshot.particles) writeGroup(out, block);
}

class Gone : public Source {
 public:
  explicit Gone(std::size_t entries) : entries_(entries) {}
  std::size_t entries() const override { return entries_; }
  void read(std::size_t, std::size_t, std::byte*) const override { assert(false); }

 private:
  std::size_t entries_;
};

/// Calls `visit(array)` for each array of a snapshot that may have a source.
template <class AnySnapshot, class Visit>
void forEachArray(AnySnapshot& snapshot, Visit&& visit) {
  for (auto& block : snapshot.particles)
    for (auto& array : block.arrays) visit(array);
  for (auto& field : snapshot.fields) visit(field.array);
}

}  // namespace

SnapshotInFlight::SnapshotInFlight(std::filesystem::path file, const Snapshot& snapshot, const ArchiveOptions& options,
                                   const Writers& writers, Behind& behind)
    : path_(std::move(file)) {
  try {
    file_ = std::make_unique<FileInFlight>(
        writers, behind, temporaryOf(path_), Storage{options.doubleAsFloat, options.compression},
        [&](Hdf5File& out) { writeFirst(out, snapshot, options.version); }, datasetsOf(snapshot));
  } catch (...) {
    if (writers.ranks().isFirst()) abandon();
    throw;
  }
}

SnapshotInFlight::~SnapshotInFlight() = default;
SnapshotInFlight::SnapshotInFlight(SnapshotInFlight&&) noexcept = default;

void SnapshotInFlight::finish(const mpi::Communicator& ranks) {
  try {
    file_->finish(ranks);
    ranks.onFirst([&] { moveInto(temporaryOf(path_), path_); });
  } catch (...) {
    if (ranks.isFirst()) abandon();
    throw;
  }
}

PackingUse SnapshotInFlight::packing() const { return file_->packing(); }

void SnapshotInFlight::abandon() {
  std::error_code ignored;
  std::filesystem::remove(temporaryOf(path_), ignored);
}

void writeSnapshot(const std::filesystem::path& file, const Snapshot& snapshot, const ArchiveOptions& options) {
  const Writers alone;
  Behind atOnce;
  SnapshotInFlight(file, snapshot, options, alone, atOnce).finish(alone.ranks());
}

std::uint64_t bytesInFlight(const Snapshot& snapshot) {
  std::uint64_t bytes = 0;
  forEachArray(snapshot, [&](const Array& array) { bytes += array.source ? bytesOf(array) : 0; });
  return bytes;
}

Snapshot withoutValues(Snapshot snapshot) {
  forEachArray(snapshot, [](Array& array) {
    if (array.source) array.source = valuesElsewhere(array.entries());
  });
  return snapshot;
}

std::shared_ptr<const Source> valuesElsewhere(std::size_t entries) { return std::make_shared<Gone>(entries); }

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

std::vector<std::uint64_t> boxShape(const GridBox& box) {
  std::vector<std::uint64_t> shape;
  for (const int axis : {2, 1, 0}) shape.push_back(static_cast<std::uint64_t>(box.upper[axis] - box.lower[axis]));
  return shape;
}

std::uint64_t volumeOf(const std::vector<std::uint64_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

Vec3 spacingOf(const GridInfo& grid, int level) {
  Vec3 spacing = grid.spacing;
  for (const int axis : axesInUse(grid)) spacing[axis] = std::ldexp(spacing[axis], -level);
  return spacing;
}

std::vector<std::uint64_t> fieldShape(const GridInfo& grid, Centring centring) {
  if (!grid.boxes.empty()) {
    assert(centring == Centring::cell);
    std::uint64_t cells = 0;
    for (const GridBox& box : grid.boxes) cells += volumeOf(boxShape(box));
    return {cells};
  }
  Index3 entries = grid.cells;
  if (centring == Centring::node)
    for (const int axis : axesInUse(grid)) ++entries[axis];
  return {static_cast<std::uint64_t>(entries[2]), static_cast<std::uint64_t>(entries[1]),
          static_cast<std::uint64_t>(entries[0])};
}

}  // namespace tushar::output
