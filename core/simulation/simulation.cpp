#include "core/simulation/simulation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/collect/gather.hpp"
#include "core/report/error_norms.hpp"
#include "core/simulation/between_materials.hpp"
#include "core/simulation/kept_reductions.hpp"
#include "core/solvers/solver.hpp"
#include "core/tasks/between_materials.hpp"

namespace tushar::simulation {

namespace {

std::string hostName() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

/// Advice to the user: names settings that are missing in the scene and would keep particles in the finest cells.
std::string adviceNearCoarser(const RegridSettings& regrid) {
  if (!regrid.adaptive)
    return "<adaptive>true</adaptive> in <AMR>, so that the finest cells follow; or a larger <Level>";
  if (regrid.once) return "no <regrid_once> in <AMR>, so that the finest cells follow";
  return "a smaller <min_timestep_interval> in <AMR>, so that the finest cells follow in time";
}

/// The tasks of the next step: after a particle has been removed, the careful ones, if the component has them.
tasks::TaskGraph& graphOfStep(RunState& run) {
  const bool isCareful = run.scheduler.relocation().lost().removed > 0 && !run.phases.carefulAdvance.tasks().empty();
  return isCareful ? run.phases.carefulAdvance : run.phases.timeAdvance;
}

/// Whether steps make particles where there are none: a task that makes particles at a rate reads the length of the
/// step, but one that only divides or merges particles does not.
bool makesParticles(const tasks::TaskGraph& step) {
  return std::any_of(step.tasks().begin(), step.tasks().end(), [](const tasks::CompiledTask& compiled) {
    const auto& accesses = compiled.task.accesses;
    return compiled.task.kind == tasks::TaskKind::newParticles &&
           std::any_of(accesses.begin(), accesses.end(),
                       [](const tasks::Access& access) { return access.label->name == data::delT.name; });
  });
}

/// Throws NumericalError, on all ranks, if so many particles were removed that the result no longer represents the
/// scene.
void refuseLosses(RunState& run) {
  constexpr double most = 0.01;
  const long removed = run.scheduler.relocation().lost().removed;
  const long all = removed + collect::particleCount(run.warehouse, run.materials());
  if (static_cast<double>(removed) > most * static_cast<double>(all))
    throw NumericalError(
        fmt::format("{} of {} were removed, more than {:g} %: steps turned them inside out, deformed them too much, or "
                    "threw them through a symmetry plane",
                    removed, counted(all, "particle"), 100 * most),
        "");
}

}  // namespace

Simulation::Simulation(Problem problem, const RunOptions& options, Clock::time_point startedAt)
    : Simulation(std::move(problem), options, startedAt, mpi::Communicator::alone()) {}

Simulation::Simulation(Problem problem, const RunOptions& options, Clock::time_point startedAt,
                       const mpi::Communicator& ranks)
    : run_(std::move(problem), options, startedAt, ranks),
      outputs_(run_, options.outputFolder),
      checkpoints_(run_, outputs_),
      patch_cutter_(run_),
      rebalancer_(run_),
      regridder_(run_),
      report_(run_) {
  if (run_.problem.smallerSteps) level_steps_.emplace(run_);
  if (!run_.phases.nextMaterials.tasks().empty()) run_.scheduler.skipAbsentMaterials();
  run_.scheduler.relocation().setAdviceNearCoarser(adviceNearCoarser(run_.problem.regrid));
}

long Simulation::tryStart() {
  run_.problem.restart ? resume() : initialize();
  return collect::particleCount(run_.warehouse, run_.materials());
}

report::Report Simulation::run() {
  begin();
  outputs_.open();
  openLog();
  if (!run_.problem.restart) {
    outputs_.saveStart();
    checkpoints_.writeFirst();
  }
  report_.noteStartUp(outputSeconds());
  run_.clock.agree(run_.ranks);
  outputs_.throwIfFailed();
  loop();
  saveEnd();
  report::Report report = makeReport();
  if (log_ && solvers::isLoaded()) log_->addLibrary("PETSc", solvers::petscVersion());
  if (log_) log_->end(report.ended, report.steps, static_cast<int>(exitCodeOf(report)));
  return report;
}

void Simulation::openLog() {
  for (const std::string& host : run_.ranks.gather(hostName()))
    if (std::find(record_.hosts.begin(), record_.hosts.end(), host) == record_.hosts.end())
      record_.hosts.push_back(host);
  if (outputs_.folder().empty()) return;
  record_.ranks = run_.ranks.size();
  record_.threads = run_.scheduler.threads().count();
  record_.restarts = run_.problem.restart.has_value();
  record_.step = run_.time.step();
  run_.ranks.onFirst([&] { log_.emplace(outputs_.folder(), record_); });
}

/// Saves the state at the end. The checkpoint comes first, because a restart needs it, and `mpirun` gives an
/// interrupted run only two seconds.
void Simulation::saveEnd() {
  const bool isCut = run_.clock.isInterrupted() || run_.clock.isStopped();
  if (failure_) saveLastGood();
  if (isCut && !outputs_.folder().empty()) checkpoints_.write();
  if (isCut || run_.problem.archive.outputLastTimestep) outputs_.save();
  run_.progress.finish();
  outputs_.flush();
  checkpoints_.writeLast();
}

void Simulation::saveNow() {
  if (outputs_.folder().empty())
    return run_.progress.line("nothing is saved: the scene has no outputs, saved totals or checkpoints");
  outputs_.save();
  checkpoints_.write();
  checkpoints_.settle();
  run_.progress.line(fmt::format("step {:>6}  t = {:<12.6g} saved on request; sus --restart {} continues from here",
                                 run_.time.step(), run_.time.time(), outputs_.folder()));
}

void Simulation::begin() {
  if (run_.problem.restart) {
    outputs_.lockArchive();
    resume();
    return distributeAtStart();
  }
  initialize();
  distributeAtStart();
  run_.totalsAtStart = run_.measureTotals(run_.phases.startTotals);
}

void Simulation::distributeAtStart() {
  patch_cutter_.cutAtStart();
  if (patch_cutter_.times() == 0) rebalancer_.balanceAtStart();  // cuts come with shares of their own
}

void Simulation::resume() {
  checkpoints_.resume();
  beginSums();
  outputs_.passMilestones();
  run_.setTimeOfAnalyses();  // the earlier run has taken the samples that were due up to now
}

/// Initialises the state on successively finer cells, as far as the state requires them: finer cells resolve more of
/// the initial state.
void Simulation::initialize() {
  do {
    initializeOnce();
  } while (regridder_.refinedStart());
  refuseCoarseParticles();
  beginSums();
  run_.warehouse.releaseFreeMemory();  // what particles are made with is not what steps need
  bool hasParticles = false;
  for (int m = 0; m < run_.materials(); ++m) hasParticles = hasParticles || run_.table.find(data::positionName, m) >= 0;
  if (hasParticles && !makesParticles(run_.phases.timeAdvance) &&
      collect::particleCount(run_.warehouse, run_.materials()) == 0)
    throw InputError({{{run_.problem.scenePath, 0, 0},
                       "MaterialProperties",
                       "there are no particles: no geom_object overlaps the grid"}});
}

void Simulation::refuseCoarseParticles() {
  const grid::Grid& grid = *run_.problem.grid;
  std::string outside;
  for (std::size_t m = 0; m < run_.phases.materials().size(); ++m) {
    const int reach = run_.table.reach(static_cast<int>(m)) + 1;
    bool isOutside = false;
    for (const grid::Patch& patch : grid.patches()) {
      const data::ParticleSet& set = run_.warehouse.particles(data::Generation::old, static_cast<int>(m), patch.id());
      if (grid.levels() == 1 || set.owned() == 0) continue;
      grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
        const grid::Box around = grid::Box{cell, cell + Index3::filled(1)}.grown(reach, grid.dimension());
        if (!set.in(cell).empty() && !isOutside) isOutside = !grid.isFinest(patch) || !grid.isFinest(around);
      });
    }
    if (run_.ranks.any(isOutside)) outside += (outside.empty() ? "" : ", ") + run_.phases.materials()[m];
  }
  if (!outside.empty())
    throw InputError({{run_.problem.regrid.where, "",
                       fmt::format("particles of {} are in coarser cells, or too close to them; particles must be on "
                                   "the finest level: give a larger <Level>, or <adaptive> in <AMR>",
                                   outside)}});
}

