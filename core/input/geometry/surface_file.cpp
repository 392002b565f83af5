#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "core/input/geometry/surface.hpp"

// Files of triangles. STL: 3D Systems, StereoLithography Interface Specification (1988).

namespace tushar::input {

namespace {

constexpr std::size_t headerBytes = 84,
                      facetBytes = 50;  ///< sizes of the parts of a binary file: header with a count, facet

/// The content of a file, or the reason why it cannot be used.
struct Read {
  Triangles triangles;
  std::string problem;
};

Read failed(std::string problem) { return {{}, std::move(problem)}; }

bool isSound(const Triangles& triangles) {
  for (const auto& corners : triangles)
    for (const Vec3& corner : corners)
      if (!corner.allFinite()) return false;
  return true;
}

std::uint32_t countIn(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= headerBytes) std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

/// Reads a binary file: for each facet, a normal and three corners as little-endian floats, and two bytes.
Read readBinary(const std::string& bytes) {
  Read read;
  read.triangles.resize(countIn(bytes));
  const char* at = bytes.data() + headerBytes;
  for (auto& corners : read.triangles) {
    std::array<float, 12> numbers;
    std::memcpy(numbers.data(), at, sizeof numbers);
    for (std::size_t k = 0; k < 3; ++k) corners[k] = Vec3(numbers[3 * k + 3], numbers[3 * k + 4], numbers[3 * k + 5]);
    at += facetBytes;
  }
  return read;
}

/// Reads a text file: `vertex x y z` three times in each `facet`; the other words are redundant.
Read readText(const std::string& text) {
  Read read;
  std::istringstream lines(text);
  std::string line, word;
  std::size_t corner = 0;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    if (!(words >> word)) continue;
    if ((word == "endfacet" || (word == "facet" && !read.triangles.empty())) && corner != 3)
      return failed(fmt::format("line {}: found a facet of {} vertices, expected three", number, corner));
    if (word == "facet") {
      read.triangles.emplace_back();
      corner = 0;
    } else if (word == "vertex") {
      Vec3 x;
      if (read.triangles.empty() || corner == 3)
        return failed(fmt::format("line {}: found a fourth vertex in a facet", number));
      if (!(words >> x[0] >> x[1] >> x[2]))
        return failed(fmt::format("line {}: expected `vertex x y z`, found '{}'", number, line));
      read.triangles.back()[corner++] = x;
    } else if (word != "solid" && word != "endsolid" && word != "outer" && word != "endloop" && word != "endfacet") {
      return failed(
          fmt::format("line {}: found '{}', expected solid, facet, outer loop, vertex, endloop, endfacet or endsolid",
                      number, word));
    }
  }
  if (word != "endsolid" || (corner != 3 && !read.triangles.empty())) return failed("it ends before `endsolid`");
  return read;
}

Read readStl(const std::string& bytes) {
  if (bytes.size() >= headerBytes && bytes.size() == headerBytes + facetBytes * countIn(bytes))
    return readBinary(bytes);
  if (bytes.starts_with("solid")) return readText(bytes);
  if (bytes.size() < headerBytes) return failed("it does not begin with `solid`, and is too short for a binary file");
  return failed(fmt::format("it does not begin with `solid`, and a binary file of {} triangles has {} bytes, not {}",
                            countIn(bytes), headerBytes + facetBytes * countIn(bytes), bytes.size()));
}

std::optional<std::string> slurp(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) return {};
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// Reads three numbers per line; empty lines are ignored. If a line is invalid, `problem` names it.
template <class Number>
std::vector<std::array<Number, 3>> readTriples(const std::string& text, std::string& problem) {
  std::vector<std::array<Number, 3>> triples;
  std::istringstream lines(text);
  std::string line, more;
  for (int number = 1; std::getline(lines, line) && problem.empty(); ++number) {
    std::istringstream words(line);
    std::array<Number, 3> triple;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (!(words >> triple[0] >> triple[1] >> triple[2]) || words >> more)
      problem = fmt::format("line {}: found '{}', expected three numbers", number, line);
    triples.push_back(triple);
  }
  return triples;
}

/// Reads Uintah's pair of files: points (.pts) and triangles (.tri).
Read joinPoints(const std::string& points, const std::string& corners) {
  Read read;
  const auto places = readTriples<double>(points, read.problem);
  if (!read.problem.empty()) return failed(".pts: " + read.problem);
  for (const auto& numbers : readTriples<long>(corners, read.problem)) {
    if (!read.problem.empty()) break;
    auto& triangle = read.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      if (numbers[k] < 0 || numbers[k] >= static_cast<long>(places.size()))
        return failed(fmt::format(".tri: there is no point {}; points are numbered from 0 to {}", numbers[k],
                                  static_cast<long>(places.size()) - 1));
      const auto& at = places[numbers[k]];
      triangle[k] = Vec3(at[0], at[1], at[2]);
    }
  }
  return read.problem.empty() ? read : failed(".tri: " + read.problem);
}

Read readFile(const std::string& path) {
  if (path.ends_with(".stl") || path.ends_with(".STL")) {
    const auto bytes = slurp(path);
    return bytes ? readStl(*bytes) : failed("there is no such file");
  }
  const auto points = slurp(path + ".pts"), corners = slurp(path + ".tri");
  if (!points || !corners) return failed(fmt::format("there is no such file ending in {}", points ? ".tri" : ".pts"));
  return joinPoints(*points, *corners);
}

}  // namespace

Triangles readTriangles(const std::string& path, const Element& tag, Diagnostics& diagnostics) {
  Read read = readFile(path);
  if (read.problem.empty() && read.triangles.empty()) read.problem = "it contains no triangles";
  if (read.problem.empty() && !isSound(read.triangles)) read.problem = "the coordinates of a corner are not finite";
  if (read.problem.empty()) return read.triangles;
  diagnostics.error(tag, fmt::format("'{}': {}", path, read.problem));
  return {};
}

std::shared_ptr<const Surface> readSurface(const std::string& path, const Element& tag, Diagnostics& diagnostics) {
  Triangles triangles = readTriangles(path, tag, diagnostics);
  if (triangles.empty()) return nullptr;
  const std::string why = whyOpen(triangles);
  const auto surface = std::make_shared<const Surface>(std::move(triangles), why.empty());
  if (why.empty()) return surface;
  constexpr double most = 0.2;  // of the points; a cube that lacks one triangle of twelve has a half
  if (const double part = surface->disagreement(); part > most) {
    diagnostics.error(tag, fmt::format("'{}': {}", path, why));
    return nullptr;
  }
  diagnostics.note(tag, fmt::format("'{}': {}; for each point, lines along x, y and z are tested, and the majority "
                                    "determines whether it is inside",
                                    path, why));
  return surface;
}

}  // namespace tushar::input
