#pragma once

#include <optional>
#include <type_traits>
#include <utility>

#include "core/tasks/context.hpp"
#include "core/tasks/task.hpp"

namespace tushar::tasks {

/// The patches of a rank, sorted by id.
using RankPatches = std::vector<const grid::Patch*>;

/// An access as an argument of a task: it declares the use of a variable, and corresponds to one parameter of the body.
template <class Label, AccessKind Kind>
struct FieldAccess;

template <data::Centring C, class T, AccessKind Kind>
struct FieldAccess<data::FieldLabel<C, T>, Kind> {
  const data::FieldLabel<C, T>* label;
  int ghost = 0;
  bool own = false;
  bool offered = false;
  /// `Kind`, or requiresNew if `Kind` is requiresOld: both have the same type of view.
  AccessKind kind = Kind;
  int index = -1;  ///< index among the task's accesses

  void declare(std::vector<Access>& accesses) { index = append(accesses, {label, kind, ghost, own, offered}); }
  void number(int& next) { index = next++; }

  static constexpr bool readOnly = Kind == AccessKind::requiresOld;
  using Element = std::conditional_t<readOnly, const T, T>;

  decltype(auto) bind(const TaskContext& context) const {
    if constexpr (Kind == AccessKind::creates)
      return (context.column<T>(index));
    else if constexpr (C == data::Centring::particle)
      return context.particles<Element>(index, *label);
    else
      return context.grid<C, Element>(index, *label);
  }
};

template <class R, AccessKind Kind>
struct FieldAccess<data::ReductionLabel<R>, Kind> {
  const data::ReductionLabel<R>* label;
  int index = -1;

  void declare(std::vector<Access>& accesses) { index = append(accesses, {label, Kind, 0}); }
  void number(int& next) { index = next++; }
  decltype(auto) bind(const TaskContext& context) const {
    if constexpr (Kind == AccessKind::computes)
      return (context.partOfReduction<R>(index));
    else
      return context.reduction<R>(index).value;
  }
};

/// A plain value passed to the body.
template <class T>
struct PlainArgument {
  T value;
  void declare(std::vector<Access>&) {}
  const T& bind(const TaskContext&) const { return value; }
};

/// For a task that runs once per rank: passes the communicator of all ranks with patches, which run the task together.
struct RanksArgument {
  void declare(std::vector<Access>&) {}
  const mpi::Communicator& bind(const TaskContext& context) const { return context.ranks(); }
};
inline RanksArgument togetherOnRanks() { return {}; }

/// The ranks that run a task together, and the threads of this rank, which are free meanwhile.
struct Workers {
  const mpi::Communicator& ranks;
  Threads& threads;
};
/// Calls work(p) for each patch number p of a rank, on its threads.
template <class Work>
void forEachOn(const Workers& workers, const RankPatches& patches, const Work& work) {
  workers.threads.forEach(static_cast<int>(patches.size()), [&](int p) { work(static_cast<std::size_t>(p)); });
}
/// For a task that runs once per rank: passes its Workers.
struct WorkersArgument {
  void declare(std::vector<Access>&) {}
  Workers bind(const TaskContext& context) const { return {context.ranks(), context.threads()}; }
};
inline WorkersArgument withWorkers() { return {}; }

/// The patches of a task that runs once per rank, sorted by id.
RankPatches patchesOf(const TaskContext& context);

/// Reads the state at the start of the step: a view of const T over the patch and `ghost` layers of cells or nodes
/// around it.
template <data::Centring C, class T>
FieldAccess<data::FieldLabel<C, T>, AccessKind::requiresOld> requiresOld(const data::FieldLabel<C, T>& label,
                                                                         int ghost = 0) {
  return {&label, ghost};
}
/// Reads a reduction known at the start of the step, such as delT: a double.
template <class R>
FieldAccess<data::ReductionLabel<R>, AccessKind::requiresOld> requiresOld(const data::ReductionLabel<R>& label) {
  return {&label};
}
/// Reads values computed by an earlier task: a view of const T over the patch and `ghost` layers of cells or nodes
/// around it.
template <data::Centring C, class T>
FieldAccess<data::FieldLabel<C, T>, AccessKind::requiresOld> requiresNew(const data::FieldLabel<C, T>& label,
                                                                         int ghost = 0) {
  return {&label, ghost, false, false, AccessKind::requiresNew};
}
/// Writes every value of the patch: a view of T. The values are undefined before the task (NaN in the dev preset).
template <data::Centring C, class T>
FieldAccess<data::FieldLabel<C, T>, AccessKind::computes> computes(const data::FieldLabel<C, T>& label) {
  return {&label};
}
/// Writes every node that the patch owns (Grid::ownNodes), so that no two patches of a rank write the same node. The
/// framework fills in the other nodes of the patch after the task, from the patches that own them.
template <class T>
FieldAccess<data::NodeLabel<T>, AccessKind::computes> computesOwn(const data::NodeLabel<T>& label) {
  return {&label, 0, true};
}
/// Contributes to a reduction over the whole grid: a reference to the reducer R.
template <class R>
FieldAccess<data::ReductionLabel<R>, AccessKind::computes> computes(const data::ReductionLabel<R>& label) {
  return {&label};
}
/// Changes values computed by an earlier task: a view of T.
template <data::Centring C, class T>
FieldAccess<data::FieldLabel<C, T>, AccessKind::modifies> modifies(const data::FieldLabel<C, T>& label) {
  return {&label};
}
/// Sets the values of the new particles: a std::vector<T> to append to, in the order of ParticleMaker::add.
template <class T>
FieldAccess<data::ParticleLabel<T>, AccessKind::creates> creates(const data::ParticleLabel<T>& label) {
  return {&label};
}
/// An access that only some scenes need; see `when`.
template <class Access>
struct OptionalAccess {
  bool on;
  Access access;