void Simulation::initializeOnce() {
  Phases& phases = run_.phases;
  try {
    run_.scheduler.run(phases.initialize, {0, run_.time.time()});
  } catch (const NumericalError& error) {
    throw advised(error);
  }
  run_.scheduler.commit(phases.initialize);
}

void Simulation::loop() {
  report_.beginLoop(outputSeconds());
  run_.progress.begin(run_.time.fractionDone());
  try {
    while (!hasEnded()) step();
  } catch (const NumericalError& error) {
    failure_ = advised(error);
  }
  report_.endLoop(outputSeconds());
}

void Simulation::step() {
  TimeControl& time = run_.time;
  const long removed = run_.scheduler.relocation().lost().removed;
  advance();
  addToSums();
  level_steps_ ? report_.noteStep(level_steps_->steps()) : report_.noteStep();
  if (run_.progress.due()) run_.progress.live(time.step(), time.time(), time.delT(), time.fractionDone());
  regridder_.regridIfDue();
  patch_cutter_.cutIfDue();
  rebalancer_.balanceIfDue();
  outputs_.saveGlobals();
  outputs_.saveIfDue();
  run_.clock.agree(run_.ranks);
  outputs_.throwIfFailed();
  if (run_.clock.takeSaveRequest()) saveNow();
  if (!hasEnded() && checkpoints_.isDue()) checkpoints_.write();
  if (run_.scheduler.relocation().lost().removed == removed) return;
  refuseLosses(run_);
  if (removed == 0 && !run_.phases.carefulAdvance.tasks().empty())
    run_.progress.line(fmt::format("step {:>6}  t = {:<12.6g} particles were removed; from now on, {}", time.step(),
                                   time.time(), run_.phases.aboutCarefulSteps()));
}

