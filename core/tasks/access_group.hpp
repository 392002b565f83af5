#pragma once

#include <utility>

#include "core/tasks/access.hpp"

// Accesses that a body gets by name, as one struct of views.

namespace tushar::tasks {

/// An empty set, for views without particles.
const data::ParticleSet& noParticles();

/// Placeholder for a view while a group only declares its accesses.
template <class View>
struct Blank {
  static View make() { return View{}; }
};
template <class T>
struct Blank<T&> {
  static T& make() {
    static thread_local T blank{};
    return blank;
  }
};
template <class T>
struct Blank<data::ParticleView<T>> {
  static data::ParticleView<T> make() { return {nullptr, noParticles(), grid::Box{}}; }
};
template <data::Centring C, class T>
struct Blank<data::GridView<C, T>> {
  static data::GridView<C, T> make() { return {nullptr, grid::Box{}}; }
};

/// Declares the accesses of a group in order.
template <Allowed allowed>
class DeclareEach {
 public:
  explicit DeclareEach(std::vector<Access>& accesses) : accesses_(&accesses) {}

  template <class Argument>
  decltype(auto) operator()(Argument argument) const {
    static_assert(
        isOfLabel<Argument>,
        "take(...) accepts only accesses to labels; pass other values to a group as settings, all<Group>(value)");
    checkAccess<allowed, Argument>();
    argument.declare(*accesses_);
    return Blank<decltype(argument.bind(std::declval<const TaskContext&>()))>::make();
  }

 private:
  std::vector<Access>* accesses_;
};

/// Returns the views of the same accesses in the same order.
class BindEach {
 public:
  BindEach(const TaskContext& context, int first) : context_(&context), next_(first) {}

  template <class Argument>
  decltype(auto) operator()(Argument argument) {
    argument.number(next_);
    return argument.bind(*context_);
  }

 private:
  const TaskContext* context_;
  int next_;
};

/// The argument made by the function `all`: `from(take)` makes the group, with the settings stored in `from`.
template <class Group, class From>
struct GroupArgument {
  From from;
  int first = 0;  ///< index of the group's first access among those of the task

  template <Allowed allowed>
  void declareFor(std::vector<Access>& accesses) {
    first = static_cast<int>(accesses.size());
    DeclareEach<allowed> take(accesses);
    from(take);
  }
  Group bind(const TaskContext& context) const {
    BindEach take(context, first);
    return from(take);
  }
};
template <class Group, class From>
inline constexpr bool isOfMaterialAndPatch<GroupArgument<Group, From>> = true;

/// The argument made by the function `totals`.
template <class Group, class From>
struct TotalsArgument : GroupArgument<Group, From> {
  template <Allowed>
  void declareFor(std::vector<Access>& accesses) {
    GroupArgument<Group, From>::template declareFor<Allowed{.fields = false}>(accesses);
  }
};

/// A function that makes a group with given settings. As a closure it costs the compiler less than a std::tuple of
/// them.
template <class Group, class... Settings>
auto groupMaker(Settings&... settings) {
  return [... each = std::move(settings)](auto& take) -> Group { return Group::from(take, each...); };
}

/// Accesses that the body receives as one `Group`: an aggregate of views whose `static Group from(auto& take, const
/// Settings&... settings)` gives each member its access by designated initialisers, `.mass =
/// take(requiresOld(p::mass))`. Recommended for bodies that use more than about eight variables. Groups can be nested:
/// `.particles = Placed<Shape>::from(take, settings)`. A task for several materials or patches receives a
/// std::vector<Group>. An access stores the address of its label, so a label among the settings must be passed by
/// pointer.
template <class Group, class... Settings>
auto all(Settings... settings) {
  static_assert(!(std::is_base_of_v<data::Label, Settings> || ...), "pass a label to all<Group>(...) by pointer");
  auto from = groupMaker<Group>(settings...);
  return GroupArgument<Group, decltype(from)>{std::move(from)};
}

/// Reducers that the body receives as one `Group` of references. Totals belong to no patch and no material, so the body
/// gets only one group, even in a task for several materials or patches.
template <class Group, class... Settings>
auto totals(Settings... settings) {
  static_assert(!(std::is_base_of_v<data::Label, Settings> || ...), "pass a label to totals<Group>(...) by pointer");
  auto from = groupMaker<Group>(settings...);
  return TotalsArgument<Group, decltype(from)>{{std::move(from)}};
}

}  // namespace tushar::tasks