  void declare(std::vector<tasks::Access>& accesses) {
    if (on) access.declare(accesses);
  }
  void number(int& next) {
    if (on) access.number(next);
  }
  auto bind(const TaskContext& context) const { return on ? std::optional(access.bind(context)) : std::nullopt; }
};
/// An access that is declared only if `on` is true: the body gets a std::optional view.
template <class Label, AccessKind Kind>
OptionalAccess<FieldAccess<Label, Kind>> when(bool on, FieldAccess<Label, Kind> access) {
  using View = decltype(access.bind(std::declval<const TaskContext&>()));
  static_assert(
      !std::is_reference_v<View>,
      "when(...) accepts only accesses that become views; a reducer or a list of new values cannot be optional");
  return {on, access};
}

/// An output that a task computes only if something reads it; see `offers`.
template <class Access>
struct OfferedAccess {
  Access access;

  void declare(std::vector<tasks::Access>& accesses) { access.declare(accesses); }
  void number(int& next) { access.number(next); }
  auto bind(const TaskContext& context) const {
    return context.isWanted(access.index) ? std::optional(access.bind(context)) : std::nullopt;
  }
};
/// Computes a costly output that only some scenes need: like `computes` if a later task, another list or the scene's
/// outputs read it, otherwise not allocated. The body gets a std::optional view.
template <data::Centring C, class T>
OfferedAccess<FieldAccess<data::FieldLabel<C, T>, AccessKind::computes>> offers(const data::FieldLabel<C, T>& label) {
  return {{&label, 0, false, true}};
}

/// The fluxes of a cell variable through the faces at which the level of the patch ends.
template <class T>
struct FluxAccess {
  const data::CellLabel<T>* label;
  int index = -1;

