#include "core/simulation/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "core/base/memory.hpp"
#include "core/base/mpi_together.hpp"
#include "core/base/trace.hpp"
#include "core/output/archive_files.hpp"
#include "core/output/checkpoint_store.hpp"
#include "core/simulation/checkpoint_file.hpp"
#include "core/simulation/snapshot_of.hpp"

namespace tushar::simulation {

namespace {

output::ArchiveOptions howOf(const ArchiveSettings& settings) {
  return {settings.doubleAsFloat, settings.compression, TUSHAR_VERSION};
}

}  // namespace

Outputs::Outputs(RunState& run, std::filesystem::path parent)
    : run_(run),
      meeting_(run.ranks.split(0)),
      parent_(std::move(parent)),
      times_(run.problem.time.initTime, run.problem.archive.outputInterval),
      saves_(!run.phases.savedFields().empty() || !run.phases.savedGlobals().empty() || samples()) {}

Outputs::~Outputs() {
  constexpr std::chrono::milliseconds patience(2000);
  if (!on_its_way_) return;
  try {
    const bool isAlone = run_.writers.count() == 1;
    if (!isAlone && mpi::meet(meeting_, patience))
      finish(run_.files);
    else if (run_.ranks.isFirst())
      isAlone ? finish(mpi::Communicator::alone()) : on_its_way_->file.abandon();
  } catch (const std::runtime_error&) {
    on_its_way_.reset();  // something else has ended the run, and is reported
  }
}

void Outputs::lockArchive() {
  run_.ranks.onFirst([&] { lock_.emplace(run_.problem.restart->archive); });
}

void Outputs::open() {
  const ArchiveSettings& settings = run_.problem.archive;
  const bool goesOn = run_.problem.restart.has_value();
  if (!goesOn && !saves_ && !settings.checkpoint) return;
  const output::ArchiveOptions how = howOf(settings);
  run_.ranks.onFirst([&] { goesOn ? reopenArchive(how) : makeArchive(how); });
  folder_ = run_.ranks.broadcast(archive_ ? archive_->folder().string() : "");
  last_ = run_.ranks.broadcast(archive_ ? archive_->lastStep() : -1);
  if (archive_) run_.clock.watch(archive_->folder());
  std::error_code unseen;  // it may be on a disk of rank 0's node
  run_.writers = run_.writers.only(std::filesystem::exists(folder_, unseen));
}

void Outputs::makeArchive(const output::ArchiveOptions& how) {
  const Problem& problem = run_.problem;
  archive_ = std::make_unique<output::Archive>(parent_ / problem.archive.filebase, problem.inputXml, how);
  lock_.emplace(archive_->folder());
}

void Outputs::reopenArchive(const output::ArchiveOptions& how) {
  const Problem& problem = run_.problem;
  const Restart& restart = *problem.restart;
  const output::ArchivePoint from = archivePointOf(run_);
  output::CheckpointStore(restart.archive, 1).goBackTo(restart.step);
  archive_ = std::make_unique<output::Archive>(restart.archive, problem.archive.filebase, from, problem.inputXml, how);
  for (const std::string& damage : archive_->damages())
    if (warn_) warn_(damage);
  run_.progress.line(fmt::format("step {:>6}  t = {:<12.6g} continues in {}", run_.time.step(), run_.time.time(),
                                 archive_->folder().string()));
}

void Outputs::saveStart() {
  saveGlobals();
  if (run_.problem.archive.outputInitTimestep) save();
}

void Outputs::saveGlobals() {
  if (folder_.empty()) return;
  run_.setTimeOfAnalyses();
  std::vector<Analysis*> due;
  for (const auto& analysis : run_.problem.analyses)
    if (analysis->isSampleDue(run_.time.step())) due.push_back(analysis.get());
  if (due.empty() && run_.phases.savedGlobals().empty()) return;
  run_.scheduler.run(run_.phases.everyStep, {run_.time.step(), run_.time.time()});
  for (Analysis* analysis : due) sample(*analysis);
  const auto started = Clock::now();
  onArchive([this](output::Archive& archive) { appendGlobals(archive); });
  seconds_ += secondsSince(started);
}

void Outputs::onArchive(const std::function<void(output::Archive&)>& action) {
  if (!archive_ || failure_) return;
  try {
    action(*archive_);
  } catch (...) {
    failure_ = std::current_exception();
    run_.clock.noteFailure();
  }
}

void Outputs::throwIfFailed() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (run_.clock.hasFailed()) throw mpi::FailedElsewhere();
}

