#include "core/simulation/run_state.hpp"

namespace tushar::simulation {

namespace {

std::optional<std::size_t> bytesOf(std::optional<int> megabytes) {
  return megabytes ? std::optional(static_cast<std::size_t>(*megabytes) << 20) : std::nullopt;
}

}  // namespace

RunState::RunState(Problem givenProblem, const RunOptions& options, Clock::time_point startedAt,
                   const mpi::Communicator& givenRanks)
    : problem(std::move(givenProblem)),
      ranks(givenRanks),
      files(ranks.split(0)),
      writers(output::Writers::spread(files, options.writers)),
      mostBehind(ranks.broadcast(bytesOf(options.behind))),
      phases(*problem.component, problem.analyses),
      warehouse(*problem.grid, table, ranks),
      scheduler(warehouse, problem.threads, problem.cellsPerThread),
      time(problem.time),
      clock(startedAt),
      progress(options.quiet || !ranks.isFirst(), stdout) {
  phases.compile(problem.analyses, problem.archive.saves, *problem.grid, table, problem.regrid, problem.smallerSteps);
  delT = table.number(data::delT, -1);
  warehouse.grow(materials());
  for (const Reported& one : phases.reported())
    reportedSoFar.emplace_back().reduction = table.find(one.label->name, -1);
}

void RunState::setTimeOfAnalyses() {
  for (const auto& analysis : problem.analyses) analysis->setTime(time.time(), time.time() - problem.time.initTime);
}

void RunState::diagnose(tasks::TaskGraph& graph) {
  setTimeOfAnalyses();
  scheduler.run(graph, {time.step(), time.time()});
}

std::vector<double> RunState::reduction(std::string_view label) const {
  const int number = table.find(label, -1);
  return number < 0 ? std::vector<double>{} : warehouse.reductionValues(number);
}

Totals RunState::measureTotals(tasks::TaskGraph& graph) {
  diagnose(graph);
  Totals totals;
  for (const auto& total : phases.totals()) totals.push_back(reduction(total.label));
  return totals;
}

void RunState::addStepToReported() {
  for (std::size_t k = 0; k < reportedSoFar.size(); ++k)
    if (ReportedSoFar& soFar = reportedSoFar[k]; phases.reported()[k].isOfSteps() && soFar.reduction >= 0)
      soFar.addStep(phases.reported()[k].over, warehouse.reductionValues(soFar.reduction), time.delT());
}

tasks::LostParticles RunState::lostParticles() {
  const tasks::LostParticles& lost = scheduler.relocation().lost();
  return {.left = ranks.sum(lost.left), .removed = lost.removed};
}

tasks::MigratedVariables RunState::migratedVariables() const {
  tasks::MigratedVariables migrated{materials(), {}};
  for (const std::string& name : phases.lasting())
    for (int material = -1; material < migrated.materials; ++material)
      if (const int number = table.find(name, material);
          number >= 0 && table[number].label->centring != data::Centring::reduction)
        migrated.variables.push_back(number);
  return migrated;
}

}  // namespace tushar::simulation
