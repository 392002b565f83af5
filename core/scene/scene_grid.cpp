#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <map>

#include "core/grid/choose_patches.hpp"
#include "core/input/schema.hpp"
#include "core/scene/scene_levels.hpp"

namespace tushar::scene {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::findKind;
using simulation::namesOf;

namespace {

const std::vector<std::string> conditionKinds(grid::boundaryKindNames.begin(), grid::boundaryKindNames.end());

/// The kind that `var`, one of `conditionKinds`, names.
grid::BoundaryKind kindOf(const std::string& var) {
  return static_cast<grid::BoundaryKind>(std::find(conditionKinds.begin(), conditionKinds.end(), var) -
                                         conditionKinds.begin());
}
bool isSymmetry(const std::string& var) { return var == nameOf(grid::BoundaryKind::symmetry); }

/// Labels of Uintah's components of flow, which scenes of others carry along.
const std::vector<std::string> labelsOfFlow{"Density", "Pressure", "SpecificVol"};
bool isOfFlow(const std::string& label) {
  return std::find(labelsOfFlow.begin(), labelsOfFlow.end(), label) != labelsOfFlow.end();
}

struct ConditionSection {
  std::string id, label, var;
  std::optional<std::string> value;
};

struct FaceSection {
  int face = 0;
  std::vector<ConditionSection> conditions;
};

struct FacesSection {
  std::vector<FaceSection> faces;
};

struct GridSection {
  FacesSection boundaries;
  std::vector<LevelSection> levels;
};

/// What is wrong with an attribute.
void errorOf(const std::string& attribute, const Element& element, const std::string& problem,
             Diagnostics& diagnostics) {
  diagnostics.error(element.whereOf(attribute), element.path(), attribute + ": " + problem);
}

Schema<ConditionSection> conditionTag() {
  return Schema<ConditionSection>("BCType", "The condition for a variable at a face.")
      .attributeValue("id", &ConditionSection::id, "all", "1", "number of the material that it holds for, or all");
}

/// `var`, and the value that it may need.
void checkKind(const ConditionSection& condition, const Element& element, Diagnostics& diagnostics) {
  if (const std::string problem = input::choiceProblem(condition.var, conditionKinds); !problem.empty())
    errorOf("var", element, problem, diagnostics);
  else if (!isSymmetry(condition.var) && !condition.value)
    diagnostics.error(element, "a " + condition.var + " condition needs a <value>");
}

const Schema<ConditionSection>& conditionSchema() {
  static const Schema<ConditionSection> schema =
      conditionTag()
          .requiredAttribute("label", &ConditionSection::label, "1", "the variable")
          .requiredAttribute("var", &ConditionSection::var, "1", "symmetry, Dirichlet or Neumann")
          .optional("value", &ConditionSection::value, "SI unit of the variable", "a number or a vector")
          .check([](const ConditionSection& condition, const Element& element, Diagnostics& diagnostics) {
            if (!isOfFlow(condition.label)) checkKind(condition, element, diagnostics);
            if (const auto number = input::parse<int>(condition.id); condition.id != "all" && !(number && *number >= 0))
              errorOf("id", element, "found '" + condition.id + "', expected 'all' or the number of a material",
                      diagnostics);
          });
  return schema;
}

/// Choices whose words stand for themselves.
input::Choices<std::string> wordsOf(const std::vector<std::string>& words) {
  input::Choices<std::string> choices;
  for (const std::string& word : words) choices.emplace_back(word, word);
  return choices;
}

/// The tags of <Grid> around those of conditions, which must outlive it.
struct GridTags {
  explicit GridTags(const Schema<ConditionSection>& condition)
      : face(Schema<FaceSection>("Face", "A side of the grid.")
                 .requiredChoiceAttribute("side", &FaceSection::face,
                                          {{"x-", 0}, {"x+", 1}, {"y-", 2}, {"y+", 3}, {"z-", 4}, {"z+", 5}}, "which")
                 .list("BCType", &FaceSection::conditions, condition, "what a variable does there")),
        faces(Schema<FacesSection>("BoundaryConditions",
                                   "The conditions at the sides of the grid; a side that is not named is free.")
                  .list("Face", &FacesSection::faces, face, "a side")),
        grid(Schema<GridSection>("Grid", "The grid and the conditions at its sides.")
                 .ignoredAttribute("doAMR", "a grid is refined where it has several levels")
                 .section("BoundaryConditions", &GridSection::boundaries, faces)
                 .list("Level", &GridSection::levels, levelSchema(),
                       "the grid, and boxes in which it is finer; the coarsest first", 1)) {}
  GridTags(const GridTags&) = delete;
  GridTags& operator=(const GridTags&) = delete;

