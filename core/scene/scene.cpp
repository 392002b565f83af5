#include "core/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "core/base/joined.hpp"
#include "core/input/schema.hpp"
#include "core/scene/module_conflicts.hpp"
#include "core/scene/scene_labels.hpp"
#include "core/scene/scene_samples.hpp"
#include "core/simulation/phases.hpp"

namespace tushar::scene {

using input::Diagnostics;
using input::Document;
using input::Element;
using simulation::Analysis;
using simulation::ArchiveSettings;
using simulation::Catalogue;
using simulation::Component;
using simulation::ComponentKind;
using simulation::MakeAnalysis;
using simulation::MakeComponent;
using simulation::MeasuredError;
using simulation::Phases;
using simulation::Problem;
using simulation::SaveRequest;
using simulation::TimeSettings;

namespace {

const std::vector<std::string> sharedSections{"Meta", "SimulationComponent", "Time", "DataArchiver", "Grid",
                                              "AMR",  "DataAnalysis"};

struct Meta {
  std::string title;
};
const input::Schema<Meta>& metaSchema() {
  static const input::Schema<Meta> schema = input::Schema<Meta>("Meta", "A description of the scene.")
                                                .custom(
                                                    "title",
                                                    [](Meta& meta, const Element& element, Diagnostics&) {
                                                      if (const auto title = element.child("title"))
                                                        meta.title = title->text();
                                                    },
                                                    {"title"}, "title")
                                                .forms({input::patternForm({"title"}, ".*")})
                                                .ignored("info", "a note for readers")
                                                .ignored("description", "a note for readers");
  return schema;
}

struct ComponentTag {
  std::string type;
};
const input::Schema<ComponentTag>& componentSchema() {
  static const input::Schema<ComponentTag> schema =
      input::Schema<ComponentTag>("SimulationComponent", "The physics.")
          .requiredAttribute("type", &ComponentTag::type, "1", "name of the component; sus --list names them");
  return schema;
}

/// The section with this name; reports it if it is missing or given twice.
std::optional<Element> section(const Element& root, const std::string& name, bool required, Diagnostics& diagnostics) {
  const std::vector<Element> all = root.children(name);
  if (all.empty()) {
    if (required) diagnostics.error(root, fmt::format("the section <{}> is missing", name));
    return {};
  }
  for (std::size_t k = 1; k < all.size(); ++k)
    diagnostics.error(all[k], fmt::format("<{}> is given twice; the first is at {}", name, all[0].where().text()));
  return all.front();
}

const ComponentKind* readComponentKind(const Element& root, const Catalogue& catalogue, Diagnostics& diagnostics) {
  const auto tag = section(root, "SimulationComponent", true, diagnostics);
  if (!tag) return nullptr;
  const std::size_t before = diagnostics.size();
  const ComponentTag read = componentSchema().read(*tag, diagnostics);
  if (diagnostics.size() > before) return nullptr;
  std::string type = read.type;
  if (std::none_of(type.begin(), type.end(), [](unsigned char c) { return std::islower(c); }))  // as in Uintah
    std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::tolower(c); });
  const ComponentKind* kind = catalogue.component(type);
  if (!kind)
    diagnostics.error(
        tag->whereOf("type"), tag->path(),
        "type: " + input::choiceProblem(read.type, catalogue.componentNames()) + "; --load FILE loads one of your own");
  return kind;
}

void refuseUnknownSections(const Element& root, const ComponentKind& kind, Diagnostics& diagnostics) {
  std::vector<std::string> known = sharedSections;
  for (const std::string& section : kind.sections)
    if (std::find(known.begin(), known.end(), section) == known.end()) known.push_back(section);
  for (const Element& child : root.children())
    if (std::find(known.begin(), known.end(), child.name()) != known.end())
      continue;
    else if (const auto idle = std::find_if(idleSections().begin(), idleSections().end(),
                                            [&](const auto& section) { return section.first == child.name(); });
             idle != idleSections().end())
      diagnostics.note(child, idle->second);
    else
      diagnostics.error(child, fmt::format("unknown section <{}>{}; allowed here: {}", child.name(),
                                           didYouMean(child.name(), known), joined(known, ", ")));
}

