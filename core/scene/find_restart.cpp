#include "core/scene/find_restart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/archive_hdf5_input.hpp"
#include "core/output/archive_index.hpp"
#include "core/output/checkpoint_manifest.hpp"
#include "core/output/checkpoint_store.hpp"

namespace tushar::scene {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& where, const std::string& sentence) {
  throw InputError({{{where.string(), 0, 0}, "", sentence}});
}

/// The folder behind a path that may be a link to it.
fs::path folderOf(const fs::path& uda) {
  if (!fs::exists(uda)) refuse(uda, "there is no such folder; --restart takes the .uda folder of a run");
  if (!fs::is_directory(uda))
    refuse(uda, "this is not a folder; --restart takes the .uda folder of a run (without --restart, sus runs a scene)");
  const fs::path path = uda.has_filename() ? uda : uda.parent_path();
  const fs::path folder = fs::is_symlink(path) ? path.parent_path() / fs::read_symlink(path) : path;
  if (!fs::exists(folder / "index.xml") && !fs::exists(folder / "checkpoints"))
    refuse(uda, "this is not a .uda folder: it has neither index.xml nor checkpoints");
  if (const std::string why = output::ArchiveIndex::refusalOf(output::textOf(folder / "index.xml").value_or(""));
      !why.empty())
    refuse(uda, why);
  return folder;
}

std::string damageSentence(const output::CheckpointStore& store, int step, const std::string& damage) {
  return fmt::format("the checkpoint {} is damaged: {}", store.folder(step).string(), damage);
}

int chosen(const fs::path& archive, const output::CheckpointStore& store, int step) {
  const std::vector<int> steps = store.steps();
  const std::string there =
      fmt::format("there {} {}", steps.size() == 1 ? "is that of step" : "are those of steps", fmt::join(steps, ", "));
  if (!std::binary_search(steps.begin(), steps.end(), step))
    refuse(archive, fmt::format("there is no checkpoint of step {}; {}", step, there));
  if (const std::string damage = output::damageOf(store.folder(step)); !damage.empty())
    refuse(archive, fmt::format("{}; {}", damageSentence(store, step, damage), there));
  return step;
}

/// The last checkpoint that is whole, from LATEST back; the others get their sentence.
int lastWhole(const output::CheckpointStore& store, std::vector<std::string>& notes) {
  std::vector<InputProblem> problems;
  const std::vector<int> steps = store.steps();
  auto next = std::upper_bound(steps.begin(), steps.end(), store.latest());
  while (next != steps.begin()) {
    const int step = *--next;
    const std::string damage = output::damageOf(store.folder(step));
    if (damage.empty()) return step;
    notes.push_back(damageSentence(store, step, damage));
    problems.push_back({{}, "", notes.back()});
  }
  problems.push_back({{}, "", "no earlier checkpoint is intact; start the run again from its scene"});
  throw InputError(std::move(problems));
}

}  // namespace

simulation::Restart findRestart(const std::string& uda, std::optional<int> step) {
  simulation::Restart restart{folderOf(uda), 0, {}};
  const output::CheckpointStore store(restart.archive, 1);
  if (store.steps().empty())
    refuse(uda, "there are no checkpoints; ask for them with <checkpoint .../> in <DataArchiver>");
  restart.step = step ? chosen(restart.archive, store, *step) : lastWhole(store, restart.notes);
  if (output::textOf(restart.scene()).value_or("").empty()) {
    output::replaceFileOnDisk(restart.scene(), output::Hdf5Input(restart.state()).text("/scene"));
    restart.notes.push_back(fmt::format("{} was lost and is that of the checkpoint now", restart.scene().string()));
  }
  return restart;
}

}  // namespace tushar::scene
