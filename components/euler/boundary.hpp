#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "components/euler/labels.hpp"
#include "components/euler/mixture.hpp"
#include "components/euler/rows.hpp"

namespace tushar::euler {

/// A non-reflecting side, which slowly relaxes the pressure to a far-field value. With the normal n outwards, the
/// incoming characteristic p - rho c u_n changes at the rate -K (p - p_far), where K = sigma (1 - M²) c / L and L is
/// the length of the grid along n. Beyond the side, the characteristic is therefore smaller by (p - p_far) sigma (1 +
/// M) h / L. Sources: T. Poinsot & S. K. Lele, J. Comput. Phys. 101 (1992) 104; for K, D. H. Rudy & J. C. Strikwerda,
/// J. Comput. Phys. 36 (1980) 55.
struct Relaxation {
  double farPressure = 0;  ///< far-field pressure [Pa]
  double sigma = 0;
  double thickness = 0;  ///< ratio h / L
  int axis = 0;
  int outwards = 0;  ///< 1 or -1: the direction of n along the axis; 0: the side does not relax

  bool acts() const { return outwards != 0; }
  /// The decrease [Pa] of the incoming characteristic at a side while sound crosses `crossings` cells. `speed` is the
  /// outward velocity u_n [m/s].
  double loss(double pressure, double speed, double sound, double crossings = 1) const {
    const double mach = std::clamp(speed / sound, -1.0, 1.0);
    const double share = sigma * thickness * std::max(1 + mach, crossings * (1 - mach * mach));
    return mach < 1 ? (pressure - farPressure) * std::min(share, 1.0) : 0.0;
  }
};

/// The rise of the pressure from one cell to the next outwards, by gravity g and a force per volume f: rho g_n h + f_n
/// h.
struct Rise {
  double byWeight = 0;  ///< g_n h [m²/s²]
  double byForce = 0;   ///< f_n h [Pa]

  bool acts() const { return byWeight != 0 || byForce != 0; }
  double at(double density) const { return density * byWeight + byForce; }
};

/// The state beyond a side of the grid: W = factor * W_inside + value, where W_inside is that of the mirrored or of the
/// nearest cell.
template <int D>
struct GhostRule {
  bool mirrored = false;
  State<D> factor, value;
  double densityOfPressure = 0;   ///< if greater than 0, rho is (p + p_inf) times this number [kg/(m³ Pa)]
  double pInfinity = 0;           ///< p_inf [Pa]
  double temperature = 0;         ///< if greater than 0, the temperature of a gas with its own law [K]
  bool keepsTemperature = false;  ///< whether the temperature continues instead of rho, beyond a prescribed pressure
  const Gas* gas = nullptr;       ///< the only gas, if the rule depends on its law
  Relaxation relaxes = {};        ///< relaxation at a side that lets waves out
  Rise rises = {};                ///< rise of a pressure that continues beyond the side
  Mixture<kMostGases> laws;       ///< laws of several gases, used by the relaxation

  /// Whether each component of the state beyond is a factor times that inside, plus a value.
  bool isLinear() const {
    return !(densityOfPressure > 0) && !(temperature > 0) && !keepsTemperature && !relaxes.acts() && !rises.acts();
  }
};

/// The rules of a side: a rule for each of its parts and, as the base class, the rule for the rest of the side.
template <int D>
struct SideRules : GhostRule<D> {
  std::vector<GhostRule<D>> parts = {};
  /// Returns the rule for a cell beyond a part of the side, if the scene gives formulas; otherwise empty.
  std::function<GhostRule<D>(int part, const Index<D>& cell)> varying = {};

