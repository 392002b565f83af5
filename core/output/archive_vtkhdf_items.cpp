#include "core/output/archive_vtkhdf_items.hpp"

#include <utility>

#include "core/output/archive_files.hpp"

namespace tushar::output {

namespace {

Array::Values typeOf(const pugi::xml_node& item) {
  if (std::string(item.attribute("NumberType").as_string()) == "Float") return std::vector<double>{};
  if (item.attribute("Precision").as_int() == 8) return std::vector<std::uint64_t>{};
  return std::vector<std::int32_t>{};
}

/// The name of an XDMF Attribute in the VTKHDF file: `CellData/c.temperature`.
std::string nameOf(const pugi::xml_node& attribute) {
  const bool ofCells = std::string(attribute.attribute("Center").as_string()) == "Cell";
  return (ofCells ? "CellData/" : "PointData/") + nameInPath(attribute.attribute("Name").as_string());
}

/// The dataset whose rows a HyperSlab shows; other items are returned unchanged.
pugi::xml_node wholeOf(const pugi::xml_node& item) {
  const pugi::xml_node slab = item.child("DataItem");
  return slab ? slab.next_sibling("DataItem") : item;
}

}  // namespace

std::vector<std::uint64_t> Item::shapeOf(std::uint64_t count) const {
  std::vector<std::uint64_t> full = shape;
  if (isList()) full.front() = count;
  return full;
}

Item itemOf(const pugi::xml_node& node, std::uint64_t& count) {
  const std::string place = node.text().as_string();
  Item item{place.substr(place.find(':') + 1), numbersIn<std::uint64_t>(node.attribute("Dimensions").as_string()),
            typeOf(node)};
  if (item.isList() && !item.shape.empty()) count = std::exchange(item.shape.front(), 0);
  return item;
}

Items itemsOf(const pugi::xml_node& grid, std::uint64_t& count) {
  Items items;
  const pugi::xml_node points = grid.child("Geometry").child("DataItem");
  if (std::string(points.attribute("Format").as_string()) == "HDF") items["Points"] = itemOf(points, count);
  for (const pugi::xml_node& attribute : grid.children("Attribute"))
    items[nameOf(attribute)] = itemOf(wholeOf(attribute.child("DataItem")), count);
  return items;
}

std::string inRoot(const std::string& name) { return name.empty() ? "/VTKHDF" : "/VTKHDF/" + name; }

void addNumbers(Hdf5File& file, const std::string& name, Array::Values values, int components) {
  const Array array{name, "", "", components, std::move(values)};
  file.dataset(inRoot(name), array, {array.entries()});
}

void addHead(Hdf5File& file, const char* type, const std::vector<int>& version, const std::vector<double>& times) {
  file.group(inRoot("Steps"));
  file.attribute(inRoot(""), "Version", version);
  file.fixedText(inRoot(""), "Type", type);
  file.attribute(inRoot("Steps"), "NSteps", static_cast<int>(times.size()));
  addNumbers(file, "Steps/Values", times);
}

}  // namespace tushar::output
