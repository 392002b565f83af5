#include <algorithm>
#include <utility>

#include "core/grid/choose_patches.hpp"
#include "core/tasks/scheduler.hpp"

// How many threads work on the patches of this rank, and which patches each of them gets, according to their costs.

namespace tushar::tasks {

std::vector<double> Scheduler::takeCosts() {
  costs_.resize(warehouse_->grid().patches().size());
  for (double& cost : costs_) cost /= threads_.count();
  return std::exchange(costs_, std::vector<double>(costs_.size()));
}

int Scheduler::usefulThreads() const {
  const int most = std::max(1, std::min(most_threads_, warehouse_->patches()));
  if (cells_per_thread_ == 0) return most;
  const double cells = static_cast<double>(warehouse_->grid().cellCount()) / warehouse_->ranks().size();
  return grid::usefulThreads(cells, cells_per_thread_, most);
}

void Scheduler::forgetLayout() {
  exchange_.forgetLayout();
  relocation_.forgetLayout();
  costs_.clear();
  with_patches_.reset();
  threads_.resize(usefulThreads());
  threads_.distribute({});
}

/// Now and then, gives each thread patches that have taken as long as those of the others. On several ranks, the times
/// are those since they were last used to distribute patches over ranks.
void Scheduler::distributeOverThreads() {
  constexpr int interval = 8;
  if (threads_.count() == 1 || ++runs_ % interval != 0) return;
  threads_.distribute(costs_);
  if (warehouse_->ranks().isAlone()) std::fill(costs_.begin(), costs_.end(), 0.0);
}

}  // namespace tushar::tasks
