#include "core/simulation/catalogue.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tushar::simulation {

namespace {

/// Adds an entry; its name must not be in use yet.
template <class Entries, class Value>
void insert(Entries& entries, const std::string& name, const Value& value) {
  if (!entries.emplace(name, value).second) throw std::invalid_argument(fmt::format("the name '{}' is taken", name));
}

template <class Entries>
std::vector<std::string> keysOf(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries) names.push_back(name);
  return names;
}

}  // namespace

Catalogue::Catalogue(const std::vector<ComponentKind>& components, const std::vector<AnalysisKind>& analyses) {
  for (const ComponentKind& kind : components) insert(components_, kind.name, kind);
  for (const AnalysisKind& kind : analyses) insert(analyses_, kind.name, kind);
}

void Catalogue::add(const Catalogue& other) {
  for (const ComponentKind* kind : other.components()) insert(components_, kind->name, *kind);
  for (const AnalysisKind* kind : other.analyses()) insert(analyses_, kind->name, *kind);
}

void Catalogue::addModule(const Module& module, std::function<Catalogue()> load) {
  const auto shared = std::make_shared<LoadModule>(std::move(load));
  for (const std::string& name : module.components) insert(components_, name, shared);
  for (const std::string& name : module.analyses) insert(analyses_, name, shared);
}

std::vector<std::string> Catalogue::componentNames() const { return keysOf(components_); }
std::vector<std::string> Catalogue::analysisNames() const { return keysOf(analyses_); }

/// Replaces the placeholders of a module by its actual contents.
void Catalogue::take(const LoadModule& load) const {
  const Catalogue brought = load();
  for (const ComponentKind* kind : brought.components()) components_.insert_or_assign(kind->name, *kind);
  for (const AnalysisKind* kind : brought.analyses()) analyses_.insert_or_assign(kind->name, *kind);
}

template <class Kind>
const Kind* Catalogue::find(const Entries<Kind>& entries, std::string_view name) const {
  const auto found = entries.find(name);
  if (found == entries.end()) return nullptr;
  if (const auto* load = std::get_if<std::shared_ptr<LoadModule>>(&found->second)) take(*std::shared_ptr(*load));
  const Kind* kind = std::get_if<Kind>(&found->second);
  if (!kind) throw std::runtime_error(fmt::format("the module that should define '{}' does not define it", name));
  return kind;
}

template <class Kind>
std::vector<const Kind*> Catalogue::all(const Entries<Kind>& entries) const {
  std::vector<const Kind*> kinds;
  for (const std::string& name : keysOf(entries)) kinds.push_back(find(entries, name));
  return kinds;
}

const ComponentKind* Catalogue::component(std::string_view name) const { return find(components_, name); }
const AnalysisKind* Catalogue::analysis(std::string_view name) const { return find(analyses_, name); }
std::vector<const ComponentKind*> Catalogue::components() const { return all(components_); }
std::vector<const AnalysisKind*> Catalogue::analyses() const { return all(analyses_); }

}  // namespace tushar::simulation
