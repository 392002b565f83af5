#include "core/simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/interrupt.hpp"
#include "core/simulation/error_norms.hpp"
#include "core/simulation/gather.hpp"
#include "core/simulation/kept_reductions.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::simulation {

using data::Generation;

Simulation::Simulation(Problem problem, const RunOptions& options, Clock::time_point startedAt)
    : Simulation(std::move(problem), options, startedAt, mpi::Communicator::alone()) {}

Simulation::Simulation(Problem problem, const RunOptions& options, Clock::time_point startedAt,
                       const mpi::Communicator& ranks)
    : problem_(std::move(problem)),
      options_(options),
      ranks_(&ranks),
      started_at_(startedAt),
      phases_(*problem_.component, problem_.analyses),
      warehouse_(*problem_.level, table_, ranks),
      scheduler_(warehouse_, problem_.threads),
      time_(problem_.time),
      balance_(ranks.size()),
      progress_(options.quiet || !ranks.isFirst(), stdout),
      outputs_(problem_.time.initTime, problem_.archive.outputInterval) {
  if (problem_.archive.checkpoint) checkpoints_.emplace(*problem_.archive.checkpoint, problem_.time.initTime);
  phases_.compile(problem_.analyses, problem_.archive.saves, *problem_.level, table_);
  warehouse_.grow(static_cast<int>(phases_.materials().size()));
}

long Simulation::tryStart() {
  problem_.restart ? resume() : initialize();
  return particleCount(warehouse_, static_cast<int>(phases_.materials().size()));
}

std::vector<double> Simulation::reduction(std::string_view label) const {
  const int number = table_.find(label, -1);
  return number < 0 ? std::vector<double>{} : warehouse_.reductionValues(number);
}

Report Simulation::run() {
  begin();
  openArchive();
  if (!problem_.restart) {
    saveGlobals();
    if (saves_ && problem_.archive.outputInitTimestep) save();
    if (checkpoints_) checkpoint();
  }
  wall_startup_ = since(started_at_) - wall_output_;
  agreeOnClock();
  const auto loopStarted = Clock::now();
  const double outputBefore = wall_output_;
  const Threads::Use useBefore = scheduler_.threads().use();
  try {
    while (!hasEnded()) step();
  } catch (const NumericalError& error) {
    failure_ = advised(error);
  }
  const double output = wall_output_ - outputBefore;
  wall_loop_ = since(loopStarted) - output;
  time_use_ = TimeUse(useBefore, scheduler_.threads(), since(loopStarted), output, *ranks_);
  if (failure_) saveLastGood();
  if (saves_ && (problem_.archive.outputLastTimestep || interrupted_)) save();
  progress_.finish();
  if (archive_) archive_->flush();
  checkpointAtEnd();
  return makeReport();
}

void Simulation::begin() {
  if (problem_.restart) {
    ranks_->onFirst([&] { lock_.emplace(problem_.restart->archive); });
    resume();
    return balanceAtStart();
  }
  initialize();
  balanceAtStart();
  totals_at_start_ = measureTotals(phases_.startTotals);
}

void Simulation::openArchive() {
  saves_ = !phases_.savedFields().empty() || !phases_.savedGlobals().empty() || samples();
  if (!problem_.restart && !saves_ && !checkpoints_) return;
  const ArchiveSettings& settings = problem_.archive;
  const output::ArchiveOptions how{settings.doubleAsFloat, settings.compression, TUSHAR_VERSION};
  ranks_->onFirst([&] { problem_.restart ? reopenArchive(how) : makeArchive(how); });
  folder_ = ranks_->broadcast(archive_ ? archive_->folder().string() : "");
  last_output_ = ranks_->broadcast(archive_ ? archive_->lastStep() : -1);
}

void Simulation::makeArchive(const output::ArchiveOptions& how) {
  const std::filesystem::path folder = options_.outputFolder;
  archive_ = std::make_unique<output::Archive>(folder / problem_.archive.filebase, problem_.inputXml, how);
  lock_.emplace(archive_->folder());
}

