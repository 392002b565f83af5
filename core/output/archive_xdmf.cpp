#include "core/output/archive_xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <ostream>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/joined.hpp"
#include "core/output/archive_snapshot.hpp"
#include "core/output/archive_snapshot_head.hpp"
#include "core/output/archive_xdmf_reader.hpp"
#include "core/output/archive_xml.hpp"

namespace tushar::output {

namespace {

using Shape = std::vector<std::uint64_t>;

/// Consecutive entries of a dataset, and the shape in which they are shown.
struct StoredRows {
  std::uint64_t first;
  Shape shape;
};

/// The common properties of the items of one output.
struct Context {
  std::string file;  ///< path of the HDF5 file, relative to the XDMF file
  bool doubleAsFloat;
};

pugi::xml_node addGrid(pugi::xml_node parent, const std::string& name, const char* type) {
  pugi::xml_node grid = parent.append_child("Grid");
  set(grid, "Name", name);
  set(grid, "GridType", type);
  return grid;
}

/// Adds an item whose values are in an HDF5 file. Readers do not support 8-byte unsigned integers, so ids are declared
/// as signed ones.
void addHeavyItem(pugi::xml_node parent, const Context& context, const std::string& path, const Array& array,
                  Shape shape) {
  if (array.components > 1) shape.push_back(static_cast<std::uint64_t>(array.components));
  const bool real = std::holds_alternative<std::vector<double>>(array.values);
  const bool wide = real ? !context.doubleAsFloat : std::holds_alternative<std::vector<std::uint64_t>>(array.values);
  pugi::xml_node item = parent.append_child("DataItem");
  set(item, "Dimensions", joined(shape, " "));
  set(item, "NumberType", real ? "Float" : "Int");
  set(item, "Precision", wide ? 8 : 4);
  set(item, "Format", "HDF");
  item.text() = (context.file + ":" + path).c_str();
}

/// Adds consecutive entries of an array in the file.
void addSlab(pugi::xml_node parent, const Context& context, const std::string& path, const Array& array,
             const StoredRows& rows) {
  const bool several = array.components > 1;
  const std::uint64_t count = volumeOf(rows.shape);
  pugi::xml_node item = parent.append_child("DataItem");
  set(item, "ItemType", "HyperSlab");
  set(item, "Dimensions",
      fmt::format("{}{}", joined(rows.shape, " "), several ? fmt::format(" {}", array.components) : ""));
  pugi::xml_node slab = item.append_child("DataItem");
  set(slab, "Dimensions", several ? "3 2" : "3 1");
  set(slab, "Format", "XML");
  slab.text() = (several ? fmt::format("{} 0 1 1 {} {}", rows.first, count, array.components)
                         : fmt::format("{} 1 {}", rows.first, count))
                    .c_str();
  addHeavyItem(item, context, path, array, {array.entries()});
}

void addLightItem(pugi::xml_node parent, const Vec3& zyx) {
  pugi::xml_node item = parent.append_child("DataItem");
  set(item, "Dimensions", 3);
  set(item, "NumberType", "Float");
  set(item, "Precision", 8);
  set(item, "Format", "XML");
  item.text() = fmt::format("{} {} {}", zyx[0], zyx[1], zyx[2]).c_str();
}

pugi::xml_node addAttribute(pugi::xml_node grid, const char* centre, const std::string& name, const Array& array) {
  pugi::xml_node attribute = grid.append_child("Attribute");
  set(attribute, "Name", name);
  set(attribute, "AttributeType",
      array.components == 1   ? "Scalar"
      : array.components == 3 ? "Vector"
      : array.components == 9 ? "Tensor"
                              : "Matrix");
  set(attribute, "Center", centre);
  return attribute;
}

void addPointCloud(pugi::xml_node grid, const Context& context, const ParticleBlock& block) {
  pugi::xml_node topology = grid.append_child("Topology");
  set(topology, "TopologyType", "Polyvertex");
  set(topology, "NodesPerElement", 1);
  set(topology, "NumberOfElements", block.count());
  pugi::xml_node geometry = grid.append_child("Geometry");
  set(geometry, "GeometryType", "XYZ");
  const Array& x = block.arrays.front();
  addHeavyItem(geometry, context, pathInFile(block, x), x, {block.count()});
  for (std::size_t k = 1; k < block.arrays.size(); ++k) {
    const Array& array = block.arrays[k];
    if (!isHeld(block, array)) continue;
    addHeavyItem(addAttribute(grid, "Node", array.label, array), context, pathInFile(block, array), array,
                 {block.count()});
  }
}

Vec3 reversed(const Vec3& xyz) { return {xyz[2], xyz[1], xyz[0]}; }

/// The position of the first node; along an axis that is not in use, the single node is in the middle.
Vec3 firstNode(const GridInfo& grid) {
  Vec3 at = grid.lower + grid.spacing / 2;
  for (const int axis : axesInUse(grid)) at[axis] = grid.lower[axis];
  return at;
}

/// Adds a uniform grid with these numbers of points along z, y, x.
void addMesh(pugi::xml_node grid, const Shape& points, const Vec3& origin, const Vec3& spacing) {
  pugi::xml_node topology = grid.append_child("Topology");
  set(topology, "TopologyType", "3DCoRectMesh");
  set(topology, "Dimensions", joined(points, " "));
  pugi::xml_node geometry = grid.append_child("Geometry");
  set(geometry, "GeometryType", "ORIGIN_DXDYDZ");
  addLightItem(geometry, reversed(origin));
  addLightItem(geometry, reversed(spacing));
}

void addUniformGrid(pugi::xml_node grid, const GridInfo& info, Centring centring) {
  const bool cells = centring == Centring::cell;
  Shape points = fieldShape(info, centring);
  if (cells)
    for (auto& extent : points) ++extent;
  addMesh(grid, points, cells ? info.lower : firstNode(info), info.spacing);
}

/// The name of a field as shown in the file.
std::string nameOf(const FieldBlock& field) {
  const std::string group = field.materialIndex < 0 ? "" : groupName(field.material, field.materialIndex) + "/";
  return group + field.array.label;
}

/// Adds a uniform grid for each box, with its part of each field. Grids of different times have different names,
/// because a reader would search long for new names if several grids had the same one.
void addBoxes(pugi::xml_node collection, const Context& context, const Snapshot& snapshot) {
  set(collection, "CollectionType", "Spatial");
  std::uint64_t first = 0;
  int number = 0;
  for (const GridBox& box : snapshot.grid.boxes) {
    const Shape cells = boxShape(box);
    const Vec3 spacing = spacingOf(snapshot.grid, box.level);
    const Vec3 corner(box.lower[0], box.lower[1], box.lower[2]);
    pugi::xml_node grid =
        addGrid(collection, nameAtStep(fmt::format("level {} box {}", box.level, number++), snapshot.step), "Uniform");
    addMesh(grid, {cells[0] + 1, cells[1] + 1, cells[2] + 1}, snapshot.grid.lower + corner.cwiseProduct(spacing),
            spacing);
    for (const FieldBlock& field : snapshot.fields)
      addSlab(addAttribute(grid, "Cell", nameOf(field), field.array), context, pathInFile(field), field.array,
              {first, cells});
    first += volumeOf(cells);
  }
}

}  // namespace

XdmfIndex::XdmfIndex(std::filesystem::path file, bool doubleAsFloat)
    : file_(std::move(file)), double_as_float_(doubleAsFloat), scratch_(temporaryOf(file_)), vtkhdf_(scratch_) {}

void XdmfIndex::keep(const std::string& name, int step, const pugi::xml_node& grid) {
  auto block = std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& other) { return other.name == name; });
  if (block == blocks_.end()) block = blocks_.insert(block, {name, {}});
  const std::string text = textOf(grid, depthOfOutputs);
  const std::uint64_t first = scratch_.append(std::as_bytes(std::span(text)));
  removeStep(block->outputs, step);
  block->outputs.push_back({step, first, text.size()});
  vtkhdf_.add(name, step, grid);
}

