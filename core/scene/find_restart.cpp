#include "core/scene/find_restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/base/error.hpp"
#include "core/base/mpi_together.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/archive_hdf5_input.hpp"
#include "core/output/archive_index.hpp"
#include "core/output/checkpoint_store.hpp"
#include "core/output/run_log.hpp"

namespace tushar::scene {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& where, const std::string& sentence) {
  throw InputError({{{where.string(), 0, 0}, "", sentence}});
}

/// The folder to which a path leads; the path may be a link.
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
  if (const std::string why = output::RunLog::refusalOf(output::textOf(folder / "run.json").value_or("")); !why.empty())
    refuse(uda, why);
  return folder;
}

/// The steps of checkpoints to try, in order: only the chosen step, or those from LATEST backwards.
std::vector<int> candidatesOf(const std::string& uda, const fs::path& archive, std::optional<int> chosen) {
  const output::CheckpointStore store(archive, 1);
  const std::vector<int> steps = store.steps();
  if (steps.empty()) refuse(uda, "there are no checkpoints; <checkpoint .../> in <DataArchiver> requests them");
  if (!chosen)
    return {std::make_reverse_iterator(std::upper_bound(steps.begin(), steps.end(), store.latest())), steps.rend()};
  if (!std::binary_search(steps.begin(), steps.end(), *chosen))
    refuse(archive, fmt::format("there is no checkpoint of step {}; {}", *chosen, simulation::listedSteps(steps)));
  return {*chosen};
}

void restoreScene(simulation::Restart& restart) {
  if (!output::textOf(restart.scene()).value_or("").empty()) return;
  output::replaceFileOnDisk(restart.scene(), output::Hdf5Input(restart.state()).text("/scene"));
  restart.notes.push_back(fmt::format("{} was missing; it was restored from the checkpoint", restart.scene().string()));
}

}  // namespace

simulation::Restart findRestart(const std::string& uda, std::optional<int> step, const mpi::Communicator& ranks) {
  simulation::Restart restart;
  restart.isChosen = ranks.broadcast(step ? 1 : 0) != 0;
  std::vector<std::uint64_t> candidates;
  ranks.onFirst([&] {
    restart.archive = folderOf(uda);
    for (const int candidate : candidatesOf(uda, restart.archive, step))
      candidates.push_back(static_cast<std::uint64_t>(candidate));
  });
  restart.archive = ranks.broadcast(restart.archive.string());
  restart.others = mpi::allOf(ranks, candidates);
  if (!simulation::takeNext(restart, ranks)) simulation::refuseDamaged(restart, ranks);
  ranks.onFirst([&] { restoreScene(restart); });
  return restart;
}

}  // namespace tushar::scene
