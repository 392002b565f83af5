#pragma once

#include <cstdint>
#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/output/archive_hdf5.hpp"

namespace tushar::output {

/// A dataset of an output, as described in an XDMF file.
struct Item {
  std::string path;
  std::vector<std::uint64_t> shape;  ///< shape; the number of entries is 0 for lists of particles and of cells of boxes
  Array::Values type;

  bool isList() const { return shape.size() <= 2; }
  /// The shape in an output whose lists have `count` entries.
  std::vector<std::uint64_t> shapeOf(std::uint64_t count) const;
  bool operator==(const Item&) const = default;
};

/// The items of an output, by their names in the VTKHDF file.
using Items = std::map<std::string, Item>;

/// Boxes of a level whose cells are consecutive rows of an output's datasets.
struct LevelRows {
  int level;
  std::uint32_t boxes;
  std::uint64_t place;  ///< place in the scratch file, which has six 32-bit numbers for each box: first and last cell
                        ///< along x, y, z
  std::uint64_t first, rows;  ///< first row, and number of rows; each cell is a row
};

/// An output of a block.
struct ShownOutput {
  int step;
  double time;              ///< time [s]
  std::uint64_t count = 0;  ///< number of entries of the lists
  const Items* items = nullptr;
  std::vector<LevelRows> levels{};
};

/// Removes the output of a step, if there is one. Steps ascend, so the search starts at the end, and its time does not
/// depend on the number of outputs.
template <class Output>
void removeStep(std::vector<Output>& outputs, int step) {
  auto found = outputs.end();
  while (found != outputs.begin() && (found - 1)->step > step) --found;
  if (found != outputs.begin() && (found - 1)->step == step) outputs.erase(found - 1);
}

/// Reads the numbers in a text, up to the first word that is not a number.
template <class Number>
std::vector<Number> numbersIn(const char* text) {
  std::istringstream words(text);
  std::vector<Number> numbers;
  for (Number number; words >> number;) numbers.push_back(number);
  return numbers;
}

/// The dataset to which an XDMF DataItem refers; `count` is set to the number of entries if it is a list.
Item itemOf(const pugi::xml_node& node, std::uint64_t& count);

/// The items of the points and of the attributes of an XDMF grid; an attribute may consist of some rows of a dataset.
Items itemsOf(const pugi::xml_node& grid, std::uint64_t& count);

/// The path of an object in a VTKHDF file.
std::string inRoot(const std::string& name);

/// Writes numbers as a dataset of a VTKHDF file, with `components` numbers per entry.
void addNumbers(Hdf5File& file, const std::string& name, Array::Values values, int components = 1);

/// Makes the groups of a VTKHDF file: its version, its type and its times [s].
void addHead(Hdf5File& file, const char* type, const std::vector<int>& version, const std::vector<double>& times);

}  // namespace tushar::output
