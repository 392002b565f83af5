#include <algorithm>

#include "core/tasks/copy_cells.hpp"
#include "core/tasks/exchange.hpp"

// Ghosts in coarser cells of variables that are interpolated together.

namespace tushar::tasks {

using mpi::Bytes;

/// Finds the joints of which all variables are filled, in the same generation.
void Exchange::findJoints() {
  joints_.clear();
  joint_of_.assign(fills_.size(), -1);
  of_coarser_.assign(fills_.size(), {});
  for (const data::VariableTable::Joint& joint : warehouse_->table().joints())
    for (const data::Generation generation : {data::Generation::old, data::Generation::fresh}) {
      JointFill together{&joint, {}};
      for (const int variable : joint.variables)
        for (std::size_t k = 0; k < fills_.size(); ++k)
          if (fills_[k].variable == variable && fills_[k].generation == generation) together.fills.push_back(k);
      if (together.fills.size() != joint.variables.size()) continue;
      for (const std::size_t fill : together.fills) {
        joint_of_[fill] = static_cast<int>(joints_.size());
        if (!warehouse_->ranks().isAlone()) of_coarser_[fill].resize(warehouse_->grid().patches().size());
      }
      joints_.push_back(std::move(together));
    }
}

/// Whether no ghost of any variable of a joint comes from another rank.
bool Exchange::isLocal(const JointFill& joint, std::size_t place) const {
  return std::all_of(joint.fills.begin(), joint.fills.end(),
                     [&](std::size_t fill) { return planOf(fills_[fill]).isLocal[place]; });
}

void Exchange::fillTogether(const JointFill& joint, std::size_t place) {
  if (planOf(fills_[joint.fills.front()]).coarse[place].empty()) return;
  thread_local std::vector<Bytes> memory;
  thread_local std::vector<Bytes*> coarse;
  if (memory.size() < joint.fills.size()) memory.resize(joint.fills.size());
  coarse.clear();
  for (std::size_t k = 0; k < joint.fills.size(); ++k) {
    gatherCoarse(fills_[joint.fills[k]], place, nullptr, memory[k]);
    coarse.push_back(&memory[k]);
  }
  fillTogether(joint, place, coarse);
}

/// Interpolates the ghosts of a patch from the values that gatherCoarse has found for each variable of a joint.
void Exchange::fillTogether(const JointFill& together, std::size_t place, const std::vector<Bytes*>& coarse) {
  const data::VariableTable::Joint& joint = *together.joint;
  const int dimension = warehouse_->grid().dimension(), patch = warehouse_->grid().patches()[place].id();
  thread_local std::vector<CellValues> from;
  std::size_t cells = 0;  // of the parts so far
  for (const CoarseGhosts& part : planOf(fills_[together.fills.front()]).coarse[place]) {
    from.clear();
    for (std::size_t k = 0; k < coarse.size(); ++k)
      from.push_back({coarse[k]->data() + cells * joint.labels[k]->bytes, part.cells});
    cells += part.cells.size();
    const std::vector<CellValues>& fine = prolongTogether(joint, dimension, from, part.ghosts);
    for (std::size_t k = 0; k < fine.size(); ++k) {
      const FilledValues values(*warehouse_, fills_[together.fills[k]]);
      copyCells(part.ghosts, {}, values.label.bytes, fine[k], values.on(patch));
    }
  }
}

void Exchange::fillTogetherFromElsewhere() {
  for (const JointFill& joint : joints_)
    for (std::size_t place = 0; place < warehouse_->grid().patches().size(); ++place) {
      if (isLocal(joint, place)) continue;
      std::vector<Bytes*> coarse;
      for (const std::size_t fill : joint.fills) coarse.push_back(&of_coarser_[fill][place]);
      fillTogether(joint, place, coarse);
    }
}

}  // namespace tushar::tasks