void Outputs::appendGlobals(output::Archive& archive) const {
  for (const std::string& name : run_.phases.savedGlobals()) {
    const data::Label& label = *run_.table[run_.table.find(name, -1)].label;
    const std::vector<double> values = run_.reduction(name);
    if (values.empty()) continue;  // of a step: there has been none yet
    archive.appendGlobal({name, std::string(label.unit), std::string(label.description), run_.time.time(), values});
  }
}

bool Outputs::samples() const {
  const auto& analyses = run_.problem.analyses;
  return std::any_of(analyses.begin(), analyses.end(),
                     [](const auto& analysis) { return !analysis->samples().empty(); });
}

void Outputs::sample(Analysis& analysis) {
  const auto started = Clock::now();
  const std::vector<output::Snapshot> parts = partsOf(run_, analysis);
  run_.ranks.onFirst([&] { analysis.sample(parts, folder_); });
  seconds_ += secondsSince(started);
}

bool Outputs::isDue() const {
  const int every = run_.problem.archive.outputTimestepInterval;
  return (every > 0 && run_.time.step() % every == 0) || times_.isReached(run_.time.time());
}

void Outputs::saveIfDue() {
  const bool due = isDue();
  passMilestones();
  if (due) save();
  finishIfWritten();
  if (!on_its_way_) onArchive([](output::Archive& archive) { archive.keepUp(); });
}

void Outputs::save() {
  if (!saves_ || last_ == run_.time.step()) return;
  run_.diagnose(run_.phases.everyOutput);
  const auto started = Clock::now();
  const trace::Span span(trace::Kind::output, "save");
  const PeakGrowth growth(memory_);
  if (on_its_way_) finish(run_.ranks);
  output::Snapshot state = snapshotOf(run_, run_.phases.savedFields());
  for (const auto& analysis : run_.problem.analyses)
    for (output::Array& column : analysis->exactProfile(run_.problem.grid->finest()))
      state.reference.push_back(std::move(column));
  behind_.setMost(mostBehind(bytesInFlight(state)));
  const std::filesystem::path file = std::filesystem::path(folder_) / output::outputName(run_.time.step());
  output::SnapshotInFlight inFlight(file, state, howOf(run_.problem.archive), run_.writers, behind_);
  on_its_way_.emplace(OnItsWay{std::move(inFlight), output::withoutValues(std::move(state))});
  if (behind_.most() == 0) finish(run_.ranks);
  last_ = run_.time.step();
  seconds_ += secondsSince(started);
}

/// Largest size of outputs in progress on a writer: the average share of a rank, or an amount that is small compared
/// with a state. 0 for a small output, because waking a thread would take as long as writing it.
std::size_t Outputs::mostBehind(std::uint64_t bytes) const {
  constexpr std::uint64_t small = std::uint64_t{1} << 20, little = std::uint64_t{16} << 20;
  if (bytes <= small) return 0;
  return run_.mostBehind.value_or(std::max(little, bytes / static_cast<std::uint64_t>(run_.ranks.size())));
}

void Outputs::finish(const mpi::Communicator& ranks) {
  OnItsWay output = std::move(*std::exchange(on_its_way_, std::nullopt));
  output.file.finish(ranks);
  packing_ += output.file.packing();
  onArchive([&](output::Archive& archive) { archive.list(output.listed); });
  run_.progress.line(fmt::format("step {:>6}  t = {:<12.6g} dt = {:<10.4g} saved in {}", output.listed.step,
                                 output.listed.time, output.listed.delT, folder_));
}

void Outputs::finishIfWritten() {
  if (on_its_way_ && !run_.ranks.any(!behind_.isDone())) finishOutput();
}

void Outputs::finishOutput() {
  if (!on_its_way_) return;
  const auto started = Clock::now();
  finish(run_.ranks);
  seconds_ += secondsSince(started);
}

void Outputs::flush() {
  finishOutput();
  run_.ranks.onFirst([this] {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    if (!archive_) return;
    flushAnalyses();
    archive_->flush();
  });
}

void Outputs::flushAnalyses() {
  for (const auto& analysis : run_.problem.analyses) analysis->flush();
}

output::ArchivePoint Outputs::sync(bool waitsForDisk) {
  flushAnalyses();
  if (waitsForDisk) archive_->sync();
  return archive_->pointAt(run_.time.step(), run_.time.time());
}

}  // namespace tushar::simulation
