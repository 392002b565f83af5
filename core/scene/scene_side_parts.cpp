#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/joined.hpp"
#include "core/input/text.hpp"
#include "core/scene/scene_sides.hpp"

namespace tushar::scene {

using input::Diagnostics;
using input::Element;

namespace {

/// A word for a side or a part of a side, and its attributes.
struct FaceWord {
  std::string name;
  std::optional<int> FaceSection::*face;
  std::vector<std::string> attributes;
};
const std::vector<FaceWord>& faceWords() {
  static const std::vector<FaceWord> words{
      {"side", &FaceSection::side, {}},
      {"circle", &FaceSection::circle, {"origin", "radius"}},
      {"annulus", &FaceSection::annulus, {"origin", "inner_radius", "outer_radius"}},
      {"ellipse", &FaceSection::ellipse, {"origin", "minor_radius", "major_radius", "angle"}},
      {"rectangle", &FaceSection::rectangle, {"lower", "upper"}},
      {"rectangulus", &FaceSection::rectangulus, {"inner_lower", "inner_upper", "outer_lower", "outer_upper"}}};
  return words;
}

/// A point as three numbers separated by blanks or commas, as in Uintah; also in brackets.
std::optional<Vec3> pointOf(const std::optional<std::string>& text, const Element& tag, const char* attribute,
                            Diagnostics& diagnostics) {
  std::string list = text.value_or("");
  std::replace_if(
      list.begin(), list.end(), [](char c) { return c == ',' || c == '[' || c == ']' || c == '\t' || c == '\n'; }, ' ');
  std::vector<double> numbers;
  for (std::size_t at = list.find_first_not_of(' '); at != std::string::npos; at = list.find_first_not_of(' ', at)) {
    const std::size_t end = std::min(list.find(' ', at), list.size());
    const auto number = input::parse<double>(std::string_view(list).substr(at, end - at));
    numbers.push_back(number ? *number : std::nan(""));
    at = end;
  }
  if (numbers.size() == 3 && std::none_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); }))
    return Vec3(numbers[0], numbers[1], numbers[2]);
  diagnostics.error(tag.whereOf(attribute), tag.path(),
                    fmt::format("attribute '{}': found '{}', expected three numbers, such as 0 0.5 0.5", attribute,
                                text.value_or("")));
  return {};
}

std::string called(const FaceWord& word) { return word.name == "side" ? "whole side" : "part with " + word.name; }

/// Whether a tag has exactly the attributes that its word requires; reports errors otherwise.
bool hasAttributesOf(const FaceWord& word, const Element& tag, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const auto& own = word.attributes;
  for (const std::string& needed : own)
    if (!tag.attribute(needed))
      diagnostics.error(tag, fmt::format("missing attribute '{}': {} needs {}", needed, word.name, joined(own, ", ")));
  std::set<std::string> told(own.begin(), own.end());
  for (const FaceWord& other : faceWords()) {
    if (&other != &word && tag.attribute(other.name))
      diagnostics.error(tag.whereOf(other.name), tag.path(),
                        fmt::format("gives both {} and {}; keep one", word.name, other.name));
    for (const std::string& attribute : other.attributes)
      if (tag.attribute(attribute) && told.insert(attribute).second)
        diagnostics.error(
            tag.whereOf(attribute), tag.path(),
            fmt::format("unknown attribute '{}' of a {}; it belongs to {}", attribute, called(word), other.name));
  }
  return diagnostics.size() == before;
}

/// Whether two corners span an area; reports an error otherwise.
bool spansArea(const Vec3& lower, const Vec3& upper, int across, const Element& tag, Diagnostics& diagnostics) {
  for (int axis = 0; axis < 3; ++axis)
    if (axis != across && upper[axis] < lower[axis]) {
      diagnostics.error(
          tag, fmt::format("upper is below lower along {}: {:g} < {:g} m", "xyz"[axis], upper[axis], lower[axis]));
      return false;
    }
  return true;
}

/// Whether one length is at most another; reports an error otherwise.
bool areInOrder(double smaller, double larger, const FaceWord& word, const Element& tag, Diagnostics& diagnostics) {
  if (smaller <= larger) return true;
  diagnostics.error(tag, fmt::format("{} is greater than {}: {:g} > {:g} m", word.attributes[1], word.attributes[2],
                                     smaller, larger));
  return false;
}

