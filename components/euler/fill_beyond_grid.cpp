#include "components/euler/boundary.hpp"

namespace tushar::euler {

namespace {

/// Along an axis with `cells` cells, the index of the cell from which a cell beyond an end of the axis is computed.
int sourceOf(int cell, int cells, bool mirrored) {
  const int inside = cell < 0 ? (mirrored ? -1 - cell : 0) : (mirrored ? 2 * cells - 1 - cell : cells - 1);
  return std::clamp(inside, 0, cells - 1);
}

/// How far, in cells, a cell lies beyond an end of an axis with `cells` cells: 1 for the first cell outside.
int depthOf(int cell, int cells) { return cell < 0 ? -cell : cell - cells + 1; }

/// The cell from which a cell outside the grid is computed; it is on the grid along all axes except `axis`.
template <int D>
Index<D> inGrid(const Level& level, const GhostRules<D>& rules, Index<D> cell, int axis) {
  for (int d = 0; d < D; ++d) {
    if (d == axis) continue;
    const int cells = level.cells().upper[d];
    if (!level.isPeriodic(d) && (cell[d] < 0 || cell[d] >= cells))
      cell[d] = sourceOf(cell[d], cells, rules[d][cell[d] < 0 ? 0 : 1].mirrored);
  }
  return cell;
}

/// The number of gases in a state of N numbers.
template <int D, std::size_t N>
inline constexpr int kGasesIn = N > D + 2 ? static_cast<int>(N - D - 2) / 2 : 1;

/// c² [m²/s²] of a state, of one gas or of several.
template <int D, std::size_t N>
double soundSpeedSquaredIn(const GhostRule<D>& rule, const std::array<double, N>& w) {
  if constexpr (constexpr int K = kGasesIn<D, N>; K == 1) {
    return rule.gas->soundSpeedSquared(w[kDensity], w[kPressure<D>]);
  } else {
    Mixture<K> laws;
    std::copy_n(rule.laws.softness.begin(), K, laws.softness.begin());
    std::copy_n(rule.laws.stiffness.begin(), K, laws.stiffness.begin());
    return lawIn<D, K>(laws, w).soundSpeedSquared(w[kDensity], w[kPressure<D>]);
  }
}

/// The largest fall of the pressure beyond a side, in parts of rho c²: on cells in which the pressure of a gas at rest
/// halves, it remains positive.
constexpr double greatestFall = 0.25;

/// Raises the pressure of a state, at constant entropy to first order unless the density is given: with the density of
/// the cell, gas that flows in would be colder in each step. It compresses all gases of a cell by the same factor. If
/// the pressure depends on the density alone, the temperature stays.
template <int D, std::size_t N>
void raise(const GhostRule<D>& rule, double rise, std::array<double, N>& w) {
  const double density = w[kDensity], squared = soundSpeedSquaredIn<D>(rule, w);
  const double limited = std::max(rise, -greatestFall * density * squared);
  constexpr int K = kGasesIn<D, N>;
  const bool isBarotropic = K == 1 && rule.gas->isBarotropic();
  if (isBarotropic || rule.factor[kDensity] == 1) w[kDensity] += limited / squared;
  if constexpr (K > 1)
    for (int k = 0; k < K; ++k) w[kMass<D>(k)] *= w[kDensity] / density;
  if (isBarotropic)
    w[kPressure<D>] *= w[kDensity] / density;
  else
    w[kPressure<D>] += limited;
}

/// Weakens the incoming wave in a state, at constant entropy, to let waves out; the wave decays over `cells` cells. It
/// compresses all gases of a cell by the same factor. If the pressure depends on the density alone, the temperature
/// stays, so the last component, rho c_v T, changes like the density. `rise` is the rise of the pressure at rest from
/// cell to cell [Pa]; the pressure at the side itself relaxes.
template <int D, std::size_t N>
void relax(const GhostRule<D>& rule, int cells, double rise, std::array<double, N>& w) {
  const Relaxation& side = rule.relaxes;
  double& speed = w[kVelocity(side.axis)];
  constexpr int K = kGasesIn<D, N>;
  const double squared = soundSpeedSquaredIn<D>(rule, w), sound = std::sqrt(squared);
  const double pressure = K == 1 ? rule.gas->pressureOf(w[kDensity], w[kPressure<D>]) : w[kPressure<D>];
  const double half = 0.5 * cells * side.loss(pressure - (cells - 0.5) * rise, side.outwards * speed, sound);
  speed += side.outwards * half / (w[kDensity] * sound);
  if constexpr (K > 1)
    for (int k = 0; k < K; ++k) w[kMass<D>(k)] -= w[kMass<D>(k)] / w[kDensity] * (half / squared);
  const double before = w[kDensity];
  w[kDensity] -= half / squared;
  if (K == 1 && rule.gas->isBarotropic())
    w[kPressure<D>] *= w[kDensity] / before;
  else
    w[kPressure<D>] -= half;
}

/// The density [kg/m³] at a pressure [Pa] and the temperature of a state with a density and a last component.
double densityAtSameHeat(const Gas& gas, double density, double last, double pressure) {
  if (!gas.law) return density * (pressure + gas.pInfinity) / (last + gas.pInfinity);
  return gas.densityAt(pressure, gas.temperature(density, gas.energyOf(density, last)));
}

/// The state at a distance of `cells` cells beyond a side, from a rule and the state `w` of the cell inside.
template <int D, std::size_t N>
std::array<double, N> beyondSide(const GhostRule<D>& rule, int cells, std::array<double, N> w) {
  const double density = w[kDensity], last = w[kPressure<D>];
  for (std::size_t k = 0; k < rule.factor.size(); ++k) w[k] = rule.factor[k] * w[k] + rule.value[k];
  const bool rises = rule.rises.acts() && rule.factor[kPressure<D>] == 1;
  const double rise = rises ? rule.rises.at(0.5 * (density + w[kDensity])) : 0;
  if (rises) raise<D>(rule, cells * rise, w);
  if (rule.densityOfPressure > 0) w[kDensity] = rule.densityOfPressure * (w[kPressure<D>] + rule.pInfinity);
  if (rule.temperature > 0 && rule.gas->isBarotropic())
    w[kPressure<D>] = rule.gas->lastAt(w[kDensity], rule.temperature);
  else if (rule.temperature > 0)
    w[kDensity] = rule.gas->densityAt(w[kPressure<D>], rule.temperature);
  if (kGasesIn<D, N> == 1 && rule.keepsTemperature)
    w[kDensity] = densityAtSameHeat(*rule.gas, density, last, w[kPressure<D>]);
  if (rule.relaxes.acts()) relax<D>(rule, cells, rise, w);
  return w;
}

/// Fills a line of cells, `depth` cells beyond a side, from a line of cells inside; cells of a line are `step` places
/// apart in memory.
template <int D, std::size_t N>
void fillLine(const GhostRule<D>& rule, int depth, const std::array<double*, N>& from, int count, std::ptrdiff_t step,
              const std::array<double*, N>& to) {
  if (!rule.isLinear()) {
    for (int i = 0; i < count; ++i) store<D>(to, i * step, beyondSide<D>(rule, depth, load<D>(from, i * step)));
    return;
  }
  for (std::size_t k = 0; k < N; ++k) {
    const bool isRuled = k < rule.factor.size();  // amounts of several gases continue
    for (int i = 0; i < count && !isRuled; ++i) to[k][i * step] = from[k][i * step];
    for (int i = 0; i < count && isRuled; ++i) to[k][i * step] = rule.factor[k] * from[k][i * step] + rule.value[k];
  }
}

/// Fills the cells of a box beyond a side where one rule applies to all of them.
template <int D, int K>
void fillByRule(const GhostRule<D>& rule, const Box& beyond, int axis, int cells, Rows<D, K>& rows) {
  if (beyond.empty()) return;
  const bool isAlongY = D > 1 && axis == 0;
  Box starts = axis == 0 ? beyond : beyond.rowStarts();
  if (isAlongY) starts.upper[1] = starts.lower[1] + 1;
  forEach<D>(starts, [&](const Index<D>& first) {
    Index<D> source = first;
    source[axis] = sourceOf(first[axis], cells, rule.mirrored);
    const int depth = depthOf(first[axis], cells);
    if (isAlongY) return fillLine<D>(rule, depth, rows.at(source), beyond.extent(1), rows.stride(1), rows.at(first));
    const int count = axis == 0 ? 1 : beyond.extent(0);
    fillLine<D>(rule, depth, rows.at(source), count, 1, rows.at(first));
  });
}

/// Fills the cells of a box beyond a side with rules that differ from cell to cell.
template <int D, int K>
void fillByPlace(const Level& level, const GhostRules<D>& rules, const Box& beyond, int axis, int side,
                 Rows<D, K>& rows) {
  const int cells = level.cells().upper[axis];
  forEach<D>(beyond, [&](const Index<D>& cell) {
    const GhostRule<D> rule = ruleAt<D>(level, rules, axis, side, inGrid<D>(level, rules, cell, axis));
    Index<D> source = cell;
    source[axis] = sourceOf(cell[axis], cells, rule.mirrored);
    store<D>(rows.at(cell), 0, beyondSide<D>(rule, depthOf(cell[axis], cells), load<D>(rows.at(source), 0)));
  });
}

/// Whether a rule only reverses velocities.
template <int D>
bool reversesOnly(const GhostRule<D>& rule) {
  bool only = rule.isLinear();
  for (std::size_t k = 0; k < rule.factor.size(); ++k) {
    const bool isVelocity = k != kDensity && k != kPressure<D>;
    only = only && rule.value[k] == 0 && (rule.factor[k] == 1 || (isVelocity && rule.factor[k] == -1));
  }
  return only;
}

/// Whether `one` does the same before and after `other`, which only reverses velocities.
template <int D>
bool isBlindTo(const GhostRule<D>& one, const GhostRule<D>& other) {
  if (!reversesOnly(other)) return false;
  bool is = !one.relaxes.acts() || other.factor[kVelocity(one.relaxes.axis)] == 1;
  for (std::size_t k = 0; k < one.factor.size(); ++k) is = is && (one.value[k] == 0 || other.factor[k] == 1);
  return is;
}

/// Whether the state beyond the corner between two sides does not depend on which of their rules comes first.
template <int D>
bool commute(const SideRules<D>& one, const SideRules<D>& other) {
  if (!one.areOne() || !other.areOne()) return false;
  if (isBlindTo<D>(one, other) || isBlindTo<D>(other, one)) return true;
  bool may = one.isLinear() && other.isLinear();
  for (std::size_t k = 0; k < one.factor.size(); ++k) {
    const bool areEqual = one.factor[k] == other.factor[k] && one.value[k] == other.value[k];
    const bool areFactors = one.value[k] == 0 && other.value[k] == 0;
    const auto keeps = [k](const GhostRule<D>& rule) { return rule.factor[k] == 1 && rule.value[k] == 0; };
    may = may && (areEqual || areFactors || keeps(one) || keeps(other));
  }
  return may;
}

/// The part of the space around the grid that is beyond some sides: for each axis, 0 if it is between the ends of the
/// axis, 1 beyond the lower end, or 2 beyond the upper end.
template <int D>
struct Corner {
  Index<D> ends;