void XdmfIndex::forget() {
  blocks_.clear();
  vtkhdf_.forget();
}

void XdmfIndex::resume(const ArchiveIndex& index) {
  std::set<int> shown;
  const bool isWhole = readXdmf(file_, [&](const std::string& block, int step, const pugi::xml_node& grid) {
    if (!index.lists(step)) return;
    keep(block, step, grid);
    shown.insert(step);
  });
  if (!isWhole) {
    forget();
    shown.clear();
  }
  for (const int step : index.steps()) {
    if (shown.contains(step)) continue;
    std::optional<Snapshot> head;
    try {
      head = readHead(file_.parent_path() / outputName(step), index);
    } catch (const FileError&) {
      // The output has been removed or damaged from outside, and cannot be shown.
    }
    if (head) add(*head);
  }
}

void XdmfIndex::write() const {
  replaceFile(file_, [this](std::ostream& out) {
    out << xmlDeclaration << "<Xdmf Version=\"3.0\">\n <Domain>\n";
    std::string text;
    for (const Block& block : blocks_) {
      out << headOfBlock(block.name) << '\n';
      for (const Text& output : block.outputs) {
        text.resize(output.size);
        scratch_.read(output.first, std::as_writable_bytes(std::span(text)));
        out << text;
      }
      out << "  </Grid>\n";
    }
    out << " </Domain>\n</Xdmf>\n";
  });
}

