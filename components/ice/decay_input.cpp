#include "components/ice/decay_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace tushar::ice {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

/// The numbers in a line of four, separated by commas or blanks; none if it has other content.
std::optional<std::array<double, 4>> numbersIn(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream words(line);
  std::array<double, 4> numbers{};
  for (double& number : numbers)
    if (!(words >> number) || !std::isfinite(number)) return std::nullopt;
  std::string more;
  return words >> more ? std::nullopt : std::optional(numbers);
}

/// Reads the lines `x,y,z,value` of a file; lines that begin with # are comments.
std::shared_ptr<const ValuesOfCells> readValues(const DecayCoefficient& read, const std::string& model,
                                                Diagnostics& diagnostics) {
  auto values = std::make_shared<ValuesOfCells>();
  values->path = fmt::format("Models/Model/{}/scalar/exponentialDecay/c2/filename", model);
  values->where = read.whereOfFile;
  values->file = *read.file;
  std::ifstream file(*read.file);
  if (!file) {
    diagnostics.error(read.whereOfFile, values->path,
                      fmt::format("'{}' cannot be read: there is no such file", *read.file));
    return nullptr;
  }
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.starts_with('#') || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto numbers = numbersIn(line);
    if (!numbers) {
      diagnostics.error(
          read.whereOfFile, values->path,
          fmt::format("'{}' has '{}' in line {}, expected x,y,z,c2", *read.file, line.substr(0, 40), number));
      return nullptr;
    }
    const auto& [x, y, z, value] = *numbers;
    values->points.emplace_back(Vec3(x, y, z), value);
  }
  return values;
}

void checkCoefficient(const DecayCoefficient& read, const Element& tag, Diagnostics& diagnostics) {
  if (!read.isTable && !read.value) diagnostics.error(tag, "missing tag <value> in <c2>: type 'constant' needs it");
  if (read.isTable && !read.file) diagnostics.error(tag, "missing tag <filename> in <c2>: type 'variable' needs it");
}

}  // namespace

const Schema<DecaySection>& decaySchema() {
  static const Schema<DecayCoefficient> coefficient =
      Schema<DecayCoefficient>("c2", "The coefficient c2, the same everywhere or read from a file.")
          .location(&DecayCoefficient::whereOfFile)
          .choiceAttribute("type", &DecayCoefficient::isTable, {{"constant", false}, {"variable", true}}, false,
                           "whether c2 is <value>, or that of each cell in <filename>")
          .optional("value", &DecayCoefficient::value, "1", "c2, of type constant")
          .optional("filename", &DecayCoefficient::file, "1",
                    "a file with a line x,y,z,c2 for each cell, of type variable; x, y, z [m] is a point in the cell")
          .check(checkCoefficient);
  static const Schema<DecaySection> schema =
      Schema<DecaySection>("exponentialDecay", "The scalar f falls by df/dt = -(c1 c2 + c3) f.")
          .required("c1", &DecaySection::factor, "1/s", "c1", input::nonNegative())
          .requiredSection("c2", &DecaySection::coefficient, coefficient, "c2")
          .value("c3", &DecaySection::rate, 0, "1/s", "c3");
  return schema;
}

ScalarDecay decayOf(double constantRate, double linearRate, const std::optional<DecaySection>& decay,
                    const std::string& model, Diagnostics& diagnostics) {
  ScalarDecay result;
  result.constantRate = constantRate;
  result.linearRate = linearRate;
  if (!decay) return result;
  result.isExponential = true;
  result.linearRate += decay->rate;
  result.factor = decay->factor;
  const DecayCoefficient& coefficient = decay->coefficient;
  if (!(coefficient.isTable ? coefficient.file.has_value() : coefficient.value.has_value())) return result;
  if (coefficient.isTable)
    result.coefficients = readValues(coefficient, model, diagnostics);
  else
    result.coefficient = *coefficient.value;
  return result;
}

}  // namespace tushar::ice