std::optional<grid::SidePart> roundPart(const FaceSection& face, const FaceWord& word, const Element& tag,
                                        Diagnostics& diagnostics) {
  const int axis = face.face() / 2, side = face.face() % 2;
  const auto origin = pointOf(face.origin, tag, "origin", diagnostics);
  if (!origin) return {};
  if (face.circle && face.radius) return grid::SidePart::circle(axis, *origin, *face.radius);
  if (face.annulus && face.innerRadius && face.outerRadius &&
      areInOrder(*face.innerRadius, *face.outerRadius, word, tag, diagnostics))
    return grid::SidePart::annulus(axis, *origin, *face.innerRadius, *face.outerRadius);
  if (face.ellipse && face.minorRadius && face.majorRadius && face.angle &&
      areInOrder(*face.minorRadius, *face.majorRadius, word, tag, diagnostics))
    return grid::SidePart::ellipse(axis, side, *origin, *face.minorRadius, *face.majorRadius, *face.angle);
  return {};  // for a number that was reported before
}

std::optional<grid::SidePart> squarePart(const FaceSection& face, const Element& tag, Diagnostics& diagnostics) {
  const int axis = face.face() / 2;
  if (face.rectangle) {
    const auto lower = pointOf(face.lower, tag, "lower", diagnostics),
               upper = pointOf(face.upper, tag, "upper", diagnostics);
    if (!lower || !upper || !spansArea(*lower, *upper, axis, tag, diagnostics)) return {};
    return grid::SidePart::rectangle(axis, *lower, *upper);
  }
  const auto innerLower = pointOf(face.innerLower, tag, "inner_lower", diagnostics),
             innerUpper = pointOf(face.innerUpper, tag, "inner_upper", diagnostics),
             outerLower = pointOf(face.outerLower, tag, "outer_lower", diagnostics),
             outerUpper = pointOf(face.outerUpper, tag, "outer_upper", diagnostics);
  if (!innerLower || !innerUpper || !outerLower || !outerUpper) return {};
  if (!spansArea(*innerLower, *innerUpper, axis, tag, diagnostics) ||
      !spansArea(*outerLower, *outerUpper, axis, tag, diagnostics))
    return {};
  return grid::SidePart::rectangulus(axis, {*innerLower, *innerUpper}, {*outerLower, *outerUpper});
}

/// Whether the points that define a part lie on its side; reports an error otherwise. As in Uintah, they must lie on it
/// exactly, without a tolerance.
bool liesInSide(const GivenPart& part, const grid::Domain& domain, Diagnostics& diagnostics) {
  const int axis = part.face / 2;
  const double at = part.face % 2 == 0 ? domain.lower[axis] : domain.upper[axis];
  const double slack = 1e-9 * std::max({domain.upper[axis] - domain.lower[axis], std::abs(at)});
  const std::size_t before = diagnostics.size();
  Diagnostics known;  // errors that readShape has reported
  for (const char* name : {"origin", "lower", "upper", "inner_lower", "inner_upper", "outer_lower", "outer_upper"}) {
    if (!part.tag.attribute(name)) continue;
    const auto point = pointOf(part.tag.attribute(name), part.tag, name, known);
    if (!point || std::abs((*point)[axis] - at) <= slack) continue;
    diagnostics.error(part.tag.whereOf(name), part.tag.path(),
                      fmt::format("attribute '{}': {} = {:g} m is not in side {}, which is at {} = {:g} m", name,
                                  "xyz"[axis], (*point)[axis], sideNames[part.face], "xyz"[axis], at));
  }
  return diagnostics.size() == before;
}

/// The kernel axis that corresponds to an axis of the scene, or -1 if the grid does not use it.
int kernelAxisOf(const grid::Level& level, int axis) {
  for (int d = 0; d < level.dimension(); ++d)
    if (level.axis(d) == axis) return d;
  return -1;
}

