#include "components/mpm/solid/listed_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "components/mpm/solid/number_lines.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

const Vec3* ListedParticles::halfAt(const Vec3& point) const {
  if (bins_.empty()) return nullptr;
  const Bin center = binOf(point);
  const Vec3* half = nullptr;
  double least = 0;
  Bin bin;
  for (bin[0] = center[0] - 1; bin[0] <= center[0] + 1; ++bin[0])
    for (bin[1] = center[1] - 1; bin[1] <= center[1] + 1; ++bin[1])
      for (bin[2] = center[2] - 1; bin[2] <= center[2] + 1; ++bin[2]) {
        auto next = std::lower_bound(bins_.begin(), bins_.end(), std::pair(bin, std::size_t{0}));
        for (; next != bins_.end() && next->first == bin; ++next) {
          const Vec3 away = point - at[next->second];
          if (!(away.array().abs() <= halfOf(next->second).array()).all()) continue;
          if (half && away.squaredNorm() >= least) continue;
          least = away.squaredNorm();
          half = &halfOf(next->second);
        }
      }
  return half;
}

input::Box3 ListedParticles::bounds() const {
  input::Box3 box{at.front(), at.front()};
  for (const Vec3& point : at) box = box.hull({point, point});
  return box;
}

void ListedParticles::giveBoxes(std::vector<Vec3> half) {
  half_ = std::move(half);
  binWidth_ = Vec3::Zero();
  for (const Vec3& one : half_) binWidth_ = binWidth_.cwiseMax(2 * one);
  bins_.resize(at.size());
  for (std::size_t p = 0; p < at.size(); ++p) bins_[p] = {binOf(at[p]), p};
  std::sort(bins_.begin(), bins_.end());
}

ListedParticles::Bin ListedParticles::binOf(const Vec3& point) const {
  Bin bin{};
  for (int axis = 0; axis < 3; ++axis)
    if (std::isfinite(binWidth_[axis])) bin[axis] = static_cast<int>(std::floor(point[axis] / binWidth_[axis]));
  return bin;
}

namespace {

enum class Format { text, native, little, big };

/// The tag `file`.
struct ListTag {
  std::string path;
  std::vector<std::string> variables;
  Format format = Format::text;
  bool isDivided = true;
};

/// A variable that a file may list: its name, how many numbers it has, and how a particle that was added to the list
/// gets it.
struct Variable {
  const char* name;
  int size;
  std::function<void(ListedParticles&, const double*)> add;
};

/// Sets an edge of the particle that was added last.
void setEdge(ListedParticles& list, int edge, const double* numbers) {
  if (list.edges.size() < list.at.size()) list.edges.emplace_back(Matrix3::Zero());
  list.edges.back().col(edge) = Eigen::Map<const Vec3>(numbers);
}

const std::vector<Variable>& variables() {
  using List = ListedParticles;
  static const std::vector<Variable> all{
      {"p.volume", 1, [](List& list, const double* n) { list.volume.push_back(*n); }},
      {"p.temperature", 1, [](List& list, const double* n) { list.temperature.push_back(*n); }},
      {"p.color", 1, [](List& list, const double* n) { list.color.push_back(*n); }},
      {"p.velocity", 3, [](List& list, const double* n) { list.velocity.emplace_back(n[0], n[1], n[2]); }},
      {"p.rvec1", 3, [](List& list, const double* n) { setEdge(list, 0, n); }},
      {"p.rvec2", 3, [](List& list, const double* n) { setEdge(list, 1, n); }},
      {"p.rvec3", 3, [](List& list, const double* n) { setEdge(list, 2, n); }}};
  return all;
}

const Variable* findVariable(const std::string& name) {
  const auto found = std::find_if(variables().begin(), variables().end(),
                                  [&](const Variable& variable) { return variable.name == name; });
  return found == variables().end() ? nullptr : &*found;
}

void checkVariables(const ListTag& tag, const Element& element, Diagnostics& diagnostics) {
  const auto places = element.children("var");
  std::vector<std::string> names;
  for (const Variable& variable : variables()) names.emplace_back(variable.name);
  int edges = 0;
  for (std::size_t k = 0; k < tag.variables.size(); ++k) {
    const std::string& name = tag.variables[k];
    if (!findVariable(name)) diagnostics.error(places[k], input::choiceProblem(name, names));
    if (std::count(tag.variables.begin(), tag.variables.begin() + static_cast<std::ptrdiff_t>(k), name) > 0)
      diagnostics.error(places[k], fmt::format("'{}' is given twice", name));
    edges += name.starts_with("p.rvec") ? 1 : 0;
  }
  if (edges != 0 && edges != 3)
    diagnostics.error(element, "the edges of a particle are p.rvec1, p.rvec2 and p.rvec3; give all three");
}

const Schema<ListTag>& listSchema() {
  static const Schema<ListTag> schema =
      Schema<ListTag>("file",
                      "The particles that a file lists, one per line, instead of those that fill a shape. It must be "
                      "the only shape of the body.")
          .foreignAttribute("label", "a name for readers")
          .required("name", &ListTag::path, "m",
                    "the file, in which each line has x, y, z of a particle and then the variables <var>, in this "
                    "order")
          .values("var", &ListTag::variables, "1",
                  "a variable in the file: p.volume (m^3), p.temperature (K), p.color, p.velocity (m/s), or p.rvec1, "
                  "p.rvec2, p.rvec3 (edges of the particle, m). Without p.volume and edges, a particle has the size "
                  "that <res> gives; with p.volume alone, it is a cube; with edges alone, their volume",
                  0)
          .choice("format", &ListTag::format,
                  {{"text", Format::text}, {"bin", Format::native}, {"lsb", Format::little}, {"msb", Format::big}},
                  Format::text,
                  "text: numbers in lines; lsb, msb, bin: the same numbers without lines, of eight bytes, beginning "
                  "with the least or the most significant byte, or in the order of this machine")
          .value("usePFS", &ListTag::isDivided, true, "1",
                 "no effect: all particles are read from this file, which need not be divided among patches first")
          .check(checkVariables);
  return schema;
}

/// What a line of the file contains: the position, and the variables.
struct Columns {
  std::vector<const Variable*> variables;
  std::size_t count = 3;
  std::string words = "x y z";

