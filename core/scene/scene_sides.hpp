#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/input/schema.hpp"
#include "core/scene/scene.hpp"

namespace tushar::scene {

/// The names of the sides of a grid, by index.
inline constexpr std::array<std::string_view, 6> sideNames{"x-", "x+", "y-", "y+", "z-", "z+"};

/// The tag `BCType`.
struct ConditionSection {
  std::string id, label, var;
  std::optional<std::string> value;
};

/// The tag `Face`: a side of the grid, given by its index in sideNames, or a part of a side. Points are stored as
/// texts, as written in the scene.
struct FaceSection {
  std::optional<int> side, circle, annulus, ellipse, rectangle, rectangulus;
  std::optional<double> radius, innerRadius, outerRadius, minorRadius, majorRadius, angle;
  std::optional<std::string> origin, lower, upper, innerLower, innerUpper, outerLower, outerUpper;
  std::vector<ConditionSection> conditions;

  /// Index of the side that the tag describes, or to which its part belongs.
  int face() const {
    for (const auto& given : {side, circle, annulus, ellipse, rectangle, rectangulus})
      if (given) return *given;
    return 0;
  }
};

/// The tag `BoundaryConditions`.
struct FacesSection {
  std::vector<FaceSection> faces;
};

const input::Schema<ConditionSection>& conditionSchema();
/// The schema of the conditions of a component, for editors, with its labels and further `var`s.
input::Schema<ConditionSection> conditionFor(const std::vector<grid::BoundaryVariable>& labels,
                                             const std::vector<std::string>& furtherVars);
/// The schema of the tag `Face`, with a schema for its conditions, which must outlive it.
input::Schema<FaceSection> faceTag(const input::Schema<ConditionSection>& condition);

/// A part of a side, and its location in the scene.
struct GivenPart {
  input::Element tag;
  int face = 0;          ///< index of the side, 0 to 5
  std::size_t part = 0;  ///< index of the part on this side
};

/// Whether a tag `Face` describes one side or one part of a side with the right attributes; reports an error if not.
bool checkFaceWords(const input::Element& tag, input::Diagnostics& diagnostics);
/// The shape of a face that is a part of a side; none, with an error, if its values are invalid.
std::optional<grid::SidePart> readShape(const FaceSection& face, const input::Element& tag,
                                        input::Diagnostics& diagnostics);
/// Reports an error for parts of sides if the component does not support them.
void refuseParts(const input::Element& tag, input::Diagnostics& diagnostics);
/// Reads the conditions of a `Grid` section. Returns the parts of sides that have conditions.
std::vector<GivenPart> readFaces(const input::Element& section, const FacesSection& faces, const SideWords& words,
                                 grid::BoundaryConditions& boundaries, input::Diagnostics& diagnostics);
/// Removes the conditions at sides of periodic axes, with a note: they have no effect, as in Uintah.
void dropPeriodicSides(const input::Element& section, grid::Domain& domain, input::Diagnostics& diagnostics);
/// Checks that parts of sides lie on their sides, do not overlap, and contain faces of cells.
void checkParts(const std::vector<GivenPart>& parts, const grid::Domain& domain, input::Diagnostics& diagnostics);

}  // namespace tushar::scene
