#include <fmt/format.h>

#include "core/base/interrupt.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/gather.hpp"
#include "core/simulation/simulation.hpp"

// How a run writes checkpoints, and goes on from one.
//
//     /                  attributes format, step, time, delT, dropped, version, component
//     /grid              attributes lower, spacing, cells, dimension
//     /scene             the scene with its overrides
//     /archive/index, xdmf    what index.xml and the XDMF file of the archive said
//     /totals/<name>     mass, momentum and energy at the very start, for the drift of the report
//     and the state: see stored_state.hpp

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

bool isSameGrid(const output::Hdf5Input& file, const output::GridInfo& grid) {
  return file.vector("/grid", "lower") == grid.lower && file.vector("/grid", "spacing") == grid.spacing &&
         file.index("/grid", "cells") == grid.cells && file.integer("/grid", "dimension") == grid.dimension;
}

}  // namespace

output::CheckpointStore Simulation::checkpointStore() const {
  return output::CheckpointStore(archive_->folder(), problem_.archive.checkpoint.value_or(CheckpointSettings{}).cycle);
}

StateNames Simulation::stateNames() const { return {phases_.lasting(), phases_.materials()}; }

void Simulation::checkpointIfDue() {
  if (checkpoints_ && !hasEnded() && checkpoints_->isDue(time_.step(), time_.time(), elapsed_)) checkpoint();
}

void Simulation::checkpointAtEnd() {
  const bool isCutShort = !time_.done();
  if (folder_.empty() || !(checkpoints_ || isCutShort)) return;
  checkpoint();
  if (isCutShort)
    progress_.line(fmt::format("step {:>6}  t = {:<12.6g} sus -restart {} goes on from here", time_.step(),
                               time_.time(), folder_));
}

void Simulation::checkpoint() {
  if (last_checkpoint_ == time_.step()) return;
  const auto started = Clock::now();
  const trace::Span span(trace::Kind::output, "checkpoint");
  const long dropped = ranks_->sum(scheduler_.relocation().dropped());
  if (archive_) {
    const output::ArchivePoint point = archive_->sync(time_.step(), time_.time());
    checkpointStore().write(time_.step(), [&](const std::filesystem::path& folder) {
      writeCheckpoint(folder / stateFile, point, dropped);
    });
  } else {
    writeState(nullptr, warehouse_, stateNames());
  }
  agreeOnClock();
  last_checkpoint_ = time_.step();
  if (checkpoints_) checkpoints_->note(time_.time(), elapsed_);
  wall_output_ += since(started);
}

void Simulation::writeCheckpoint(const std::filesystem::path& path, const output::ArchivePoint& point, long dropped) {
  output::Hdf5File file(path, false, 0);
  file.attribute("/", "format", format);
  file.attribute("/", "step", time_.step());
  file.attribute("/", "time", time_.time());
  file.attribute("/", "delT", time_.delT());
  file.attribute("/", "dropped", static_cast<std::uint64_t>(dropped));
  file.attribute("/", "version", std::string(TUSHAR_VERSION));
  file.attribute("/", "component", problem_.componentName);
  writeGrid(file, gridInfo(*problem_.level));
  file.text("/scene", problem_.inputXml);
  file.text("/archive/index", point.index);
  file.text("/archive/xdmf", point.xdmf);
  for (std::size_t k = 0; k < totals_at_start_.size(); ++k) {
    const auto& [name, label] = phases_.totals()[k];
    file.dataset("/totals/" + name, {name, "", label, 1, totals_at_start_[k]}, {totals_at_start_[k].size()});
  }
  writeState(&file, warehouse_, stateNames());
  file.close();
}

void Simulation::checkScene(const output::Hdf5Input& file) const {
  if (const int found = file.integer("/", "format"); found != format)
    refuse(file, fmt::format("the checkpoint has format {}, and this sus reads format {}; it was written by version {}",
                             found, format, file.text("/", "version")));
  if (const int found = file.integer("/", "step"); found != problem_.restart->step)
    refuse(file,
           fmt::format("the checkpoint is of step {}; give its folder the name {}", found, output::stepName(found)));
  if (const std::string found = file.text("/", "component"); found != problem_.componentName)
    refuse(file,
           fmt::format("the checkpoint is of component '{}', and the scene has '{}'", found, problem_.componentName));
  if (!isSameGrid(file, gridInfo(*problem_.level)))
    refuse(file, "the checkpoint has another grid than the scene; patches may change, cells may not");
}

void Simulation::resume() {
  const output::Hdf5Input file(problem_.restart->state());
  checkScene(file);
  readState(file, warehouse_, stateNames(), phases_.state());
  time_.resume(file.integer("/", "step"), file.real("/", "time"), file.real("/", "delT"));
  outputs_.pass(time_.time());
  agreeOnClock();
  if (checkpoints_) checkpoints_->note(time_.time(), elapsed_);
  if (ranks_->isFirst()) scheduler_.relocation().setDropped(static_cast<long>(file.count("/", "dropped")));
  for (const auto& total : phases_.totals())
    totals_at_start_.push_back(std::get<std::vector<double>>(file.dataset("/totals/" + total.first)));
  last_checkpoint_ = time_.step();
}

void Simulation::reopenArchive(const output::ArchiveOptions& how) {
  const Restart& restart = *problem_.restart;
  const output::Hdf5Input file(restart.state());
  const output::ArchivePoint from{time_.step(), time_.time(), file.text("/archive/index"), file.text("/archive/xdmf")};
  output::CheckpointStore(restart.archive, 1).goBackTo(restart.step);
  archive_ =
      std::make_unique<output::Archive>(restart.archive, problem_.archive.filebase, from, problem_.inputXml, how);
  progress_.line(
      fmt::format("step {:>6}  t = {:<12.6g} goes on in {}", time_.step(), time_.time(), archive_->folder().string()));
}

}  // namespace tushar::simulation