  Schema<FaceSection> face;
  Schema<FacesSection> faces;
  Schema<GridSection> grid;
};

const Schema<GridSection>& gridSchema() {
  static const GridTags tags(conditionSchema());
  return tags.grid;
}

/// The conditions of a component as an editor is to see them: of its labels.
Schema<ConditionSection> conditionFor(const std::vector<grid::BoundaryVariable>& labels) {
  Schema<ConditionSection> tag = conditionTag();
  std::vector<std::string> names = namesOf(labels), kinds(conditionKinds.begin(), conditionKinds.end());
  for (const std::string& label : labelsOfFlow)
    if (std::find(names.begin(), names.end(), label) == names.end()) names.push_back(label);
  kinds.emplace_back("computeFromDensity");  // of SpecificVol
  if (labels.empty())
    tag.requiredAttribute("label", &ConditionSection::label, "1", "the variable");
  else
    tag.requiredChoiceAttribute("label", &ConditionSection::label, wordsOf(names), "the variable");
  return tag.requiredChoiceAttribute("var", &ConditionSection::var, wordsOf(kinds), "what it does")
      .optional("value", &ConditionSection::value, "SI unit of the variable", "a number or a vector");
}

/// A Grid section with the labels of one component.
struct GridFor {
  explicit GridFor(const std::vector<grid::BoundaryVariable>& labels)
      : condition(conditionFor(labels)), tags(condition) {}

