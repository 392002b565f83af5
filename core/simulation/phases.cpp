#include "core/simulation/phases.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/input/values.hpp"
#include "core/simulation/between_materials.hpp"
#include "core/simulation/careful_steps.hpp"
#include "core/simulation/level_limits.hpp"
#include "core/simulation/needed_names.hpp"
#include "core/simulation/refinement_marks.hpp"
#include "core/tasks/reflux.hpp"
#include "core/tasks/take_over.hpp"

namespace tushar::simulation {

using tasks::Names;
using tasks::producedBy;
using tasks::prune;
using tasks::Pruned;
using tasks::requiredOfState;

namespace {

const data::Label* findProduced(const std::vector<tasks::Task>& tasks, std::string_view name) {
  if (name == data::particleId.name) return &data::particleId;
  for (const tasks::Task& task : tasks)
    for (const tasks::Access& access : task.accesses)
      if (access.writes() && access.label->name == name) return access.label;
  return nullptr;
}

Names united(Names a, const Names& b) {
  a.insert(b.begin(), b.end());
  return a;
}

/// The totals of conserved quantities among the diagnosed variables.
std::vector<ConservedTotal> totalsAmong(const Names& diagnosed) {
  std::vector<ConservedTotal> totals;
  for (const auto& [quantity, label] : {std::pair{Conserved::mass, total::mass.name},
                                        {Conserved::momentum, total::momentum.name},
                                        {Conserved::energy, total::energy.name}})
    if (diagnosed.contains(label)) totals.push_back({quantity, std::string(label)});
  return totals;
}

/// The reductions that analysis modules and the component contribute to the report at the end of the run.
Names measuredBy(const std::vector<std::unique_ptr<Analysis>>& analyses, const std::vector<Reported>& reported) {
  Names names = reductionsOf(reported, false);
  for (const auto& analysis : analyses) {
    for (const MeasuredError& error : analysis->errors()) names.emplace(error.label->name);
    for (const EnergyTerm& term : analysis->energies()) names.emplace(term.label->name);
  }
  return names;
}

/// Whether a variable contains fluxes, which exist only during a step.
bool isOfRims(const std::string& name) { return name.starts_with("rim."); }

/// The variables of a step that the next step needs, except those that are recomputed before each step. Includes the
/// ids of particles if there are particles.
std::vector<std::string> namesOfState(Names needed, const Names& decided, const Names& computed) {
  std::erase_if(needed, [&](const std::string& name) {
    return decided.contains(name) || name == data::recomputeTimeStep.name || isOfRims(name);
  });
  if (computed.contains(data::particleId.name)) needed.emplace(data::particleId.name);
  return {needed.begin(), needed.end()};
}

/// The variables that analysis modules sample.
std::vector<SaveRequest> samplesOf(const std::vector<std::unique_ptr<Analysis>>& analyses) {
  std::vector<SaveRequest> samples;
  for (const auto& analysis : analyses)
    for (SaveRequest& sample : analysis->samples()) samples.push_back(std::move(sample));
  return samples;
}

/// The variables of the old state that the lists read, and those that every step needs.
Names requiredByAll(std::initializer_list<const Pruned*> lists) {
  Names names{std::string(data::recomputeTimeStep.name)};
  for (const Pruned* list : lists) names.merge(requiredOfState(list->kept));
  return names;
}

/// Those of the names that are in both sets.
Names among(const Names& a, Names b) {
  std::erase_if(b, [&](const std::string& name) { return !a.contains(name); });
  return b;
}

/// The tasks that mark cells: those of the criteria and those of the component.
tasks::TaskList estimating(const tasks::TaskList& diagnostics, std::vector<BoundCriterion> criteria,
                           const tasks::TaskList& estimate) {
  tasks::TaskList list;
  for (const tasks::Task& task : diagnostics.tasks()) list.add(task);
  list.add(markTask(std::move(criteria)));
  for (const tasks::Task& task : estimate.tasks()) list.add(task);
  return list;
}

/// The time step, and the other variables that the same tasks compute.
Names decidedBefore(const std::vector<tasks::Task>& stableTimeStep) {
  return united(producedBy(stableTimeStep), {std::string(data::delT.name), std::string(tasks::partOfStep.name)});
}

}  // namespace

Phases::Phases(const Component& component, const std::vector<std::unique_ptr<Analysis>>& analyses)
    : joints_(component.jointInterpolations()), reported_(component.reported()) {
  component.scheduleInitialize(lists_.initialize);
  component.scheduleComputeStableTimeStep(lists_.stableTimeStep);
  component.scheduleTimeAdvance(lists_.timeAdvance);
  if (const auto* careful = dynamic_cast<const CarefulSteps*>(&component)) {
    careful->scheduleCarefulTimeAdvance(lists_.carefulAdvance);
    about_careful_steps_ = careful->aboutCarefulSteps();
  }
  if (const auto* moves = dynamic_cast<const MovesBetweenMaterials*>(&component))
    moves->scheduleNextMaterials(lists_.nextMaterials);
  component.scheduleDiagnostics(lists_.diagnostics);
  component.scheduleErrorEstimate(lists_.errorEstimate);
  tasks::TaskList refine;
  component.scheduleRefine(refine);
  lists_.refine = tasks::takingOver(refine);
  component.scheduleAfterRefluxing(lists_.afterRefluxing);
  addAnalyses(analyses);
  totals_ = totalsAmong(producedBy(lists_.diagnostics.tasks()));
  validateAll();
  noteMaterials();
}

void Phases::validateAll() const {
  const Lists& lists = lists_;
  const Names state = producedBy(lists.initialize.tasks());
  const Names withDelT = united(state, decidedBefore(lists.stableTimeStep.tasks()));
  const Names withSums = united(state, summed_);
  tasks::validate(lists.initialize.tasks(), {});
  tasks::validate(lists.stableTimeStep.tasks(), state);
  tasks::validate(lists.timeAdvance.tasks(), withDelT);
  tasks::validate(lists.carefulAdvance.tasks(), withDelT);
  tasks::validate(lists.nextMaterials.tasks(), state);
  tasks::validate(lists.diagnostics.tasks(), withSums);
  tasks::validate(lists.afterStep.tasks(), withSums);
  tasks::validate(estimating(lists.diagnostics, {}, lists.errorEstimate).tasks(), withSums);
  tasks::validate(lists.refine.tasks(), state);
}

void Phases::noteMaterials() {
  for (const tasks::Task& task : lists_.initialize.tasks())
    if (task.materials.size() > materials_.size()) materials_ = task.materials;
}

std::vector<InputProblem> Phases::problemsOf(const std::vector<SaveRequest>& saves, const std::string& path) const {
  const Names known = saveable();
  std::vector<InputProblem> problems;
  for (const SaveRequest& save : named(saves)) {
    if (!known.contains(save.label))
      problems.push_back(
          {save.where, path,
           fmt::format("no task of this component computes '{}'{}; available: {}", save.label,
                       didYouMean(save.label, {known.begin(), known.end()}), allOf({known.begin(), known.end()}))});
    else if (!save.material.empty() && !isMaterial(save.material))
      problems.push_back({save.whereOfMaterial, path,
                          fmt::format("there is no material '{}'{}; available: {}", save.material,
                                      didYouMean(save.material, materials_), allOf(materials_))});
  }
  return problems;
}

std::vector<InputProblem> Phases::problemsOf(const std::vector<std::unique_ptr<Analysis>>& analyses) const {
  const std::vector<SaveRequest> samples = samplesOf(analyses);
  std::vector<InputProblem> problems = problemsOf(samples, "DataAnalysis/Module");
  for (const SaveRequest& sample : samples)
    for (const std::string& remark : remarksOn(sample))
      problems.push_back({sample.whereOfMaterial, "DataAnalysis/Module", remark});
  return problems;
}

Names Phases::saveable() const {
  Names names;
  for (const auto* list : {&lists_.initialize, &lists_.timeAdvance, &lists_.diagnostics, &lists_.afterStep})
    names.merge(producedBy(list->tasks()));
  std::erase_if(names, isOfRims);
  return names;
}

void Phases::sortSaves(const std::vector<SaveRequest>& saves) {
  for (const SaveRequest& save : saves) {
    const data::Label* label = nullptr;
    for (const auto* list : {&lists_.timeAdvance, &lists_.initialize, &lists_.diagnostics, &lists_.afterStep})
      if (!label) label = findProduced(list->tasks(), save.label);
    const auto isSameLabel = [&](const SaveRequest& other) { return other.label == save.label; };
    const auto covers = [&](const SaveRequest& other) {
      return isSameLabel(other) && (other.material.empty() || other.material == save.material);
    };
    if (label && label->centring == data::Centring::reduction) {
      if (std::find(saved_globals_.begin(), saved_globals_.end(), save.label) == saved_globals_.end())
        saved_globals_.push_back(save.label);
    } else if (label && std::none_of(saved_fields_.begin(), saved_fields_.end(), covers)) {
      if (save.material.empty()) std::erase_if(saved_fields_, isSameLabel);
      saved_fields_.push_back(save);
    }
  }
  reported_ = shownOf(std::move(reported_), saved_globals_);
}

tasks::TaskList Phases::refinementTasks(const RegridSettings& regrid) const {
  if (!regrid.adaptive || (regrid.criteria.empty() && lists_.errorEstimate.tasks().empty())) return {};
  const Names diagnosed = producedBy(lists_.diagnostics.tasks());
  std::vector<std::string> known;
  for (const std::string& name : saveable())
    if (name.starts_with("c.")) known.push_back(name);
  std::vector<BoundCriterion> criteria;
  std::vector<InputProblem> problems;
  for (const Criterion& one : regrid.criteria) {
    const data::Label* label = nullptr;
    std::vector<std::string> materials;
    for (const auto* tasks : {&lists_.diagnostics, &lists_.timeAdvance, &lists_.initialize}) {
      if (label) continue;
      label = findProduced(tasks->tasks(), one.variable);
      if (label) materials = materialsOf(tasks->tasks(), *label);
    }
    if (label && label->centring == data::Centring::cell && label->number == data::Number::real)
      criteria.push_back({one, label, diagnosed.contains(one.variable), std::move(materials)});
    else
      problems.push_back({one.where, one.path,
                          fmt::format("'{}' is not a cell variable that this component computes{}; available: {}",
                                      one.variable, didYouMean(one.variable, known), allOf(known))});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return estimating(lists_.diagnostics, std::move(criteria), lists_.errorEstimate);
}

namespace {

/// Adds to each set of names that are read after a step what the step after it needs if it is taken by another list.
void addNeeded(const tasks::TaskList& other, std::initializer_list<Names*> readAfter) {
  if (other.tasks().empty()) return;
  for (Names* names : readAfter) names->merge(prune(other.tasks(), *names, true).needed);
}

/// Compiles the steps after a loss, which compute what is `needed`; empty if there are none.
tasks::TaskGraph carefulGraph(const tasks::TaskList& list, const Names& needed, const grid::Grid& grid,
                              data::VariableTable& table) {
  if (list.tasks().empty()) return {};
  return {"carefulTimeAdvance", prune(list.tasks(), needed, true), grid, table};
}

tasks::TaskGraph refluxingGraph(const tasks::TaskList& list, const Names& wanted, const grid::Grid& grid,
                                data::VariableTable& table) {
  return tasks::TaskGraph("after the steps of the next finer level", prune(list.tasks(), wanted, false), grid, table);
}

/// The tasks that correct the values of newly refined cells; none if cells are refined at most at the start.
Pruned mendsOf(const tasks::TaskList& list, const RegridSettings& regrid, const Names& wanted) {
  const tasks::TaskList mends = regrid.adaptive && !regrid.once ? list : tasks::TaskList();
  return prune(mends.tasks(), wanted, false);
}

/// The tasks that find the materials to which particles move.
Pruned movesOf(const tasks::TaskList& list) { return prune(list.tasks(), {std::string(nextMaterial.name)}, false); }

/// Numbers the variables that the time loop itself reads.
void numberSteps(bool bySmallerSteps, data::VariableTable& table) {
  table.number(data::delT, -1);
  if (bySmallerSteps) table.number(tasks::partOfStep, -1);
}

/// Records that regridding interpolates cell variables, including those of materials, from surrounding cells, if the
/// grid is adaptive. Variables that are interpolated together have equally many ghosts.
void widenGhosts(const std::vector<std::string>& lasting, bool isAdaptive, int materials, data::VariableTable& table) {
  for (const std::string& name : isAdaptive ? lasting : std::vector<std::string>())
    for (int material = -1; material < materials; ++material)
      if (const int number = table.find(name, material);
          number >= 0 && table[number].label->centring == data::Centring::cell)
        table.widen(number, 1);
  table.widenJoints();
}

void throwIfAny(std::vector<InputProblem> problems) {
  if (!problems.empty()) throw InputError(std::move(problems));
}

Names namesOf(const std::vector<ConservedTotal>& totals) {
  Names names;
  for (const ConservedTotal& total : totals) names.insert(total.label);
  return names;
}

/// Adds those problems that are not in the list yet.
void addOthers(const std::vector<InputProblem>& found, std::vector<InputProblem>& problems) {
  for (const InputProblem& problem : found)
    if (std::none_of(problems.begin(), problems.end(),
                     [&](const InputProblem& other) { return other.sentence == problem.sentence; }))
      problems.push_back(problem);
}

/// Throws InputError if tasks cannot run on a grid of several levels.
void checkOnLevels(std::initializer_list<const Pruned*> lists, const grid::Grid& grid, const Location& where) {
  std::vector<InputProblem> problems;
  for (const Pruned* list : lists) addOthers(problemsOnLevels(list->kept, grid, where), problems);
  throwIfAny(std::move(problems));
}

/// Throws InputError if tasks cannot run on one level at a time.
void refuseSmallerSteps(std::initializer_list<const Pruned*> lists, const Location& where) {
  std::vector<tasks::Task> all;
  for (const Pruned* list : lists) all.insert(all.end(), list->kept.begin(), list->kept.end());
  if (auto problem = problemOfSmallerSteps(all, where)) throw InputError(std::vector{*std::move(problem)});
}

}  // namespace

Phases::Wants Phases::wantsOf(const std::vector<SaveRequest>& samples, const Names& stepped) const {
  Wants wants{{saved_globals_.begin(), saved_globals_.end()}, {}, {}};
  const Names diagnosed = producedBy(lists_.diagnostics.tasks());
  for (const SaveRequest& save : saved_fields_)
    (stepped.contains(save.label) ? wants.ofState : wants.everyOutput).insert(save.label);
  for (const SaveRequest& sample : samples)
    (stepped.contains(sample.label) ? wants.ofState : wants.everyStep).insert(sample.label);
  for (const std::string& global : saved_globals_)
    if (!diagnosed.contains(global)) wants.ofState.insert(global);
  wants.ofState.merge(reductionsOf(reported_, true));
  return wants;
}

void Phases::takeSaves(const std::vector<SaveRequest>& saves, const std::vector<std::unique_ptr<Analysis>>& analyses,
                       int levels) {
  for (auto problems : {problemsOf(saves), problemsOf(analyses)}) throwIfAny(std::move(problems));
  sortSaves(named(saves));
  if (levels > 1) refuseSavedNodes(analyses);
}

void Phases::compile(const std::vector<std::unique_ptr<Analysis>>& analyses, const std::vector<SaveRequest>& saves,
                     const grid::Grid& grid, data::VariableTable& table, const RegridSettings& regrid,
                     const std::optional<Location>& smallerSteps) {
  takeSaves(saves, analyses, grid.levels());
  prepareLevels(grid.levels(), regrid.refluxes, smallerSteps.has_value(), table);
  const Lists& lists = lists_;
  const Names stepped = namesOfSteps();
  const Names totals = namesOf(totals_);
  const Wants wants = wantsOf(samplesOf(analyses), stepped);

  const Names decided = decidedBefore(lists.stableTimeStep.tasks());
  const Names wanted = among(decided, requiredOfState(lists.timeAdvance.tasks()));
  Pruned stable = prune(lists.stableTimeStep.tasks(), united(wanted, {std::string(data::delT.name)}), false);
  Pruned step = prune(lists.diagnostics.tasks(), wants.everyStep, false);
  Pruned output = prune(lists.diagnostics.tasks(), wants.everyOutput, false);
  Pruned begin = prune(lists.diagnostics.tasks(), totals, false);
  Pruned end = prune(lists.diagnostics.tasks(), united(totals, measuredBy(analyses, reported_)), false);
  Pruned refine = prune(refinementTasks(regrid).tasks(), {std::string(tasks::refinementMark.name)}, false);
  Pruned mend = mendsOf(lists.refine, regrid, stepped);
  Pruned moves = movesOf(lists.nextMaterials);
  Names read = requiredByAll({&stable, &step, &output, &end, &refine, &mend, &moves});
  Names always = requiredByAll({&stable, &begin, &refine, &mend, &moves});
  Names atEnd = united(united(read, wants.ofState), tasks::registersOf(lists.timeAdvance));
  const Pruned sums = addSums(always, atEnd);
  addNeeded(lists.carefulAdvance, {&always, &atEnd});
  const Pruned bare = prune(lists.timeAdvance.tasks(), always, true);
  Pruned advance = prune(lists.timeAdvance.tasks(), atEnd, true);
  if (smallerSteps) refuseSmallerSteps({&stable, &advance}, *smallerSteps);
  Pruned init = prune(lists.initialize.tasks(), neededAtStart(advance, lists.initialize), false);
  checkOnLevels({&init, &stable, &advance, &step, &output, &begin, &end, &refine, &mend, &moves, &sums}, grid,
                regrid.where);

  state_ = namesOfState(bare.needed, decided, stepped);
  lasting_ = namesOfState(advance.needed, decided, stepped);
  needed_at_restart_ = neededAfterRestart(state_, lasting_, requiredByAll({&advance}));
  initialize = tasks::TaskGraph("initialize", std::move(init), grid, table);
  stableTimeStep = tasks::TaskGraph("computeStableTimeStep", std::move(stable), grid, table);
  const Names needed = advance.needed;
  timeAdvance = tasks::TaskGraph("timeAdvance", std::move(advance), grid, table);
  carefulAdvance = carefulGraph(lists.carefulAdvance, needed, grid, table);
  nextMaterials = tasks::TaskGraph("materials of the next step", std::move(moves), grid, table);
  everyStep = tasks::TaskGraph("diagnostics of every step", std::move(step), grid, table);
  everyOutput = tasks::TaskGraph("diagnostics of every output", std::move(output), grid, table);
  startTotals = tasks::TaskGraph("totals of the start", std::move(begin), grid, table);
  report = tasks::TaskGraph("diagnostics of the report", std::move(end), grid, table);
  afterStep = tasks::TaskGraph("sums over steps", sums, grid, table);
  refinement = tasks::TaskGraph("refinement", std::move(refine), grid, table);
  refined = tasks::TaskGraph("new finer cells", std::move(mend), grid, table);
  refluxing = refluxingGraph(lists.reflux, stepped, grid, table);
  numberSteps(smallerSteps.has_value(), table);
  widenGhosts(lasting_, regrid.adaptive, static_cast<int>(materials_.size()), table);
}

}  // namespace tushar::simulation