  /// Whether the same rule applies to all cells of the side.
  bool areOne() const { return parts.empty() && !varying; }
};

/// The rules of both sides of each axis.
template <int D>
using GhostRules = std::array<std::array<SideRules<D>, 2>, D>;

/// A place at a side of the grid that has conditions: a part of the side, or the rest of it. Formulas in place of
/// values are evaluated at a point [m] and a time [s].
struct Place {
  const Level& level;
  int axis = 0, side = 0, part = grid::restOfSide;
  Vec3 x = Vec3::Zero();
  double time = 0;
};

/// The value that a scene prescribes at a place for a variable of a gas; none if it prescribes none.
template <class T>
std::optional<T> givenAt(const Place& place, const Gas& gas, const BoundaryLabel<T>& label) {
  const auto condition = place.level.boundary(place.axis, place.side, label, gas.material, place.part);
  return condition && condition->isDirichlet() ? std::optional(condition->at(place.x, place.time)) : std::nullopt;
}
/// The pressure that a scene prescribes at a place, if any. All materials share it, because Uintah's scenes give it for
/// material 0. If the gas has a weight, it is hydrostatic: a value, but not a formula, is that at the centre of the
/// first cell of the coarsest level, and at x the pressure is higher by the weight times (x - centre). Along periodic
/// axes, it does not rise.
std::optional<double> pressureAt(const Place& place, const Gas& gas);

/// Whether a place is a wall: it has the condition Symmetric, or only a Velocity that is tangential to the side.
template <int D>
bool isWall(const Place& place, const Gas& gas);

/// The rules that follow from the scene's conditions. A wall mirrors the gas. At a side with Density, Velocity or
/// Pressure, gas with these values flows in; a Temperature given with one of density and pressure determines the other.
/// Quantities that are not given continue without gradient, so a side without conditions is an outflow; but the
/// pressure rises there by the weight of the gas, so that gas at rest stays at rest. Of density and temperature, the
/// density continues beside a given pressure, except if the scene asks for a Temperature without gradient; several
/// gases keep their densities.
///
/// Formulas are evaluated at `time` [s] in the centre of each cell beyond the side, and their results are used like
/// values. Throws NumericalError if a formula gives an impossible density or p + p_inf.
template <int D>
GhostRules<D> ghostRules(const Level& level, const Gas& gas, double time = 0);
/// The rules that follow from the scene's conditions, only for the sides beyond which a box of cells reaches.
template <int D>
GhostRules<D> ghostRules(const Level& level, const Gas& gas, double time, const Box& cells);

/// The rules for several gases with these laws.
template <int D, int K>
GhostRules<D> withLaws(GhostRules<D> rules, const Mixture<K>& laws) {
  Mixture<kMostGases> all;
  std::copy(laws.softness.begin(), laws.softness.end(), all.softness.begin());
  std::copy(laws.stiffness.begin(), laws.stiffness.end(), all.stiffness.begin());
  const auto takeLaws = [all](GhostRule<D>& rule) {
    rule.laws = all;
    rule.gas = nullptr;
    rule.keepsTemperature = false;
  };
  for (auto& sides : rules)
    for (SideRules<D>& side : sides) {
      takeLaws(side);
      for (GhostRule<D>& part : side.parts) takeLaws(part);
      if (side.varying)
        side.varying = [takeLaws, makeRule = std::move(side.varying)](int part, const Index<D>& cell) {
          GhostRule<D> rule = makeRule(part, cell);
          takeLaws(rule);
          return rule;
        };
    }
  return rules;
}

/// Like ghostRules, but for differences of velocity and temperature across the sides; temperatures replace densities.
/// Given values apply at the side itself, and other values are mirrored. Formulas are evaluated at the centre of each
/// face.
template <int D>
GhostRules<D> diffusionRules(const Level& level, const Gas& gas, double time = 0);

/// The rule at a face of a side, given the cell beyond the face or the adjacent cell inside: the rule of the part to
/// which the face belongs.
template <int D>
GhostRule<D> ruleAt(const Level& level, const GhostRules<D>& rules, int axis, int side, const Index<D>& cell);

/// Fills those cells of a box that are outside the grid. The state must be known in the cells of the box on the grid,
/// and in the inner cells that the conditions at a side use.
template <int D, int K>
void fillBeyondGrid(const Level& level, const GhostRules<D>& rules, Rows<D, K>& rows, const Box& box);
template <int D, int K>
void fillBeyondGrid(const Level& level, const GhostRules<D>& rules, Rows<D, K>& rows) {
  fillBeyondGrid<D>(level, rules, rows, rows.box());
}

}  // namespace tushar::euler
