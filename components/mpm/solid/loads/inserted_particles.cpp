#include "components/mpm/solid/loads/inserted_particles.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/input/values.hpp"

namespace tushar::mpm::solid {

namespace {

using input::Diagnostics;

/// Number of values that describe an insertion in a file.
constexpr std::size_t insertionSize = 8;

/// Reads the numbers in a line.
std::vector<double> numbersOf(const std::string& line, const Location& where, Diagnostics& diagnostics) {
  std::vector<double> numbers;
  std::istringstream words(line);
  std::string word;
  while (words >> word) {
    const auto number = input::parse<double>(word).value;
    if (!number) diagnostics.error(where, {}, fmt::format("found '{}', expected a number", word));
    numbers.push_back(number.value_or(0));
  }
  return numbers;
}

}  // namespace

std::vector<Insertion> readInsertions(const std::string& path, const Location& named, Diagnostics& diagnostics) {
  std::ifstream file(path);
  if (const bool isFolder = std::filesystem::is_directory(path); !file || isFolder) {
    const char* why = isFolder ? ": it is a folder" : std::filesystem::exists(path) ? "" : ": there is no such file";
    diagnostics.error(named, "MPM/InsertParticlesFile", fmt::format("'{}' cannot be read{}", path, why));
    return {};
  }
  std::vector<Insertion> insertions;
  std::string line;
  for (int at = 1; std::getline(file, line); ++at) {
    const Location where{path, at, 0};
    const std::vector<double> n = numbersOf(line, where, diagnostics);
    if (n.empty()) continue;
    if (n.size() == insertionSize)
      insertions.push_back({n[0], n[1], {n[2], n[3], n[4]}, {n[5], n[6], n[7]}});
    else
      diagnostics.error(where, {},
                        fmt::format("found {} numbers, expected 8: time, color, 3 components of the shift, 3 of the "
                                    "new velocity",
                                    n.size()));
  }
  return insertions;
}

}  // namespace tushar::mpm::solid
