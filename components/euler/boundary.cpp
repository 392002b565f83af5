#include "components/euler/boundary.hpp"

namespace tushar::euler {

namespace {

template <int D>
GhostRule<D> ghostRule(const Level& level, const Gas& gas, int axis, int side) {
  GhostRule<D> rule;
  rule.factor.fill(1);
  rule.value.fill(0);
  if (isWall<D>(level, gas, axis, side)) {
    rule.mirrored = true;
    rule.factor[kVelocity(axis)] = -1;
    return rule;
  }
  const auto prescribe = [&](std::size_t k, double value) {
    rule.factor[k] = 0;
    rule.value[k] = value;
  };
  if (const auto velocity = givenAt(level, gas, axis, side, boundary::velocity)) {
    const Vec<D> v = level.reduce<D>(*velocity);
    for (int k = 0; k < D; ++k) prescribe(kVelocity(k), v[k]);
  }
  auto density = givenAt(level, gas, axis, side, boundary::density), pressure = pressureAt(level, gas, axis, side);
  if (const auto temperature = givenAt(level, gas, axis, side, boundary::temperature)) {
    const double pressureOfDensity = gas.gasConstant() * *temperature;
    if (density && !pressure)
      pressure = pressureOfDensity * *density;
    else if (pressure && !density)
      density = *pressure / pressureOfDensity;
    else if (!density)
      rule.densityOfPressure = 1 / pressureOfDensity;
  }
  if (density) prescribe(kDensity, *density);
  if (pressure) prescribe(kPressure<D>, *pressure);
  return rule;
}

/// The temperature [K] that is given at a side, or that a density and a pressure make.
std::optional<double> temperatureAt(const Level& level, const Gas& gas, int axis, int side) {
  if (const auto given = givenAt(level, gas, axis, side, boundary::temperature)) return given;
  const auto density = givenAt(level, gas, axis, side, boundary::density),
             pressure = pressureAt(level, gas, axis, side);
  if (!density || !pressure || gas.specificHeat == 0) return {};
  return *pressure / (gas.gasConstant() * *density);
}

template <int D>
GhostRule<D> diffusionRule(const Level& level, const Gas& gas, int axis, int side) {
  GhostRule<D> rule;
  rule.mirrored = true;
  rule.factor.fill(1);
  rule.value.fill(0);
  const auto hold = [&](std::size_t k, double value) {
    rule.factor[k] = -1;
    rule.value[k] = 2 * value;
  };
  if (level.isSymmetry(axis, side, gas.material)) {
    hold(kVelocity(axis), 0);
    return rule;
  }
  if (const auto velocity = givenAt(level, gas, axis, side, boundary::velocity))
    for (int k = 0; k < D; ++k) hold(kVelocity(k), level.reduce<D>(*velocity)[k]);
  if (const auto temperature = temperatureAt(level, gas, axis, side)) hold(kDensity, *temperature);
  return rule;
}

/// `ruleOf(level, gas, axis, side)` for each side of the grid.
template <int D>
GhostRules<D> rulesOfSides(auto ruleOf, const Level& level, const Gas& gas) {
  GhostRules<D> rules;
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) rules[d][side] = ruleOf(level, gas, d, side);
  return rules;
}

/// The cell along an axis of `cells` cells that a cell beyond its ends is made from.
int sourceOf(int cell, int cells, bool mirrored) {
  const int inside = cell < 0 ? (mirrored ? -1 - cell : 0) : (mirrored ? 2 * cells - 1 - cell : cells - 1);
  return std::clamp(inside, 0, cells - 1);
}

}  // namespace

std::optional<double> pressureAt(const Level& level, const Gas& gas, int axis, int side) {
  const auto own = givenAt(level, gas, axis, side, boundary::pressure);
  if (own || gas.material == 0) return own;
  const auto shared = level.boundary(axis, side, boundary::pressure);
  return shared && shared->isDirichlet() ? std::optional(shared->value) : std::nullopt;
}

template <int D>
bool isWall(const Level& level, const Gas& gas, int axis, int side) {
  if (level.isSymmetry(axis, side, gas.material)) return true;
  const auto velocity = givenAt(level, gas, axis, side, boundary::velocity);
  return velocity && level.reduce<D>(*velocity)[axis] == 0 && !pressureAt(level, gas, axis, side) &&
         !givenAt(level, gas, axis, side, boundary::density);
}

template <int D>
GhostRules<D> ghostRules(const Level& level, const Gas& gas) {
  return rulesOfSides<D>(ghostRule<D>, level, gas);
}

template <int D>
GhostRules<D> diffusionRules(const Level& level, const Gas& gas) {
  return rulesOfSides<D>(diffusionRule<D>, level, gas);
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
        if (rule.densityOfPressure > 0) w[kDensity] = rule.densityOfPressure * w[kPressure<D>];
        store<D>(rows.at(cell), 0, w);
      });
    }
    known.lower[d] = rows.box().lower[d];
    known.upper[d] = rows.box().upper[d];
  }
}

template GhostRules<1> ghostRules<1>(const Level&, const Gas&);
template GhostRules<2> ghostRules<2>(const Level&, const Gas&);
template GhostRules<3> ghostRules<3>(const Level&, const Gas&);
template GhostRules<1> diffusionRules<1>(const Level&, const Gas&);
template GhostRules<2> diffusionRules<2>(const Level&, const Gas&);
template GhostRules<3> diffusionRules<3>(const Level&, const Gas&);
template bool isWall<1>(const Level&, const Gas&, int, int);
template bool isWall<2>(const Level&, const Gas&, int, int);
template bool isWall<3>(const Level&, const Gas&, int, int);
template void fillBeyondGrid<1>(const Level&, const GhostRules<1>&, Rows<1>&);
template void fillBeyondGrid<2>(const Level&, const GhostRules<2>&, Rows<2>&);
template void fillBeyondGrid<3>(const Level&, const GhostRules<3>&, Rows<3>&);

}  // namespace tushar::euler
