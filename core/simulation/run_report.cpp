#include "core/simulation/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/collect/gather.hpp"
#include "core/report/drift.hpp"
#include "core/report/error_norms.hpp"

namespace tushar::simulation {

using report::Report;

namespace {

/// Number of cells of all levels, or of the boxes of a single level.
std::uint64_t cellsOf(const grid::Grid& grid) {
  return grid.levels() > 1 ? grid.cellCount() : grid.level().cellsInside();
}

}  // namespace

void RunReport::beginLoop(double outputSeconds) {
  loop_started_ = Clock::now();
  output_before_ = outputSeconds;
  use_before_ = run_.scheduler.threads().use();
}

std::vector<long> RunReport::cellsOfLevels() const {
  const grid::Grid& grid = *run_.problem.grid;
  std::vector<long> cells(static_cast<std::size_t>(grid.levels()));
  for (int id = 0; cells.size() > 1 && id < grid.patchCount(); ++id) {
    const grid::Patch patch = grid.patch(id);
    cells[static_cast<std::size_t>(patch.level().number())] += static_cast<long>(patch.cells().size());
  }
  return cells;
}

/// The number of steps that a uniform grid of the finest cells would have taken in one step of all levels: twice as
/// many for each finest level without cells.
double RunReport::stepsOfFinest() const {
  double steps = 1;
  const std::vector<long> cells = cellsOfLevels();
  for (std::size_t level = cells.size(); level-- > 1 && cells[level] == 0;) steps *= 2;
  return steps;
}

/// Counts the cell updates of levels. To estimate the updates of a uniform grid, a finest level without cells counts as
/// if it had taken twice as many steps as the next coarser level.
void RunReport::noteLevels(const std::vector<int>& steps) {
  const std::vector<long> cells = cellsOfLevels();
  double finestSteps = 0;
  for (const int ofLevel : steps) finestSteps = ofLevel > 0 ? ofLevel : 2 * finestSteps;
  uniform_updates_ += finestSteps * static_cast<double>(run_.problem.grid->finest().cells().size());
  level_updates_.resize(cells.size());
  for (std::size_t level = 0; level < cells.size(); ++level) {
    const double updates = static_cast<double>(cells[level]) * steps[level];
    level_updates_[level] += updates;
    updates_ += updates;
  }
}

void RunReport::noteStep(const std::vector<int>& stepsOfLevels) {
  if (!stepsOfLevels.empty()) {
    noteLevels(stepsOfLevels);
    for (ReportedSoFar& one : run_.reportedSoFar) one.isKnown = false;
  } else {
    run_.addStepToReported();
    updates_ += static_cast<double>(cellsOf(*run_.problem.grid));
    uniform_updates_ += stepsOfFinest() * static_cast<double>(run_.problem.grid->finest().cells().size());
  }
  for (int material = 0; material < run_.materials(); ++material)
    for (const grid::Patch& patch : run_.problem.grid->patches())
      particle_steps_ += run_.warehouse.particles(data::Generation::old, material, patch.id()).owned();
}

void RunReport::endLoop(double outputSeconds) {
  const double output = outputSeconds - output_before_;
  loop_ = secondsSince(loop_started_) - output;
  use_ = report::TimeUse(use_before_, run_.scheduler.threads(), secondsSince(loop_started_), output, run_.ranks);
}

Report RunReport::make(double fileMemory) {
  Report report;
  addMemory(report, fileMemory);
  addLayout(report);
  addProgress(report);
  addTasks(report);
  addDrifts(report);
  addReported(report);
  addErrors(report);
  report.fingerprint = collect::fingerprint(run_.warehouse, run_.phases.fingerprinted(), run_.materials());
  if (const std::vector<std::string> others = run_.phases.savedBesides(); !others.empty())
    report.fingerprintOfOthers = collect::fingerprint(run_.warehouse, others, run_.materials());
  return report;
}

/// Adds the use of memory. The free memory after the last step is measured by how much the total falls when it is
/// returned to the system.
void RunReport::addMemory(Report& report, double fileMemory) {
  const ResidentMemory memory = residentMemory();
  run_.warehouse.releaseFreeMemory();
  report.memory = {run_.ranks.max(memory.now), run_.ranks.max(memory.peak)};
  report::MemoryUse use;
  use.peak = memory.peak;
  use.buffers = std::max(0.0, memory.now - residentMemory().now);
  use.files = fileMemory;
  addVariables(run_.warehouse, use);
  report.memoryOfRanks = ofRanks(use, run_.ranks);
}

void RunReport::addLayout(Report& report) {
  const Problem& problem = run_.problem;
  report.scene = problem.scenePath;
  report.title = problem.title;
  report.component = problem.componentName;
  report.version = TUSHAR_VERSION;
  report.build = TUSHAR_BUILD_TYPE;
  report.dimension = problem.grid->dimension();
  report.patches = problem.grid->patchCount();
  report.ranks = run_.ranks.size();
  report.threads = run_.scheduler.threads().count();
  report.spacing = problem.grid->finest().minSpacing();
  report.cells = static_cast<long>(cellsOf(*problem.grid));
  report.updates = updates_;
  report.uniformUpdates = uniform_updates_;
  report.levels = cellsOfLevels();
  report.levelUpdates = level_updates_;
}

void RunReport::addProgress(Report& report) {
  report.particles = collect::particleCount(run_.warehouse, run_.materials());
  const tasks::LostParticles lost = run_.lostParticles();
  report.dropped = lost.left;
  report.removed = lost.removed;
  report.steps = run_.time.step();
  report.retries = run_.time.retries();
  for (const auto& [limit, steps] : run_.time.limits())
    report.limits.emplace_back(limit.text().empty() ? "unnamed" : limit.text(), steps);
  report.time = run_.time.time();
  report.particleSteps = static_cast<double>(run_.ranks.sum(particle_steps_));
  report.wallStartup = start_up_;
  report.wallLoop = loop_;
  report.use = use_;
}

void RunReport::addTasks(Report& report) {
  const Phases& phases = run_.phases;
  for (const tasks::TaskGraph* graph : {&phases.stableTimeStep, &phases.timeAdvance, &phases.carefulAdvance,
                                        &phases.nextMaterials, &phases.afterStep, &phases.everyStep}) {
    if (graph == &phases.carefulAdvance && run_.scheduler.relocation().lost().removed == 0) continue;
    for (const tasks::CompiledTask& task : graph->tasks()) {
      report.tasks.push_back({task.task.name, task.seconds});
      report.kept.push_back(task.task.name);
      report.exchange += task.exchangeSeconds;
    }
    if (graph == &phases.everyStep || graph == &phases.afterStep) continue;
    for (const tasks::LeftOut& task : graph->leftOut()) report.leftOut.push_back(task);
  }
}

namespace {

/// The largest momentum that the total mass can have if its energy is the total energy, sqrt(2 m E), as a scale for
/// drifts; 0 if the mass or the energy is unknown.
double greatestMomentum(const Totals& totals, const std::vector<ConservedTotal>& kinds) {
  double mass = 0, energy = 0;
  for (std::size_t k = 0; k < totals.size(); ++k) {
    if (totals[k].empty()) continue;
    if (kinds[k].quantity == Conserved::mass) mass = totals[k].front();
    if (kinds[k].quantity == Conserved::energy) energy = totals[k].front();
  }
  return std::sqrt(2 * std::abs(mass) * std::abs(energy));
}

}  // namespace

void RunReport::addDrifts(Report& report) {
  const Totals& before = run_.totalsAtStart;
  const Totals after = run_.measureTotals(run_.phases.report);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const ConservedTotal& total = run_.phases.totals()[k];
    if (before[k].empty()) continue;  // unknown, after a restart from a checkpoint of an older version
    const std::string unit(run_.table[run_.table.find(total.label, -1)].label->unit);
    const double scale = total.quantity == Conserved::momentum ? greatestMomentum(before, run_.phases.totals()) : 0;
    report.drifts.push_back(report::driftOf(total.name(), before[k], after[k], unit, scale));
  }
}