  /// The cells of a box in the corner; empty if an axis is periodic.
  Box cellsIn(const Level& level, const Box& box) const {
    const Box inside = level.clipCells(box);
    Box cells = inside;
    for (int d = 0; d < D; ++d) {
      if (ends[d] > 0 && level.isPeriodic(d)) return {};
      if (ends[d] > 0) cells.lower[d] = ends[d] == 1 ? box.lower[d] : std::max(level.cells().upper[d], box.lower[d]);
      if (ends[d] > 0) cells.upper[d] = ends[d] == 1 ? std::min(0, box.upper[d]) : box.upper[d];
    }
    return cells;
  }
  int sides() const {
    int count = 0;
    for (int d = 0; d < D; ++d) count += ends[d] > 0 ? 1 : 0;
    return count;
  }
  const SideRules<D>& rulesOf(const GhostRules<D>& rules, int axis) const { return rules[axis][ends[axis] - 1]; }
  /// Whether the order of the rules of the sides matters.
  bool hasOrder(const GhostRules<D>& rules) const {
    bool has = false;
    for (int d = 0; d < D; ++d)
      for (int e = 0; e < d; ++e)
        if (ends[d] > 0 && ends[e] > 0) has = has || !commute<D>(rulesOf(rules, d), rulesOf(rules, e));
    return has;
  }
};

/// Fills the cells of a box that are beyond several sides, where the order of the rules matters: with the mean of the
/// states that the rule of each of the sides gives. So a scene that is turned has the same states, turned.
template <int D, int K>
void fillCorner(const Level& level, const GhostRules<D>& rules, const Corner<D>& corner, const Box& beyond,
                Rows<D, K>& rows) {
  forEach<D>(beyond, [&](const Index<D>& cell) {
    std::array<State<D, K>, D> states{};
    std::size_t count = 0;
    for (int d = 0; d < D; ++d) {
      if (corner.ends[d] == 0) continue;
      const int cells = level.cells().upper[d];
      const GhostRule<D> rule = ruleAt<D>(level, rules, d, corner.ends[d] - 1, inGrid<D>(level, rules, cell, d));
      Index<D> source = cell;
      source[d] = sourceOf(cell[d], cells, rule.mirrored);
      states[count++] = beyondSide<D>(rule, depthOf(cell[d], cells), load<D>(rows.at(source), 0));
    }
    State<D, K> mean = states[0];
    for (std::size_t k = 0; k < mean.size(); ++k)
      if (count == 2)
        mean[k] = 0.5 * (states[0][k] + states[1][k]);
      else
        mean[k] += ((states[1][k] - states[0][k]) + (states[D - 1][k] - states[0][k])) / 3;
    store<D>(rows.at(cell), 0, mean);
  });
}

/// Fills the cells of a box beyond several sides again, where the order of the rules matters.
template <int D, int K>
void fillCorners(const Level& level, const GhostRules<D>& rules, Rows<D, K>& rows, const Box& box) {
  Box ways{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) ways.upper[d] = 3;
  for (int sides = 2; sides <= D; ++sides)  // beyond three sides, the means beyond two are used
    forEach<D>(ways, [&](const Index<D>& ends) {
      const Corner<D> corner{ends};
      if (corner.sides() != sides) return;
      const Box beyond = corner.cellsIn(level, box);
      if (!beyond.empty() && corner.hasOrder(rules)) fillCorner<D>(level, rules, corner, beyond, rows);
    });
}

}  // namespace

template <int D, int K>
void fillBeyondGrid(const Level& level, const GhostRules<D>& rules, Rows<D, K>& rows, const Box& box) {
  const Box grid = level.cells();
  Box known = level.clipCells(box);
  for (int d = 0; d < D; ++d) {
    if (level.isPeriodic(d)) continue;
    for (int side = 0; side < 2; ++side) {
      Box beyond = known;
      beyond.lower[d] = side == 0 ? box.lower[d] : std::max(grid.upper[d], box.lower[d]);
      beyond.upper[d] = side == 0 ? std::min(0, box.upper[d]) : box.upper[d];
      const SideRules<D>& rule = rules[d][side];
      if (!rule.areOne()) {
        fillByPlace<D>(level, rules, beyond, d, side, rows);
        continue;
      }
      fillByRule<D>(rule, beyond, d, grid.upper[d], rows);
    }
    known.lower[d] = box.lower[d];
    known.upper[d] = box.upper[d];
  }
  if constexpr (D > 1) fillCorners<D>(level, rules, rows, box);
}

template void fillBeyondGrid<1>(const Level&, const GhostRules<1>&, Rows<1, 1>&, const Box&);
template void fillBeyondGrid<1>(const Level&, const GhostRules<1>&, Rows<1, 2>&, const Box&);
template void fillBeyondGrid<1>(const Level&, const GhostRules<1>&, Rows<1, 3>&, const Box&);
template void fillBeyondGrid<2>(const Level&, const GhostRules<2>&, Rows<2, 1>&, const Box&);
template void fillBeyondGrid<2>(const Level&, const GhostRules<2>&, Rows<2, 2>&, const Box&);
template void fillBeyondGrid<2>(const Level&, const GhostRules<2>&, Rows<2, 3>&, const Box&);
template void fillBeyondGrid<3>(const Level&, const GhostRules<3>&, Rows<3, 1>&, const Box&);
template void fillBeyondGrid<3>(const Level&, const GhostRules<3>&, Rows<3, 2>&, const Box&);
template void fillBeyondGrid<3>(const Level&, const GhostRules<3>&, Rows<3, 3>&, const Box&);

}  // namespace tushar::euler
