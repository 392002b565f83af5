#pragma once

#include "components/euler/labels.hpp"
#include "components/euler/rows.hpp"

namespace tushar::euler {

namespace c {
/// The mass that flows through the lower and the upper faces of cells, for scalars that are transported with the gas.
template <int D>
inline constexpr std::array<CellLabel<Vec<D>>, 2> massFlux{
    {{"c.massFluxBelow", "kg/(m^2 s)", "mass through the lower faces"},
     {"c.massFluxAbove", "kg/(m^2 s)", "mass through the upper faces"}}};
}  // namespace c

/// The mass flux through the faces of cells in a step, per unit area and time; empty if no task needs it.
template <int D>
struct FaceMasses {
  std::optional<CellView<Vec<D>>> below = {}, above = {};

  static FaceMasses from(auto& take, bool areKept) {
    if (!areKept) return {};
    return {.below = take(computes(c::massFlux<D>[0])), .above = take(computes(c::massFlux<D>[1]))};
  }
  /// Stores the mass fluxes across an axis for the cells of a block.
  template <int K>
  void keep(const Box& block, int axis, const Rows<D, K>& flux) const {
    if (!below) return;
    forEach<D>(block, [&](const Index<D>& cell) {
      (*below)[cell][axis] = flux.number(cell, kDensity);
      (*above)[cell][axis] = flux.number(cell + Index<D>::unit(axis), kDensity);
    });
  }
};

}  // namespace tushar::euler
