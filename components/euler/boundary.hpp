#pragma once

#include "components/euler/labels.hpp"
#include "components/euler/rows.hpp"

namespace tushar::euler {

/// The state beyond a side of the grid: W = factor * (the mirrored or the nearest cell) + value.
template <int D>
struct GhostRule {
  bool mirrored = false;
  State<D> factor, value;
};

/// The rules of both sides of each axis.
template <int D>
using GhostRules = std::array<std::array<GhostRule<D>, 2>, D>;

/// From the scene's conditions: Symmetric is a wall, with Density, Velocity or Pressure gas of these values flows in;
/// whatever is not given continues with no gradient, so that a side without conditions is an outflow.
template <int D>
GhostRules<D> ghostRules(const Level& level);

/// Fills the cells of `rows` that lie beyond the grid; those on the grid must be known.
template <int D>
void fillBeyondGrid(const Level& level, const GhostRules<D>& rules, Rows<D>& rows);

}  // namespace tushar::euler