  void declare(std::vector<Access>& accesses) {
    index = append(accesses, {&data::rimLabelOf(*label), AccessKind::computes, 0, false, true, label});
  }
  void number(int& next) { index = next++; }
  data::RimFlux<T> bind(const TaskContext& context) const {
    return context.isWanted(index) ? context.flux<T>(index) : data::RimFlux<T>();
  }
};
/// Stores the fluxes of a variable at faces where the level of the patch ends, so that the framework can make the
/// fluxes of both levels equal. The body receives a RimFlux<T> and adds to it the amount of the variable that passes
/// through each face, along the axis, per unit area and time. On a single level, the RimFlux is empty. Use this access
/// in tasks of scheduleTimeAdvance that compute or modify the variable, and that change a cell by dt / h times the
/// difference of such fluxes.
template <class T>
FluxAccess<T> keepsFlux(const data::CellLabel<T>& label) {
  static_assert(data::Stored<T>::number == data::Number::real, "keepsFlux(...) accepts only labels of real numbers");
  return {&label};
}

/// The time at the start of the step [s], passed as a double.
struct TimeArgument {
  void declare(std::vector<Access>&) {}
  double bind(const TaskContext& context) const { return context.time(); }
};
inline TimeArgument startTime() { return {}; }
/// Passes `value` to the body unchanged.
template <class T>
PlainArgument<T> with(T value) {
  return {std::move(value)};
}

/// Whether an argument represents variables of a material on a patch; a task over several materials or patches then
/// gets one view for each.
template <class Argument>
inline constexpr bool isOfMaterialAndPatch = false;
template <data::Centring C, class T, AccessKind Kind>
inline constexpr bool isOfMaterialAndPatch<FieldAccess<data::FieldLabel<C, T>, Kind>> = true;
template <class Access>
inline constexpr bool isOfMaterialAndPatch<OptionalAccess<Access>> = isOfMaterialAndPatch<Access>;
template <class Access>
inline constexpr bool isOfMaterialAndPatch<OfferedAccess<Access>> = isOfMaterialAndPatch<Access>;
template <class T>
inline constexpr bool isOfMaterialAndPatch<FluxAccess<T>> = true;

/// Whether an argument represents a variable; other arguments are plain values, such as that of `with`.
template <class Argument>
inline constexpr bool isOfLabel = isOfMaterialAndPatch<Argument>;
template <class R, AccessKind Kind>
inline constexpr bool isOfLabel<FieldAccess<data::ReductionLabel<R>, Kind>> = true;

/// Whether an argument represents a variable of particles, which belongs to a material.
template <class Argument>
inline constexpr bool isOfParticles = false;
template <class T, AccessKind Kind>
inline constexpr bool isOfParticles<FieldAccess<data::ParticleLabel<T>, Kind>> = true;
template <class Access>
inline constexpr bool isOfParticles<OptionalAccess<Access>> = isOfParticles<Access>;
template <class Access>
inline constexpr bool isOfParticles<OfferedAccess<Access>> = isOfParticles<Access>;

/// Whether an argument creates values of new particles.
template <class Argument>
inline constexpr bool isCreation = false;
template <class Label>
inline constexpr bool isCreation<FieldAccess<Label, AccessKind::creates>> = true;

/// The variables that a task, or a group of accesses, may have.
struct Allowed {
  bool creation = false;   ///< creates(...)
  bool particles = false;  ///< variables of particles
  bool fields = true;      ///< variables of patches: of cells, nodes and particles
};
/// Rejects, at compile time, an access that is not allowed.
template <Allowed allowed, class Argument>
constexpr void checkAccess() {
  static_assert(allowed.fields || !isOfMaterialAndPatch<Argument>,
                "totals<Group>() accepts only reductions; use all<Group>() for variables of patches");
  static_assert(allowed.creation || !isCreation<Argument>,
                "creates(...) is allowed only in newParticles, even in a group");
  static_assert(allowed.particles || !isOfParticles<Argument>,
                "a variable of particles belongs to a material: it is allowed only in tasks with materials");
}
/// Declares an access, or the accesses of a group.
template <Allowed allowed, class Argument>
void declareChecked(Argument& argument, std::vector<Access>& accesses) {
  if constexpr (requires { argument.template declareFor<allowed>(accesses); }) {
    argument.template declareFor<allowed>(accesses);
  } else {
    checkAccess<allowed, Argument>();
    argument.declare(accesses);
  }
}

/// An access to a variable that does not belong to a material, in a task over materials.
template <class Argument>
struct WithoutMaterial {
  Argument argument;

