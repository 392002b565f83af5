#include "core/output/archive_vtkhdf.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

using Shape = std::vector<std::uint64_t>;

constexpr const char* root = "/VTKHDF";

/// Outputs sorted by time.
using Times = std::vector<const ShownOutput*>;

Times inOrder(Times times) {
  std::stable_sort(times.begin(), times.end(), [](const auto* a, const auto* b) { return a->time < b->time; });
  return times;
}

Times inOrder(const std::vector<ShownOutput>& outputs) {
  Times times;
  for (const ShownOutput& output : outputs) times.push_back(&output);
  return inOrder(std::move(times));
}

/// Collects one item for each name that occurs at any time.
Items kindsOf(const Times& times) {
  Items kinds;
  const Items* last = nullptr;
  for (const ShownOutput* output : times) {
    if (output->items != last) kinds.insert(output->items->begin(), output->items->end());
    last = output->items;
  }
  return kinds;
}

std::vector<double> valuesOf(const Times& times) {
  std::vector<double> values;
  for (const ShownOutput* output : times) values.push_back(output->time);
  return values;
}

// --- particles

/// Adds a dataset that contains the values of all times, one after the other.
void addColumn(Hdf5File& file, const std::string& name, const Item& kind, const Times& times) {
  std::vector<VirtualPart> parts;
  std::uint64_t before = 0;
  for (const ShownOutput* output : times) {
    if (const auto found = output->items->find(name); found != output->items->end()) {
      const Shape shape = found->second.shapeOf(output->count);
      Shape first(shape.size(), 0);
      first[0] = before;
      parts.push_back({outputName(output->step), found->second.path, shape, first, shape});
    }
    before += output->count;
  }
  file.virtualDataset(inRoot(name), kind.type, kind.shapeOf(before), parts);
}

/// Adds a vertex for each point. All times use the beginning of the same sequence 0, 1, 2, … as indices of points and
/// as offsets.
void addVertices(Hdf5File& file, const std::vector<std::uint64_t>& counts, std::uint64_t total) {
  const std::uint64_t most = *std::max_element(counts.begin(), counts.end());
  const std::string numbers = inRoot("Connectivity");
  file.sequence(numbers, most + 1);
  std::vector<VirtualPart> parts;
  std::uint64_t before = 0;
  for (const std::uint64_t count : counts) {
    parts.push_back({".", numbers, {most + 1}, {before}, {count + 1}});
    before += count + 1;
  }
  file.virtualDataset(inRoot("Offsets"), std::vector<std::uint64_t>{}, {before}, parts);
  constexpr std::uint8_t vertex = 1;  // VTK_VERTEX
  file.equalBytes(inRoot("Types"), vertex, total);
}

void writeParticles(Hdf5File& file, const Times& times) {
  addHead(file, "UnstructuredGrid", {2, 0}, valuesOf(times));
  std::vector<std::uint64_t> counts, starts, part;
  std::uint64_t total = 0;
  for (const ShownOutput* output : times) {
    part.push_back(counts.size());
    starts.push_back(total);
    counts.push_back(output->count);
    total += counts.back();
  }
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    addNumbers(file, name, counts);
  addNumbers(file, "Steps/PartOffsets", part);
  addNumbers(file, "Steps/NumberOfParts", std::vector<std::uint64_t>(counts.size(), 1));
  addNumbers(file, "Steps/PointOffsets", starts);
  addNumbers(file, "Steps/CellOffsets", starts);
  addNumbers(file, "Steps/ConnectivityIdOffsets", std::vector<std::uint64_t>(counts.size(), 0));
  addVertices(file, counts, total);
  for (const auto& [name, kind] : kindsOf(times)) {
    addColumn(file, name, kind, times);
    if (name != "Points") addNumbers(file, "Steps/PointDataOffsets" + name.substr(name.find('/')), starts);
  }
}

// --- cells and nodes

using Image = VtkHdfIndex::Image;

/// The corners of the cells of a grid; along an axis that is not in use there are two layers of corners, but only one
/// of nodes, in the middle.
Image imageOf(const pugi::xml_node& grid) {
  Image image{numbersIn<std::uint64_t>(grid.child("Topology").attribute("Dimensions").as_string())};
  const pugi::xml_node origin = grid.child("Geometry").child("DataItem");
  image.origin = numbersIn<double>(origin.text().as_string());
  image.spacing = numbersIn<double>(origin.next_sibling("DataItem").text().as_string());
  for (std::size_t k = 0; k < 3; ++k) {
    if (image.points[k] > 1) continue;
    image.points[k] = 2;
    image.origin[k] -= image.spacing[k] / 2;
  }
  std::reverse(image.origin.begin(), image.origin.end());
  std::reverse(image.spacing.begin(), image.spacing.end());
  return image;
}

/// The outputs of cells and nodes at one time.
struct ShownTime {
  double time;
  std::vector<const ShownOutput*> parts{};

  /// The output that contains an item of this name, and the item; null pointers if there is none.
  std::pair<const ShownOutput*, const Item*> find(const std::string& name) const {
    for (const ShownOutput* part : parts)
      if (const auto found = part->items->find(name); found != part->items->end()) return {part, &found->second};
    return {};
  }
};