void Simulation::advance() {
  TimeControl& time = run_.time;
  tasks::TaskGraph& graph = graphOfStep(run_);
  run_.warehouse.beginStep();
  const data::Minimum stable = stableStep();
  auto& dt = run_.warehouse.reduction<data::Minimum>(run_.delT);
  dt = {time.next(stable, outputs_.nextTime()), stable.reason};
  const KeptReductions before(run_.warehouse, graph.reductions());
  try {
    while (const auto asked = tryStep(dt.value)) dt.value = time.repeat(*asked);
  } catch (const NumericalError&) {
    before.restore();
    throw;
  }
  if (!level_steps_) run_.scheduler.commit(graph);
  time.advance();
  moveBetweenMaterials();
}

/// Moves particles that have separated from others, or met them, to other materials.
void Simulation::moveBetweenMaterials() {
  tasks::TaskGraph& graph = run_.phases.nextMaterials;
  if (graph.tasks().empty()) return;
  run_.scheduler.run(graph, {run_.time.step(), run_.time.time()});
  tasks::moveBetweenMaterials(run_.warehouse, run_.materials(), nextMaterial.name, run_.phases.lasting());
}

void Simulation::beginSums() {
  using data::Generation;
  for (const int number : run_.phases.afterStep.results()) {
    if (run_.warehouse.isHeld(Generation::old, number)) continue;
    run_.warehouse.allocateGrid(Generation::old, number);
    for (const grid::Patch& patch : run_.problem.grid->patches()) {
      const data::Variable variable = run_.warehouse.variable(Generation::old, number, patch.id());
      std::memset(variable.values, 0, variable.stored.size() * run_.table[number].label->bytes);
    }
  }
}

