#include "core/simulation/checkpoints.hpp"

#include <fmt/format.h>

#include "core/base/memory.hpp"
#include "core/base/trace.hpp"
#include "core/output/checkpoint_store.hpp"
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
  last_ = run_.time.step();
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
  run_.ranks.onFirst([&] { point = outputs_.sync(); });
  const int cycle = run_.problem.archive.checkpoint.value_or(CheckpointSettings{}).cycle;
  output::CheckpointStore(outputs_.folder(), cycle, run_.writers)
      .write(run_.time.step(), [&](const std::filesystem::path& folder) {
        return writeCheckpoint(run_, {folder / stateFile, point, lost});
      });
  run_.clock.agree(run_.ranks);
  last_ = run_.time.step();
  if (control_) control_->note(run_.time.time(), run_.clock.elapsed());
  seconds_ += secondsSince(started);
}

}  // namespace tushar::simulation
