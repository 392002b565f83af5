#pragma once

#include <memory>

#include "core/base/mpi.hpp"
#include "core/tasks/scheduler.hpp"
#include "core/tasks/task_list.hpp"
#include "tests/support/levels.hpp"

namespace tushar::test {

/// A grid, a warehouse and a scheduler for running small task lists.
class Runner {
 public:
  /// For one of several ranks, or for a serial run.
  explicit Runner(const grid::Domain& domain, int threads = 1,
                  const mpi::Communicator& ranks = mpi::Communicator::alone())
      : grid(domain, {ranks.rank(), ranks.size()}), warehouse(grid, table, ranks), scheduler(warehouse, threads) {}

  /// Compiles a list; all lists must be compiled before the first run.
  tasks::TaskGraph compile(const tasks::TaskList& list, const tasks::Names& wanted, bool repeated = false) {
    tasks::TaskGraph graph("test", tasks::prune(list.tasks(), wanted, repeated), grid, table);
    materials_ = std::max(materials_, graph.materials());
    return graph;
  }
  /// Runs a graph and makes its results the old state.
  void step(tasks::TaskGraph& graph) {
    warehouse.grow(materials_);
    scheduler.run(graph, {7, 0.5});
    scheduler.commit(graph);
  }

  grid::Grid grid;
  const grid::Level& level = grid.level();
  data::VariableTable table;
  data::Warehouse warehouse;
  tasks::Scheduler scheduler;

 private:
  int materials_ = 0;
};

}  // namespace tushar::test
