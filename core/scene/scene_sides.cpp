#include "core/scene/scene_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace tushar::scene {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::findKind;
using simulation::namesOf;

namespace {

const std::vector<std::string> conditionKinds(grid::boundaryKindNames.begin(), grid::boundaryKindNames.end());

/// The kind of condition named `var`, which must be in `conditionKinds`.
grid::BoundaryKind kindOf(const std::string& var) {
  return static_cast<grid::BoundaryKind>(std::find(conditionKinds.begin(), conditionKinds.end(), var) -
                                         conditionKinds.begin());
}
bool isSymmetry(const std::string& var) { return var == nameOf(grid::BoundaryKind::symmetry); }

/// Labels of Uintah's flow components, which also appear in scenes of other components.
const std::vector<std::string> labelsOfFlow{"Density", "Pressure", "SpecificVol"};
bool isOfFlow(const std::string& label) {
  return std::find(labelsOfFlow.begin(), labelsOfFlow.end(), label) != labelsOfFlow.end();
}

/// Reports an error in an attribute.
void errorOf(const std::string& attribute, const Element& element, const std::string& problem,
             Diagnostics& diagnostics) {
  diagnostics.error(element.whereOf(attribute), element.path(), attribute + ": " + problem);
}

Schema<ConditionSection> conditionTag() {
  return Schema<ConditionSection>("BCType", "The condition for a variable at a face.")
      .attributeValue("id", &ConditionSection::id, "all", "1", "index of the material to which it applies, or all");
}

/// The values allowed for `var`: those of all components, and those given.
std::vector<std::string> varsWith(const std::vector<std::string>& further) {
  std::vector<std::string> vars = conditionKinds;
  vars.insert(vars.end(), further.begin(), further.end());
  return vars;
}

/// Checks `var` and, if it needs a value, the value.
void checkKind(const ConditionSection& condition, const Element& element, const std::vector<std::string>& furtherVars,
               Diagnostics& diagnostics) {
  if (const std::string problem = input::choiceProblem(condition.var, varsWith(furtherVars)); !problem.empty())
    errorOf("var", element, problem, diagnostics);
  else if (!isSymmetry(condition.var) && !condition.value)
    diagnostics.error(element, "a " + condition.var + " condition needs a <value>");
}

/// Choices in which each word stands for itself.
input::Choices<std::string> wordsOf(const std::vector<std::string>& words) {
  input::Choices<std::string> choices;
  for (const std::string& word : words) choices.emplace_back(word, word);
  return choices;
}

}  // namespace

const Schema<ConditionSection>& conditionSchema() {
  static const Schema<ConditionSection> schema =
      conditionTag()
          .requiredAttribute("label", &ConditionSection::label, "1", "the variable")
          .requiredAttribute("var", &ConditionSection::var, "1", "symmetry, Dirichlet or Neumann")
          .optional("value", &ConditionSection::value, "SI unit of the variable",
                    "a number or a vector; for some components also formulas")
          .check([](const ConditionSection& condition, const Element& element, Diagnostics& diagnostics) {
            if (const auto number = input::parse<int>(condition.id); condition.id != "all" && !(number && *number >= 0))
              errorOf("id", element, "found '" + condition.id + "', expected 'all' or the index of a material",
                      diagnostics);
          });
  return schema;
}

Schema<ConditionSection> conditionFor(const std::vector<grid::BoundaryVariable>& labels,
                                      const std::vector<std::string>& furtherVars) {
  Schema<ConditionSection> tag = conditionTag();
  std::vector<std::string> names = namesOf(labels), kinds = varsWith(furtherVars);
  for (const std::string& label : labelsOfFlow)
    if (std::find(names.begin(), names.end(), label) == names.end()) names.push_back(label);
  kinds.emplace_back("computeFromDensity");  // of SpecificVol
  if (labels.empty())
    tag.requiredAttribute("label", &ConditionSection::label, "1", "the variable");
  else
    tag.requiredChoiceAttribute("label", &ConditionSection::label, wordsOf(names), "the variable");
  return tag.requiredChoiceAttribute("var", &ConditionSection::var, wordsOf(kinds), "the kind of condition")
      .optional("value", &ConditionSection::value, "SI unit of the variable",
                "a number or a vector; for some components also formulas");
}

