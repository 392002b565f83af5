#include "core/scene/scene_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/scene/module_conflicts.hpp"
#include "core/scene/scene_samples.hpp"
#include "core/simulation/phases.hpp"

namespace tushar::scene {

using input::Diagnostics;
using simulation::Analysis;
using simulation::Component;
using simulation::Phases;
using simulation::SaveRequest;

namespace {

/// Replaces Uintah's names of variables by Tushar's, with a note; each variable is saved once.
void renameLabels(const simulation::OtherNames& names, std::vector<SaveRequest>& saves, Diagnostics& diagnostics) {
  std::vector<SaveRequest> kept;
  for (SaveRequest& save : saves) {
    const std::string given = std::exchange(save.label, nameHere(names, save.label));
    const bool isRenamed = save.label != given;
    if (isRenamed)
      diagnostics.note(save.where, "DataArchiver/save", fmt::format("'{}' is saved as '{}'", given, save.label));
    const bool isThere =
        std::any_of(kept.begin(), kept.end(), [&](const SaveRequest& other) { return other.label == save.label; });
    if (!isRenamed || !isThere) kept.push_back(save);
  }
  saves = std::move(kept);
}

}  // namespace

void checkLabels(const Component& component, const std::vector<std::unique_ptr<Analysis>>& analyses,
                 std::vector<SaveRequest>& saves, Diagnostics& diagnostics) {
  renameLabels(otherNames(component, analyses), saves, diagnostics);
  settleSamples(component, analyses, diagnostics);
  const Phases phases(component, analyses);
  const std::vector<std::string> foreign = component.foreignLabels();
  std::erase_if(saves, [&](const SaveRequest& save) {
    const bool isLacking = std::find(foreign.begin(), foreign.end(), save.label) != foreign.end() &&
                           !phases.saveable().contains(save.label);
    if (isLacking)
      diagnostics.note(save.where, "DataArchiver/save",
                       fmt::format("'{}' is not saved, since no task computes it in this scene", save.label));
    return isLacking;
  });
  for (const SaveRequest& save : saves)
    if (!save.material.empty() && save.material != "all" && phases.materials().size() > 1 && phases.isTotal(save.label))
      diagnostics.note(save.whereOfMaterial, "DataArchiver/save",
                       fmt::format("'{}' is a total over all materials, and is saved as such", save.label));
  for (const SaveRequest& save : saves)
    for (const std::string& remark : phases.remarksOn(save))
      diagnostics.note(save.whereOfMaterial, "DataArchiver/save", remark);
  for (const std::vector<InputProblem>& problems : {phases.problemsOf(saves), phases.problemsOf(analyses)})
    for (const InputProblem& problem : problems) diagnostics.error(problem.where, problem.tagPath, problem.sentence);
  refuseSharedFiles(analyses, saves, diagnostics);
}

}  // namespace tushar::scene
