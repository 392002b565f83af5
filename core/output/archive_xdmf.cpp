#include "core/output/archive_xdmf.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "core/output/archive_files.hpp"
#include "core/output/archive_snapshot.hpp"
#include "core/output/archive_xml.hpp"

namespace tushar::output {

namespace {

using Shape = std::vector<std::uint64_t>;

/// What the items of one output share.
struct Context {
  std::string file;  ///< of HDF5, relative to the XDMF file
  bool doubleAsFloat;
};

pugi::xml_node addGrid(pugi::xml_node parent, const std::string& name, const char* type) {
  pugi::xml_node grid = parent.append_child("Grid");
  set(grid, "Name", name);
  set(grid, "GridType", type);
  return grid;
}

/// The readers know no 8-byte unsigned integers, so ids are read as signed ones.
void addHeavyItem(pugi::xml_node parent, const Context& context, const std::string& path, const Array& array,
                  Shape shape) {
  if (array.components > 1) shape.push_back(static_cast<std::uint64_t>(array.components));
  const bool real = std::holds_alternative<std::vector<double>>(array.values);
  const bool wide = real ? !context.doubleAsFloat : std::holds_alternative<std::vector<std::uint64_t>>(array.values);
  pugi::xml_node item = parent.append_child("DataItem");
  set(item, "Dimensions", fmt::format("{}", fmt::join(shape, " ")));
  set(item, "NumberType", real ? "Float" : "Int");
  set(item, "Precision", wide ? 8 : 4);
  set(item, "Format", "HDF");
  item.text() = (context.file + ":" + path).c_str();
}

void addLightItem(pugi::xml_node parent, const Vec3& zyx) {
  pugi::xml_node item = parent.append_child("DataItem");
  set(item, "Dimensions", 3);
  set(item, "NumberType", "Float");
  set(item, "Precision", 8);
  set(item, "Format", "XML");
  item.text() = fmt::format("{} {} {}", zyx[0], zyx[1], zyx[2]).c_str();
}

void addAttribute(pugi::xml_node grid, const Context& context, const char* centre, const std::string& name,
                  const std::string& path, const Array& array, const Shape& shape) {
  pugi::xml_node attribute = grid.append_child("Attribute");
  set(attribute, "Name", name);
  set(attribute, "AttributeType",
      array.components == 1   ? "Scalar"
      : array.components == 3 ? "Vector"
      : array.components == 9 ? "Tensor"
                              : "Matrix");
  set(attribute, "Center", centre);
  addHeavyItem(attribute, context, path, array, shape);
}

void addParticles(pugi::xml_node at, const Context& context, const ParticleBlock& block) {
  pugi::xml_node grid = addGrid(at, groupName(block.material, block.materialIndex), "Uniform");
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
    addAttribute(grid, context, "Node", array.label, pathInFile(block, array), array, {block.count()});
  }
}

Vec3 reversed(const Vec3& xyz) { return {xyz[2], xyz[1], xyz[0]}; }

/// Where the first node of the nodes' grid stands: an axis that is not in use has its one node in the middle.
Vec3 firstNode(const GridInfo& grid) {
  Vec3 at = grid.lower + grid.spacing / 2;
  for (const int axis : axesInUse(grid)) at[axis] = grid.lower[axis];
  return at;
}

void addFields(pugi::xml_node at, const Context& context, const Snapshot& snapshot, Centring centring) {
  const bool cells = centring == Centring::cell;
  const auto isHere = [&](const FieldBlock& field) { return field.centring == centring; };
  if (std::none_of(snapshot.fields.begin(), snapshot.fields.end(), isHere)) return;
  const Shape shape = fieldShape(snapshot.grid, centring);
  Shape points = shape;
  if (cells)
    for (auto& extent : points) ++extent;
  pugi::xml_node grid = addGrid(at, cells ? "cells" : "nodes", "Uniform");
  pugi::xml_node topology = grid.append_child("Topology");
  set(topology, "TopologyType", "3DCoRectMesh");
  set(topology, "Dimensions", fmt::format("{}", fmt::join(points, " ")));
  pugi::xml_node geometry = grid.append_child("Geometry");
  set(geometry, "GeometryType", "ORIGIN_DXDYDZ");
  addLightItem(geometry, reversed(cells ? snapshot.grid.lower : firstNode(snapshot.grid)));
  addLightItem(geometry, reversed(snapshot.grid.spacing));
  for (const FieldBlock& field : snapshot.fields) {
    if (!isHere(field)) continue;
    const std::string group = field.materialIndex < 0 ? "" : groupName(field.material, field.materialIndex) + "/";
    addAttribute(grid, context, cells ? "Cell" : "Node", group + field.array.label, pathInFile(field), field.array,
                 shape);
  }
}

}  // namespace

XdmfIndex::XdmfIndex(const std::string& name, bool doubleAsFloat) : double_as_float_(doubleAsFloat) {
  pugi::xml_node root = document_.append_child("Xdmf");
  set(root, "Version", "3.0");
  times_ = addGrid(root.append_child("Domain"), name, "Collection");
  set(times_, "CollectionType", "Temporal");
}

void XdmfIndex::add(const Snapshot& snapshot) {
  const std::string name = fmt::format("step {}", snapshot.step);
  times_.remove_child(times_.find_child_by_attribute("Grid", "Name", name.c_str()));
  const Context context{outputName(snapshot.step), double_as_float_};
  pugi::xml_node at = addGrid(times_, name, "Collection");
  set(at, "CollectionType", "Spatial");
  set(at.append_child("Time"), "Value", snapshot.time);
  for (const ParticleBlock& block : snapshot.particles)
    if (block.count() > 0) addParticles(at, context, block);
  addFields(at, context, snapshot, Centring::cell);
  addFields(at, context, snapshot, Centring::node);
}

std::string XdmfIndex::text() const { return textOf(document_); }

}  // namespace tushar::output
