#include "tools/information.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "core/input/document.hpp"
#include "core/input/geometry.hpp"
#include "core/input/paths.hpp"
#include "core/input/relax_ng.hpp"
#include "core/input/xml_schema.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_form.hpp"
#include "tools/completion.hpp"
#include "tools/messages.hpp"
#include "tools/version.hpp"

namespace tushar {

namespace {

/// Prints the components, analysis modules and shapes.
void printList(const simulation::Catalogue& known) {
  const auto components = known.components();
  const auto analyses = known.analyses();
  fmt::print("components (SimulationComponent type=)\n");
  for (const auto* kind : components) fmt::print("  {:<16} {}\n", kind->name, kind->sentence);
  fmt::print("analysis modules (DataAnalysis/Module name=)\n");
  for (const auto* kind : analyses) fmt::print("  {:<16} {}\n", kind->name, kind->sentence);
  fmt::print("shapes (geom_object)\n");
  for (const std::string& name : input::geometryNames()) fmt::print("  {}\n", name);
}

/// The names that --describe accepts.
std::vector<std::string> manualNames(const simulation::Catalogue& known) {
  std::vector<std::string> names = known.componentNames();
  for (const std::string& other : known.analysisNames()) names.push_back(other);
  names.emplace_back("scene");
  return names;
}

ExitCode describe(const std::string& name, const simulation::Catalogue& known) {
  if (name == "scene") {
    scene::describeSharedSections(std::cout, known);
  } else if (const auto* component = known.component(name)) {
    component->describe(std::cout);
    if (!component->conditionWords.sections.empty()) scene::gridForm(*component).describe(std::cout);
  } else if (const auto* analysis = known.analysis(name)) {
    analysis->describe(std::cout);
  } else {
    const std::vector<std::string> names = manualNames(known);
    fmt::print(stderr, "sus: {}\n",
               withNumber(fmt::format("there is no manual for '{}'{}; available: {}", name, didYouMean(name, names),
                                      allOf(names))));
    return ExitCode::badCommandLine;
  }
  return ExitCode::success;
}

void printSchema(const std::string& language, const simulation::Catalogue& known) {
  const input::TagForm scene = scene::sceneForm(known);
  const std::string comment = fmt::format(
      " Scenes of sus {}; made by: sus --schema {}. It does not describe the limits of values, how tags depend on each "
      "other,\n     or which labels and materials exist. sus --check SCENE checks all of that.",
      TUSHAR_VERSION, language);
  if (language == "rng") return input::writeRelaxNg(std::cout, scene, comment + " ");
  input::writeXmlSchema(
      std::cout, scene,
      comment +
          "\n     Nor can XSD 1.0 describe which tags are required and how often, since tags may be in any order,\n    "
          " or what depends on a type, a name, or the component: a tag may contain whatever any of them allows. ");
}

/// Prints the paths of all values in a scene; `given` is the scene or the folder of a run.
void printPaths(const std::string& given) {
  const bool isFolder = std::filesystem::is_directory(given);
  input::Diagnostics diagnostics;
  const input::Document document = input::Document::load(isFolder ? given + "/input.xml" : given, diagnostics);
  diagnostics.throwIfAny();
  for (const std::string& path : input::settablePaths(document.root())) fmt::print("{}\n", path);
}

}  // namespace

ExitCode answer(const Arguments& arguments, const simulation::Catalogue& known) {
  if (arguments.version)
    fmt::print("{}", versionText());
  else if (arguments.list)
    printList(known);
  else if (!arguments.describe.empty())
    return describe(arguments.describe, known);
  else if (!arguments.schema.empty())
    printSchema(arguments.schema, known);
  else if (!arguments.completion.empty())
    fmt::print("{}", bashCompletion(arguments.optionNames, manualNames(known)));
  else
    printPaths(arguments.paths);
  return ExitCode::success;
}

}  // namespace tushar
