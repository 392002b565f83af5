#pragma once

#include "components/euler/labels.hpp"
#include "components/euler/rows.hpp"

namespace tushar::euler {

namespace c {
/// The mass fluxes through the lower and the upper faces of cells, for scalars that the gas carries.
template <int D>
inline constexpr std::array<CellLabel<Vec<D>>, 2> massFlux{
    {{"c.massFluxBelow", "kg/(m^2 s)", "mass flux through the lower faces"},
     {"c.massFluxAbove", "kg/(m^2 s)", "mass flux through the upper faces"}}};
}  // namespace c

/// Views of the mass fluxes through the faces of cells in a step [kg/(m² s)]; empty if no task needs them.
template <int D>
struct FaceMasses {
  std::optional<CellView<Vec<D>>> below = {}, above = {};

  static FaceMasses from(auto& take, bool areKept) {
    if (!areKept) return {};
    return {.below = take(computes(c::massFlux<D>[0])), .above = take(computes(c::massFlux<D>[1]))};
  }
  /// Stores the mass fluxes along an axis through the faces of the cells of a block.
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
