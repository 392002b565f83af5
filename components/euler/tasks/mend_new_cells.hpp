#pragma once

#include <vector>

#include "components/euler/tasks/check_state.hpp"

namespace tushar::euler {

/// Density, momentum and energy of new cells are interpolated each by itself, so that beside a jump the pressure of
/// one could be below -p_inf, though that of its parent is not. There all children of the parent get their mean, which
/// is its state: nothing is lost. `newCells`: boxes of whole parents.
template <int D>
void mendNewCells(const Patch&, const Gas& gas, const std::vector<Box>& newCells, const ChangedState<D>& state) {
  constexpr int children = 1 << D;
  for (const Box& box : newCells)
    forEach<D>(box.coarsened(D), [&](const Index<D>& parent) {
      const auto child = [&](int k) {
        Index<D> cell;
        for (int d = 0; d < D; ++d) cell[d] = 2 * parent[d] + ((k >> d) & 1);
        return cell;
      };
      const auto isFine = [&](const Index<D>& cell) {
        return canBe<D>(gas, &state.density[cell], state.momentum[cell].data(), &state.totalEnergy[cell], 1);
      };
      bool areFine = true;
      for (int k = 0; k < children; ++k) areFine = areFine && isFine(child(k));
      if (areFine) return;
      const auto setToMean = [&](const auto& values) {
        auto sum = values[child(0)];
        for (int k = 1; k < children; ++k) sum += values[child(k)];
        for (int k = 0; k < children; ++k) values[child(k)] = sum / children;
      };
      setToMean(state.density);
      setToMean(state.momentum);
      setToMean(state.totalEnergy);
    });
}

}  // namespace tushar::euler
