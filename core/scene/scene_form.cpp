#include "core/scene/scene_form.hpp"

#include <algorithm>
#include <cctype>
#include <list>
#include <memory>

#include "core/input/schema.hpp"
#include "core/scene/scene.hpp"

namespace tushar::scene {

using input::Alternative;
using input::Demand;
using input::Schema;
using input::SchemaBase;
using input::TagForm;
using simulation::Catalogue;
using simulation::ComponentKind;
using simulation::SectionForm;

namespace {

/// An empty structure for the schemas that editors use, which read no values.
struct Unread {};

/// Schemas that keep their addresses.
using Schemas = std::list<Schema<Unread>>;

void addTag(Schema<Unread>& parent, const TagForm& form, const std::string& sentence) {
  const auto readNothing = [](Unread&, const input::Element&, input::Diagnostics&) {};
  parent.custom(form.tags.front(), readNothing, form.tags, sentence).forms({form});
}

void addSection(Schema<Unread>& root, const std::string& tag, const SchemaBase& schema, bool isRequired,
                const std::vector<Demand>& demands = {}) {
  TagForm form = input::sectionForm(
      {tag},
      [&schema, demands] {
        return std::vector<Alternative>{{&schema, demands}};
      },
      isRequired ? 1 : 0);
  form.repeats = false;
  addTag(root, form, schema.sentence());
}

/// The spellings of a name that Uintah accepts: as given, and in capitals.
std::vector<std::string> spellings(const std::string& name) {
  std::string capitals = name;
  std::transform(name.begin(), name.end(), capitals.begin(), [](unsigned char c) { return std::toupper(c); });
  return {name, capitals};
}

/// The schema of `<DataAnalysis>` with all modules.
const SchemaBase& analysisForm(const Catalogue& catalogue, Schemas& schemas) {
  std::vector<Alternative> modules;
  const auto kinds = catalogue.analyses();
  for (const auto* kind : kinds) {
    const SchemaBase* schema = kind->schema ? kind->schema() : nullptr;
    if (schema) modules.push_back({schema, {{"name", {kind->name}}}});
  }
  TagForm form = input::sectionForm({"Module"}, [modules] { return modules; });
  Schema<Unread>& all = schemas.emplace_back("DataAnalysis", "What is measured while a scene runs.");
  const bool hasUnknown = modules.size() < kinds.size();
  addTag(all, hasUnknown ? input::anyForm({"Module"}) : form, "an analysis module, selected by its name");
  return all;
}

std::vector<std::vector<SectionForm>> waysToWrite(const ComponentKind& kind) {
  if (kind.forms) return kind.forms();
  std::vector<SectionForm> sections;
  for (const std::string& name : kind.sections) sections.push_back({name, nullptr, false});
  return {sections};
}

void addShared(Schema<Unread>& root, const ComponentKind& kind, const SchemaBase& grid, const SchemaBase& analyses) {
  addSection(root, "Meta", metaForm(), false);
  addSection(root, "SimulationComponent", componentForm(), true, {{"type", spellings(kind.name)}});
  addSection(root, "Time", timeForm(), true);
  addSection(root, "DataArchiver", archiveForm(), false);
  addSection(root, "Grid", grid, true);
  addSection(root, "AMR", amrForm(kind), false);
  addSection(root, "DataAnalysis", analyses, false);
  for (const auto& [tag, why] : idleSections())
    if (std::find(kind.sections.begin(), kind.sections.end(), tag) == kind.sections.end())
      addTag(root, input::anyForm({tag}), why);
}

}  // namespace

TagForm sceneForm(const Catalogue& catalogue) {
  const auto schemas = std::make_shared<Schemas>();
  std::vector<const SchemaBase*> roots;
  const SchemaBase& analyses = analysisForm(catalogue, *schemas);
  for (const ComponentKind* kind : catalogue.components()) {
    const SchemaBase& grid = gridForm(*kind);
    for (const std::vector<SectionForm>& sections : waysToWrite(*kind)) {
      Schema<Unread>& root = schemas->emplace_back("Uintah_specification", kind->sentence + ".");
      addShared(root, *kind, grid, analyses);
      for (const SectionForm& section : sections)
        section.schema ? addSection(root, section.name, *section.schema, section.required, section.demands)
                       : addTag(root, input::anyForm({section.name}), "anything");
      roots.push_back(&root);
    }
  }
  return input::sectionForm({"Uintah_specification"}, [schemas, roots] {
    std::vector<Alternative> all;
    for (const SchemaBase* root : roots) all.push_back({root, {}});
    return all;
  });
}

}  // namespace tushar::scene
