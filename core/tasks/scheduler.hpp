#pragma once

#include "core/tasks/task_graph.hpp"

namespace tushar::tasks {

/// Where in a run a graph is executed; named in errors.
struct StepInfo {
  int step = 0;
  double time = 0;  ///< s
};

/// Runs compiled task graphs on the warehouse of this rank.
class Scheduler {
 public:
  explicit Scheduler(data::Warehouse& warehouse) : warehouse_(&warehouse), relocation_(warehouse) {}

  /// Runs every task on every patch. A body that throws ends the run of the graph: a NumericalError comes out with
  /// task, patch, material, step and time added; anything else as TaskError. The old generation is never touched.
  void run(TaskGraph& graph, const StepInfo& at);
  /// Makes the results of a graph the old state.
  void commit(const TaskGraph& graph);

  Relocation& relocation() { return relocation_; }

 private:
  void exchange(CompiledTask& task);
  void runWork(CompiledTask& task, const StepInfo& at);
  void runPlaced(CompiledTask& task, const grid::Patch& patch, int material, const StepInfo& at);
  void allocateOutputs(const MaterialBinding& binding, const grid::Patch& patch, int material);
  void free(const CompiledTask& task);

  data::Warehouse* warehouse_;
  Relocation relocation_;
};

}  // namespace tushar::tasks