void XdmfIndex::addTime(const std::string& block, const Snapshot& snapshot, const char* type,
                        const std::function<void(pugi::xml_node)>& fill) {
  pugi::xml_document document;
  pugi::xml_node grid = addGrid(document, nameAtStep(block, snapshot.step), type);
  set(grid.append_child("Time"), "Value", snapshot.time);
  fill(grid);
  keep(block, snapshot.step, grid);
}

void XdmfIndex::addFields(const Snapshot& snapshot, Centring centring) {
  const Context context{outputName(snapshot.step), double_as_float_};
  const bool cells = centring == Centring::cell;
  const auto isHere = [&](const FieldBlock& field) { return field.centring == centring; };
  if (std::none_of(snapshot.fields.begin(), snapshot.fields.end(), isHere)) return;
  if (!snapshot.grid.boxes.empty())
    return addTime("cells", snapshot, "Collection", [&](pugi::xml_node grid) { addBoxes(grid, context, snapshot); });
  addTime(cells ? "cells" : "nodes", snapshot, "Uniform", [&](pugi::xml_node grid) {
    addUniformGrid(grid, snapshot.grid, centring);
    for (const FieldBlock& field : snapshot.fields) {
      if (!isHere(field)) continue;
      addHeavyItem(addAttribute(grid, cells ? "Cell" : "Node", nameOf(field), field.array), context, pathInFile(field),
                   field.array, fieldShape(snapshot.grid, centring));
    }
  });
}

/// Adds the particles at one time. If there are none, adds an empty collection, because readers refuse a grid of 0
/// points.
void XdmfIndex::addParticles(const Snapshot& snapshot, const ParticleBlock& block) {
  const std::string name = groupName(block.material, block.materialIndex);
  if (block.count() == 0)
    return addTime(name, snapshot, "Collection", [](pugi::xml_node grid) { set(grid, "CollectionType", "Spatial"); });
  addTime(name, snapshot, "Uniform", [&](pugi::xml_node grid) {
    addPointCloud(grid, {outputName(snapshot.step), double_as_float_}, block);
  });
}

void XdmfIndex::add(const Snapshot& snapshot) {
  for (const ParticleBlock& block : snapshot.particles) addParticles(snapshot, block);
  addFields(snapshot, Centring::cell);
  addFields(snapshot, Centring::node);
}

}  // namespace tushar::output