/// Groups outputs of several blocks by time.
std::vector<ShownTime> together(const Times& outputs) {
  std::vector<ShownTime> times;
  for (const ShownOutput* output : outputs) {
    if (times.empty() || times.back().time != output->time) times.push_back({output->time});
    times.back().parts.push_back(output);
  }
  return times;
}

/// Adds the parts of a step. If a single layer of nodes is drawn as two layers of corners, both layers show its values.
void addAtStep(std::vector<VirtualPart>& parts, const std::string& output, const Item& item, const Shape& room,
               std::uint64_t step) {
  Shape extent{1};
  extent.insert(extent.end(), item.shape.begin(), item.shape.end());
  for (std::uint64_t z = 0; z < room[0]; z += extent[1])
    for (std::uint64_t y = 0; y < room[1]; y += extent[2])
      for (std::uint64_t x = 0; x < room[2]; x += extent[3]) {
        Shape first{step, z, y, x};
        first.resize(extent.size(), 0);
        parts.push_back({output, item.path, item.shape, first, extent});
      }
}

void addField(Hdf5File& file, const std::string& name, const Item& kind, const std::vector<ShownTime>& times,
              Shape room) {
  if (name.starts_with("CellData"))
    for (std::uint64_t& extent : room) --extent;
  std::vector<VirtualPart> parts;
  for (std::uint64_t step = 0; step < times.size(); ++step)
    if (const auto [output, item] = times[step].find(name); item)
      addAtStep(parts, outputName(output->step), *item, room, step);
  Shape shape{times.size()};
  shape.insert(shape.end(), room.begin(), room.end());
  shape.insert(shape.end(), kind.shape.begin() + 3, kind.shape.end());
  file.virtualDataset(inRoot(name), kind.type, shape, parts);
}

void writeFields(Hdf5File& file, const Times& outputs, const Image& image) {
  const std::vector<ShownTime> times = together(outputs);
  std::vector<double> values;
  for (const ShownTime& time : times) values.push_back(time.time);
  addHead(file, "ImageData", {2, 0}, values);
  std::vector<int> extent(6, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) extent[2 * axis + 1] = static_cast<int>(image.points[2 - axis]) - 1;
  file.attribute(root, "WholeExtent", extent);
  file.attribute(root, "Origin", image.origin);
  file.attribute(root, "Spacing", image.spacing);
  file.attribute(root, "Direction", std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  for (const auto& [name, kind] : kindsOf(outputs)) addField(file, name, kind, times, image.points);
}

void putInPlace(const fs::path& path, const std::function<void(Hdf5File&)>& write) {
  const fs::path temporary = temporaryOf(path);
  try {
    Hdf5File file(temporary, false, 0);
    write(file);
    file.close();
    moveInto(temporary, path);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

}  // namespace

VtkHdfIndex::Block& VtkHdfIndex::blockOf(const std::string& name, const pugi::xml_node& grid) {
  const auto found =
      std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& other) { return other.name == name; });
  if (found != blocks_.end()) return *found;
  const bool isMesh = grid.child("Topology").attribute("TopologyType").as_string() == std::string("3DCoRectMesh");
  return blocks_.emplace_back(Block{name, isMesh || grid.child("Grid"), isMesh ? imageOf(grid) : Image{}, {}});
}

const Items* VtkHdfIndex::kindOf(Items items) {
  const auto found = std::find(kinds_.rbegin(), kinds_.rend(), items);
  return found == kinds_.rend() ? &kinds_.emplace_back(std::move(items)) : &*found;
}

void VtkHdfIndex::add(const std::string& name, int step, const pugi::xml_node& grid) {
  Block& block = blockOf(name, grid);
  ShownOutput output{step, grid.child("Time").attribute("Value").as_double()};
  const pugi::xml_node box = grid.child("Grid");
  output.items = kindOf(itemsOf(box ? box : grid, output.count));
  if (block.isMesh && name == "cells") boxes_.add(grid, output);
  removeStep(block.outputs, step);
  block.outputs.push_back(std::move(output));
}

void VtkHdfIndex::forget() {
  blocks_.clear();
  kinds_.clear();
}

void VtkHdfIndex::write(const fs::path& xdmfFile) const {
  Times fields;
  Image image;
  for (const Block& block : blocks_) {
    const Times times = inOrder(block.outputs);
    if (block.isMesh && block.name == "cells" && boxes_.any()) {
      putInPlace(fs::path(xdmfFile).replace_extension("vtkhdf"), [&](Hdf5File& file) { boxes_.write(file, times); });
    } else if (block.isMesh) {
      if (image.points.empty() || block.name == "cells") image = block.image;
      fields.insert(fields.end(), times.begin(), times.end());
    } else if (!kindsOf(times).empty()) {
      putInPlace(fs::path(xdmfFile).replace_extension(block.name + ".vtkhdf"),
                 [&](Hdf5File& file) { writeParticles(file, times); });
    }
  }
  if (!fields.empty())
    putInPlace(fs::path(xdmfFile).replace_extension("vtkhdf"),
               [&](Hdf5File& file) { writeFields(file, inOrder(std::move(fields)), image); });
}

}  // namespace tushar::output