  Schema<ConditionSection> condition;
  GridTags tags;
};

Vec3 conditionValue(const ConditionSection& condition, bool isVector, const Element& element,
                    Diagnostics& diagnostics) {
  if (!condition.value) return Vec3::Zero();
  const auto vector = input::parse<Vec3>(*condition.value);
  const auto number = input::parse<double>(*condition.value);
  const std::string& problem = isVector ? vector.problem : number.problem;
  if (!problem.empty()) diagnostics.error(element.child("value")->where(), element.path(), "value: " + problem);
  return isVector ? vector.value.value_or(Vec3::Zero()) : Vec3(number.value.value_or(0), 0, 0);
}

/// Why a condition contradicts itself or, on a plane of symmetry, the plane; or nothing.
std::string contradiction(const grid::BoundaryCondition& condition, bool onOddPlane) {
  const bool symmetry = condition.kind == grid::BoundaryKind::symmetry;
  if (symmetry != (condition.variable == grid::symmetric))
    return fmt::format("found label '{}' with var '{}'; 'Symmetric' goes with 'symmetry', and with nothing else",
                       condition.variable.name, nameOf(condition.kind));
  if (!symmetry && onOddPlane && (condition.kind == grid::BoundaryKind::dirichlet || condition.value != Vec3::Zero()))
    return "this face is a plane of symmetry: the only other condition that it allows is a Neumann condition of 0";
  return {};
}

/// Whether a value may be given on a plane of symmetry: the images of its vector have the same where it lies in the
/// plane.
bool fitsPlane(const grid::BoundaryVariable& label, const grid::BoundaryCondition& condition, int axis) {
  return label.isEven && condition.kind == grid::BoundaryKind::dirichlet &&
         (!label.isVector || condition.value[axis] == 0);
}

/// Those of a side across `axis`.
void readConditions(const std::vector<ConditionSection>& given, const std::vector<Element>& tags, int axis,
                    const std::vector<grid::BoundaryVariable>& labels, std::vector<grid::BoundaryCondition>& conditions,
                    Diagnostics& diagnostics) {
  const bool onPlane = std::any_of(given.begin(), given.end(), [](const auto& one) { return isSymmetry(one.var); });
  std::map<std::string, Location> seen;
  for (std::size_t k = 0; k < given.size() && k < tags.size(); ++k) {
    const grid::BoundaryVariable* label = findKind(labels, given[k].label);
    const bool followsDensity = given[k].label == "SpecificVol" && findKind(labels, "Density");
    if (followsDensity && given[k].var == "computeFromDensity") continue;  // as it does anyway
    if (followsDensity) {
      diagnostics.note(tags[k], "does nothing: the specific volume follows from the Density");
      continue;
    }
    if (!label && isOfFlow(given[k].label))
      diagnostics.note(tags[k], given[k].label + " is for components of flow: nothing here depends on it");
    else if (!label && !labels.empty())
      errorOf("label", tags[k], input::choiceProblem(given[k].label, namesOf(labels)), diagnostics);
    if (label && isOfFlow(given[k].label)) checkKind(given[k], tags[k], diagnostics);
    if (!label || !input::choiceProblem(given[k].var, conditionKinds).empty()) continue;
    const bool isPlane = isSymmetry(given[k].var);
    if (isPlane && given[k].value) diagnostics.note(tags[k], "<value> does nothing on a plane of symmetry");
    conditions.push_back(
        {*label, kindOf(given[k].var),
         isPlane ? Vec3(Vec3::Zero()) : conditionValue(given[k], label->isVector, tags[k], diagnostics),
         input::parse<int>(given[k].id).value.value_or(-1)});
    const bool onOddPlane = onPlane && !fitsPlane(*label, conditions.back(), axis);
    if (const std::string problem = contradiction(conditions.back(), onOddPlane); !problem.empty())
      diagnostics.error(placeOf({&tags[k].whereOf("var"), &tags[k].whereOf("label")}, tags[k].where()), tags[k].path(),
                        problem);
    if (const auto [first, isNew] = seen.emplace(given[k].label + given[k].id, tags[k].where()); !isNew)
      diagnostics.error(tags[k], fmt::format("{} already has a condition on this face, at {}; keep one", label->name,
                                             first->second.text()));
  }
}

void readFaces(const Element& section, const FacesSection& faces, const std::vector<grid::BoundaryVariable>& labels,
               grid::Domain& domain, Diagnostics& diagnostics) {
  const auto group = section.child("BoundaryConditions");
  if (!group) return;
  const std::vector<Element> elements = group->children("Face");
  std::map<std::string, Location> seen;
  for (std::size_t f = 0; f < faces.faces.size() && f < elements.size(); ++f) {
    readConditions(faces.faces[f].conditions, elements[f].children("BCType"), faces.faces[f].face / 2, labels,
                   domain.boundaries.faces[faces.faces[f].face], diagnostics);
    const std::string side = elements[f].attribute("side").value_or("");
    if (const auto [first, isNew] = seen.emplace(side, elements[f].where()); !isNew)
      diagnostics.error(elements[f],
                        fmt::format("side {} is given twice, the first time at {}", side, first->second.text()));
  }
}

void checkSize(const grid::Domain& domain, const Element& element, Diagnostics& diagnostics) {
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    cells *= domain.resolution[axis];
    if (domain.upper[axis] == domain.lower[axis] && domain.resolution[axis] > 1)
      diagnostics.error(element, fmt::format("there are {} cells along {}, where the box has no extent",
                                             domain.resolution[axis], "xyz"[axis]));
  }
  if (domain.upper == domain.lower) diagnostics.error(element, "the box has no extent along any axis");
  if (cells > mostCells)
    diagnostics.error(element,
                      fmt::format("resolution [{},{},{}] makes {:.3g} cells; the most is {:.3g}", domain.resolution[0],
                                  domain.resolution[1], domain.resolution[2], cells, mostCells));
}

/// Of a grid of one level.
void cutIntoPatches(const GridBox& box, const grid::Workers& workers, const Element& element, grid::Domain& domain,
                    Diagnostics& diagnostics) {
  if (!box.patches && !workers.layout) {
    domain.patches =
        grid::choosePatches(domain.resolution, box.autoPatch.value_or(workers.patchesFor(domain.resolution)));
    return;
  }
  domain.patches = workers.layout ? *workers.layout : *box.patches;
  for (int axis = 0; axis < 3; ++axis)
    if (domain.patches[axis] > domain.resolution[axis])
      diagnostics.error(element,
                        fmt::format("there are {} patches along {}{}, but only {}", domain.patches[axis], "xyz"[axis],
                                    workers.layout ? " in --layout" : "", counted(domain.resolution[axis], "cell")));
}

/// Of a grid of several levels: boxes of blocks.
void groupBlocks(const Element& section, const grid::Workers& workers, grid::Domain& domain, Diagnostics& diagnostics) {
  if (workers.layout) {
    grid::Refinement& refinement = domain.refinement;
    refinement.blocksPerPatch = *workers.layout;
    for (int axis = 0; axis < 3; ++axis) {  // no more than there are, which keeps the number of their cells an int
      const int blocks = std::max(1, domain.resolution[axis] / refinement.blockCells[axis]) << (refinement.levels - 1);
      (*refinement.blocksPerPatch)[axis] = std::min((*workers.layout)[axis], blocks);
    }
  }
  for (const Element& level : section.children("Level"))
    for (const Element& box : level.children("Box"))
      for (const char* tag : {"patches", "autoPatch"})
        if (const auto given = box.child(tag))
          diagnostics.note(*given,
                           "does nothing: patches of a refined grid are boxes of blocks; -layout sets how many "
                           "blocks a patch has at the most");
}

/// A side of a periodic axis takes no conditions; Uintah overlooks them.
void checkPeriodic(const Element& section, const grid::Domain& domain, Diagnostics& diagnostics) {
  const auto group = section.child("BoundaryConditions");
  if (!group) return;
  const std::string sides[] = {"x-", "x+", "y-", "y+", "z-", "z+"};
  for (const Element& face : group->children("Face"))
    for (int k = 0; k < 6; ++k)
      if (domain.periodic[k / 2] != 0 && face.attribute("side") == sides[k])
        diagnostics.note(face,
                         fmt::format("does nothing: {} is periodic, so this side can have no condition", "xyz"[k / 2]));
}

/// Faces that are a part of a side, as Uintah has them; whether there are none.
bool refusePartsOfSides(const Element& section, Diagnostics& diagnostics) {
  bool none = true;
  const auto group = section.child("BoundaryConditions");
  for (const Element& face : group ? group->children("Face") : std::vector<Element>{})
    for (const char* shape : {"circle", "annulus", "ellipse", "rectangle", "rectangulus"})
      if (const auto side = face.attribute(shape)) {
        diagnostics.error(
            face.whereOf(shape), face.path(),
            fmt::format(
                "conditions on a part of a side ({}) are not available; give side=\"{}\" for conditions on all of it",
                shape, *side));
        none = false;
      }
  return none;
}

}  // namespace

