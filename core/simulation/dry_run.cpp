#include "core/simulation/dry_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <set>

#include "core/simulation/scene.hpp"
#include "core/tasks/exchange.hpp"

namespace tushar::simulation {

namespace {

using Clock = std::chrono::steady_clock;

/// Memory of this process that is in use, MB.
double residentMegabytes() {
  long total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

int rankInTheMiddle(const grid::Level& level) {
  Index3 middle;
  for (int d = 0; d < 3; ++d) middle[d] = level.cells().upper[d] / 2;
  return level.ownerOf(level.patchOf(middle).id());
}

/// Plans the messages of graphs, and counts them.
class Messages {
 public:
  Messages(const grid::Level& level, const data::VariableTable& table) : level_(level), table_(table) {}

  void add(const tasks::TaskGraph& graph, DryRun& result) {
    for (const tasks::CompiledTask& task : graph.tasks()) {
      std::set<int> receivers;
      for (const tasks::NumberedFill& fill : task.fills)
        for (const auto& [rank, copies] : planOf(fill).outgoing) {
          receivers.insert(rank);
          for (const tasks::GhostCopy& copy : copies)
            if (!fill.particles) result.bytes += static_cast<double>(copy.box.size() * table_[fill.variable].label->bytes);
        }
      result.messages += static_cast<int>(receivers.size());
      neighbours_.insert(receivers.begin(), receivers.end());
    }
    result.neighbours = static_cast<int>(neighbours_.size());
  }

 private:
  const tasks::GhostPlan& planOf(const tasks::NumberedFill& fill) {
    const tasks::GhostReach reach = tasks::reachOf(table_, fill);
    const auto [plan, isNew] = plans_.try_emplace(reach);
    if (isNew) plan->second = planGhosts(level_, reach.nodes, reach.width);
    return plan->second;
  }

  const grid::Level& level_;
  const data::VariableTable& table_;
  std::map<tasks::GhostReach, tasks::GhostPlan> plans_;
  std::set<int> neighbours_;
};

}  // namespace

DryRun dryRun(const std::string& scene, const std::vector<std::string>& overrides, const Catalogue& catalogue, int ranks) {
  const int rank = rankInTheMiddle(*readScene(scene, overrides, catalogue, {0, ranks}).level);
  const double before = residentMegabytes();
  const auto started = Clock::now();
  const Problem problem = readScene(scene, overrides, catalogue, {rank, ranks});
  const grid::Level& level = *problem.level;
  data::VariableTable table;
  Phases phases(*problem.component, problem.analyses);
  phases.compile(problem.analyses, problem.archive.saves, level, table);
  DryRun result;
  Messages messages(level, table);
  for (const tasks::TaskGraph* graph : {&phases.stableTimeStep, &phases.timeAdvance}) {
    result.tasks += static_cast<int>(graph->tasks().size());
    result.placements += static_cast<int>(graph->placements().size());
    messages.add(*graph, result);
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - started).count();
  result.megabytes = residentMegabytes() - before;
  result.rank = level.share().rank;
  result.ranks = level.share().ranks;
  result.patches = static_cast<int>(level.patches().size());
  result.patchesOfAll = level.patchCount();
  return result;
}

std::string toText(const DryRun& result) {
  return fmt::format(
      "rank {} of {}: {} of {} patches\n"
      "  a step: {} tasks, run {} times; {} neighbours, {} messages of ghosts, {:.4g} kB (particles not counted)\n"
      "  compiled in {:.3f} ms with {:.2f} MB\n",
      result.rank, result.ranks, result.patches, result.patchesOfAll, result.tasks, result.placements, result.neighbours,
      result.messages, 1e-3 * result.bytes, 1e3 * result.seconds, result.megabytes);
}

}  // namespace tushar::simulation