Schema<FaceSection> faceTag(const Schema<ConditionSection>& condition) {
  input::Choices<int> sides;
  for (const std::string_view name : sideNames) sides.emplace_back(name, static_cast<int>(sides.size()));
  const auto point = [](const char* what) { return std::string(what) + ", such as 0 0.5 0.5"; };
  return Schema<FaceSection>("Face", "A side of the grid, or a part of one.")
      .optionalChoiceAttribute("side", &FaceSection::side, sides, "this whole side, except its parts")
      .optionalChoiceAttribute("circle", &FaceSection::circle, sides, "the part of this side inside a circle")
      .optionalChoiceAttribute("annulus", &FaceSection::annulus, sides, "the part between two circles")
      .optionalChoiceAttribute("ellipse", &FaceSection::ellipse, sides, "the part inside an ellipse")
      .optionalChoiceAttribute("rectangle", &FaceSection::rectangle, sides, "the part inside a rectangle")
      .optionalChoiceAttribute("rectangulus", &FaceSection::rectangulus, sides, "the part between two rectangles")
      .oneOfLast(6)
      .optionalAttribute("origin", &FaceSection::origin, "m", point("the centre of a circle, annulus or ellipse"))
      .optionalAttribute("radius", &FaceSection::radius, "m", "radius of a circle", input::positive())
      .optionalAttribute("inner_radius", &FaceSection::innerRadius, "m", "inner radius of an annulus",
                         input::positive())
      .optionalAttribute("outer_radius", &FaceSection::outerRadius, "m", "outer radius of an annulus",
                         input::positive())
      .optionalAttribute("minor_radius", &FaceSection::minorRadius, "m", "shorter semi-axis of an ellipse",
                         input::positive())
      .optionalAttribute("major_radius", &FaceSection::majorRadius, "m", "longer semi-axis of an ellipse",
                         input::positive())
      .optionalAttribute("angle", &FaceSection::angle, "degree",
                         "angle of the longer axis of an ellipse, seen from outside, measured from y on x+ and x-, "
                         "from z on y+ and y-, from x on z+ and z-")
      .optionalAttribute("lower", &FaceSection::lower, "m", point("a corner of a rectangle"))
      .optionalAttribute("upper", &FaceSection::upper, "m", point("the opposite corner"))
      .optionalAttribute("inner_lower", &FaceSection::innerLower, "m", point("a corner of the hole of a rectangulus"))
      .optionalAttribute("inner_upper", &FaceSection::innerUpper, "m", point("the opposite corner"))
      .optionalAttribute("outer_lower", &FaceSection::outerLower, "m", point("a corner of a rectangulus"))
      .optionalAttribute("outer_upper", &FaceSection::outerUpper, "m", point("the opposite corner"))
      .ignoredAttribute("name", "a note for readers")
      .list("BCType", &FaceSection::conditions, condition, "the condition for a variable on this side or part");
}

