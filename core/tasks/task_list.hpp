#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/tasks/access_group.hpp"

namespace tushar::tasks {

/// Materials that follow others: their indices continue those of `before`. A component whose materials have different
/// variables, such as bodies and the cohesive zones between them, declares separate tasks for both.
template <class Material>
struct Following {
  std::vector<std::string> before;         ///< names of the materials before them
  const std::vector<Material>* materials;  ///< must outlive the list

  int first() const { return static_cast<int>(before.size()); }
};
/// The materials of `later`, whose indices continue those of `before`.
template <class Before, class Material>
Following<Material> following(const std::vector<Before>& before, const std::vector<Material>& later) {
  Following<Material> result{{}, &later};
  for (const Before& material : before) result.before.push_back(material.name);
  return result;
}

/// The tasks of one phase of a run, in the order in which a component declares them.
///
/// A task is added in the same way as a std::thread is started: a function and its arguments. Each access becomes one
/// parameter of the body, so a body can neither read an undeclared variable nor forget a declared one.
class TaskList {
 public:
  /// Adds a task that runs `body(patch, arguments...)` on each patch.
  template <class Body, class... Arguments>
  void perPatch(std::string_view name, Body body, Arguments... arguments) {
    check<On::patch, Arguments...>();
    static_assert(!(isWithoutMaterial<Arguments> || ...),
                  "withoutMaterial(...) is not needed in perPatch, whose tasks have no materials");
    std::vector<Access> accesses = declare<allowedIn(On::patch)>(arguments...);
    add(name, TaskKind::work, {}, std::move(accesses),
        [body, ... bound = std::move(arguments)](const TaskContext& context) {
          body(context.patch(), bound.bind(context)...);
        });
  }

  /// Adds a task that runs `body(patch, material, arguments...)` on each patch, for each of `materials`, which must
  /// outlive the list and have a `name`. The labels are variables of the material.
  template <class Material, class Body, class... Arguments>
  void perMaterial(std::string_view name, Body body, const std::vector<Material>& materials, Arguments... arguments) {
    check<On::material, Arguments...>();
    std::vector<Access> accesses = declare<allowedIn(On::material)>(arguments...);
    add(name, TaskKind::work, names(materials), std::move(accesses),
        [body, &materials, ... bound = std::move(arguments)](const TaskContext& context) {
          body(context.patch(), materials[context.material()], bound.bind(context)...);
        });
  }

  /// The same for materials that follow others.
  template <class Material, class Body, class... Arguments>
  void perMaterial(std::string_view name, Body body, const Following<Material>& later, Arguments... arguments) {
    check<On::material, Arguments...>();
    std::vector<Access> accesses = declare<allowedIn(On::material)>(arguments...);
    add(name, TaskKind::work, names(later), std::move(accesses),
        [body, first = later.first(), materials = later.materials,
         ... bound = std::move(arguments)](const TaskContext& context) {
          body(context.patch(), (*materials)[context.material() - first], bound.bind(context)...);
        });
    tasks_.back().firstMaterial = later.first();
  }

  /// Adds a task that runs `body(patch, materials, arguments...)` once on each patch, with all materials: an access to
  /// a label becomes a std::vector of views, one for each material.
  template <class Material, class Body, class... Arguments>
  void acrossMaterials(std::string_view name, Body body, const std::vector<Material>& materials,
                       Arguments... arguments) {
    check<On::materials, Arguments...>();
    std::vector<Access> accesses = declare<allowedIn(On::materials)>(arguments...);
    add(
        name, TaskKind::work, names(materials), std::move(accesses),
        [body, &materials, ... bound = std::move(arguments)](const TaskContext& context) {
          body(context.patch(), materials, bindAll(bound, context)...);
        },
        Sees::allMaterials);
  }

  /// Adds a task that runs `body(patches, arguments...)` once on a rank, for work that needs all patches together, such
  /// as a linear solve: an access to a label becomes a std::vector of views, one for each patch.
  template <class Body, class... Arguments>
  void perRank(std::string_view name, Body body, Arguments... arguments) {
    check<On::rank, Arguments...>();
    std::vector<Access> accesses = declare<allowedIn(On::rank)>(arguments...);
    add(
        name, TaskKind::work, {}, std::move(accesses),
        [body, ... bound = std::move(arguments)](const TaskContext& context) {
          body(patchesOf(context), bindRank(bound, context)...);
        },
        Sees::rank);
  }

