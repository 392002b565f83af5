#include "core/tasks/context.hpp"

#include "core/tasks/access.hpp"

namespace tushar::tasks {

data::Variable TaskContext::variable(int access) const {
  const BoundAccess& bound = (*accesses_)[access];
  return warehouse_->variable(bound.generation, bound.variable, patch_->id());
}

TaskContext::ParticlePlace TaskContext::particlePlace(int access) const {
  const BoundAccess& bound = (*accesses_)[access];
  return {variable(access).values, &warehouse_->particles(bound.set, material_, patch_->id()),
          bound.ghost > 0 ? patch_->cellsWithin(bound.ghost) : patch_->cells()};
}

TaskContext::GridPlace TaskContext::gridPlace(int access, data::Centring centring) const {
  const BoundAccess& bound = (*accesses_)[access];
  const data::Variable found = variable(access);
  if (bound.own) return {found.values, found.stored, warehouse_->grid().ownNodes(patch_->id())};
  const bool isOfNodes = centring == data::Centring::node;
  return {found.values, found.stored, isOfNodes ? patch_->nodesWithin(bound.ghost) : patch_->cellsWithin(bound.ghost)};
}

RankPatches patchesOf(const TaskContext& context) {
  RankPatches patches;
  for (const TaskContext& patch : context.ofPatches()) patches.push_back(&patch.patch());
  return patches;
}

}  // namespace tushar::tasks
