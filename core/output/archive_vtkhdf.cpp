#include "core/output/archive_vtkhdf.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <pugixml.hpp>
#include <vector>

#include "core/output/archive_files.hpp"
#include "core/output/archive_vtkhdf_boxes.hpp"
#include "core/output/archive_vtkhdf_items.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

using Shape = std::vector<std::uint64_t>;

constexpr const char* root = "/VTKHDF";

/// The arrays of a block in one output, by name in the VTKHDF file.
using Items = std::map<std::string, Item>;

/// Outputs by time [s].
using Times = std::map<double, Items>;

/// Adds what a temporal collection of XDMF shows; a time without particles has no items.
void readTimes(const pugi::xml_node& collection, Times& times) {
  for (const pugi::xml_node& grid : collection.children("Grid")) {
    Items& items = times[grid.child("Time").attribute("Value").as_double()];
    const pugi::xml_node points = grid.child("Geometry").child("DataItem");
    if (std::string(points.attribute("Format").as_string()) == "HDF") items["Points"] = itemOf(points);
    for (const pugi::xml_node& attribute : grid.children("Attribute"))
      items[nameOf(attribute)] = itemOf(attribute.child("DataItem"));
  }
}

/// One item for each name that occurs at any time.
Items kindsOf(const Times& times) {
  Items kinds;
  for (const auto& [time, items] : times) kinds.insert(items.begin(), items.end());
  return kinds;
}

std::vector<double> valuesOf(const Times& times) {
  std::vector<double> values;
  for (const auto& time : times) values.push_back(time.first);
  return values;
}

// --- particles

std::uint64_t countOf(const Items& items) {
  const auto points = items.find("Points");
  return points == items.end() ? 0 : points->second.shape.front();
}

/// The values of all times, one after the other.
void addColumn(Hdf5File& file, const std::string& name, const Item& kind, const Times& times, std::uint64_t total) {
  std::vector<VirtualPart> parts;
  std::uint64_t before = 0;
  for (const auto& [time, items] : times) {
    if (const auto found = items.find(name); found != items.end()) {
      const Item& item = found->second;
      Shape first(item.shape.size(), 0);
      first[0] = before;
      parts.push_back({item.file, item.path, item.shape, first, item.shape});
    }
    before += countOf(items);
  }
  Shape shape = kind.shape;
  shape[0] = total;
  file.virtualDataset(inRoot(name), kind.type, shape, parts);
}

/// A vertex for each point. All times show the start of the same 0, 1, 2, …, as numbers of points and as offsets.
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
  for (const auto& [time, items] : times) {
    part.push_back(counts.size());
    starts.push_back(total);
    counts.push_back(countOf(items));
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
    addColumn(file, name, kind, times, total);
    if (name != "Points") addNumbers(file, "Steps/PointDataOffsets" + name.substr(name.find('/')), starts);
  }
}

// --- cells and nodes

/// The points of a uniform grid.
struct Image {
  Shape points;                             ///< along z, y, x
  std::vector<double> origin{}, spacing{};  ///< along x, y, z, m
};

/// The corners of the cells: an axis that is not in use has one layer of nodes, in the middle, and two of corners.
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

/// Where there are two layers of corners for one of nodes, both show the same nodes.
void addAtStep(std::vector<VirtualPart>& parts, const Item& item, const Shape& room, std::uint64_t step) {
  Shape extent{1};
  extent.insert(extent.end(), item.shape.begin(), item.shape.end());
  for (std::uint64_t z = 0; z < room[0]; z += extent[1])
    for (std::uint64_t y = 0; y < room[1]; y += extent[2])
      for (std::uint64_t x = 0; x < room[2]; x += extent[3]) {
        Shape first{step, z, y, x};
        first.resize(extent.size(), 0);
        parts.push_back({item.file, item.path, item.shape, first, extent});
      }
}

void addField(Hdf5File& file, const std::string& name, const Item& kind, const Times& times, Shape room) {
  if (name.starts_with("CellData"))
    for (std::uint64_t& extent : room) --extent;
  std::vector<VirtualPart> parts;
  std::uint64_t step = 0;
  for (const auto& [time, items] : times) {
    if (const auto found = items.find(name); found != items.end()) addAtStep(parts, found->second, room, step);
    ++step;
  }
  Shape shape{times.size()};
  shape.insert(shape.end(), room.begin(), room.end());
  shape.insert(shape.end(), kind.shape.begin() + 3, kind.shape.end());
  file.virtualDataset(inRoot(name), kind.type, shape, parts);
}

void writeFields(Hdf5File& file, const Times& times, const Image& image) {
  addHead(file, "ImageData", {2, 0}, valuesOf(times));
  std::vector<int> extent(6, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) extent[2 * axis + 1] = static_cast<int>(image.points[2 - axis]) - 1;
  file.attribute(root, "WholeExtent", extent);
  file.attribute(root, "Origin", image.origin);
  file.attribute(root, "Spacing", image.spacing);
  file.attribute(root, "Direction", std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  for (const auto& [name, kind] : kindsOf(times)) addField(file, name, kind, times, image.points);
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

void writeVtkHdf(const fs::path& xdmfFile, const pugi::xml_node& domain) {
  Times fields;
  Image image;
  for (const pugi::xml_node& block : domain) {
    const std::string name = block.attribute("Name").as_string();
    const pugi::xml_node first = block.child("Grid");
    if (hasBoxes(block)) {
      putInPlace(fs::path(xdmfFile).replace_extension("vtkhdf"), [&](Hdf5File& file) { writeBoxes(file, block); });
    } else if (first.child("Topology").attribute("TopologyType").as_string() == std::string("3DCoRectMesh")) {
      if (image.points.empty() || name == "cells") image = imageOf(first);
      readTimes(block, fields);
    } else {
      Times particles;
      readTimes(block, particles);
      if (kindsOf(particles).empty()) continue;
      putInPlace(fs::path(xdmfFile).replace_extension(name + ".vtkhdf"),
                 [&](Hdf5File& file) { writeParticles(file, particles); });
    }
  }
  if (!fields.empty())
    putInPlace(fs::path(xdmfFile).replace_extension("vtkhdf"),
               [&](Hdf5File& file) { writeFields(file, fields, image); });
}

}  // namespace tushar::output
