#pragma once

#include <vector>

#include "components/euler/tasks/check_state.hpp"

namespace tushar::euler {

/// The children of a refined cell: the finer cells into which it was divided.
template <int D>
class Children {
 public:
  explicit Children(const Index<D>& parent) : parent_(parent) {}

  template <class Visit>
  void forEach(Visit&& visit) const {
    for (int k = 0; k < number; ++k) visit(at(k));
  }
  template <class Test>
  bool areAll(Test&& test) const {
    bool all = true;
    forEach([&](const Index<D>& cell) { all = all && test(cell); });
    return all;
  }
  /// Sets all children to their mean, which is the value of the parent.
  template <class View>
  void setToMean(const View& values) const {
    auto sum = values[at(0)];
    for (int k = 1; k < number; ++k) sum += values[at(k)];
    for (int k = 0; k < number; ++k) values[at(k)] = sum / number;
  }

 private:
  static constexpr int number = 1 << D;

  Index<D> at(int k) const {
    Index<D> cell;
    for (int d = 0; d < D; ++d) cell[d] = 2 * parent_[d] + ((k >> d) & 1);
    return cell;
  }

  Index<D> parent_;
};

/// Replaces impossible new cells by the mean over their parent. Since density, momentum and energy are interpolated
/// separately, the pressure next to a jump could be below -p_inf. In that case, all children of the parent get their
/// mean, which is the state of the parent, so conservation holds. `newCells` are boxes that consist of whole parents.
template <int D>
void mendNewCells(const Patch&, const Gas& gas, const std::vector<Box>& newCells, const ChangedState<D>& state) {
  const auto isFine = [&](const Index<D>& cell) {
    return canBe<D>(gas, &state.density[cell], state.momentum[cell].data(), &state.totalEnergy[cell], 1);
  };
  for (const Box& box : newCells)
    forEach<D>(box.coarsened(D), [&](const Index<D>& parent) {
      const Children<D> children(parent);
      if (children.areAll(isFine)) return;
      children.setToMean(state.density);
      children.setToMean(state.momentum);
      children.setToMean(state.totalEnergy);
    });
}

}  // namespace tushar::euler