NumericalError Simulation::advised(const NumericalError& error) const {
  if (!error.advice().empty()) return error;
  const bool repeats = problem_.time.recomputeTimeStep || time_.delT() == 0;
  return {error.what(), problem_.component->advice() + (repeats ? "" : "; or recompute_timestep in <Time>"),
          error.value()};
}

void Simulation::saveLastGood() {
  if (folder_.empty()) return;
  if (saves_) save();
  checkpoint();
  failure_ = NumericalError(fmt::format("{}; the last whole step, {} at t = {:.6g} s, is saved: sus -restart {}",
                                        failure_->what(), time_.step(), time_.time(), folder_),
                            failure_->advice(), failure_->value());
}

void Simulation::initialize() {
  try {
    scheduler_.run(phases_.initialize, {0, time_.time()});
  } catch (const NumericalError& error) {
    throw advised(error);
  }
  scheduler_.commit(phases_.initialize);
  warehouse_.releaseFreeMemory();  // what particles are made with is not what steps need
  const int materials = static_cast<int>(phases_.materials().size());
  if (materials > 0 && particleCount(warehouse_, materials) == 0)
    throw InputError({{{problem_.scenePath, 0, 0},
                       "MaterialProperties",
                       "there are no particles: no geom_object has a point on the grid"}});
}

void Simulation::step() {
  warehouse_.beginStep();
  const int delT = table_.number(data::delT, -1);
  warehouse_.resetReduction(delT);
  scheduler_.run(phases_.stableTimeStep, {time_.step() + 1, time_.time()});
  auto& dt = warehouse_.reduction<data::Minimum>(delT);
  dt.value = time_.next(dt, outputs_.next());
  const auto tryStep = [&] {
    return scheduler_.run(phases_.timeAdvance,
                          {time_.step() + 1, time_.time(), dt.value, time_.repeats(), time_.mayHalve()});
  };
  const KeptReductions before(warehouse_, phases_.timeAdvance.reductions());
  try {
    while (const auto asked = tryStep()) dt.value = time_.repeat(*asked);
  } catch (const NumericalError&) {
    before.restore();
    throw;
  }
  scheduler_.commit(phases_.timeAdvance);
  time_.advance();
  particle_steps_ += ownParticles();
  if (progress_.due()) progress_.live(time_.step(), time_.time(), time_.delT(), problem_.time.maxTime);
  balanceIfDue();
  saveGlobals();
  saveIfDue();
  agreeOnClock();
  checkpointIfDue();
}

long Simulation::ownParticles() {
  long count = 0;
  for (int material = 0; material < static_cast<int>(phases_.materials().size()); ++material)
    for (const grid::Patch& patch : problem_.level->patches())
      count += warehouse_.particles(Generation::old, material, patch.id()).owned();
  return count;
}

void Simulation::agreeOnClock() {
  double seen[] = {since(started_at_), isInterrupted() ? 1.0 : 0.0};
  ranks_->max(seen);
  elapsed_ = seen[0];
  interrupted_ = seen[1] > 0;
}

bool Simulation::hasEnded() const { return time_.done() || interrupted_ || outOfWallTime(); }

bool Simulation::outOfWallTime() const { return elapsed_ > problem_.time.maxWallTime; }

void Simulation::diagnose(tasks::TaskGraph& graph) {
  for (const auto& analysis : problem_.analyses) analysis->setTime(time_.time(), time_.time() - problem_.time.initTime);
  scheduler_.run(graph, {time_.step(), time_.time()});
}

void Simulation::saveGlobals() {
  if (folder_.empty() || (phases_.savedGlobals().empty() && !samples())) return;
  diagnose(phases_.everyStep);
  for (const auto& analysis : problem_.analyses)
    if (analysis->isSampleDue()) sample(*analysis);
  if (!archive_) return;
  const auto started = Clock::now();
  for (const std::string& name : phases_.savedGlobals()) {
    const data::Label& label = *table_[table_.find(name, -1)].label;
    if (reduction(name).empty()) continue;  // of a step: there has been none yet
    archive_->appendGlobal(
        {name, std::string(label.unit), std::string(label.description), time_.time(), reduction(name)});
  }
  wall_output_ += since(started);
}

bool Simulation::samples() const {
  return std::any_of(problem_.analyses.begin(), problem_.analyses.end(),
                     [](const auto& analysis) { return !analysis->samples().empty(); });
}