namespace {

/// Reads a value; it may be a formula if the component supports formulas.
template <class T, class Formula>
std::string readValue(const std::string& text, bool mayVary, T& value, std::optional<Formula>& formula) {
  const auto plain = input::parse<T>(text);
  if (plain || !mayVary) {
    value = plain.value.value_or(value);
    return plain.problem;
  }
  const auto given = input::parse<Formula>(text);
  if (!given) return given.problem;
  if (given.value->isConstant())
    value = (*given.value)(Vec3::Zero());
  else
    formula = given.value;
  return {};
}

/// Sets the value of a condition, or its formula.
void takeValue(const ConditionSection& given, const Element& tag, bool mayVary, grid::BoundaryCondition& condition,
               Diagnostics& diagnostics) {
  if (!given.value) return;
  const Location& where = tag.child("value")->where();
  std::string problem;
  std::optional<input::VectorExpression> formula;
  if (condition.variable.isVector && input::parse<double>(*given.value).value == 0.0) {
    diagnostics.note(where, tag.path(), "the value 0 is taken as the vector [0,0,0]");
  } else if (condition.variable.isVector) {
    problem = readValue(*given.value, mayVary, condition.value, formula);
  } else {
    std::optional<input::Expression> one;
    problem = readValue(*given.value, mayVary, condition.value[0], one);
    if (one) formula = input::VectorExpression({*one, input::Expression(), input::Expression()});
  }
  if (!problem.empty()) diagnostics.error(where, tag.path(), "value: " + problem);
  if (!formula) return;
  formula->readAt(where);
  condition.formula = std::make_shared<const input::VectorExpression>(*std::move(formula));
}

/// Why a condition contradicts itself or a symmetry plane; empty if it does not.
std::string contradiction(const grid::BoundaryCondition& condition, bool onOddPlane) {
  const bool symmetry = condition.kind == grid::BoundaryKind::symmetry;
  if (symmetry != (condition.variable == grid::symmetric))
    return fmt::format("found label '{}' with var '{}'; 'Symmetric' and 'symmetry' are allowed only together",
                       condition.variable.name, nameOf(condition.kind));
  if (!symmetry && onOddPlane &&
      (condition.kind == grid::BoundaryKind::dirichlet || condition.formula || condition.value != Vec3::Zero()))
    return "this face is a symmetry plane: the only other condition that it allows is a Neumann condition of 0";
  return {};
}

/// Whether a value may be given on a symmetry plane: a vector must be parallel to the plane, so that its mirror image
/// is the same.
bool fitsPlane(const grid::BoundaryVariable& label, const grid::BoundaryCondition& condition, int axis) {
  return label.isEven && condition.kind == grid::BoundaryKind::dirichlet &&
         (!label.isVector || (!condition.formula && condition.value[axis] == 0));
}

/// The locations of the conditions of a face, by label and material.
using SeenConditions = std::map<std::string, std::map<std::string, Location>>;

/// The location of an earlier condition for the same variable and at least one of the same materials.
std::optional<Location> givenBefore(const ConditionSection& given, const Location& where, SeenConditions& seen) {
  auto& places = seen[given.label];
  for (const auto& [id, place] : places)
    if (id == given.id || id == "all" || given.id == "all") return place;
  places.emplace(given.id, where);
  return {};
}

/// A face that is being read, and the list to which its conditions are added.
struct ReadFace {
  const SideWords& words;
  const Element& sides;  ///< the BoundaryConditions section
  int axis;              ///< axis normal to the face
  /// Conditions of this face, including those of the same part that have been read before.
  std::vector<grid::BoundaryCondition>& conditions;
  SeenConditions& seen;  ///< the location of each condition
};

void noteSeen(const ConditionSection& given, const Element& tag, const ReadFace& face, Diagnostics& diagnostics) {
  if (const auto first = givenBefore(given, tag.where(), face.seen))
    diagnostics.error(
        tag, fmt::format("{} already has a condition on this face, at {}; keep one", given.label, first->text()));
}

/// Adds the conditions into which a component translates a condition of its own type.
void readOwnCondition(const ConditionSection& given, const Element& tag, const ReadFace& face,
                      Diagnostics& diagnostics) {
  noteSeen(given, tag, face, diagnostics);
  for (grid::BoundaryCondition& condition : face.words.own.read(face.sides, tag, diagnostics)) {
    condition.material = input::parse<int>(given.id).value.value_or(-1);
    face.conditions.push_back(std::move(condition));
  }
}

/// Adds the condition of a tag, unless its label has no effect.
void readCondition(const ConditionSection& given, const Element& tag, bool onPlane, const ReadFace& face,
                   Diagnostics& diagnostics) {
  const auto& labels = face.words.labels;
  const grid::BoundaryVariable* label = findKind(labels, given.label);
  if (given.label == "SpecificVol" && findKind(labels, "Density")) {
    if (given.var != "computeFromDensity")  // as it does anyway
      diagnostics.note(tag, "does nothing: the specific volume follows from the Density");
    return;
  }
  if (!label && isOfFlow(given.label))
    diagnostics.note(tag, given.label + " is for flow components: it has no effect here");
  else if (!label && !labels.empty())
    errorOf("label", tag, input::choiceProblem(given.label, namesOf(labels)), diagnostics);
  const auto& further = face.words.own.vars;
  const bool isOwn = std::find(further.begin(), further.end(), given.var) != further.end();
  if (!isOwn && (label || !isOfFlow(given.label))) checkKind(given, tag, further, diagnostics);
  if (label && isOwn) return readOwnCondition(given, tag, face, diagnostics);
  if (!label || !input::choiceProblem(given.var, conditionKinds).empty()) return;
  const bool isPlane = isSymmetry(given.var);
  if (isPlane && given.value) diagnostics.note(tag, "<value> does nothing on a symmetry plane");
  grid::BoundaryCondition condition{*label, kindOf(given.var), Vec3::Zero(),
                                    input::parse<int>(given.id).value.value_or(-1)};
  const bool mayVary = face.words.takesFormulas && condition.kind == grid::BoundaryKind::dirichlet;
  if (!isPlane) takeValue(given, tag, mayVary, condition, diagnostics);
  const bool onOddPlane = onPlane && !fitsPlane(*label, condition, face.axis);
  if (const std::string problem = contradiction(condition, onOddPlane); !problem.empty())
    diagnostics.error(placeOf({&tag.whereOf("var"), &tag.whereOf("label")}, tag.where()), tag.path(), problem);
  noteSeen(given, tag, face, diagnostics);
  face.conditions.push_back(std::move(condition));
}

void readConditions(const FaceSection& given, const Element& tag, const ReadFace& face, Diagnostics& diagnostics) {
  const std::vector<Element> tags = tag.children("BCType");
  const auto& conditions = given.conditions;
  const bool onPlane =
      std::any_of(conditions.begin(), conditions.end(), [](const auto& one) { return isSymmetry(one.var); });
  for (std::size_t k = 0; k < conditions.size() && k < tags.size(); ++k)
    readCondition(conditions[k], tags[k], onPlane, face, diagnostics);
}

/// Index of the part of a side with this shape; faces with the same shape share a part.
std::size_t partWith(const grid::SidePart& shape, std::vector<grid::ConditionsOfPart>& parts) {
  const auto same = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.shape == shape; });
  if (same != parts.end()) return same - parts.begin();
  parts.push_back({shape, {}});
  return parts.size() - 1;
}

}  // namespace

