#include "core/simulation/checkpoint_file.hpp"

#include <fmt/format.h>

#include "core/collect/gather.hpp"
#include "core/collect/stored_state.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/inside_boxes.hpp"

namespace tushar::simulation {

namespace {

constexpr int format = 1;

[[noreturn]] void refuse(const output::Hdf5Input& file, const std::string& sentence) {
  throw InputError({{{file.path().string(), 0, 0}, "", sentence}});
}

void writeGrid(output::Hdf5File& file, const output::GridInfo& grid) {
  file.group("/grid");
  file.attribute("/grid", "lower", grid.lower);
  file.attribute("/grid", "spacing", grid.spacing);
  file.attribute("/grid", "cells", grid.cells);
  file.attribute("/grid", "dimension", grid.dimension);
}

/// Writes the tree of refined blocks, if there are several levels.
void writeTree(output::Hdf5File& file, const grid::Grid& grid) {
  if (grid.levels() == 1) return;
  file.attribute("/grid", "levels", grid.levels());
  file.attribute("/grid", "blockCells", grid.blockCells());
  const std::vector<std::uint64_t>& keys = grid.tree().keys();
  file.dataset("/grid/leaves", {"leaves", "1", "blocks that are not refined", 1, keys}, {keys.size()});
}

/// Reads the tree of refined blocks.
void readTree(const output::Hdf5Input& file, RunState& run) {
  grid::Grid& grid = *run.problem.grid;
  const bool isRefined = file.has("/grid/leaves");
  if (isRefined != (grid.levels() > 1) || (isRefined && (file.integer("/grid", "levels") != grid.levels() ||
                                                         !(file.index("/grid", "blockCells") == grid.blockCells()))))
    refuse(file, "the checkpoint has other levels or blocks than the scene");
  if (!isRefined) return;
  Index3 periodic;
  for (int d = 0; d < grid.dimension(); ++d) periodic[d] = grid.level().isPeriodic(d);
  const auto keys = std::get<std::vector<std::uint64_t>>(file.dataset("/grid/leaves"));
  try {
    grid.refine(
        grid.cut(grid::BlockTree::fromKeys(grid.dimension(), grid.tree().roots(), periodic, grid.levels(), keys)));
  } catch (const std::invalid_argument&) {
    refuse(file, "the blocks of the checkpoint do not tile the grid");
  }
  run.warehouse.startAnew(run.materials());
  run.scheduler.forgetLayout();
}

bool isSameGrid(const output::Hdf5Input& file, const output::GridInfo& grid) {
  return file.vector("/grid", "lower") == grid.lower && file.vector("/grid", "spacing") == grid.spacing &&
         file.index("/grid", "cells") == grid.cells && file.integer("/grid", "dimension") == grid.dimension &&
         output::hasSameInside(file, grid);
}

void checkScene(const output::Hdf5Input& file, const Problem& problem) {
  if (const int found = file.integer("/", "format"); found != format)
    refuse(file, fmt::format(
                     "the checkpoint has format {}, but this sus supports only format {}; it was written by version {}",
                     found, format, file.text("/", "version")));
  if (const int found = file.integer("/", "step"); found != problem.restart->step)
    refuse(file, fmt::format("the checkpoint is of step {}; rename its folder to {}", found, output::stepName(found)));
  if (const std::string found = file.text("/", "component"); found != problem.componentName)
    refuse(file,
           fmt::format("the checkpoint is of component '{}', but the scene has '{}'", found, problem.componentName));
  if (!isSameGrid(file, collect::gridInfo(problem.grid->level())))
    refuse(file, "the checkpoint has a different grid from the scene; a restart may change patches, but not cells");
}

/// A text with empty lines at its end: files of the same form, with texts of the same length, are written faster (see
/// output::HeadImage).
std::string padded(std::string text) {
  constexpr std::size_t unit = 4096;
  text.resize((text.size() / unit + 1) * unit, '\n');
  return text;
}

collect::StateNames stateNames(const RunState& run) { return {run.phases.lasting(), run.phases.materials()}; }

/// Writes everything except the values of variables.
void writeHeader(output::Hdf5File& file, const RunState& run, const CheckpointTarget& target) {
  file.attribute("/", "format", format);
  file.attribute("/", "step", run.time.step());
  file.attribute("/", "time", run.time.time());
  file.attribute("/", "delT", run.time.delT());
  file.attribute("/", "dropped", static_cast<std::uint64_t>(target.lost.left));
  file.text("/removed", std::to_string(target.lost.removed));
  file.attribute("/", "version", std::string(TUSHAR_VERSION));
  file.attribute("/", "component", run.problem.componentName);
  writeGrid(file, collect::gridInfo(run.problem.grid->level()));
  output::writeInside(file, collect::gridInfo(run.problem.grid->level()));
  writeTree(file, *run.problem.grid);
  file.text("/scene", run.problem.inputXml);
  file.text("/archive/index", padded(target.point.index));
  file.text("/archive/xdmf", "");  // which older versions look for
  for (std::size_t k = 0; k < run.totalsAtStart.size(); ++k) {
    const ConservedTotal& of = run.phases.totals()[k];
    const std::vector<double>& total = run.totalsAtStart[k];
    file.dataset("/totals/" + of.name(), {of.name(), "", of.label, 1, total}, {total.size()});
  }
  for (std::size_t k = 0; k < run.reportedSoFar.size(); ++k) {
    const Reported& of = run.phases.reported()[k];
    const ReportedSoFar& soFar = run.reportedSoFar[k];
    if (of.isOfSteps() && soFar.isKnown && !soFar.value.empty())
      file.dataset("/reported/" + of.key, {of.key, of.unit, of.text, 1, soFar.value}, {soFar.value.size()});
  }
}

}  // namespace

std::vector<output::FilePart> writeCheckpoint(RunState& run, const CheckpointTarget& target) {
  const collect::StoredState state(run.warehouse, stateNames(run));
  const std::vector<output::ByteRange> places = output::writeTogether(
      run.writers, target.path, {.describes = false}, [&](output::Hdf5File& file) { writeHeader(file, run, target); },
      state.datasets());
  std::vector<output::FilePart> parts;
  for (const output::ByteRange& place : places) parts.push_back({target.path.filename().string(), place});
  return parts;
}

namespace {

/// The numbers of lost particles. Checkpoints of older versions do not contain removed particles.
tasks::LostParticles lostIn(const output::Hdf5Input& file) {
  return {.left = static_cast<long>(file.count("/", "dropped")),
          .removed = file.has("/removed") ? std::stol(file.text("/removed")) : 0};
}

/// Reads the numbers of the report. Checkpoints of older versions do not contain them, nor do those made before the
/// first step.
void readReported(const output::Hdf5Input& file, RunState& run) {
  for (std::size_t k = 0; k < run.reportedSoFar.size(); ++k) {
    const Reported& of = run.phases.reported()[k];
    if (!of.isOfSteps()) continue;
    ReportedSoFar& soFar = run.reportedSoFar[k];
    const bool isStored = file.has("/reported/" + of.key);
    soFar.isKnown = isStored || run.problem.restart->step == 0;
    if (isStored) soFar.value = std::get<std::vector<double>>(file.dataset("/reported/" + of.key));
  }
}

}  // namespace

void readCheckpoint(RunState& run) {
  const output::Hdf5Input file(run.problem.restart->state());
  checkScene(file, run.problem);
  readTree(file, run);
  output::CheckedParts checks(run.problem.restart->state().parent_path(), run.problem.restart->parts, run.ranks);
  collect::readState(file, run.warehouse, stateNames(run), run.phases.neededAtRestart(), checks);
  run.time.resume(file.integer("/", "step"), file.real("/", "time"), file.real("/", "delT"));
  tasks::LostParticles lost = lostIn(file);
  if (!run.ranks.isFirst()) lost.left = 0;
  run.scheduler.relocation().setLost(lost);
  for (const ConservedTotal& total : run.phases.totals()) {
    const std::string path = "/totals/" + total.name();  // absent if the version that wrote the file did not measure it
    run.totalsAtStart.push_back(file.has(path) ? std::get<std::vector<double>>(file.dataset(path))
                                               : std::vector<double>());
  }
  readReported(file, run);
}

output::ArchivePoint archivePointOf(const RunState& run) {
  const output::Hdf5Input file(run.problem.restart->state());
  return {run.time.step(), run.time.time(), file.text("/archive/index")};
}

}  // namespace tushar::simulation