void Simulation::sample(Analysis& analysis) {
  const auto started = Clock::now();
  Gather gather(warehouse_);
  output::Snapshot snapshot = positions(gather);
  for (const SaveRequest& request : analysis.samples()) addField(snapshot, request, gather);
  output::load(snapshot);
  ranks_->onFirst([&] { analysis.sample(snapshot, folder_); });
  wall_output_ += since(started);
}

bool Simulation::outputDue() const {
  const int every = problem_.archive.outputTimestepInterval;
  return (every > 0 && time_.step() % every == 0) || outputs_.isReached(time_.time());
}

void Simulation::saveIfDue() {
  const bool due = outputDue();
  outputs_.pass(time_.time());
  if (saves_ && due) save();
}

void Simulation::save() {
  if (last_output_ == time_.step()) return;
  diagnose(phases_.everyOutput);
  const auto started = Clock::now();
  const trace::Span span(trace::Kind::output, "save");
  const output::Snapshot state = snapshot();
  ranks_->onFirst([&] { archive_->write(state); });
  last_output_ = time_.step();
  wall_output_ += since(started);
  progress_.line(fmt::format("step {:>6}  t = {:<12.6g} dt = {:<10.4g} saved in {}", time_.step(), time_.time(),
                             time_.delT(), folder_));
}

output::Snapshot Simulation::positions(Gather& gather) {
  output::Snapshot snapshot;
  snapshot.step = time_.step();
  snapshot.time = time_.time();
  snapshot.delT = time_.delT();
  snapshot.grid = gridInfo(*problem_.level);
  for (std::size_t m = 0; m < phases_.materials().size(); ++m) {
    const int number = table_.find(data::positionName, static_cast<int>(m));
    if (number < 0) continue;
    snapshot.particles.push_back({phases_.materials()[m], static_cast<int>(m), {}});
    snapshot.particles.back().arrays.push_back(gather.stream(Generation::old, number));
  }
  return snapshot;
}

output::Snapshot Simulation::snapshot() {
  Gather gather(warehouse_);
  output::Snapshot snapshot = positions(gather);
  for (const SaveRequest& save : phases_.savedFields()) addField(snapshot, save, gather);
  for (const auto& analysis : problem_.analyses)
    for (output::Array& column : analysis->exactProfile(*problem_.level))
      snapshot.reference.push_back(std::move(column));
  return snapshot;
}

void Simulation::addField(output::Snapshot& snapshot, const SaveRequest& save, Gather& gather) {
  for (int m = -1; m < static_cast<int>(phases_.materials().size()); ++m) {
    const int number = table_.find(save.label, m);
    const std::string material = m < 0 ? "" : phases_.materials()[static_cast<std::size_t>(m)];
    if (number < 0 || save.label == data::positionName || (!save.material.empty() && save.material != material))
      continue;
    const data::Label& label = *table_[number].label;
    const bool derived = !warehouse_.isHeld(Generation::old, number);
    output::Array array = gather.stream(derived ? Generation::fresh : Generation::old, number);
    if (label.centring == data::Centring::particle)
      snapshot.particles[static_cast<std::size_t>(m)].arrays.push_back(std::move(array));
    else if (array.entries() > 0)
      snapshot.fields.push_back(
          {label.centring == data::Centring::node ? output::Centring::node : output::Centring::cell, material, m,
           std::move(array)});
  }
}

Simulation::Totals Simulation::measureTotals(tasks::TaskGraph& graph) {
  diagnose(graph);
  Totals totals;
  for (const auto& total : phases_.totals()) totals.push_back(reduction(total.second));
  return totals;
}

std::string Simulation::whyEnded() const {
  if (failure_) return "failed";
  if (interrupted_) return "interrupted";
  if (time_.time() >= problem_.time.maxTime) return "maxTime";
  return time_.done() ? "max_Timesteps" : "max_wall_time";
}

