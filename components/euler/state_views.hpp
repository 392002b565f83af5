#pragma once

#include <type_traits>
#include <vector>

#include "components/euler/labels.hpp"
#include "components/euler/mixture.hpp"

namespace tushar::euler {

/// Views of the state that a step reads (T is const double) or writes (T is double).
template <int D, class T>
struct StateViews {
  CellView<T> density;
  CellView<std::conditional_t<std::is_const_v<T>, const Vec<D>, Vec<D>>> momentum;
  CellView<T> totalEnergy;
};

/// Views of the state of several gases: of the mixture as a whole, and of each gas.
template <int D, class T>
struct MixtureViews : StateViews<D, T> {
  std::vector<CellView<T>> masses, shares;
};
/// The type of the views for K gases.
template <int D, int K, class T>
using ViewsOf = std::conditional_t<K == 1, StateViews<D, T>, MixtureViews<D, T>>;

/// The accesses to the state at the start of a step, with `ghost` layers of cells around the patch.
template <int D>
struct OldState : StateViews<D, const double> {
  static OldState from(auto& take, int ghost) {
    return {{take(requiresOld(c::density, ghost)), take(requiresOld(c::momentum<D>, ghost)),
             take(requiresOld(c::totalEnergy, ghost))}};
  }
};

/// The accesses to the state that a step computes.
template <int D>
struct NewState : StateViews<D, double> {
  static NewState from(auto& take) {
    return {{take(computes(c::density)), take(computes(c::momentum<D>)), take(computes(c::totalEnergy))}};
  }
};

/// The accesses to the state that a task changes.
template <int D>
struct ChangedState : StateViews<D, double> {
  static ChangedState from(auto& take) {
    return {{take(modifies(c::density)), take(modifies(c::momentum<D>)), take(modifies(c::totalEnergy))}};
  }
};

}  // namespace tushar::euler