/// Adds the numbers of the component that are known and finite. The diagnostics at the end have run.
void RunReport::addReported(Report& report) {
  for (std::size_t k = 0; k < run_.reportedSoFar.size(); ++k) {
    const Reported& one = run_.phases.reported()[k];
    const ReportedSoFar& soFar = run_.reportedSoFar[k];
    if (one.isOfSteps() && !soFar.isKnown) continue;
    std::vector<double> value = one.isOfSteps() ? soFar.value : run_.reduction(one.label->name);
    const bool isFinite = std::all_of(value.begin(), value.end(), [](double x) { return std::isfinite(x); });
    if (!value.empty() && isFinite) report.ofRun.push_back({one.key, one.text, one.unit, std::move(value)});
  }
}

void RunReport::addErrors(Report& report) {
  for (const auto& analysis : run_.problem.analyses) {
    if (std::string why = analysis->whyUnmeasured(); !why.empty()) {
      report.unmeasured.push_back(std::move(why));
      continue;
    }
    for (const EnergyTerm& term : analysis->energies()) {
      auto& side = term.side == EnergyTerm::Side::came ? report.energies.came : report.energies.went;
      side.emplace_back(term.name, run_.reduction(term.label->name).front());
    }
    for (const MeasuredError& error : analysis->errors()) {
      report::ErrorNorms norms = report::normsOf(error, run_.reduction(error.label->name));
      if (!norms.norms.empty()) report.errors.push_back(std::move(norms));
    }
  }
}

}  // namespace tushar::simulation
