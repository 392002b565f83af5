#include "core/simulation/checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/base/memory.hpp"
#include "core/base/trace.hpp"
#include "core/simulation/checkpoint_file.hpp"

namespace tushar::simulation {

Checkpoints::Checkpoints(RunState& run, Outputs& outputs) : run_(run), outputs_(outputs) {
  if (const auto& asked = run.problem.archive.checkpoint) control_.emplace(*asked, run.problem.time.initTime);
}

bool Checkpoints::read() {
  Restart& restart = *run_.problem.restart;
  try {
    readCheckpoint(run_);
    return true;
  } catch (const output::DamageError& error) {
    noteDamage(restart, error.what());
  }
  const std::size_t before = restart.notes.size() - 1;
  if (!takeNext(restart, run_.ranks)) refuseDamaged(restart, run_.ranks);
  run_.ranks.onFirst([&] {
    for (std::size_t k = before; warn_ && k < restart.notes.size(); ++k) warn_(restart.notes[k]);
    if (warn_) warn_(continuesFrom(restart));
  });
  run_.warehouse.startAnew(run_.materials());
  run_.scheduler.forgetLayout();
  return false;
}

void Checkpoints::resume() {
  while (!read()) {
  }
  run_.clock.agree(run_.ranks);
  if (control_) control_->note(run_.time.time(), run_.clock.elapsed());
  last_ = on_disk_ = run_.time.step();
}

bool Checkpoints::isDue() const {
  return control_ && control_->isDue(run_.time.step(), run_.time.time(), run_.clock.elapsed());
}

void Checkpoints::writeFirst() {
  if (control_) write();
}

void Checkpoints::writeLast() {
  const bool isCutShort = !run_.time.done();
  if (outputs_.folder().empty() || !(control_ || isCutShort)) return;
  write();
  settle();
  if (isCutShort)
    run_.progress.line(fmt::format("step {:>6}  t = {:<12.6g} sus --restart {} continues from here", run_.time.step(),
                                   run_.time.time(), outputs_.folder()));
}

void Checkpoints::write() {
  if (last_ == run_.time.step()) return;
  outputs_.finishOutput();
  const auto started = Clock::now();
  const trace::Span span(trace::Kind::output, "checkpoint");
  const PeakGrowth growth(memory_);
  const tasks::LostParticles lost = run_.lostParticles();
  output::ArchivePoint point;
  const bool waitsForDisk = run_.ranks.broadcast(started >= next_wait_ ? 1 : 0) == 1;
  run_.ranks.onFirst([&] { point = outputs_.sync(waitsForDisk); });
  const auto fill = [&](const std::filesystem::path& folder) {
    return writeCheckpoint(run_, {folder / stateFile, point, lost});
  };
  store().write(run_.time.step(), fill, {.waitsForDisk = waitsForDisk, .lastOnDisk = on_disk_});
  run_.clock.agree(run_.ranks);
  last_ = run_.time.step();
  if (waitsForDisk) noteOnDisk(started);
  if (control_) control_->note(run_.time.time(), run_.clock.elapsed());
  seconds_ += secondsSince(started);
}

output::CheckpointStore Checkpoints::store() const {
  const int cycle = run_.problem.archive.checkpoint.value_or(CheckpointSettings{}).cycle;
  return output::CheckpointStore(outputs_.folder(), cycle, run_.writers);
}

void Checkpoints::settle() {
  if (last_ == on_disk_) return;
  const auto started = Clock::now();
  run_.ranks.onFirst([&] { outputs_.sync(true); });
  store().bringToDisk(last_);
  noteOnDisk(started);
  seconds_ += secondsSince(started);
}

void Checkpoints::noteOnDisk(Clock::time_point started) {
  constexpr std::chrono::seconds least(1), most(30);
  const auto now = Clock::now();
  on_disk_ = last_;
  next_wait_ = now + std::clamp<Clock::duration>(5 * (now - started), least, most);
}

}  // namespace tushar::simulation
