#include "core/scene/scene_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/input/values.hpp"
#include "core/simulation/phases.hpp"

namespace tushar::scene {

using input::Diagnostics;
using simulation::Analysis;
using simulation::Component;
using simulation::Phases;
using simulation::SampledVariable;

namespace {

constexpr const char* path = "DataAnalysis/Module";

/// The variables and materials that a scene can name.
struct Known {
  Phases phases;
  simulation::OtherNames names;
  tasks::Names labels;
  std::set<std::string> foreign;
  std::vector<std::string> materials;  ///< names of materials, by index in the scene
  std::set<std::string> noted;         ///< names of materials for which a note has been written

  Known(const Component& component, const std::vector<std::unique_ptr<Analysis>>& analyses)
      : phases(component, analyses), names(otherNames(component, analyses)), labels(phases.saveable()) {
    const std::vector<std::string> lacking = component.foreignLabels();
    foreign.insert(lacking.begin(), lacking.end());
    materials = phases.materials();
    for (const std::string& gas : component.gasNames())
      if (std::find(materials.begin(), materials.end(), gas) == materials.end()) materials.push_back(gas);
  }
};

/// The index of a material that is given by name or index; -1, with an error, if there is no such material.
int numberOf(const std::string& word, const Known& known, std::string& problem) {
  const auto& all = known.materials;
  if (const auto named = std::find(all.begin(), all.end(), word); named != all.end())
    return static_cast<int>(named - all.begin());
  const int count = std::max(1, static_cast<int>(all.size()));
  const auto number = input::parse<int>(word);
  if (word.empty()) return 0;
  if (number.value && *number.value >= 0 && *number.value < count) return *number.value;
  problem = number.value ? fmt::format("there is no material {}; materials are numbered from 0 to {}", word, count - 1)
            : all.empty()
                ? fmt::format("there is no material '{}': the variables of this component belong to no material", word)
                : fmt::format("there is no material '{}'{}; available: {}", word, didYouMean(word, all), allOf(all));
  return -1;
}

/// Whether a word may refer to the only material, even if it has another name.
bool isLoneMaterial(const std::string& word, const Known& known) {
  return known.materials.size() == 1 && !input::parse<int>(word).value;
}

void settleMaterial(SampledVariable& variable, Known& known, Diagnostics& diagnostics) {
  simulation::SaveRequest& request = variable.request;
  std::string problem;
  variable.material = numberOf(request.material, known, problem);
  if (variable.material < 0 && isLoneMaterial(request.material, known)) {  // as in Uintah
    if (known.noted.insert(request.material).second)
      diagnostics.note(
          request.whereOfMaterial, path,
          fmt::format("'{}' is taken to mean the only material, '{}'", request.material, known.materials[0]));
    variable.material = 0;
    problem.clear();
  }
  const auto& bodies = known.phases.materials();
  if (!problem.empty()) {
    diagnostics.error(request.whereOfMaterial, path, problem);
  } else if (!known.phases.isOfMaterials(request.label)) {
    request.material.clear();
    return;
  } else if (variable.material >= static_cast<int>(bodies.size())) {
    diagnostics.error(
        request.where, path,
        fmt::format("'{}' is not a variable of the gas '{}'; set matl to the index of a body, from 0 to {}",
                    variable.called, known.materials[variable.material], bodies.size() - 1));
  } else {
    request.material = bodies[variable.material];
    return;
  }
  request.material.clear();
}

/// Resolves the names of a variable; returns whether to keep it.
bool settle(SampledVariable& variable, Known& known, Diagnostics& diagnostics) {
  simulation::SaveRequest& request = variable.request;
  request.label = nameHere(known.names, request.label);
  if (known.foreign.contains(request.label) && !known.labels.contains(request.label)) {
    diagnostics.note(request.where, path,
                     fmt::format("'{}' is left out, since no task computes it in this scene", variable.called));
    return false;
  }
  if (!known.labels.contains(request.label)) return true;  // Phases reports it
  if (!request.label.starts_with("c.") && !request.label.starts_with("g."))
    diagnostics.error(
        request.where, path,
        fmt::format("found '{}', expected a cell variable (c.) or a node variable (g.)", variable.called));
  settleMaterial(variable, known, diagnostics);
  return true;
}

}  // namespace

simulation::OtherNames otherNames(const Component& component, const std::vector<std::unique_ptr<Analysis>>& analyses) {
  simulation::OtherNames names = component.otherNames();
  for (const auto& analysis : analyses)
    for (auto& name : analysis->otherNames()) names.push_back(std::move(name));
  return names;
}

std::string nameHere(const simulation::OtherNames& names, const std::string& name) {
  const auto isIt = [&](const auto& pair) { return pair.first == name; };
  const auto found = std::find_if(names.begin(), names.end(), isIt);
  return found == names.end() ? name : found->second;
}

void settleSamples(const Component& component, const std::vector<std::unique_ptr<Analysis>>& analyses,
                   Diagnostics& diagnostics) {
  const auto looks = [](const auto& analysis) { return analysis->variables() != nullptr; };
  if (std::none_of(analyses.begin(), analyses.end(), looks)) return;
  Known known(component, analyses);
  for (const auto& analysis : analyses)
    if (auto* variables = analysis->variables())
      std::erase_if(*variables, [&](SampledVariable& variable) { return !settle(variable, known, diagnostics); });
}

void settleSamples(const Component& component, const std::vector<std::unique_ptr<Analysis>>& analyses) {
  Diagnostics said;
  settleSamples(component, analyses, said);
}

}  // namespace tushar::scene
