#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "core/input/refuse.hpp"
#include "core/input/schema.hpp"
#include "core/scene/component_lists.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_samples.hpp"

namespace tushar::scene {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::Criterion;
using Indicator = simulation::Criterion::Indicator;

namespace {

/// The name of the criterion that refines cells with particles of any material; it is not the name of a variable.
constexpr std::string_view cellsWithParticles = "particles";

struct VariableTag {
  std::string name, material;
  Indicator indicator = Indicator::jump;
  std::optional<double> refine, coarsen;
  Location where;
  std::string path;
};

struct CriteriaSection {
  std::vector<VariableTag> variables;
};

struct ThresholdsSection {
  bool refluxes = true;
  CriteriaSection criteria;
};

struct RegridderSection {
  std::string type;
  std::optional<bool> adaptive;
  bool once = false;
  std::optional<int> maxLevels;
  std::optional<std::vector<Index3>> ratios, blocks;
  int interval = 8;
  Index3 dilation = Index3::filled(1);
};

struct AmrSection {
  bool usesLockStep = true;
  RegridderSection regridder;
  std::vector<ThresholdsSection> components;
};

bool isLower(Indicator indicator) { return indicator == Indicator::below; }
bool isValue(Indicator indicator) { return indicator == Indicator::above || indicator == Indicator::below; }

/// The default threshold for coarsening: half of the threshold for refining or, for indicators that are the value
/// itself, beyond this threshold by half of its magnitude.
double coarsenOf(const VariableTag& tag, double refine) {
  if (tag.coarsen) return *tag.coarsen;
  return isLower(tag.indicator) ? refine + 0.5 * std::abs(refine) : refine - 0.5 * std::abs(refine);
}

void noteIdle(const Element& particles, Diagnostics& diagnostics) {
  for (const input::Attribute& given : particles.attributes())
    if (given.name != "name")
      diagnostics.note(given.where, particles.path(),
                       fmt::format("{} does nothing: all cells with particles are on the finest level", given.name));
}

void checkThresholds(const VariableTag& tag, const Element& element, Diagnostics& diagnostics) {
  if (tag.name == cellsWithParticles) return noteIdle(element, diagnostics);
  if (!tag.refine)
    return diagnostics.error(
        element, fmt::format("missing attribute 'value' of <{}> (cells are refined where the indicator is above this)",
                             element.name()));
  const double refine = *tag.refine;
  const auto refuse = [&](const char* attribute, double found, const std::string& expected) {
    diagnostics.error(element.whereOf(attribute), element.path(),
                      fmt::format("attribute '{}': found '{:g}', expected {}", attribute, found, expected));
  };
  if (!isValue(tag.indicator) && refine <= 0) return refuse("value", refine, "a value greater than 0");
  if (tag.indicator == Indicator::secondDerivative && refine >= 1)
    return refuse("value", refine, "a value less than 1, since the indicator second_derivative is at most 1");
  if (!tag.coarsen) return;
  if (!isValue(tag.indicator) && *tag.coarsen < 0) refuse("coarsen", *tag.coarsen, "a value of at least 0");
  if (isLower(tag.indicator) ? *tag.coarsen < refine : *tag.coarsen > refine)
    refuse("coarsen", *tag.coarsen,
           fmt::format("{} the attribute 'value', {:g}", isLower(tag.indicator) ? "at least" : "at most", refine));
}

const Schema<VariableTag>& variableSchema() {
  static const Schema<VariableTag> schema =
      Schema<VariableTag>("Variable", "A refinement criterion.")
          .location(&VariableTag::where)
          .requiredAttribute("name", &VariableTag::name, "1",
                             "a cell variable, such as c.density; or particles, without other attributes, since the "
                             "finest level always follows them")
          .optionalAttribute("value", &VariableTag::refine, "1",
                             "cells are refined where the indicator is above this or, with type=\"below\", below it; "
                             "required, except for particles")
          .attributeValue("matl", &VariableTag::material, "all", "1", "name or index of the material, or all")
          .choiceAttribute(
              "type", &VariableTag::indicator,
              {{"jump", Indicator::jump},
               {"second_derivative", Indicator::secondDerivative},
               {"gradient", Indicator::gradient},
               {"above", Indicator::above},
               {"below", Indicator::below}},
              Indicator::jump,
              "the indicator. jump: half the difference between the neighbours, divided by the smallest magnitude in "
              "the three cells (for quantities that are never near 0); second_derivative: Löhner's, from 0 to 1; "
              "gradient: in the unit of the variable per m, as in Uintah; above, below: the value itself")
          .ours()
          .optionalAttribute("coarsen", &VariableTag::coarsen, "1",
                             "cells are not coarsened where the indicator is above this or, with type=\"below\", "
                             "below it; half of value by default")
          .ours()
          .check(checkThresholds);
  return schema;
}

const Schema<CriteriaSection>& criteriaSchema() {
  static const Schema<CriteriaSection> schema =
      Schema<CriteriaSection>("Refinement_Criteria_Thresholds",
                              "Criteria for finer cells; if there are several criteria, the one that requests the "
                              "finest cells prevails.")
          .list("Variable", &CriteriaSection::variables, variableSchema(), "a refinement criterion");
  return schema;
}

const Schema<ThresholdsSection>& thresholdsSchema() {
  static const Schema<ThresholdsSection> schema = [] {
    Schema<ThresholdsSection> section("component", "How a component runs on several levels.");
    section
        .value("do_Refluxing", &ThresholdsSection::refluxes, true, "1",
               "whether the flux out of coarse cells equals that into finer ones, to round-off; otherwise totals drift")
        .section("Refinement_Criteria_Thresholds", &ThresholdsSection::criteria, criteriaSchema());
    const std::string order = "interpolation between levels is of second order";
    input::noteTag(section, "orderOfInterpolation", order);
    input::noteTag(section, "orderOf_CFI_Interpolation", order);
    input::noteTag(section, "CFI_interpolator", order);
    section.ignored("ClampSpecificVolume", "Uintah does not use it here either");
    const std::string region = "use a further <Level> of <Grid> to specify where cells are finer";
    for (const char* tag : {"min_grid_level", "max_grid_level", "manualGrid", "Refine_Regions"})
      input::noteTag(section, tag, region);
    return section;
  }();
  return schema;
}

void noteOldRegridderTags(Schema<RegridderSection>& section) {
  input::noteTag(section, "max_timestep_interval", "<min_timestep_interval> alone determines when to regrid");
  const std::string buffer =
      "<cell_stability_dilation> alone widens the refined region, in addition to the distance that signals travel";
  for (const char* tag :
       {"cell_regrid_dilation", "cell_deletion_dilation", "min_boundary_cells", "dynamic_dilation", "max_dilation"})
    input::noteTag(section, tag, buffer);
  const std::string cost = "the cost of a refinement is not considered";
  for (const char* tag : {"amr_overhead_low", "amr_overhead_high"}) input::noteTag(section, tag, cost);
  input::noteTag(section, "patches_per_level_per_proc", "patches are boxes of blocks; --layout sets their size");
}

const Schema<RegridderSection>& regridderSchema() {
  static const Schema<RegridderSection> schema = [] {
    Schema<RegridderSection> section("Regridder", "How the grid is refined, and when.");
    section
        .choiceAttribute("type", &RegridderSection::type, {{"Tiled", "Tiled"}, {"BNR", "BNR"}}, "Tiled",
                         "Uintah's algorithms for choosing patches; both mean blocks here")
        .elsewhere("SingleLevel",
                   "<patches> in the Box of a level, or --layout, determines the patches of a single level")
        .optional("adaptive", &RegridderSection::adaptive, "1",
                  "whether the refinement follows the state; true by default if there is a <Variable> or, for mpm, if "
                  "<max_levels> is above 1. Without a <Variable>, euler refines at jumps of c.density, c.pressure and "
                  "c.mach above 0.02; mpm needs none, as the finest level follows its particles")
        .value("regrid_once", &RegridderSection::once, false, "1", "whether the grid is refined only at the start")
        .optional("max_levels", &RegridderSection::maxLevels, "1",
                  "largest number of levels, including the coarsest; by default the number that follows from the "
                  "Levels of Grid, but at least 2 if the grid is adaptive",
                  input::between(1, 16))
        .optional("cell_refinement_ratio", &RegridderSection::ratios, "1",
                  "ratio of cell widths from each level to the next; the last one also holds for further levels. 2, 4, "
                  "8 … along all axes that the grid uses; 4 counts as two levels",
                  input::atLeast(1))
        .optional("min_patch_size", &RegridderSection::blocks, "1",
                  "cells in a block, which is refined as a whole: an even number of at least 4 that divides the "
                  "resolution, the same for all levels; by default the largest up to 8 (in one dimension, up to 16)",
                  input::atLeast(1))
        .value("min_timestep_interval", &RegridderSection::interval, 8, "1", "steps from one regridding to the next",
               input::atLeast(1))
        .value("cell_stability_dilation", &RegridderSection::dilation, Index3::filled(1), "1",
               "number of cells to refine around those that signals can reach until the next regridding; the largest "
               "of the three numbers is used along all axes",
               input::nonNegative());
    input::refuseOtherValues(section, "simple_refinement_ratio", {"2"}, "give one more level instead");
    noteOldRegridderTags(section);
    return section;
  }();
  return schema;
}

ThresholdsSection readThresholds(const Element& given, Diagnostics& diagnostics) {
  ThresholdsSection read = thresholdsSchema().read(given, diagnostics);
  for (VariableTag& tag : read.criteria.variables) tag.path = given.path() + "/Refinement_Criteria_Thresholds/Variable";
  return read;
}

/// The schema of `AMR` with the sections of the named components.
Schema<AmrSection> makeAmrSchema(const std::vector<std::string>& names) {
  Schema<AmrSection> section("AMR", "Adaptive mesh refinement: cells of several sizes.");
  const auto readComponents = [names](AmrSection& read, const Element& element, Diagnostics& diagnostics) {
    for (const std::string& name : names)
      for (const Element& given : element.children(name)) read.components.push_back(readThresholds(given, diagnostics));
  };
  section.ignoredAttribute("type", "<Regridder> determines whether a grid is adaptive")
      .check([](const AmrSection&, const Element& given, Diagnostics& diagnostics) {
        input::noteAttribute(given, "type", "<Regridder> determines whether a grid is adaptive", diagnostics);
      })
      .value("useLockStep", &AmrSection::usesLockStep, true, "1",
             "true: all levels take the same time step; false: finer levels take several smaller steps for each step "
             "of the next coarser level; not available if a task of a step needs new values of other cells or sums "
             "over the grid")
      .section("Regridder", &AmrSection::regridder, regridderSchema());
  if (!names.empty()) {
    input::TagForm form = input::sectionForm(names, [] {
      return std::vector<input::Alternative>{{&thresholdsSchema(), {}}};
    });
    form.repeats = false;
    section
        .custom(names.front(), readComponents, names, "how the component runs on several levels",
                [](std::ostream& out, int indent) { thresholdsSchema().describeContents(out, indent); })
        .forms({std::move(form)});
  }
  input::noteTag(section, "doMultiTaskgraphing", "the tasks of all levels are in one graph");
  input::noteTag(section, "FineCoarseInterfaces", "interpolation between levels is of second order");
  return section;
}

const Schema<AmrSection>& amrSchema(const std::vector<std::string>& names) {
  static std::map<std::vector<std::string>, Schema<AmrSection>> schemas;
  const auto known = schemas.find(names);
  return known != schemas.end() ? known->second : schemas.emplace(names, makeAmrSchema(names)).first->second;
}

/// The sections of `AMR` that belong to a component: those that it lists, and one with the component's own name, such
/// as `MyFlow` for `my_flow`.
std::vector<std::string> amrSectionsOf(const simulation::ComponentKind& kind) {
  std::vector<std::string> names = kind.amrSections;
  if (!kind.takesLevels) return names;
  const auto plain = [](std::string name) {
    std::erase(name, '_');
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name;
  };
  for (const std::string& section : kind.sections)
    if (plain(section) == plain(kind.name) && std::find(names.begin(), names.end(), section) == names.end())
      names.push_back(section);
  return names;
}

/// The sections of `AMR` for an unknown component: all tags that do not belong to `AMR` itself.
std::vector<std::string> unknownTagsOf(const Element& amr) {
  std::vector<std::string> names;
  const std::vector<std::string> own = amrSchema({}).tagNames();
  for (const Element& child : amr.children())
    if (std::find(own.begin(), own.end(), child.name()) == own.end() &&
        std::find(names.begin(), names.end(), child.name()) == names.end())
      names.push_back(child.name());
  return names;
}

Criterion criterionOf(const VariableTag& tag) {
  Criterion criterion;
  criterion.variable = tag.name;
  if (tag.material != "all") criterion.material = tag.material;
  criterion.indicator = tag.indicator;
  criterion.refine = tag.refine.value_or(0);
  criterion.coarsen = coarsenOf(tag, criterion.refine);
  criterion.where = tag.where;
  criterion.path = tag.path;
  return criterion;
}

void checkBlocks(const Element& amr, const std::optional<std::vector<Index3>>& blocks, Diagnostics& diagnostics) {
  if (blocks && std::any_of(blocks->begin(), blocks->end(), [&](const Index3& one) { return one != blocks->front(); }))
    diagnostics.error(
        *amr.child("Regridder")->child("min_patch_size"),
        fmt::format(
            "found {}, expected the same for all levels: a block is refined into blocks with the same number of cells",
            input::toText(*blocks)));
}

/// Checks that the material of a criterion has its variable; replaces the index of a material by its name.
void checkMaterial(Criterion& criterion, const std::vector<std::string>& materials, Diagnostics& diagnostics) {
  std::string& given = criterion.material;
  if (given.empty()) return;
  if (materials.empty()) {
    diagnostics.note(criterion.where, criterion.path,
                     fmt::format("matl does nothing: '{}' belongs to no material", criterion.variable));
    given.clear();
    return;
  }
  const auto number = input::parse<int>(given).value;
  if (number && *number >= 0 && *number < std::ssize(materials)) given = materials[*number];
  if (const std::string problem = input::choiceProblem(given, materials); !problem.empty())
    diagnostics.error(criterion.where, criterion.path, "matl: " + problem);
}

}  // namespace

AmrSettings readAmr(const Element& section, const simulation::ComponentKind* kind, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const AmrSection read = amrSchema(kind ? amrSectionsOf(*kind) : unknownTagsOf(section)).read(section, diagnostics);
  AmrSettings amr;
  amr.tag = section;
  for (const ThresholdsSection& component : read.components) {
    amr.regrid.refluxes = amr.regrid.refluxes && component.refluxes;
    for (const VariableTag& tag : component.criteria.variables) amr.regrid.criteria.push_back(criterionOf(tag));
  }
  const RegridderSection& regridder = read.regridder;
  const bool refinesByItself = kind && kind->refinesByItself && regridder.maxLevels.value_or(1) > 1;
  amr.regrid.adaptive = regridder.adaptive.value_or(refinesByItself || !amr.regrid.criteria.empty());
  amr.regrid.once = regridder.once;
  amr.regrid.interval = regridder.interval;
  amr.regrid.dilation = *std::max_element(regridder.dilation.at.begin(), regridder.dilation.at.end());
  amr.maxLevels = regridder.maxLevels;
  amr.ratios = regridder.ratios;
  if (diagnostics.size() > before) return amr;
  checkBlocks(section, regridder.blocks, diagnostics);
  if (regridder.blocks) amr.block = regridder.blocks->front();
  if (!read.usesLockStep) amr.smallerSteps = section.child("useLockStep")->where();
  if (!amr.regrid.adaptive)
    for (const Criterion& criterion : amr.regrid.criteria)
      diagnostics.note(criterion.where, criterion.path, "does nothing: the grid is not <adaptive>");
  return amr;
}

simulation::RegridSettings settled(AmrSettings amr, const simulation::Component& component, Diagnostics& diagnostics) {
  std::vector<Criterion>& criteria = amr.regrid.criteria;
  if (!amr.regrid.adaptive) return amr.regrid;
  const bool followsParticles = hasParticles(component);  // always, so also if the scene says so
  if (followsParticles)
    std::erase_if(criteria, [](const Criterion& one) { return one.variable == cellsWithParticles; });
  if (criteria.empty() && !followsParticles) {
    criteria = component.criteria();
    if (criteria.empty() && !estimatesErrors(component))
      diagnostics.error(
          *amr.tag->child("Regridder")->child("adaptive"),
          "<adaptive> true needs a <Variable> in <Refinement_Criteria_Thresholds>, which specifies where to refine");
    return amr.regrid;
  }
  const simulation::OtherNames otherNames = component.otherNames();
  for (Criterion& criterion : criteria) criterion.variable = nameHere(otherNames, criterion.variable);
  const auto variables = cellVariables(component);
  std::vector<std::string> names;
  if (followsParticles) names.emplace_back(cellsWithParticles);
  for (const auto& [name, materials] : variables) names.push_back(name);
  for (Criterion& criterion : criteria)
    if (const auto found = variables.find(criterion.variable); found != variables.end())
      checkMaterial(criterion, found->second, diagnostics);
    else
      diagnostics.error(criterion.where, criterion.path, "name: " + input::choiceProblem(criterion.variable, names));
  return amr.regrid;
}

void dropSavedNodes(std::vector<simulation::SaveRequest>& saves, Diagnostics& diagnostics) {
  std::erase_if(saves, [&](const simulation::SaveRequest& save) {
    const bool isOfNodes = save.label.starts_with(data::NodeLabel<double>::prefix());
    if (isOfNodes)
      diagnostics.note(
          save.where, "DataArchiver/save",
          fmt::format("'{}' is not saved: on several levels only cell and particle variables are", save.label));
    return isOfNodes;
  });
}

const input::SchemaBase& amrForm(const simulation::ComponentKind& kind) { return amrSchema(amrSectionsOf(kind)); }

void describeAmr(std::ostream& out, const simulation::Catalogue& catalogue) {
  std::vector<std::string> names;
  for (const simulation::ComponentKind* kind : catalogue.components())
    for (std::string& name : amrSectionsOf(*kind))
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  amrSchema(names).describe(out);
}

}  // namespace tushar::scene
