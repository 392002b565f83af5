#include "core/output/archive_vtkhdf_items.hpp"

#include "core/output/archive_files.hpp"

namespace tushar::output {

namespace {

Array::Values typeOf(const pugi::xml_node& item) {
  if (std::string(item.attribute("NumberType").as_string()) == "Float") return std::vector<double>{};
  if (item.attribute("Precision").as_int() == 8) return std::vector<std::uint64_t>{};
  return std::vector<std::int32_t>{};
}

}  // namespace

Item itemOf(const pugi::xml_node& node) {
  const std::string place = node.text().as_string();
  const std::size_t colon = place.find(':');
  return {place.substr(0, colon), place.substr(colon + 1),
          numbersIn<std::uint64_t>(node.attribute("Dimensions").as_string()), typeOf(node)};
}

std::string nameOf(const pugi::xml_node& attribute) {
  const bool ofCells = std::string(attribute.attribute("Center").as_string()) == "Cell";
  return (ofCells ? "CellData/" : "PointData/") + nameInPath(attribute.attribute("Name").as_string());
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