  /// Adds a task that runs `body(patches, materials, arguments...)` once on a rank, for variables of materials: an
  /// access becomes `views[patch][material]`.
  template <class Material, class Body, class... Arguments>
  void perRankAcrossMaterials(std::string_view name, Body body, const std::vector<Material>& materials,
                              Arguments... arguments) {
    check<On::rankAndMaterials, Arguments...>();
    std::vector<Access> accesses = declare<allowedIn(On::rankAndMaterials)>(arguments...);
    add(
        name, TaskKind::work, names(materials), std::move(accesses),
        [body, &materials, ... bound = std::move(arguments)](const TaskContext& context) {
          body(patchesOf(context), materials, bindRankAll(bound, context)...);
        },
        Sees::rank);
  }

  /// Adds a task that runs `body(patch, material, maker, arguments...)`: the new particles replace those of the patch.
  /// The task must create all particle variables that are needed afterwards; node and cell variables stay.
  template <class Material, class Body, class... Arguments>
  void newParticles(std::string_view name, Body body, const std::vector<Material>& materials, Arguments... arguments) {
    check<On::newParticles, Arguments...>();
    std::vector<Access> accesses = declare<allowedIn(On::newParticles)>(arguments...);
    add(name, TaskKind::newParticles, names(materials), std::move(accesses),
        [body, &materials, ... bound = std::move(arguments)](const TaskContext& context) {
          body(context.patch(), materials[context.material()], context.maker(), bound.bind(context)...);
        });
  }

  /// The same for materials that follow others.
  template <class Material, class Body, class... Arguments>
  void newParticles(std::string_view name, Body body, const Following<Material>& later, Arguments... arguments) {
    check<On::newParticles, Arguments...>();
    std::vector<Access> accesses = declare<allowedIn(On::newParticles)>(arguments...);
    add(name, TaskKind::newParticles, names(later), std::move(accesses),
        [body, first = later.first(), materials = later.materials,
         ... bound = std::move(arguments)](const TaskContext& context) {
          body(context.patch(), (*materials)[context.material() - first], context.maker(), bound.bind(context)...);
        });
    tasks_.back().firstMaterial = later.first();
  }

  /// Adds a relocation: afterwards, every particle is in the cell and on the patch that contain its `position`, which
  /// an earlier task must have computed. All particle variables that are needed afterwards are moved as well.
  /// `materials` are those of all particles, also if they are Following.
  template <int D, class Materials>
  void relocate(const data::ParticleLabel<Vec<D>>& position, const Materials& materials) {
    add({"relocate", TaskKind::relocate, names(materials), {{&position, AccessKind::requiresNew, 0}}, {}});
  }

  const std::vector<Task>& tasks() const { return tasks_; }
  void add(Task task);

 private:
  /// What one call of a body receives.
  enum class Sees { patch, allMaterials, rank };

  void add(std::string_view name, TaskKind kind, std::vector<std::string>&& materials, std::vector<Access>&& accesses,
           TaskBody&& body, Sees sees = Sees::patch);

  /// The kinds of tasks, by the function that adds them.
  enum class On { patch, material, materials, rank, rankAndMaterials, newParticles };
  static constexpr Allowed allowedIn(On on) {
    return {.creation = on == On::newParticles, .particles = on != On::patch && on != On::rank};
  }
  /// Rejects, at compile time, arguments that are meaningless for a kind of task.
  template <On on, class... Arguments>
  static constexpr void check() {
    constexpr bool isOnRank = on == On::rank || on == On::rankAndMaterials;
    static_assert(isOnRank || !(isOfRanks<Arguments> || ...),
                  "togetherOnRanks() and withWorkers() are allowed only in perRank and perRankAcrossMaterials");
    static_assert(!(isOnRank || on == On::newParticles) || !(isWithoutMaterial<Arguments> || ...),
                  "withoutMaterial(...) is allowed only in perMaterial and acrossMaterials");
    static_assert(on == On::patch || !(isMarks<Arguments> || ...), "marks() is allowed only in perPatch");
    static_assert(!isOnRank || !(isNewCells<Arguments> || ...),
                  "newCells() and besideFiner() are allowed only in tasks of a patch, not in those of a rank");
  }
  template <Allowed allowed, class... Arguments>
  static std::vector<Access> declare(Arguments&... arguments) {
    std::vector<Access> accesses;
    (declareChecked<allowed>(arguments, accesses), ...);
    return accesses;
  }
  template <class Material>
  [[gnu::noinline]] static std::vector<std::string> names(const std::vector<Material>& materials) {
    std::vector<std::string> result;
    for (const Material& material : materials) result.push_back(material.name);
    return result;
  }
  /// The names of the materials before the later ones, and of these.
  template <class Material>
  [[gnu::noinline]] static std::vector<std::string> names(const Following<Material>& later) {
    std::vector<std::string> result = later.before;
    for (const Material& material : *later.materials) result.push_back(material.name);
    return result;
  }

  std::vector<Task> tasks_;
};

}  // namespace tushar::tasks
