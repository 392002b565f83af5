#include <fmt/format.h>

#include "core/simulation/phases.hpp"
#include "core/tasks/reflux.hpp"

// The parts of Phases that apply only to grids of several levels.

namespace tushar::simulation {

void Phases::refuseSavedNodes(const std::vector<std::unique_ptr<Analysis>>& analyses) const {
  std::vector<InputProblem> problems;
  const auto refuse = [&](const std::vector<SaveRequest>& saves, const char* path) {
    for (const SaveRequest& save : saves)
      if (save.label.starts_with(data::NodeLabel<double>::prefix()))
        problems.push_back(
            {save.where, path,
             fmt::format("'{}' is a node variable; on several levels only cell and particle variables are saved",
                         save.label)});
  };
  refuse(saved_fields_, "DataArchiver/save");
  for (const auto& analysis : analyses)
    if (!analysis->layers().empty() || !analysis->windows().empty()) refuse(analysis->samples(), "DataAnalysis/Module");
  if (!problems.empty()) throw InputError(std::move(problems));
}

void Phases::prepareLevels(int levels, bool refluxes, bool bySmallerSteps, data::VariableTable& table) {
  levels_ = levels;
  smaller_steps_ = bySmallerSteps;
  if (levels == 1) return;
  if (refluxes) addRefluxing(bySmallerSteps);
  for (const auto& joint : joints_) table.join(joint);
}

void Phases::addRefluxing(bool bySmallerSteps) {
  if (!bySmallerSteps) {
    lists_.timeAdvance = tasks::withRefluxing(lists_.timeAdvance, lists_.afterRefluxing);
    return;
  }
  tasks::SteppedByLevel lists = tasks::withRegisters(lists_.timeAdvance, lists_.afterRefluxing);
  lists_.timeAdvance = std::move(lists.advance);
  lists_.reflux = std::move(lists.reflux);
}

}  // namespace tushar::simulation
