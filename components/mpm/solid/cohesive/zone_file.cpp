#include "components/mpm/solid/cohesive/zone_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "components/mpm/solid/number_lines.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;

namespace {

constexpr std::size_t numbersOfZone = 12;
/// Largest difference between 1 and the length of a normal or of a tangent; also the largest cosine between them.
constexpr double directionTolerance = 1e-2;

void checkDirections(const Vec3& normal, const Vec3& tangent, const Location& where, Diagnostics& diagnostics) {
  for (const auto& [name, vector] : {std::pair{"normal", normal}, {"tangent", tangent}})
    if (!(std::abs(vector.norm() - 1) <= directionTolerance))
      diagnostics.error(where, {}, fmt::format("the {} has the length {:g}, expected 1", name, vector.norm()));
  if (!(std::abs(normal.dot(tangent)) <= directionTolerance))
    diagnostics.error(
        where, {},
        fmt::format("the tangent is not perpendicular to the normal: their product is {:g}", normal.dot(tangent)));
}

/// The index of a material in a file; -1 if there is no such material, which is reported.
int indexOf(double number, int materials, const Location& where, Diagnostics& diagnostics) {
  if (number == std::floor(number) && number >= 0 && number < materials) return static_cast<int>(number);
  diagnostics.error(
      where, {}, fmt::format("there is no material {:g}; materials are numbered from 0 to {}", number, materials - 1));
  return -1;
}

CohesiveZone zoneOf(const std::vector<double>& n, int materials, const Location& where, Diagnostics& diagnostics) {
  CohesiveZone zone{.position = {n[0], n[1], n[2]}, .area = n[3], .normal = {n[4], n[5], n[6]}, .line = where.line};
  if (!(zone.area > 0)) diagnostics.error(where, {}, fmt::format("the area is {:g}, expected more than 0", zone.area));
  checkDirections(zone.normal, {n[7], n[8], n[9]}, where, diagnostics);
  zone.normal.normalize();
  zone.bottom = indexOf(n[10], materials, where, diagnostics);
  zone.top = indexOf(n[11], materials, where, diagnostics);
  if (zone.bottom >= 0 && zone.bottom == zone.top)
    diagnostics.error(where, {}, fmt::format("the bottom and the top material are both {}", zone.top));
  return zone;
}

}  // namespace

std::vector<CohesiveZone> readZones(const std::string& path, const Location& named, int materials,
                                    Diagnostics& diagnostics) {
  std::ifstream file(path);
  if (const bool isFolder = std::filesystem::is_directory(path); !file || isFolder) {
    std::string why = isFolder ? ": it is a folder" : std::filesystem::exists(path) ? "" : ": there is no such file";
    if (std::filesystem::exists(path + ".gz")) why += fmt::format("; unpack '{}.gz'", path);
    diagnostics.error(named, "MaterialProperties/MPM/cohesive_zone/cz_filename",
                      fmt::format("'{}' cannot be read{}", path, why));
    return {};
  }
  const std::size_t before = diagnostics.size();
  std::vector<CohesiveZone> zones;
  std::string line;
  for (int at = 1; std::getline(file, line); ++at) {
    const Location where{path, at, 0};
    const auto numbers = numbersInLine(line, where, diagnostics);
    if (!numbers || numbers->empty()) continue;
    if (numbers->size() == numbersOfZone)
      zones.push_back(zoneOf(*numbers, materials, where, diagnostics));
    else
      diagnostics.error(where, {},
                        fmt::format("found {} numbers, expected 12: 3 coordinates of the position, the area, 3 "
                                    "components of the normal, 3 of a tangent, the bottom and the top material",
                                    numbers->size()));
  }
  if (zones.empty() && diagnostics.size() == before)
    diagnostics.error(named, "MaterialProperties/MPM/cohesive_zone/cz_filename",
                      fmt::format("'{}' contains no zones", path));
  return zones;
}

}  // namespace tushar::mpm::solid