Report Simulation::makeReport() {
  const ResidentMemory memory = residentMemory();
  warehouse_.releaseFreeMemory();
  Report report;
  report.memory = {ranks_->max(memory.now), ranks_->max(memory.peak)};
  report.scene = problem_.scenePath;
  report.title = problem_.title;
  report.component = problem_.componentName;
  report.version = TUSHAR_VERSION;
  report.build = TUSHAR_BUILD_TYPE;
  report.dimension = problem_.level->dimension();
  report.patches = problem_.level->patchCount();
  report.ranks = ranks_->size();
  report.threads = scheduler_.threads().count();
  report.spacing = problem_.level->minSpacing();
  report.cells = static_cast<long>(problem_.level->cells().size());
  report.particles = particleCount(warehouse_, static_cast<int>(phases_.materials().size()));
  report.dropped = ranks_->sum(scheduler_.relocation().dropped());
  report.steps = time_.step();
  report.retries = time_.retries();
  report.rebalancing = balance_.report();
  for (const auto& [limit, steps] : time_.limits())
    report.limits.emplace_back(limit.text().empty() ? "unnamed" : limit.text(), steps);
  report.time = time_.time();
  report.particleSteps = static_cast<double>(ranks_->sum(particle_steps_));
  report.wallStartup = wall_startup_;
  report.wallLoop = wall_loop_;
  report.use = time_use_;
  reportTasks(report);
  reportDrift(report);
  reportErrors(report);
  report.ended = whyEnded();
  if (failure_) {
    report.failure = failure_->what();
    report.advice = failure_->advice();
  }
  report.wallOutput = wall_output_;
  report.archive = folder_;
  report.unusedOptions = solvers::unusedOptions();
  report.fingerprint = fingerprint(warehouse_, phases_.state(), static_cast<int>(phases_.materials().size()));
  return report;
}

void Simulation::reportTasks(Report& report) {
  for (const tasks::TaskGraph* graph : {&phases_.stableTimeStep, &phases_.timeAdvance, &phases_.everyStep}) {
    for (const tasks::CompiledTask& task : graph->tasks()) {
      report.tasks.push_back({task.task.name, task.seconds});
      report.kept.push_back(task.task.name);
      report.exchange += task.exchangeSeconds;
    }
    if (graph == &phases_.everyStep) continue;
    for (const tasks::LeftOut& task : graph->leftOut()) report.leftOut.push_back(task);
  }
}

void Simulation::reportDrift(Report& report) {
  const Totals& before = totals_at_start_;
  const Totals after = measureTotals(phases_.report);
  for (std::size_t k = 0; k < before.size(); ++k) {
    double start = 0, end = 0, change = 0;
    for (std::size_t i = 0; i < before[k].size(); ++i) {
      start += before[k][i] * before[k][i];
      end += after[k][i] * after[k][i];
      change += (after[k][i] - before[k][i]) * (after[k][i] - before[k][i]);
    }
    const auto& [what, label] = phases_.totals()[k];
    const bool scalar = before[k].size() == 1;
    Drift drift{what, std::sqrt(start), std::sqrt(end), std::sqrt(change), start > 0, {}};
    if (scalar) {
      drift.start = before[k][0];
      drift.end = after[k][0];
      drift.change = after[k][0] - before[k][0];
    }
    if (drift.relative) drift.change /= std::abs(drift.start);
    drift.unit = std::string(table_[table_.find(label, -1)].label->unit);
    report.drifts.push_back(drift);
  }
}

void Simulation::reportErrors(Report& report) {
  for (const auto& analysis : problem_.analyses) {
    if (std::string why = analysis->whyUnmeasured(); !why.empty()) {
      report.unmeasured.push_back(std::move(why));
      continue;
    }
    for (const EnergyTerm& term : analysis->energies()) {
      auto& side = term.side == EnergyTerm::Side::came ? report.energies.came : report.energies.went;
      side.emplace_back(term.name, reduction(term.label->name).front());
    }
    for (const MeasuredError& error : analysis->errors()) {
      ErrorNorms norms = normsOf(error, reduction(error.label->name));
      if (!norms.norms.empty()) report.errors.push_back(std::move(norms));
    }
  }
  if (failure_) return;
  if (const auto sentence = unmeasurable(report.errors)) failure_ = advised(NumericalError(*sentence, ""));
}

}  // namespace tushar::simulation