/// Refuses text and attributes of the root, except for XML namespaces, which editors write.
void refuseLooseWords(const Element& root, Diagnostics& diagnostics) {
  std::vector<std::string> allowed;
  for (const input::Attribute& attribute : root.attributes())
    if (attribute.name.starts_with("xmlns") || attribute.name.find(':') != std::string::npos)
      allowed.push_back(attribute.name);
  input::refuseAttributes(root, allowed, diagnostics);
  input::refuseText(root, diagnostics);
}

struct ReadModule {
  Element element;
  MakeAnalysis make;
};

/// The modules of a scene. If its component is not known, `loads` is false: then only their names are checked, because
/// building a missing library may take minutes.
std::vector<ReadModule> readModules(const Element& root, const Catalogue& catalogue, bool loads,
                                    Diagnostics& diagnostics) {
  std::vector<ReadModule> modules;
  const auto analysis = section(root, "DataAnalysis", false, diagnostics);
  if (!analysis) return modules;
  input::refuseAttributes(*analysis, {}, diagnostics);
  input::refuseText(*analysis, diagnostics);
  for (const Element& child : analysis->children()) {
    if (child.name() != "Module") {
      diagnostics.error(child, fmt::format("unknown tag <{}>{}; allowed here: Module", child.name(),
                                           didYouMean(child.name(), {"Module"})));
      continue;
    }
    const auto name = child.attribute("name");
    if (!name)
      diagnostics.error(child, "missing attribute 'name'; available: " + allOf(catalogue.analysisNames()));
    else if (const std::string problem = input::choiceProblem(*name, catalogue.analysisNames()); !problem.empty())
      diagnostics.error(child.whereOf("name"), child.path(), "name: " + problem);
    else if (loads)
      modules.push_back({child, catalogue.analysis(*name)->read(child, diagnostics)});
  }
  return modules;
}

