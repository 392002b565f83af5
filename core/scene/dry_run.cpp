#include "core/scene/dry_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <set>

#include "core/scene/scene.hpp"
#include "core/simulation/phases.hpp"
#include "core/tasks/exchange.hpp"

namespace tushar::scene {

namespace {

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Resident memory of this process [MB].
double residentMegabytes() {
  long total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// The rank that owns the cell at the centre of the grid.
int rankInTheMiddle(const grid::Grid& grid) {
  for (int number = 0; number < grid.levels(); ++number) {
    grid::Box middle = grid.level(number).cells();
    for (int d = 0; d < 3; ++d) {
      middle.lower[d] = middle.upper[d] / 2;
      middle.upper[d] = middle.lower[d] + 1;
    }
    const std::vector<grid::Patch> found = grid.patchesOverlapping(middle, number);
    if (!found.empty()) return grid.ownerOf(found.front().id());
  }
  return 0;
}

/// Counts the messages that the task graphs would send.
class Messages {
 public:
  Messages(const grid::Grid& grid, const data::VariableTable& table) : grid_(grid), table_(table) {}

  void add(const tasks::TaskGraph& graph, DryRun& result) {
    if (graph.tasks().empty()) return;
    for (const tasks::CompiledTask& task : graph.tasks()) {
      std::set<int> receivers;
      for (const tasks::BoundGhostFill& fill : task.fills)
        for (const auto& [rank, copies] : plans_.of(grid_, tasks::reachOf(table_, fill)).outgoing) {
          receivers.insert(rank);
          if (!fill.particles) result.bytes += bytesOf(copies, table_[fill.variable].label->bytes);
        }
      result.messages += static_cast<int>(receivers.size());
      neighbours_.insert(receivers.begin(), receivers.end());
      if (task.task.kind == tasks::TaskKind::relocate) addRelocations(static_cast<int>(task.materials.size()), result);
      if (task.task.perRank) ++result.agreements;  // agreement on whether to begin
    }
    ++result.agreements;  // agreement on the outcome
    result.neighbours = static_cast<int>(neighbours_.size());
  }

 private:
  static double bytesOf(const std::vector<tasks::GhostCopy>& copies, std::size_t bytes) {
    double all = 0;
    for (const tasks::GhostCopy& copy : copies) all += static_cast<double>(copy.box.size() * bytes);
    return all;
  }
  void addRelocations(int materials, DryRun& result) {
    const auto& receivers =
        plans_.of(grid_, {data::Centring::particle, tasks::ParticleMigration::neighbourhood}).incoming;
    neighbours_.insert(receivers.begin(), receivers.end());
    result.messages += materials * static_cast<int>(receivers.size());
    result.agreements += materials;
  }

  const grid::Grid& grid_;
  const data::VariableTable& table_;
  tasks::GhostPlans plans_;
  std::set<int> neighbours_;
};

}  // namespace

DryRun dryRun(const std::string& scene, const std::vector<std::string>& overrides,
              const simulation::Catalogue& catalogue, const grid::Workers& workers) {
  const int rank = rankInTheMiddle(*readScene(scene, overrides, catalogue, workers, {0, workers.ranks}).grid);
  const double memoryBefore = residentMegabytes(), timeBefore = processorSeconds();
  const simulation::Problem problem = readScene(scene, overrides, catalogue, workers, {rank, workers.ranks});
  const grid::Grid& grid = *problem.grid;
  data::VariableTable table;
  simulation::Phases phases(*problem.component, problem.analyses);
  phases.compile(problem.analyses, problem.archive.saves, grid, table, problem.regrid, problem.smallerSteps);
  DryRun result;
  result.agreements = 1;  // agreement on whether to stop
  Messages messages(grid, table);
  for (const tasks::TaskGraph* graph :
       {&phases.stableTimeStep, &phases.timeAdvance, &phases.afterStep, &phases.everyStep}) {
    result.tasks += static_cast<int>(graph->tasks().size());
    result.placements += static_cast<int>(graph->placements().size());
    messages.add(*graph, result);
  }
  result.seconds = processorSeconds() - timeBefore;
  result.megabytes = residentMegabytes() - memoryBefore;
  result.rank = grid.share().rank;
  result.ranks = grid.share().ranks;
  result.patches = static_cast<int>(grid.patches().size());
  result.patchesOfAll = grid.patchCount();
  result.isAdaptive = problem.regrid.adaptive;
  result.hasSmallerSteps = problem.smallerSteps.has_value();
  return result;
}

std::string toText(const DryRun& result) {
  std::string limits;
  if (result.isAdaptive)
    limits += "  this is the grid before criteria refine it; during the run the number of patches changes\n";
  if (result.hasSmallerSteps)
    limits +=
        "  for one step of all levels; finer levels take several steps in this time, each with its own messages\n";
  return fmt::format(
      "rank {} of {}: {} of {} patches\n{}"
      "  per step: {} tasks, run {} times; {} messages to {} neighbours with {:.4g} kB plus particles; {} "
      "synchronisations of all ranks\n  compiled in {:.2f} ms of processor time with {:.2f} MB\n",
      result.rank, result.ranks, result.patches, result.patchesOfAll, limits, result.tasks, result.placements,
      result.messages, result.neighbours, 1e-3 * result.bytes, result.agreements, 1e3 * result.seconds,
      result.megabytes);
}

}  // namespace tushar::scene