void Simulation::addToSums() {
  const auto isDue = [&](const auto& analysis) { return analysis->isDueAfterStep(run_.time.time()); };
  const auto& analyses = run_.problem.analyses;
  if (run_.phases.afterStep.tasks().empty() || std::none_of(analyses.begin(), analyses.end(), isDue)) return;
  run_.scheduler.run(run_.phases.afterStep, {run_.time.step(), run_.time.time()});
  run_.scheduler.commit(run_.phases.afterStep);
}

data::Minimum Simulation::stableStep() {
  if (level_steps_) return level_steps_->stable();
  run_.warehouse.resetReduction(run_.delT);
  run_.scheduler.run(run_.phases.stableTimeStep, {run_.time.step() + 1, run_.time.time()});
  return run_.warehouse.reduction<data::Minimum>(run_.delT);
}

std::optional<data::Minimum> Simulation::tryStep(double dt) {
  TimeControl& time = run_.time;
  const tasks::StepInfo at{time.step() + 1, time.time(), dt, time.repeats(), time.mayHalve()};
  return level_steps_ ? level_steps_->advance(at) : run_.scheduler.run(graphOfStep(run_), at);
}

bool Simulation::hasEnded() const {
  return run_.time.done() || run_.clock.isInterrupted() || run_.clock.isStopped() ||
         run_.clock.elapsed() > run_.problem.time.maxWallTime;
}

std::string Simulation::whyEnded() const {
  if (failure_) return "failed";
  if (run_.clock.isInterrupted()) return "interrupted";
  if (run_.time.time() >= run_.problem.time.maxTime) return "maxTime";
  if (run_.clock.isStopped()) return "stop_now";
  return run_.time.done() ? "max_Timesteps" : "max_wall_time";
}

NumericalError Simulation::advised(const NumericalError& error) const {
  if (!error.advice().empty()) return error;
  const bool repeats = run_.problem.time.recomputeTimeStep || run_.time.delT() == 0;
  return {error.what(), run_.problem.component->advice() + (repeats ? "" : "; or recompute_timestep in <Time>"),
          error.value()};
}

void Simulation::saveLastGood() {
  if (outputs_.folder().empty()) return;
  outputs_.save();
  checkpoints_.write();
  failure_ = NumericalError(fmt::format("{}; the last complete step, {} at t = {:.6g} s, is saved: sus --restart {}",
                                        failure_->what(), run_.time.step(), run_.time.time(), outputs_.folder()),
                            failure_->advice(), failure_->value());
}

report::Report Simulation::makeReport() {
  report::Report report = report_.make(outputs_.memory() + checkpoints_.memory());
  if (!failure_)
    if (const auto sentence = report::unmeasurable(report.errors)) failure_ = advised(NumericalError(*sentence, ""));
  report.ended = whyEnded();
  if (failure_) {
    report.failure = failure_->what();
    report.advice = failure_->advice();
  }
  report.rebalancing = rebalancer_.report();
  report.recuts = patch_cutter_.times();
  report.regrids = regridder_.regrids();
  report.wallRegrid = regridder_.seconds();
  report.wallOutput = outputSeconds();
  report.wallOutputWait = run_.ranks.max(outputs_.waited());
  const output::PackingUse& packing = outputs_.packing();
  std::array<double, 4> sums{packing.bytes, packing.packed, packing.packing, packing.writing};
  run_.ranks.sum(sums);
  report.compression = {sums[0], sums[1], sums[2], sums[3]};
  report.archive = outputs_.folder();
  report.unusedOptions = solvers::unusedOptions();
  return report;
}

ExitCode exitCodeOf(const report::Report& report) {
  if (!report.failure.empty()) return ExitCode::numerical;
  return report.ended == "interrupted" ? ExitCode::interrupted : ExitCode::success;
}

}  // namespace tushar::simulation
