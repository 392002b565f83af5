#include "components/ice/check_conditions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "components/euler/labels.hpp"
#include "components/ice/gas_materials.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::ice {

using input::Diagnostics;
using input::Element;

namespace {

/// The greatest pressure that one of the gases cannot have [Pa]: 0, or -p_inf if all of them are stiffened.
double pressureLimit(const std::vector<GasMaterial>& gases) {
  double least = gases.empty() ? 0 : gases.front().state.pInfinity;
  for (const GasMaterial& gas : gases) least = std::min(least, gas.state.pInfinity);
  return 0 - least;
}

/// Reports conditions of the gas that are not available: invalid values, and derivatives other than 0.
void checkCondition(const Element& condition, double leastPressure, Diagnostics& diagnostics) {
  const std::string label = condition.attribute("label").value_or(""), var = condition.attribute("var").value_or("");
  const auto text = condition.child("value");
  if (!text) return;
  const auto number = input::parse<double>(text->text());
  const auto vector = input::parse<Vec3>(text->text());
  if (var == nameOf(BoundaryKind::neumann)) {
    if ((number && *number != 0) || (vector && *vector != Vec3::Zero()))
      diagnostics.error(*text,
                        fmt::format("found '{}', expected 0: a Neumann condition extends {} unchanged beyond the grid",
                                    text->text(), label));
    return;
  }
  const auto limit = [&](const grid::BoundaryVariable& of, double least, const std::string& unit) {
    if (label == of.name && var == nameOf(BoundaryKind::dirichlet) && number &&
        !input::satisfies(*number, input::greaterThan(least)))
      diagnostics.error(*text, input::violation(text->text(), input::greaterThan(least), unit));
  };
  limit(euler::boundary::density, 0, "kg/m^3");
  limit(euler::boundary::pressure, leastPressure, "Pa");
  limit(euler::boundary::temperature, 0, "K");
}

/// Reports a condition that is incompatible with another condition of the same face. `slips`: the face is a wall that
/// slips; `relaxes`: it lets waves out.
void checkBeside(const Element& condition, bool slips, bool relaxes, Diagnostics& diagnostics) {
  const std::string label = condition.attribute("label").value_or(""), var = condition.attribute("var").value_or("");
  const bool isGiven = var == nameOf(BoundaryKind::dirichlet);
  const bool isWall = var == "FreeSlipWall" || var == nameOf(BoundaryKind::symmetry);
  const bool acts = isGiven || isWall || var == "Sine";
  if (slips && !isWall && (acts || var == "LODI"))
    diagnostics.error(condition, "a FreeSlipWall is a plane of symmetry, so it takes no other condition");
  if (relaxes && !slips && acts && !(isGiven && label == euler::boundary::temperature.name))
    diagnostics.error(condition, "with var LODI for the Pressure, only a Temperature may be given as well");
}

/// The scalar to whose value at a side a condition applies; empty if it is for another variable.
std::string scalarOf(const Element& condition) {
  const std::string label = condition.attribute("label").value_or("");
  const std::string_view start = "scalar-", end = "_CC";
  if (!label.starts_with(start)) return "";
  return label.substr(start.size(), label.size() - start.size() - (label.ends_with(end) ? end.size() : 0));
}

/// Reports a second condition of a face for a scalar under its other name.
void refuseScalarsGivenTwice(const Element& face, Diagnostics& diagnostics) {
  const std::vector<Element> conditions = face.children("BCType");
  for (std::size_t k = 0; k < conditions.size(); ++k)
    for (std::size_t first = 0; first < k; ++first) {
      const std::string scalar = scalarOf(conditions[k]);
      const int one = materialOf(conditions[first]), other = materialOf(conditions[k]);
      const bool isSame = conditions[first].attribute("label") == conditions[k].attribute("label");  // reported before
      if (!scalar.empty() && scalar == scalarOf(conditions[first]) && !isSame && (one == other || one < 0 || other < 0))
        diagnostics.error(conditions[k], fmt::format("scalar-{} already has a condition on this face, at {}; keep one",
                                                     scalar, conditions[first].where().text()));
    }
}

/// Reports conditions of faces that contradict one another, or that require another condition.
void checkFaces(const Element& root, Diagnostics& diagnostics) {
  const auto group = root.child("Grid") ? root.child("Grid")->child("BoundaryConditions") : std::nullopt;
  for (const Element& face : group ? group->children("Face") : std::vector<Element>()) {
    const auto has = [&](const char* var, const std::string_view label) {
      const auto conditions = face.children("BCType");
      return std::any_of(conditions.begin(), conditions.end(), [&](const Element& one) {
        return one.attribute("var") == var && (label.empty() || one.attribute("label") == label);
      });
    };
    const bool slips = has("FreeSlipWall", ""), relaxes = has("LODI", euler::boundary::pressure.name);
    if (!relaxes && has("LODI", ""))
      diagnostics.error(face, "var LODI for another variable needs var LODI for the Pressure");
    if (has("Sine", euler::boundary::temperature.name) && !has("Sine", euler::boundary::pressure.name) &&
        !has("Sine", euler::boundary::velocity.name))
      diagnostics.error(face, "var Sine for the Temperature needs var Sine for the Pressure or the Velocity");
    for (const Element& condition : face.children("BCType")) checkBeside(condition, slips, relaxes, diagnostics);
    refuseScalarsGivenTwice(face, diagnostics);
  }
}

/// Notes a condition that applies to nothing: of a scalar that the scene does not have, or of what only gases have for
/// a body.
void noteIdleCondition(const Element& condition, int solids, const std::vector<ScalarSettings>& scalars, bool isBinary,
                       Diagnostics& diagnostics) {
  const int material = materialOf(condition);
  const std::string scalar = scalarOf(condition);
  const bool isOfGas = condition.attribute("label") == euler::boundary::density.name || !scalar.empty();
  const bool exists = (isBinary && scalar == "f") ||
                      std::any_of(scalars.begin(), scalars.end(), [&](const auto& one) { return one.name == scalar; });
  if (!scalar.empty() && !exists)
    diagnostics.note(condition, fmt::format("does nothing: the scene has no scalar '{}'", scalar));
  else if (material >= 0 && material < solids && isOfGas)
    diagnostics.note(condition,
                     fmt::format("does nothing: material {} is a body; the gas has index {}", material, solids));
}

/// Checks the constants for sides with words of Uintah's: they are needed, and a gas can have the pressure far away.
void checkConstants(const Element& root, double leastPressure, Diagnostics& diagnostics) {
  const auto sides = root.child("Grid") ? root.child("Grid")->child("BoundaryConditions") : std::nullopt;
  if (!sides) return;
  const std::vector<Element> conditions = simulation::boundaryConditions(root);
  for (const auto& [tag, var] : {std::pair("LODI", "LODI"), std::pair("SINE_BC", "Sine")})
    if (const auto constants = sides->child(tag);
        constants && std::none_of(conditions.begin(), conditions.end(),
                                  [&, var = var](const Element& one) { return one.attribute("var") == var; }))
      diagnostics.note(*constants, fmt::format("does nothing: no side has var {}", var));
  const auto waves = sides->child("LODI");
  const auto far = waves ? waves->child("press_infinity") : std::nullopt;
  const auto pressure = far ? input::parse<double>(far->text()) : input::parse<double>("");
  if (pressure && !input::satisfies(*pressure, input::greaterThan(leastPressure)))
    diagnostics.error(*far, input::violation(far->text(), input::greaterThan(leastPressure), "Pa"));
}

}  // namespace

void checkConditions(const Element& root, int solids, const std::vector<GasMaterial>& gases,
                     const std::vector<ScalarSettings>& scalars, bool isBinary, Diagnostics& diagnostics) {
  checkFaces(root, diagnostics);
  const double leastPressure = pressureLimit(gases);
  checkConstants(root, leastPressure, diagnostics);
  const int last = solids + std::max(1, static_cast<int>(gases.size())) - 1;
  for (const Element& condition : simulation::boundaryConditions(root)) {
    const int material = materialOf(condition);
    if (material > last)
      diagnostics.error(condition.whereOf("id"), condition.path(),
                        last == solids ? fmt::format("there is no material {}: the gas has index {}", material, solids)
                                       : fmt::format("there is no material {}: the gases have indices {} to {}",
                                                     material, solids, last));
    noteIdleCondition(condition, solids, scalars, isBinary, diagnostics);
    const bool isShared = condition.attribute("label") == euler::boundary::pressure.name;
    if (material < 0 || material >= solids || isShared) checkCondition(condition, leastPressure, diagnostics);
  }
}

}  // namespace tushar::ice
