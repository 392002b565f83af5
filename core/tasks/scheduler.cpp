#include "core/tasks/scheduler.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>

#include "core/base/error.hpp"
#include "core/tasks/kept_levels.hpp"

namespace tushar::tasks {

using data::Generation;

namespace {

double seconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

int firstMaterial(const CompiledTask& task) { return task.task.perMaterial() ? 0 : -1; }

/// Runs `work`; adds the position in the run to exceptions that it throws.
template <class Work>
void located(const CompiledTask& task, int patch, int material, const StepInfo& at, Work&& work) {
  try {
    work();
  } catch (const NumericalError& error) {
    throw NumericalError(fmt::format("{} ({})", error.what(), placeOf(task, patch, material, at)), error.advice(),
                         error.value(), error.cell());
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw TaskError(fmt::format("{} ({})", error.what(), placeOf(task, patch, material, at)));
  }
}

/// Keeps the first of the errors on all patches: that of the lowest cell or, for equal cells, of the lowest patch.
class FirstRefusal {
 public:
  void note(const NumericalError& error, int patch) {
    const std::lock_guard<std::mutex> alone(mutex_);
    if (error_ && std::pair(error_->cell(), patch_) < std::pair(error.cell(), patch)) return;
    error_ = error;
    patch_ = patch;
  }
  const std::optional<NumericalError>& error() const { return error_; }