std::vector<GivenPart> readFaces(const Element& section, const FacesSection& faces, const SideWords& words,
                                 grid::BoundaryConditions& boundaries, Diagnostics& diagnostics) {
  std::vector<GivenPart> parts;
  const auto group = section.child("BoundaryConditions");
  if (!group) return parts;
  const std::vector<Element> elements = group->children("Face");
  std::map<std::string, Location> sides;
  std::map<std::pair<int, std::size_t>, SeenConditions> seenOnParts;
  for (std::size_t f = 0; f < faces.faces.size() && f < elements.size(); ++f) {
    const FaceSection& given = faces.faces[f];
    const int face = given.face();
    if (!checkFaceWords(elements[f], diagnostics)) continue;
    if (const auto side = elements[f].attribute("side")) {
      SeenConditions seen;
      readConditions(given, elements[f], {words, *group, face / 2, boundaries.faces[face], seen}, diagnostics);
      if (const auto [first, isNew] = sides.emplace(*side, elements[f].where()); !isNew)
        diagnostics.error(elements[f],
                          fmt::format("side {} is given twice, the first time at {}", *side, first->second.text()));
      continue;
    }
    if (!words.takesParts) refuseParts(elements[f], diagnostics);
    const auto shape = words.takesParts ? readShape(given, elements[f], diagnostics) : std::nullopt;
    if (!shape) continue;
    const std::size_t part = partWith(*shape, boundaries.parts[face]);
    readConditions(given, elements[f],
                   {words, *group, face / 2, boundaries.parts[face][part].conditions, seenOnParts[{face, part}]},
                   diagnostics);
    parts.push_back({elements[f], face, part});
  }
  return parts;
}

void dropPeriodicSides(const Element& section, grid::Domain& domain, Diagnostics& diagnostics) {
  for (int k = 0; k < 6; ++k)
    if (domain.periodic[k / 2] != 0) domain.boundaries.faces[k].clear();
  const auto group = section.child("BoundaryConditions");
  if (!group) return;
  for (const Element& face : group->children("Face"))
    for (int k = 0; k < 6; ++k)
      if (domain.periodic[k / 2] != 0 && face.attribute("side") == sideNames[k])
        diagnostics.note(face,
                         fmt::format("does nothing: {} is periodic, so this side can have no condition", "xyz"[k / 2]));
}

}  // namespace tushar::scene