  explicit Columns(const ListTag& tag) {
    for (const std::string& name : tag.variables) {
      variables.push_back(findVariable(name));
      count += variables.back()->size;
      words += variables.back()->size == 1 ? " " + name : fmt::format(" {} ({} numbers)", name, variables.back()->size);
    }
  }

  void addTo(ListedParticles& list, const double* numbers) const {
    list.at.emplace_back(numbers[0], numbers[1], numbers[2]);
    numbers += 3;
    for (const Variable* variable : variables) {
      variable->add(list, numbers);
      numbers += variable->size;
    }
  }
};

/// Why a particle that was read is not possible; empty if it is.
std::string problemOfLast(const ListedParticles& list) {
  if (!list.volume.empty() && !(list.volume.back() > 0))
    return fmt::format("p.volume: found {:g}, expected a positive number", list.volume.back());
  if (!list.temperature.empty() && !(list.temperature.back() >= 0))
    return fmt::format("p.temperature: found {:g}, expected a number that is not negative", list.temperature.back());
  if (!list.edges.empty() && !(std::abs(list.edges.back().determinant()) > 0))
    return "p.rvec1, p.rvec2, p.rvec3: the particle has no volume";
  return {};
}

/// The number of wrong lines of a file that are reported.
constexpr std::size_t reportedLines = 10;

void readText(std::istream& file, const std::string& path, const Columns& columns, ListedParticles& list,
              Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  std::string line;
  for (int number = 1; std::getline(file, line) && diagnostics.size() < before + reportedLines; ++number) {
    const Location where{path, number, 0};
    const auto numbers = numbersInLine(line, where, diagnostics);
    if (!numbers || numbers->empty()) continue;
    if (numbers->size() != columns.count) {
      diagnostics.error(
          where, {}, fmt::format("found {} numbers, expected {}: {}", numbers->size(), columns.count, columns.words));
      continue;
    }
    columns.addTo(list, numbers->data());
    if (const std::string problem = problemOfLast(list); !problem.empty()) diagnostics.error(where, {}, problem);
  }
}

void readBinary(std::istream& file, const std::string& path, Format format, const Columns& columns,
                ListedParticles& list, Diagnostics& diagnostics) {
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  const std::size_t size = columns.count * sizeof(double);
  if (bytes.size() % size != 0)
    return diagnostics.error({path, 0, 0}, {},
                             fmt::format("has {} bytes, which is not a multiple of {}: {} numbers of 8 bytes per "
                                         "particle ({})",
                                         bytes.size(), size, columns.count, columns.words));
  const bool reverses =
      format != Format::native && (format == Format::little) != (std::endian::native == std::endian::little);
  std::vector<double> numbers(columns.count);
  const std::size_t before = diagnostics.size();
  for (std::size_t from = 0; from < bytes.size() && diagnostics.size() < before + reportedLines; from += size) {
    std::string record = bytes.substr(from, size);
    for (std::size_t k = 0; reverses && k < size; k += sizeof(double))
      std::reverse(record.begin() + static_cast<std::ptrdiff_t>(k),
                   record.begin() + static_cast<std::ptrdiff_t>(k + sizeof(double)));
    std::memcpy(numbers.data(), record.data(), size);
    columns.addTo(list, numbers.data());
    std::string problem = problemOfLast(list);
    if (!std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); }))
      problem = "found a number that is not finite; is <format> right?";
    if (!problem.empty()) diagnostics.error({path, 0, 0}, {}, fmt::format("particle {}: {}", from / size + 1, problem));
  }
}

}  // namespace

const input::SchemaBase& listedParticlesSchema() { return listSchema(); }

std::shared_ptr<const ListedParticles> readListedParticles(const Element& tag, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const ListTag read = listSchema().read(tag, diagnostics);
  if (diagnostics.size() != before) return nullptr;
  const Element name = *tag.child("name");
  std::ifstream file(read.path, std::ios::binary);
  if (const bool isFolder = std::filesystem::is_directory(read.path); !file || isFolder) {
    const char* why = isFolder                             ? ": it is a folder"
                      : std::filesystem::exists(read.path) ? ""
                                                           : ": there is no such file";
    diagnostics.error(name, fmt::format("'{}' cannot be read{}", read.path, why));
    return nullptr;
  }
  auto list = std::make_shared<ListedParticles>();
  const Columns columns(read);
  if (read.format == Format::text)
    readText(file, read.path, columns, *list, diagnostics);
  else
    readBinary(file, read.path, read.format, columns, *list, diagnostics);
  if (diagnostics.size() == before && list->at.empty())
    diagnostics.error(name, fmt::format("'{}' lists no particles", read.path));
  return diagnostics.size() == before ? list : nullptr;
}

}  // namespace tushar::mpm::solid
