#pragma once

#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/output/archive_hdf5.hpp"

namespace tushar::output {

/// A dataset of an output, as an XDMF file names it.
struct Item {
  std::string file, path;
  std::vector<std::uint64_t> shape;
  Array::Values type;
};

/// The numbers in a text, up to the first word that is not a number.
template <class Number>
std::vector<Number> numbersIn(const char* text) {
  std::istringstream words(text);
  std::vector<Number> numbers;
  for (Number number; words >> number;) numbers.push_back(number);
  return numbers;
}

/// The target of an XDMF DataItem.
Item itemOf(const pugi::xml_node& node);

/// The name, in a VTKHDF file, of an Attribute of XDMF: `CellData/c.temperature`.
std::string nameOf(const pugi::xml_node& attribute);

/// The path of something in a VTKHDF file.
std::string inRoot(const std::string& name);

/// Writes numbers as a dataset of a VTKHDF file, `components` for each entry.
void addNumbers(Hdf5File& file, const std::string& name, Array::Values values, int components = 1);

/// Makes the groups of a VTKHDF file: its version and type, and its times [s].
void addHead(Hdf5File& file, const char* type, const std::vector<int>& version, const std::vector<double>& times);

}  // namespace tushar::output