/// The centres [m] of the cell faces on a side that belong to a part of it.
template <int D>
std::vector<Vec3> middlesOf(const grid::SidePart& shape, const grid::Level& level, int kernelAxis, int side) {
  grid::Box faces = level.cellsNear(shape.lower(), shape.upper());
  faces.lower[kernelAxis] = 0;
  faces.upper[kernelAxis] = 1;
  std::vector<Vec3> middles;
  grid::forEach<D>(faces, [&](const Index<D>& cell) {
    const Vec3 middle = level.middleOfSide<D>(kernelAxis, side, cell);
    if (shape.holds(middle)) middles.push_back(middle);
  });
  return middles;
}
std::vector<Vec3> middlesOf(const grid::SidePart& shape, const grid::Level& level, int kernelAxis, int side) {
  if (level.dimension() == 1) return middlesOf<1>(shape, level, kernelAxis, side);
  if (level.dimension() == 2) return middlesOf<2>(shape, level, kernelAxis, side);
  return middlesOf<3>(shape, level, kernelAxis, side);
}

/// Number of cell faces in a part, on one level. Reports an error for a face that another part contains, too.
std::size_t countFaces(const GivenPart& part, const std::vector<GivenPart>& all, const grid::Level& level,
                       Diagnostics& diagnostics) {
  const int d = kernelAxisOf(level, part.face / 2), side = part.face % 2;
  if (d < 0) return 0;
  const auto& shapes = level.parts(d, side);
  const std::vector<Vec3> middles = middlesOf(shapes[part.part].shape, level, d, side);
  for (const GivenPart& other : all) {
    if (other.face != part.face || other.part >= part.part) continue;
    const auto shared = std::find_if(middles.begin(), middles.end(),
                                     [&](const Vec3& middle) { return shapes[other.part].shape.holds(middle); });
    if (shared == middles.end()) continue;
    diagnostics.error(part.tag, fmt::format("overlaps the part at {}: both contain the face at ({:g}, {:g}, {:g})",
                                            other.tag.where().text(), (*shared)[0], (*shared)[1], (*shared)[2]));
    break;
  }
  return middles.size();
}

}  // namespace

bool checkFaceWords(const Element& tag, Diagnostics& diagnostics) {
  for (const FaceWord& word : faceWords())
    if (tag.attribute(word.name)) return hasAttributesOf(word, tag, diagnostics);
  std::vector<std::string> names;
  for (const FaceWord& word : faceWords()) names.push_back(word.name);
  diagnostics.error(tag, "missing attribute 'side' of <Face>, or one of the attributes for a part of a side: " +
                             allOf({names.begin() + 1, names.end()}));
  return false;
}

std::optional<grid::SidePart> readShape(const FaceSection& face, const Element& tag, Diagnostics& diagnostics) {
  for (const FaceWord& word : faceWords())
    if (face.*word.face) {
      const bool isRound = face.circle || face.annulus || face.ellipse;
      return isRound ? roundPart(face, word, tag, diagnostics) : squarePart(face, tag, diagnostics);
    }
  return {};
}

void refuseParts(const Element& tag, Diagnostics& diagnostics) {
  for (const FaceWord& word : faceWords())
    if (const auto side = tag.attribute(word.name); side && word.name != "side")
      diagnostics.error(
          tag.whereOf(word.name), tag.path(),
          fmt::format(
              "conditions on a part of a side ({}) are not available; use side=\"{}\" to apply them to the whole side",
              word.name, *side));
}

void checkParts(const std::vector<GivenPart>& parts, const grid::Domain& domain, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  for (const GivenPart& part : parts) {
    const char axis = "xyz"[part.face / 2];
    if (domain.periodic[part.face / 2] != 0)
      diagnostics.error(part.tag, fmt::format("{} is periodic, so no part of this side can have conditions", axis));
    else
      liesInSide(part, domain, diagnostics);
  }
  if (diagnostics.size() > before) return;
  std::vector<std::size_t> faces(parts.size());
  for (int number = 0; number < domain.refinement.levels; ++number) {
    const grid::Level level(domain, number, domain.refinement.levels, nullptr);
    for (std::size_t k = 0; k < parts.size(); ++k) faces[k] = countFaces(parts[k], parts, level, diagnostics);
    if (diagnostics.size() > before) return;
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (faces[k] == 0)
      diagnostics.note(parts[k].tag,
                       fmt::format("does nothing: no face of the finest cells on side {} has its centre in this part",
                                   sideNames[parts[k].face]));
}

}  // namespace tushar::scene