  template <Allowed>
  void declareFor(std::vector<Access>& accesses) {
    const std::size_t first = accesses.size();
    declareChecked<Allowed{}>(argument, accesses);
    for (std::size_t k = first; k < accesses.size(); ++k) accesses[k].ofNone = true;
  }
  decltype(auto) bind(const TaskContext& context) const { return argument.bind(context); }
};
/// In a task over materials, marks a variable that belongs to none of them: the body gets a single view, or a single
/// group. perMaterial may only read such variables.
template <class Argument>
WithoutMaterial<Argument> withoutMaterial(Argument argument) {
  static_assert(isOfMaterialAndPatch<Argument>, "withoutMaterial(...) accepts only an access to a variable of a patch");
  return {std::move(argument)};
}
template <class Argument>
inline constexpr bool isWithoutMaterial = false;
template <class Argument>
inline constexpr bool isWithoutMaterial<WithoutMaterial<Argument>> = true;

/// An access to variables of given materials, whatever the materials of the task.
template <class Argument>
struct OfMaterials {
  MaterialRange range;
  Argument argument;
  std::vector<Argument> ofEach = {};

  template <Allowed>
  void declareFor(std::vector<Access>& accesses) {
    for (int material = range.first; material < range.end; ++material) {
      const std::size_t first = accesses.size();
      declareChecked<Allowed{.particles = true}>(ofEach.emplace_back(argument), accesses);
      for (std::size_t k = first; k < accesses.size(); ++k) accesses[k].ofMaterial = material;
    }
  }
  auto bind(const TaskContext& context) const {
    std::vector<std::decay_t<decltype(argument.bind(context))>> views;
    for (const Argument& one : ofEach) views.push_back(one.bind(context));
    return views;
  }
};
/// Reads variables of given materials: the body gets a std::vector with one view, or one group, for each of them, in
/// the order of their indices.
template <class Argument>
OfMaterials<Argument> ofMaterials(MaterialRange range, Argument argument) {
  static_assert(isOfMaterialAndPatch<Argument>, "ofMaterials(...) accepts only an access to a variable of a patch");
  return {range, std::move(argument)};
}

/// Whether an argument is allowed only in tasks that run once per rank; whether it is that of marks();
/// whether it passes cells of a patch, as newCells() does.
template <class Argument>
inline constexpr bool isOfRanks = std::is_same_v<Argument, RanksArgument> || std::is_same_v<Argument, WorkersArgument>;
template <class Argument>
inline constexpr bool isMarks = false;
template <class Argument>
inline constexpr bool isNewCells = false;

/// The results of calling `bind` for each element of `contexts`.
template <class Contexts, class Bind>
auto bindEach(const Contexts& contexts, Bind bind) {
  std::vector<std::decay_t<decltype(bind(contexts[0]))>> views;
  views.reserve(contexts.size());
  for (const TaskContext& one : contexts) views.push_back(bind(one));
  return views;
}

/// The value of an argument in a task over all materials: for labels, one view per material.
template <class Argument>
decltype(auto) bindAll(const Argument& argument, const TaskContext& context) {
  if constexpr (isOfMaterialAndPatch<Argument>)
    return bindEach(context.ofMaterials(), [&](const TaskContext& one) { return argument.bind(one); });
  else
    return argument.bind(context);
}

/// The value of an argument in a task over the whole rank: for labels, one view per patch.
template <class Argument>
decltype(auto) bindRank(const Argument& argument, const TaskContext& context) {
  if constexpr (isOfMaterialAndPatch<Argument>)
    return bindEach(context.ofPatches(), [&](const TaskContext& patch) { return argument.bind(patch); });
  else
    return argument.bind(context);
}
/// The value of an argument in a task over all materials of the whole rank: `views[patch][material]`.
template <class Argument>
decltype(auto) bindRankAll(const Argument& argument, const TaskContext& context) {
  if constexpr (isOfMaterialAndPatch<Argument>)
    return bindEach(context.ofPatches(), [&](const TaskContext& patch) { return bindAll(argument, patch); });
  else
    return argument.bind(context);
}

}  // namespace tushar::tasks