grid::Domain readGrid(const Element& section, const std::vector<grid::BoundaryVariable>& boundaryLabels,
                      const grid::Workers& workers, const AmrSettings& amr, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  grid::Domain domain;
  if (!refusePartsOfSides(section, diagnostics)) return domain;
  const GridSection read = gridSchema().read(section, diagnostics);
  readFaces(section, read.boundaries, boundaryLabels, domain, diagnostics);
  if (diagnostics.size() > before) return domain;
  const std::vector<Element> boxes = section.children("Level").front().children("Box");
  if (boxes.size() > 1)
    diagnostics.error(boxes[1], fmt::format("the first Level has one Box; this is a second one (the first is at {})",
                                            boxes[0].where().text()));
  const LevelSection& level = read.levels.front();
  const GridBox& box = level.boxes.front();
  domain.lower = box.lower;
  domain.upper = box.upper;
  domain.resolution = resolutionOf(box, level, boxes.front(), diagnostics);
  domain.periodic = level.periodic;
  checkPeriodic(section, domain, diagnostics);
  checkSize(domain, boxes.front(), diagnostics);
  if (diagnostics.size() == before) readRefinement(section, read.levels, amr, domain, diagnostics);
  if (diagnostics.size() > before) return domain;
  if (domain.refinement.levels > 1)
    groupBlocks(section, workers, domain, diagnostics);
  else
    cutIntoPatches(box, workers, boxes.front(), domain, diagnostics);
  return domain;
}

const input::SchemaBase& gridForm(const std::vector<grid::BoundaryVariable>& boundaryLabels) {
  static std::list<GridFor> all;
  return all.emplace_back(boundaryLabels).tags.grid;
}

void describeGrid(std::ostream& out) { gridSchema().describe(out); }

}  // namespace tushar::scene
