#include "components/euler/boundary.hpp"

namespace tushar::euler {

namespace {

template <int D>
GhostRule<D> ghostRule(const Level& level, int axis, int side) {
  GhostRule<D> rule;
  rule.factor.fill(1);
  rule.value.fill(0);
  if (level.isSymmetry(axis, side)) {
    rule.mirrored = true;
    rule.factor[kVelocity(axis)] = -1;
    return rule;
  }
  const auto prescribe = [&](std::size_t k, double value) {
    rule.factor[k] = 0;
    rule.value[k] = value;
  };
  if (const auto density = level.boundary(axis, side, boundary::density)) prescribe(kDensity, density->value);
  if (const auto pressure = level.boundary(axis, side, boundary::pressure)) prescribe(kPressure<D>, pressure->value);
  if (const auto velocity = level.boundary(axis, side, boundary::velocity)) {
    const Vec<D> v = level.reduce<D>(velocity->value);
    for (int k = 0; k < D; ++k) prescribe(kVelocity(k), v[k]);
  }
  return rule;
}

/// The cell along an axis of `cells` cells that a cell beyond its ends is made from.
int sourceOf(int cell, int cells, bool mirrored) {
  const int inside = cell < 0 ? (mirrored ? -1 - cell : 0) : (mirrored ? 2 * cells - 1 - cell : cells - 1);
  return std::clamp(inside, 0, cells - 1);
}

}  // namespace

template <int D>
GhostRules<D> ghostRules(const Level& level) {
  GhostRules<D> rules;
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) rules[d][side] = ghostRule<D>(level, d, side);
  return rules;
}

template <int D>
void fillBeyondGrid(const Level& level, const GhostRules<D>& rules, Rows<D>& rows) {
  const Box grid = level.cells();
  Box known = level.clipCells(rows.box());
  for (int d = 0; d < D; ++d) {
    if (level.isPeriodic(d)) continue;
    for (std::size_t side = 0; side < 2; ++side) {
      Box beyond = known;
      beyond.lower[d] = side == 0 ? rows.box().lower[d] : grid.upper[d];
      beyond.upper[d] = side == 0 ? 0 : rows.box().upper[d];
      const GhostRule<D>& rule = rules[d][side];
      forEach<D>(beyond, [&](const Index<D>& cell) {
        Index<D> source = cell;
        source[d] = sourceOf(cell[d], grid.upper[d], rule.mirrored);
        State<D> w = load<D>(rows.at(source), 0);
        for (std::size_t k = 0; k < w.size(); ++k) w[k] = rule.factor[k] * w[k] + rule.value[k];
        store<D>(rows.at(cell), 0, w);
      });
    }
    known.lower[d] = rows.box().lower[d];
    known.upper[d] = rows.box().upper[d];
  }
}

template GhostRules<1> ghostRules<1>(const Level&);
template GhostRules<2> ghostRules<2>(const Level&);
template GhostRules<3> ghostRules<3>(const Level&);
template void fillBeyondGrid<1>(const Level&, const GhostRules<1>&, Rows<1>&);
template void fillBeyondGrid<2>(const Level&, const GhostRules<2>&, Rows<2>&);
template void fillBeyondGrid<3>(const Level&, const GhostRules<3>&, Rows<3>&);

}  // namespace tushar::euler
