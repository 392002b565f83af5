#pragma once

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/tasks/access_group.hpp"

namespace tushar::tasks {

/// The tasks of one phase of a run, in the order in which a component declares them.
///
/// A task is added as one starts a std::thread: a function and its arguments. Each access becomes one parameter of
/// the body, so a body can neither read what it did not declare nor forget what it did.
class TaskList {
 public:
  /// Runs `body(patch, arguments...)` on each patch.
  template <class Body, class... Arguments>
  void perPatch(std::string name, Body body, Arguments... arguments) {
    check<false, false, Arguments...>();
    static_assert(!(isWithoutMaterial<Arguments> || ...), "a task of perPatch has no materials to leave out");
    std::vector<Access> accesses = declare<false>(arguments...);
    add({std::move(name),
         TaskKind::work,
         {},
         std::move(accesses),
         [body, bound = std::make_tuple(arguments...)](const TaskContext& context) {
           std::apply([&](const auto&... argument) { body(context.patch(), argument.bind(context)...); }, bound);
         }});
  }

  /// Runs `body(patch, material, arguments...)` on each patch, for each of `materials`, which must outlive the list
  /// and have a `name`. The labels are variables of the material.
  template <class Material, class Body, class... Arguments>
  void perMaterial(std::string name, Body body, const std::vector<Material>& materials, Arguments... arguments) {
    check<false, false, Arguments...>();
    std::vector<Access> accesses = declare<false>(arguments...);
    add({std::move(name), TaskKind::work, names(materials), std::move(accesses),
         [body, &materials, bound = std::make_tuple(arguments...)](const TaskContext& context) {
           const Material& material = materials[context.material()];
           std::apply([&](const auto&... argument) { body(context.patch(), material, argument.bind(context)...); },
                      bound);
         }});
  }

  /// Runs `body(patch, materials, arguments...)` on each patch, once for all materials: an access to a label becomes a
  /// std::vector of views, one for each material.
  template <class Material, class Body, class... Arguments>
  void acrossMaterials(std::string name, Body body, const std::vector<Material>& materials, Arguments... arguments) {
    check<false, false, Arguments...>();
    std::vector<Access> accesses = declare<false>(arguments...);
    add({std::move(name), TaskKind::work, names(materials), std::move(accesses),
         [body, &materials, bound = std::make_tuple(arguments...)](const TaskContext& context) {
           std::apply([&](const auto&... argument) { body(context.patch(), materials, bindAll(argument, context)...); },
                      bound);
         },
         true});
  }

  /// Runs `body(patches, arguments...)` once on a rank, for what takes all patches at once, such as a linear solve: an
  /// access to a label becomes a std::vector of views, one for each patch.
  template <class Body, class... Arguments>
  void perRank(std::string name, Body body, Arguments... arguments) {
    check<false, true, Arguments...>();
    std::vector<Access> accesses = declare<false>(arguments...);
    addPerRank({std::move(name),
                TaskKind::work,
                {},
                std::move(accesses),
                [body, bound = std::make_tuple(arguments...)](const TaskContext& context) {
                  std::apply([&](const auto&... argument) { body(patchesOf(context), bindRank(argument, context)...); },
                             bound);
                }});
  }

  /// Runs `body(patches, materials, arguments...)` once on a rank, for variables of materials: an access becomes
  /// `views[patch][material]`.
  template <class Material, class Body, class... Arguments>
  void perRankAcrossMaterials(std::string name, Body body, const std::vector<Material>& materials,
                              Arguments... arguments) {
    check<false, true, Arguments...>();
    std::vector<Access> accesses = declare<false>(arguments...);
    addPerRank(
        {std::move(name), TaskKind::work, names(materials), std::move(accesses),
         [body, &materials, bound = std::make_tuple(arguments...)](const TaskContext& context) {
           std::apply(
               [&](const auto&... argument) { body(patchesOf(context), materials, bindRankAll(argument, context)...); },
               bound);
         }});
  }

  /// Runs `body(patch, material, maker, arguments...)`: the particles that the body makes replace those of the patch.
  /// Particle variables that are needed afterwards must be among what it `creates`; node and cell variables stay.
  template <class Material, class Body, class... Arguments>
  void newParticles(std::string name, Body body, const std::vector<Material>& materials, Arguments... arguments) {
    check<true, false, Arguments...>();
    std::vector<Access> accesses = declare<true>(arguments...);
    add({std::move(name), TaskKind::newParticles, names(materials), std::move(accesses),
         [body, &materials, bound = std::make_tuple(arguments...)](const TaskContext& context) {
           const Material& material = materials[context.material()];
           std::apply(
               [&](const auto&... argument) {
                 body(context.patch(), material, context.maker(), argument.bind(context)...);
               },
               bound);
         }});
  }

  /// From here on every particle is where `position` (computed before) says: in its new cell, on its new patch.
  /// All particle variables that are needed afterwards go with it.
  template <class Material, int D>
  void relocate(const data::ParticleLabel<Vec<D>>& position, const std::vector<Material>& materials) {
    add({"relocate", TaskKind::relocate, names(materials), {{&position, AccessKind::requiresNew, 0}}, {}});
  }

  const std::vector<Task>& tasks() const { return tasks_; }
  void add(Task task) { tasks_.push_back(std::move(task)); }

 private:
  void addPerRank(Task task) {
    task.perRank = true;
    add(std::move(task));
  }
  /// Refuses arguments that mean nothing to a kind of task.
  template <bool makesParticles, bool isOnRank, class... Arguments>
  static constexpr void check() {
    static_assert(makesParticles || !(isCreation<Arguments> || ...), "creates(...) belongs to newParticles");
    static_assert(isOnRank || !(isOfRanks<Arguments> || ...),
                  "togetherOnRanks() belongs to perRank and perRankAcrossMaterials");
    static_assert(!isOnRank || !(isWithoutMaterial<Arguments> || ...),
                  "withoutMaterial(...) belongs to perMaterial and acrossMaterials");
  }
  template <bool makesParticles, class Argument>
  static void declareOne(Argument& argument, std::vector<Access>& accesses) {
    if constexpr (requires { argument.template declareFor<makesParticles>(accesses); })
      argument.template declareFor<makesParticles>(accesses);
    else
      argument.declare(accesses);
  }
  template <bool makesParticles, class... Arguments>
  static std::vector<Access> declare(Arguments&... arguments) {
    std::vector<Access> accesses;
    (declareOne<makesParticles>(arguments, accesses), ...);
    return accesses;
  }
  template <class Material>
  static std::vector<std::string> names(const std::vector<Material>& materials) {
    std::vector<std::string> result;
    for (const Material& material : materials) result.push_back(material.name);
    return result;
  }

  std::vector<Task> tasks_;
};

}  // namespace tushar::tasks
