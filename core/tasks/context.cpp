#include "core/tasks/context.hpp"

#include "core/tasks/access.hpp"

namespace tushar::tasks {

data::Variable TaskContext::variable(int access) const {
  const BoundAccess& bound = (*accesses_)[access];
  return warehouse_->variable(bound.generation, bound.variable, patch_->id());
}

TaskContext::ParticlePlace TaskContext::particlePlace(int access) const {
  const BoundAccess& bound = (*accesses_)[access];
  const int material = warehouse_->table()[bound.variable].material;
  const data::ParticleSet& set = warehouse_->particles(bound.set, material, patch_->id());
  std::byte* const values = variable(access).values;
  if (bound.ghost == 0) return {values, &set, patch_->cells()};
  const bool isAll = bound.ghost == warehouse_->table().reach(material);
  return {values, &set, isAll ? set.cells() : patch_->cellsWithin(bound.ghost)};
}

TaskContext::GridPlace TaskContext::gridPlace(int access, data::Centring centring) const {
  const BoundAccess& bound = (*accesses_)[access];
  const data::Variable found = variable(access);
  if (bound.own) return {found.values, found.stored, warehouse_->grid().ownNodes(patch_->id())};
  if (bound.ghost == warehouse_->table().ghost(bound.variable)) return {found.values, found.stored, found.stored};
  const bool isOfNodes = centring == data::Centring::node;
  return {found.values, found.stored, isOfNodes ? patch_->nodesWithin(bound.ghost) : patch_->cellsWithin(bound.ghost)};
}

RankPatches patchesOf(const TaskContext& context) {
  RankPatches patches;
  for (const TaskContext& patch : context.ofPatches()) patches.push_back(&patch.patch());
  return patches;
}

}  // namespace tushar::tasks
