#include "components/mpm/solid/loads/inserted_particles.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "components/mpm/solid/number_lines.hpp"

namespace tushar::mpm::solid {

namespace {

using input::Diagnostics;

/// Number of values that describe an insertion in a file.
constexpr std::size_t insertionSize = 8;

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
    const auto numbers = numbersInLine(line, where, diagnostics);
    if (!numbers || numbers->empty()) continue;
    const std::vector<double>& n = *numbers;
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

void refuseShifts(const Level& level, const std::vector<Insertion>& insertions, const Location& where) {
  std::array<bool, 3> isThin{true, true, true};
  for (int d = 0; d < level.dimension(); ++d) isThin[level.axis(d)] = false;
  for (const Insertion& insertion : insertions)
    for (int axis = 0; axis < 3; ++axis)
      if (isThin[axis] && insertion.shift[axis] != 0)
        throw InputError({{where, "MPM/InsertParticlesFile",
                           fmt::format("particles move along {}, along which the grid has one cell", "xyz"[axis])}});
}

}  // namespace tushar::mpm::solid
