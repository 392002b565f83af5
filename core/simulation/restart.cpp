#include "core/simulation/restart.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "core/base/joined.hpp"
#include "core/base/mpi_together.hpp"

namespace tushar::simulation {

namespace {

InputError refusalOf(const Restart& restart) {
  if (restart.isChosen)
    return InputError({{{restart.archive.string(), 0, 0},
                        "",
                        fmt::format("{}; {}", restart.notes.back(),
                                    listedSteps(output::CheckpointStore(restart.archive, 1).steps()))}});
  std::vector<InputProblem> problems;
  for (const std::string& note : restart.notes) problems.push_back({{}, "", note});
  problems.push_back({{}, "", "no earlier checkpoint is intact; start the run again from its scene"});
  return InputError(std::move(problems));
}

/// Refuses a checkpoint of a newer version. (Otherwise an earlier one would be used, and this one would be lost.)
[[noreturn]] void refuseNewer(const Restart& restart, const std::string& sentence, const mpi::Communicator& ranks) {
  if (ranks.isFirst()) throw InputError({{{restart.state().parent_path().string(), 0, 0}, "", sentence}});
  throw mpi::FailedElsewhere();
}

}  // namespace

void noteDamage(Restart& restart, const std::string& damage) {
  restart.notes.push_back(
      fmt::format("the checkpoint {} is damaged: {}", restart.state().parent_path().string(), damage));
}

bool takeNext(Restart& restart, const mpi::Communicator& ranks) {
  while (!restart.others.empty()) {
    restart.step = static_cast<int>(restart.others.front());
    restart.others.erase(restart.others.begin());
    output::Inspection found = output::inspect(restart.state().parent_path(), ranks);
    restart.parts = std::move(found.parts);
    if (found.damage.empty()) return true;
    if (found.isNewer) refuseNewer(restart, found.damage, ranks);
    noteDamage(restart, found.damage);
  }
  return false;
}

void refuseDamaged(const Restart& restart, const mpi::Communicator& ranks) {
  if (ranks.isFirst()) throw refusalOf(restart);
  throw mpi::FailedElsewhere();
}

std::string listedSteps(const std::vector<int>& steps) {
  return fmt::format("available: step{} {}", steps.size() == 1 ? "" : "s", joined(steps, ", "));
}

std::string continuesFrom(const Restart& restart) {
  return fmt::format("continues from the checkpoint of step {}", restart.step);
}

}  // namespace tushar::simulation