 private:
  std::mutex mutex_;
  std::optional<NumericalError> error_;
  int patch_ = 0;
};

}  // namespace

std::string placeOf(const CompiledTask& task, int patch, int material, const StepInfo& at) {
  std::string text = "task " + task.task.name;
  if (patch >= 0) text += fmt::format(", patch {}", patch);
  if (material >= 0) text += ", material " + task.task.materials[material];
  text += fmt::format(", step {}, time {:.6g} s", at.step, at.time);
  if (at.delT > 0) text += fmt::format(", time step {:.6g} s", at.delT);
  if (at.repeats > 0) text += fmt::format(" after {} repeats", at.repeats);
  return text;
}

template <class Work>
void Scheduler::workOn(std::size_t place, const CompiledTask& task, const Work& work) {
  const grid::Patch& patch = warehouse_->grid().patches()[place];
  const trace::Span span(trace::Kind::task, task.task.name, patch.id());
  if (warehouse_->ranks().isAlone() && threads_.count() == 1) return work(patch);
  const auto started = Clock::now();
  work(patch);
  costs_[place] += seconds(Clock::now() - started);
}

/// Runs work on patches: first on those whose ghosts are complete, then on the others, after messages have arrived.
template <class Work>
void Scheduler::forEachPatch(CompiledTask& task, const Work& work) {
  const int patches = warehouse_->patches();
  const bool isUnderWay = exchange_.isUnderWay();
  if (!isUnderWay && level_ < 0)
    return threads_.forEach(patches, [&](int k) { workOn(static_cast<std::size_t>(k), task, work); });
  std::vector<std::size_t> early, late;
  for (std::size_t place = 0; place < static_cast<std::size_t>(patches); ++place)
    if (isOfLevel(place)) (!isUnderWay || exchange_.isReady(place) ? early : late).push_back(place);
  const auto workOnAll = [&](const std::vector<std::size_t>& places) {
    threads_.forEach(static_cast<int>(places.size()), [&](int k) { workOn(places[k], task, work); });
  };
  workOnAll(early);
  if (isUnderWay && finishExchange(task)) workOnAll(late);
}

/// Completes the exchange; returns false if a rank from which this one receives messages has stopped.
bool Scheduler::finishExchange(CompiledTask& task) {
  const auto started = Clock::now();
  heard_stop_ = !exchange_.finish() || heard_stop_;
  const double taken = seconds(Clock::now() - started);
  task.exchangeSeconds += taken;
  task.seconds -= taken;
  return !heard_stop_;
}

void Scheduler::divideReductions(const CompiledTask& task) {
  for (const int reduction : task.readReductions) warehouse_->slot(reduction);
  for (const int reduction : task.reductions) warehouse_->slot(reduction).divide(warehouse_->grid().patches().size());
}

void Scheduler::gatherReductions(const CompiledTask& task) {
  for (const int reduction : task.reductions) warehouse_->slot(reduction).gather();
}

std::optional<data::Minimum> Scheduler::run(TaskGraph& graph, const StepInfo& at) {
  if (graph.tasks().empty()) return std::nullopt;
  const OneClock oneClock(threads_, warehouse_->ranks());
  start(graph, static_cast<int>(graph.tasks().size()), at);
  for (int t = 0; t < end_; ++t) {
    CompiledTask& task = graph.tasks()[t];
    runTask(graph, t, at);
    if (!hasStopped()) free(task);
    task.seconds += lap(trace::Kind::task);
    if (hasStopped() && warehouse_->ranks().isAlone()) break;
  }
  agree(graph);
  if (outcome_.isNone()) return std::nullopt;
  warehouse_->forgetGhosts();  // ranks that stopped early have determined fewer ghosts than others
  if (outcome_.kind == Outcome::Kind::shortensStep) return outcome_.factor;
  if (at.mayRepeat) return data::Minimum{0.5, outcome_.value};
  if (outcome_.kind == Outcome::Kind::throws) throw broadcastError(warehouse_->ranks(), error_, outcome_.rank);
  throw whatBroke(graph, at);
}

double Scheduler::lap(trace::Kind kind) {
  const auto now = Clock::now();
  const double taken = seconds(now - std::exchange(lap_started_, now));
  if (threads_.isCountedOutside()) threads_.count(taken, kind);
  return taken;
}

void Scheduler::start(const TaskGraph& graph, int end, const StepInfo& at) {
  lap_started_ = Clock::now();
  end_ = end;
  level_ = at.level;
  exchange_.setLevel(at.level, at.part);
  outcome_ = {};
  error_.reset();
  heard_stop_ = false;
  costs_.resize(warehouse_->grid().patches().size());
  distributeOverThreads();
  findAbsent(graph);
  relocation_.start();
  exchange_.forgetParticles();
  for (const int reduction : graph.reductions()) warehouse_->resetReduction(reduction);
}

void Scheduler::runTask(TaskGraph& graph, int number, const StepInfo& at) {
  CompiledTask& task = graph.tasks()[number];
  running_ = number;
  const bool exchanges = hasStopped() || !exchange_.movesNothing();
  if (exchanges && task.sends >= 0 && task.sends < end_)
    exchange_.send(presentOf(graph.tasks()[task.sends].fills), hasStopped());
  if (exchanges && !task.fills.empty()) {
    exchange_.begin(hasStopped());
    if (!task.mayStartEarly || hasStopped()) heard_stop_ = !exchange_.finish() || heard_stop_;
    task.exchangeSeconds += lap(trace::Kind::message);
  }
  if (task.task.kind == TaskKind::relocate)
    relocate(task, at);
  else if (task.task.perRank ? mayRunTogether() : !hasStopped())
    runWork(task, at);
  if (task.task.kind != TaskKind::work) exchange_.forgetParticles();
}

std::optional<data::Minimum> Scheduler::factorOf(const CompiledTask& task) {
  if (task.recomputeTimeStep < 0) return std::nullopt;
  const auto& factor = warehouse_->reduction<data::Minimum>(task.recomputeTimeStep);
  return factor.value < 1 ? std::optional(factor) : std::nullopt;
}

/// Whether this rank may run a collective task: false if any rank has stopped, or if this rank has no patches.
bool Scheduler::mayRunTogether() {
  heard_stop_ = warehouse_->ranks().any(hasStopped());
  ranksWithPatches();
  return !heard_stop_ && !warehouse_->grid().patches().empty();
}

const mpi::Communicator& Scheduler::ranksWithPatches() {
  if (!with_patches_) {
    with_patches_ = warehouse_->ranks().split(warehouse_->grid().patches().empty() ? 0 : 1);
    if (with_patches_->isAlone()) with_patches_ = mpi::Communicator();
  }
  return *with_patches_;
}

/// Runs a task. If it may request a repetition of the step, it runs for all materials even after an error on this rank,
/// because every request counts.
void Scheduler::runWork(CompiledTask& task, const StepInfo& at) {
  divideReductions(task);
  const bool mayAsk = task.recomputeTimeStep >= 0, isOnce = task.task.acrossMaterials || task.task.perRank;
  const MaterialRange each = isOnce ? MaterialRange{} : task.task.range();
  for (int m = each.first; m < each.end && !heard_stop_ && (mayAsk || !hasStopped()); ++m) {
    if (!isPresent(m)) continue;
    if (task.task.perRank)
      threads_.alone([&] { runOnRank(task, at); }, trace::Kind::task, task.task.name);
    else
      runOnPatches(task, m, at);
  }
  shareFaces(task);
  if (const auto factor = factorOf(task))
    outcome_.merge({running_, Outcome::Kind::shortensStep, 0, 0, warehouse_->ranks().rank(), *factor, {}});
}

void Scheduler::shareFaces(const CompiledTask& task) {
  for (std::size_t m = 0; m < task.materials.size(); ++m)
    if (isPresent(static_cast<int>(m) + firstMaterial(task)))
      for (const Output& shared : task.materials[m].shared)
        if (!hasStopped()) exchange_.shareFaces(shared.variable, shared.set);
}

/// Relocates particles, on all ranks or on none. If no task follows a relocation, its moves are made when the step is
/// accepted.
void Scheduler::relocate(const CompiledTask& task, const StepInfo& at) {
  bool isFirst = true;  // all ranks take part in the first relocation, even those that have stopped
  for (int m = 0; m < static_cast<int>(task.materials.size()) && (isFirst || !hasStopped()); ++m) {
    if (!isPresent(m)) continue;
    isFirst = false;
    const MaterialBinding& binding = task.of(m);
    try {
      located(task, -1, m, at, [&] {
        const int position = binding.accesses.front().variable;
        heard_stop_ = !relocation_.find(m, position, hasStopped()) || heard_stop_;
        if (!heard_stop_ && !task.isLast) relocation_.apply(m, binding.carried, Generation::fresh);
      });
    } catch (const NumericalError& error) {
      note(task, m, error);
    }
  }
}

void Scheduler::runOnPatches(CompiledTask& task, int material, const StepInfo& at) {
  const bool all = task.task.acrossMaterials;
  const int from = all ? 0 : material, end = all ? static_cast<int>(task.materials.size()) : material + 1;
  for (int m = from; m < end; ++m)
    if (isPresent(m)) allocateOutputs(task.of(m));
  const bool makes = task.task.kind == TaskKind::newParticles;
  makers_.clear();
  for (int place = 0; makes && place < warehouse_->patches(); ++place)
    makers_.emplace_back(task.of(material).accesses.size());
  FirstRefusal first;
  std::atomic<bool> kept = true;
  const auto checkBounds = [&](const grid::Patch& patch) {
    for (int m = from; m < end; ++m)
      if (isPresent(m) && !keepsBounds(*warehouse_, task.of(m).bounded, patch)) kept = false;
  };
  forEachPatch(task, [&](const grid::Patch& patch) {
    try {
      all ? runAcrossMaterials(task, patch, at) : runPlaced(task, patch, material, at);
      if (!makes) checkBounds(patch);
    } catch (const NumericalError& error) {
      first.note(error, patch.id());
    }
  });
  gatherReductions(task);
  if (makes && !first.error()) {
    install(task, material, at);
    forEachPatch(task, checkBounds);
  }
  if (first.error())
    note(task, material, *first.error());
  else if (!kept)
    noteBroken(task, from, end);
}

void Scheduler::runOnRank(CompiledTask& task, const StepInfo& at) {
  const int first = firstMaterial(task);
  for (std::size_t m = 0; m < task.materials.size(); ++m)
    if (isPresent(static_cast<int>(m) + first)) allocateOutputs(task.materials[m]);
  std::vector<std::vector<TaskContext>> contexts;
  for (const grid::Patch& patch : warehouse_->grid().patches()) {
    std::vector<TaskContext>& ofPatch = contexts.emplace_back();
    for (std::size_t m = 0; m < task.materials.size(); ++m)
      ofPatch.push_back(contextOf(task, patch, static_cast<int>(m) + first, at));
  }
  std::vector<TaskContext> patches;
  for (const std::vector<TaskContext>& ofPatch : contexts) {
    patches.push_back(ofPatch.front());
    patches.back().setMaterials(ofPatch);
  }
  TaskContext rank = patches.front();
  rank.setPatches(patches);
  rank.setRanks(ranksWithPatches());
  rank.setThreads(threads_);
  try {
    located(task, -1, -1, at, [&] { task.task.body(rank); });
  } catch (const NumericalError& error) {
    note(task, -1, error);
  }
  gatherReductions(task);
  if (!hasStopped()) noteBroken(task, first, first + static_cast<int>(task.materials.size()));
}

void Scheduler::runAcrossMaterials(CompiledTask& task, const grid::Patch& patch, const StepInfo& at) {
  std::vector<TaskContext> contexts;
  contexts.reserve(task.materials.size());
  for (std::size_t m = 0; m < task.materials.size(); ++m)
    contexts.push_back(contextOf(task, patch, static_cast<int>(m), at));
  TaskContext all = contexts.front();
  all.setMaterials(contexts);
  located(task, patch.id(), -1, at, [&] { task.task.body(all); });
}

void Scheduler::runPlaced(CompiledTask& task, const grid::Patch& patch, int material, const StepInfo& at) {
  ParticleMaker* maker = nullptr;
  if (task.task.kind == TaskKind::newParticles) maker = &makers_[patch.id() - warehouse_->grid().firstPatch()];
  located(task, patch.id(), material, at, [&] {
    task.task.body(TaskContext(*warehouse_, patch, material, task.of(material).accesses, at.time, maker));
  });
}

void Scheduler::install(const CompiledTask& task, int material, const StepInfo& at) {
  const std::vector<grid::Patch>& patches = warehouse_->grid().patches();
  const MaterialBinding& binding = task.of(material);
  ParticleInstaller installer(*warehouse_, material, makers_);
  const auto onPatches = [&](const ParticleInstaller::Work& work) {
    threads_.forEach(static_cast<int>(patches.size()), [&](int k) {
      const grid::Patch& patch = patches[k];
      located(task, patch.id(), material, at, [&] { work(patch, makers_[k]); });
    });
  };
  installer.makeSets(onPatches);
  if (installer.keepsAll()) return makers_.clear();
  for (std::size_t a = 0; a < binding.accesses.size(); ++a) {
    const int number = binding.accesses[a].variable;
    if (task.task.accesses[a].kind != AccessKind::creates) continue;
    const bool isRead = std::find(binding.freed.begin(), binding.freed.end(), number) == binding.freed.end();
    installer.write(number, a, isRead, onPatches);
  }
  installer.writeIds(onPatches);
  makers_.clear();
}

/// Allocates outputs; preserves values that another level has already computed.
void Scheduler::allocateOutputs(const MaterialBinding& binding) {
  for (const Output& output : binding.outputs) {
    if (level_ >= 0 && isHeld(*warehouse_, Generation::fresh, output.variable)) continue;
    switch (warehouse_->table()[output.variable].label->centring) {
      case data::Centring::particle:
        warehouse_->allocateParticles(Generation::fresh, output.variable, output.set);
        break;
      case data::Centring::rim:
        warehouse_->allocateRims(Generation::fresh, output.variable);
        break;
      default:
        warehouse_->allocateGrid(Generation::fresh, output.variable);
        if (output.cleared) warehouse_->clear(Generation::fresh, output.variable);
    }
  }
}

void Scheduler::free(const CompiledTask& task) {
  for (std::size_t m = 0; m < task.materials.size(); ++m)
    if (m == 0 ||
        isPresent(static_cast<int>(m) + firstMaterial(task)))  // the first one also frees what has no material
      for (const int number : task.materials[m].freed) warehouse_->free(Generation::fresh, number);
}

void Scheduler::fillGhosts(const std::vector<int>& variables) {
  std::vector<BoundGhostFill> fills;
  for (const int number : variables) fills.push_back({number, Generation::old, Generation::old, false});
  exchange_.setLevel(-1, 0);
  exchange_.send(fills, false);
  exchange_.begin(false);
  exchange_.finish();
}

void Scheduler::commit(TaskGraph& graph) {
  relocation_.commit();
  for (const int number : graph.results())
    if (isPresent(warehouse_->table()[number].material)) warehouse_->makeOld(number);
  if (!graph.tasks().empty()) apply(graph.tasks().back());
  for (const int material : graph.changedSets())
    if (isPresent(material)) warehouse_->swapSets(material);
}

void Scheduler::apply(CompiledTask& last) {
  if (last.task.kind != TaskKind::relocate) return;
  const OneClock oneClock(threads_, warehouse_->ranks());
  lap_started_ = Clock::now();
  for (int m = 0; m < static_cast<int>(last.materials.size()); ++m)
    if (isPresent(m)) relocation_.apply(m, last.materials[m].carried, Generation::old);
  last.seconds += lap(trace::Kind::task);
}

}  // namespace tushar::tasks