std::vector<std::unique_ptr<Analysis>> makeModules(const std::vector<ReadModule>& modules, const Component& component,
                                                   const grid::Level& level) {
  std::vector<std::unique_ptr<Analysis>> analyses;
  std::vector<InputProblem> problems;
  TakenByModules taken;
  for (const ReadModule& module : modules) {
    try {
      analyses.push_back(module.make(component, level));
      if (level.boxes() && !analyses.back()->takesSeveralBoxes())
        throw InputError(
            {{module.element.where(), module.element.path(), "needs a grid of one box: the first Level has several"}});
      refuseTwice(*analyses.back(), module.element, taken);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return analyses;
}

/// Refuses intervals that are no longer than the resolution of the times of the run.
void checkIntervals(const TimeSettings& time, const ArchiveSettings& archive, const Element& section,
                    Diagnostics& diagnostics) {
  if (const auto tag = section.child("outputInterval"))
    checkInterval(archive.outputInterval, time, *tag, "", diagnostics);
  if (archive.checkpoint && archive.checkpoint->interval)
    checkInterval(*archive.checkpoint->interval, time, *section.child("checkpoint"),
                  "attribute 'interval': ", diagnostics);
}

/// Refuses sampling intervals of analysis modules that are no longer than the resolution of the times of the run.
void checkIntervals(const TimeSettings& time, const std::vector<ReadModule>& modules, Diagnostics& diagnostics) {
  for (const ReadModule& module : modules)
    if (const auto tag = module.element.child("outputInterval"))
      checkInterval(input::parse<double>(tag->text()).value.value_or(0), time, *tag, "", diagnostics);
}

/// The tag that requests several levels.
Element whereOfLevels(const Element& grid, const AmrSettings& amr) {
  const std::vector<Element> levels = grid.children("Level");
  return levels.size() > 1 ? levels[1] : *amr.tag;
}

/// Refuses several levels for a component that supports only one. The message does not list the components that support
/// several levels, because their modules may not have been built yet.
void checkTakesLevels(const ComponentKind& kind, const Element& grid, const AmrSettings& amr,
                      Diagnostics& diagnostics) {
  if (!kind.takesLevels)
    diagnostics.error(whereOfLevels(grid, amr),
                      fmt::format("'{}' needs a grid of one level: one <Level> in <Grid>, and no <max_levels> above 1 "
                                  "in <AMR>",
                                  kind.name));
}

/// Refuses several levels, and a level of several boxes, if the component cannot run on them with the settings of the
/// scene. Records the tag that requests several levels.
void checkTakesGrid(const ComponentKind& kind, const Component& component, const Element& grid,
                    const grid::Domain& domain, AmrSettings& amr, Diagnostics& diagnostics) {
  if (domain.refinement.levels > 1) {
    const Element where = whereOfLevels(grid, amr);
    if (const std::string why = component.whyOneLevel(); !why.empty())
      diagnostics.error(where, fmt::format("'{}' needs a grid of one level: {}", kind.name, why));
    amr.regrid.where = where.where();
  }
  if (domain.boxes.empty()) return;
  if (const std::string why = component.whyOneBox(); !why.empty())
    diagnostics.error(grid.children("Level").front().children("Box")[1],
                      fmt::format("'{}' needs a grid of one box: {}", kind.name, why));
}

/// A component constructed on a minimal grid that it accepts, with one axis if possible.
struct Trial {
  std::unique_ptr<grid::Level> level;
  std::unique_ptr<Component> component;  ///< null if no grid is accepted
};
Trial tryOut(const MakeComponent& make) {
  for (int axes = 1; axes <= 3; ++axes) {
    grid::Domain domain;
    for (int d = axes; d < 3; ++d) domain.upper[d] = 0;
    auto level = std::make_unique<grid::Level>(domain);
    try {
      auto component = make(*level);
      return {std::move(level), std::move(component)};
    } catch (const InputError&) {
      continue;  // it needs more axes
    }
  }
  return {};
}

/// Checks the labels even if other parts of the scene are invalid, because the labels of a component and its modules do
/// not depend on the grid. Returns false if the check is impossible: some components and modules cannot be constructed
/// on the small grid that it uses.
bool checkLabelsWithoutGrid(const MakeComponent& make, const std::vector<ReadModule>& modules,
                            std::vector<SaveRequest>& saves, Diagnostics& diagnostics) {
  const auto [level, component] = tryOut(make);
  if (!component) return false;
  std::vector<std::unique_ptr<Analysis>> analyses;
  try {
    analyses = makeModules(modules, *component, *level);
  } catch (const InputError&) {
    return false;
  }
  checkLabels(*component, analyses, saves, diagnostics);
  return true;
}

/// Reads the parts of a scene that do not depend on the component.
void readSharedSections(const Element& root, Problem& problem, Diagnostics& diagnostics) {
  if (const auto meta = section(root, "Meta", false, diagnostics))
    problem.title = metaSchema().read(*meta, diagnostics).title;
  if (const auto time = section(root, "Time", true, diagnostics)) problem.time = readTime(*time, diagnostics);
  if (const auto archive = section(root, "DataArchiver", false, diagnostics)) {
    problem.archive = readArchive(*archive, diagnostics);
    checkIntervals(problem.time, problem.archive, *archive, diagnostics);
  }
}

AmrSettings amrOf(const Element& root, const ComponentKind* kind, Diagnostics& diagnostics) {
  const auto given = section(root, "AMR", false, diagnostics);
  AmrSettings amr = given ? readAmr(*given, kind, diagnostics) : AmrSettings{};
  if (kind && kind->cellsOfBlocks) amr.fewestCellsOfBlock = kind->cellsOfBlocks(root);
  return amr;
}

/// Reads `<Grid>` as the component of the scene accepts it; for an unknown component, accepts everything that any grid
/// may contain.
grid::Domain readGridFor(const ComponentKind* kind, const Element& section, const AmrSettings& amr,
                         const grid::Workers& workers, Diagnostics& diagnostics) {
  SideWords words{{}, true, true};
  if (kind) words = {kind->boundaryLabels, kind->takesPartsOfSides, kind->takesFormulasAtSides, kind->conditionWords};
  grid::Domain domain = readGrid(section, words, workers, amr, diagnostics);
  if (kind && domain.refinement.levels > 1) checkTakesLevels(*kind, section, amr, diagnostics);
  return domain;
}

void takeThreads(const grid::Workers& workers, Problem& problem) {
  problem.threads = workers.threads;
  if (workers.mayBeFewer) problem.cellsPerThread = grid::cellsPerThread;
}

/// The tag that makes finer levels take smaller steps; none on a single level.
std::optional<Location> smallerStepsOn(const grid::Grid& grid, const AmrSettings& amr, Diagnostics& diagnostics) {
  if (grid.levels() > 1 || !amr.smallerSteps) return amr.smallerSteps;
  diagnostics.note(*amr.smallerSteps, "AMR/useLockStep", "does nothing: the grid has one level");
  return std::nullopt;
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& idleSections() {
  static const std::vector<std::pair<std::string, std::string>> sections{
      {"LoadBalancer", "does nothing here: it does not affect the distribution of patches and tasks"},
      {"Scheduler", "does nothing here: it does not affect the distribution of patches and tasks"},
      {"ParallelOptions", "does nothing here: it does not affect the distribution of patches and tasks"},
      {"SimulationController", "does nothing here: use the options of sus instead"},
      {"Debug", "does nothing here: see sus --trace and --schedule"},
      {"ParticlePosition", "does nothing here: the <res> of a body determines where its particles start"},
      {"InitialConditions", "does nothing here: no component uses it"},
      {"CFD", "does nothing here: no component uses it"}};
  return sections;
}

Problem readScene(const std::string& path, const std::vector<std::string>& overrides, const Catalogue& catalogue,
                  const grid::Workers& workers, grid::Share share) {
  Diagnostics diagnostics;
  Document document = Document::load(path, diagnostics);
  diagnostics.throwIfAny();
  for (const std::string& change : overrides) document.set(change, diagnostics);
  const Element root = document.root();

  Problem problem;
  problem.scenePath = path;
  problem.inputXml = document.text();
  refuseLooseWords(root, diagnostics);
  const ComponentKind* kind = readComponentKind(root, catalogue, diagnostics);
  if (kind) refuseUnknownSections(root, *kind, diagnostics);
  if (kind)
    for (const std::string& first : kind->readFirst) document.readFirst(first);
  readSharedSections(root, problem, diagnostics);
  AmrSettings amr = amrOf(root, kind, diagnostics);
  grid::Domain domain;
  if (const auto grid = section(root, "Grid", true, diagnostics))
    domain = readGridFor(kind, *grid, amr, workers, diagnostics);
  if (kind && kind->nodesBeyond) domain.nodesBeyond = kind->nodesBeyond(root);
  const MakeComponent makeComponent = kind ? kind->read(root, diagnostics) : MakeComponent();
  const std::vector<ReadModule> modules = readModules(root, catalogue, kind != nullptr, diagnostics);
  checkIntervals(problem.time, modules, diagnostics);
  const bool modulesAreRight = std::all_of(modules.begin(), modules.end(), [](const auto& m) { return m.make; });
  const bool labelsAreChecked = makeComponent && modulesAreRight &&
                                checkLabelsWithoutGrid(makeComponent, modules, problem.archive.saves, diagnostics);
  diagnostics.throwIfAny();

  problem.componentName = kind->name;
  problem.grid = std::make_unique<grid::Grid>(domain, share);
  takeThreads(workers, problem);
  problem.component = makeComponent(problem.grid->finest());
  checkTakesGrid(*kind, *problem.component, *root.child("Grid"), domain, amr, diagnostics);
  problem.smallerSteps = smallerStepsOn(*problem.grid, amr, diagnostics);
  problem.regrid = settled(std::move(amr), *problem.component, diagnostics);
  problem.regrid.adaptive = problem.regrid.adaptive && problem.grid->levels() > 1;
  diagnostics.throwIfAny();
  if (problem.component->mayRepeatStep()) problem.time.recomputeTimeStep = true;
  problem.analyses = makeModules(modules, *problem.component, problem.grid->finest());
  if (labelsAreChecked)
    settleSamples(*problem.component, problem.analyses);
  else
    checkLabels(*problem.component, problem.analyses, problem.archive.saves, diagnostics);
  diagnostics.throwIfAny();
  if (domain.refinement.levels > 1) dropSavedNodes(problem.archive.saves, diagnostics);
  for (const InputProblem& note : problem.component->notes()) diagnostics.note(note.where, note.tagPath, note.sentence);
  problem.notes = diagnostics.notes();
  return problem;
}

const input::SchemaBase& metaForm() { return metaSchema(); }
const input::SchemaBase& componentForm() { return componentSchema(); }

void describeSharedSections(std::ostream& out, const Catalogue& catalogue) {
  metaSchema().describe(out);
  componentSchema().describe(out);
  describeTime(out);
  describeArchive(out);
  describeGrid(out);
  describeAmr(out, catalogue);
}

}  // namespace tushar::scene
