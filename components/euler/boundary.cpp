#include "components/euler/boundary.hpp"

#include <fmt/format.h>

namespace tushar::euler {

namespace {

/// Adds the prescribed density, pressure and temperature to the rule of a gas with its own law.
template <int D>
void prescribeByLaw(const Place& place, const Gas& gas, std::optional<double> density,
                    const std::optional<double>& pressure, GhostRule<D>& rule) {
  const auto temperature = givenAt(place, gas, boundary::temperature);
  const auto prescribe = [&](std::size_t k, double value) {
    rule.factor[k] = 0;
    rule.value[k] = value;
  };
  if (pressure && !density && (temperature || gas.isBarotropic()))
    density = gas.densityAt(*pressure, temperature.value_or(1));
  if (density) prescribe(kDensity, *density);
  if (pressure && !gas.isBarotropic()) {
    prescribe(kPressure<D>, *pressure);
  } else if (temperature && density) {
    prescribe(kPressure<D>, gas.lastAt(*density, *temperature));
  } else if (temperature) {
    rule.temperature = *temperature;
    rule.gas = &gas;
  }
}

/// Whether a scene asks for a temperature without gradient at a place where it prescribes the pressure, but neither
/// density nor temperature.
bool keepsTemperature(const Place& place, const Gas& gas) {
  const auto given = place.level.boundary(place.axis, place.side, boundary::temperature, gas.material, place.part);
  return given && !given->isDirichlet() && given->value == 0 && !gas.isBarotropic() && pressureAt(place, gas) &&
         !givenAt(place, gas, boundary::density);
}

/// The relaxation at a side that lets waves out; no relaxation at other sides.
Relaxation relaxationAt(const Place& place, const Gas& gas) {
  const auto given = givenAt(place, gas, boundary::waves);
  if (!given) return {};
  return {.farPressure = (*given)[0],
          .sigma = (*given)[1],
          .thickness = 1.0 / place.level.cells().extent(place.axis),
          .axis = place.axis,
          .outwards = place.side == 0 ? -1 : 1};
}

/// The rise of a pressure that continues beyond a side.
template <int D>
Rise riseAt(const Place& place, const Gas& gas) {
  if (gas.gravity.isZero(0) && gas.push.isZero(0)) return {};
  const double outwards = (place.side == 0 ? -1 : 1) * place.level.spacing(place.axis);
  return {.byWeight = outwards * place.level.template reduce<D>(gas.gravity)[place.axis],
          .byForce = outwards * place.level.template reduce<D>(gas.push)[place.axis]};
}

template <int D>
GhostRule<D> ghostRule(const Place& place, const Gas& gas) {
  GhostRule<D> rule;
  rule.factor.fill(1);
  rule.value.fill(0);
  rule.relaxes = relaxationAt(place, gas);
  if (rule.relaxes.acts()) rule.gas = &gas;
  if (isWall<D>(place, gas)) {
    rule.mirrored = true;
    rule.factor[kVelocity(place.axis)] = -1;
    return rule;
  }
  rule.rises = riseAt<D>(place, gas);
  if (rule.rises.acts()) rule.gas = &gas;
  const auto prescribe = [&](std::size_t k, double value) {
    rule.factor[k] = 0;
    rule.value[k] = value;
  };
  if (const auto velocity = givenAt(place, gas, boundary::velocity)) {
    const Vec<D> v = place.level.template reduce<D>(*velocity);
    for (int k = 0; k < D; ++k) prescribe(kVelocity(k), v[k]);
  }
  auto density = givenAt(place, gas, boundary::density), pressure = pressureAt(place, gas);
  rule.keepsTemperature = keepsTemperature(place, gas);
  if (rule.keepsTemperature) rule.gas = &gas;
  if (gas.law) {
    prescribeByLaw<D>(place, gas, density, pressure, rule);
    return rule;
  }
  if (const auto temperature = givenAt(place, gas, boundary::temperature)) {
    const double pressureOfDensity = gas.gasConstant() * *temperature;
    if (density && !pressure)
      pressure = pressureOfDensity * *density - gas.pInfinity;
    else if (pressure && !density)
      density = (*pressure + gas.pInfinity) / pressureOfDensity;
    else if (!density)
      rule.densityOfPressure = 1 / pressureOfDensity, rule.pInfinity = gas.pInfinity;
  }
  if (density) prescribe(kDensity, *density);
  if (pressure) prescribe(kPressure<D>, *pressure);
  return rule;
}

/// The temperature [K] at a place: the given one, or the one that follows from a given density and pressure.
std::optional<double> temperatureAt(const Place& place, const Gas& gas) {
  if (const auto given = givenAt(place, gas, boundary::temperature)) return given;
  const auto density = givenAt(place, gas, boundary::density), pressure = pressureAt(place, gas);
  if (!density || !pressure || gas.specificHeat == 0 || gas.isBarotropic()) return {};
  if (gas.law) return gas.temperature(*density, gas.energyOf(*density, *pressure));
  return (*pressure + gas.pInfinity) / (gas.gasConstant() * *density);
}

template <int D>
GhostRule<D> diffusionRule(const Place& place, const Gas& gas) {
  GhostRule<D> rule;
  rule.mirrored = true;
  rule.factor.fill(1);
  rule.value.fill(0);
  const auto hold = [&](std::size_t k, double value) {
    rule.factor[k] = -1;
    rule.value[k] = 2 * value;
  };
  if (place.level.isSymmetry(place.axis, place.side, gas.material, place.part)) {
    hold(kVelocity(place.axis), 0);
    return rule;
  }
  if (const auto velocity = givenAt(place, gas, boundary::velocity))
    for (int k = 0; k < D; ++k) hold(kVelocity(k), place.level.template reduce<D>(*velocity)[k]);
  if (const auto temperature = temperatureAt(place, gas)) hold(kDensity, *temperature);
  return rule;
}

/// Whether any condition at a side depends on the place: a formula, or a pressure that rises by the weight of the gas.
bool dependsOnPlace(const Level& level, const Gas& gas, int axis, int side) {
  const auto hasSome = [&](const std::vector<grid::BoundaryCondition>& conditions) {
    return std::any_of(conditions.begin(), conditions.end(), [&](const auto& one) {
      return one.formula || (!gas.weight.isZero(0) && one.kind == grid::BoundaryKind::dirichlet &&
                             one.variable.name == boundary::pressure.name);
    });
  };
  const auto& parts = level.parts(axis, side);
  return hasSome(level.domain().boundaries.face(level.axis(axis), side)) ||
         std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return hasSome(part.conditions); });
}

/// Throws NumericalError if formulas give an impossible state next to a cell.
void checkGiven(const Place& place, const Gas& gas, std::uint64_t cell) {
  const auto require = [&](bool isFine, const grid::BoundaryVariable& label, const std::string& found) {
    if (isFine) return;
    throw NumericalError(fmt::format("{} at side {}{} is {} at ({:g}, {:g}, {:g}), t = {:g} s", label.name,
                                     "xyz"[place.level.axis(place.axis)], "-+"[place.side], found, place.x[0],
                                     place.x[1], place.x[2], place.time),
                         "another formula in its <value>", std::string(label.name), cell);
  };
  const auto requireAbove = [&](double least, const BoundaryLabel<double>& label, const std::optional<double>& given,
                                const char* unit) {
    require(!given || (std::isfinite(*given) && *given > least), label,
            fmt::format("{:g} {}, but must be greater than {:g} {},", given.value_or(0), unit, least, unit));
  };
  requireAbove(0, boundary::density, givenAt(place, gas, boundary::density), "kg/m^3");
  requireAbove(0 - gas.pInfinity, boundary::pressure, pressureAt(place, gas), "Pa");
  requireAbove(0, boundary::temperature, givenAt(place, gas, boundary::temperature), "K");
  const auto velocity = givenAt(place, gas, boundary::velocity);
  require(!velocity || velocity->allFinite(), boundary::velocity, "not finite");
}

/// The rules of the sides beyond which a box reaches: `makeRule(place, gas)` makes one, and `pointAt(axis, side, cell)`
/// is the point at which formulas are evaluated.
template <int D, class MakeRule, class PointAt>
GhostRules<D> rulesOf(const Level& level, const Gas& gas, double time, const Box& box, MakeRule makeRule,
                      PointAt pointAt) {
  GhostRules<D> rules{};
  for (int d = 0; d < D; ++d)
    for (int side = 0; side < 2; ++side) {
      if (side == 0 ? box.lower[d] >= 0 : box.upper[d] <= level.cells().upper[d]) continue;
      SideRules<D>& of = rules[d][side];
      if (dependsOnPlace(level, gas, d, side)) {
        of.varying = [&level, gas, d, side, time, makeRule, pointAt](int part, const Index<D>& cell) {
          const Place place{level, d, side, part, pointAt(d, side, cell), time};
          Index<D> nearest = level.wrapped<D>(cell);
          for (int k = 0; k < D; ++k) nearest[k] = std::clamp(nearest[k], 0, level.cells().upper[k] - 1);
          checkGiven(place, gas, level.cellNumber<D>(nearest));
          return makeRule(place, gas);
        };
        continue;
      }
      of = {makeRule({level, d, side}, gas)};
      for (int part = 0; part < std::ssize(level.parts(d, side)); ++part)
        of.parts.push_back(makeRule({level, d, side, part}, gas));
    }
  return rules;
}

/// The centre of the first cell of the coarsest level [m].
Vec3 firstCentre(const Level& level) {
  const grid::Domain& domain = level.domain();
  Vec3 centre = domain.lower;
  for (int axis = 0; axis < 3; ++axis) {
    const int cells = domain.resolution[axis] > 1 ? domain.resolution[axis] >> level.number() : 1;
    centre[axis] += 0.5 * (domain.upper[axis] - domain.lower[axis]) / cells;
  }
  return centre;
}

}  // namespace

std::optional<double> pressureAt(const Place& place, const Gas& gas) {
  for (const int material : {gas.material, 0}) {
    const auto condition = place.level.boundary(place.axis, place.side, boundary::pressure, material, place.part);
    if (!condition || !condition->isDirichlet()) continue;
    const double given = condition->at(place.x, place.time);
    if (gas.weight.isZero(0) || condition->formula) return given;
    Vec3 weight = gas.weight;
    for (int axis = 0; axis < 3; ++axis)
      if (place.level.domain().periodic[axis] != 0) weight[axis] = 0;
    return given + weight.dot(place.x - firstCentre(place.level));
  }
  return {};
}

template <int D>
bool isWall(const Place& place, const Gas& gas) {
  if (place.level.isSymmetry(place.axis, place.side, gas.material, place.part)) return true;
  const auto velocity = givenAt(place, gas, boundary::velocity);
  return velocity && place.level.template reduce<D>(*velocity)[place.axis] == 0 && !pressureAt(place, gas) &&
         !givenAt(place, gas, boundary::density);
}

template <int D>
GhostRules<D> ghostRules(const Level& level, const Gas& gas, double time, const Box& cells) {
  return rulesOf<D>(level, gas, time, cells, ghostRule<D>, [&level](int, int, const Index<D>& cell) {
    return level.expandPoint<D>(level.cellCentre<D>(level.wrapped<D>(cell)));
  });
}
template <int D>
GhostRules<D> ghostRules(const Level& level, const Gas& gas, double time) {
  return ghostRules<D>(level, gas, time, level.cells().grown(1, D));
}

template <int D>
GhostRules<D> diffusionRules(const Level& level, const Gas& gas, double time) {
  return rulesOf<D>(
      level, gas, time, level.cells().grown(1, D), diffusionRule<D>,
      [&level](int axis, int side, const Index<D>& cell) { return level.middleOfSide<D>(axis, side, cell); });
}

template <int D>
GhostRule<D> ruleAt(const Level& level, const GhostRules<D>& rules, int axis, int side, const Index<D>& cell) {
  const SideRules<D>& of = rules[axis][side];
  if (of.areOne()) return of;
  const int part = level.partAt<D>(axis, side, cell);
  if (of.varying) return of.varying(part, cell);
  return part == grid::restOfSide ? of : of.parts[part];
}

template GhostRules<1> ghostRules<1>(const Level&, const Gas&, double);
template GhostRules<1> ghostRules<1>(const Level&, const Gas&, double, const Box&);
template GhostRules<2> ghostRules<2>(const Level&, const Gas&, double);
template GhostRules<2> ghostRules<2>(const Level&, const Gas&, double, const Box&);
template GhostRules<3> ghostRules<3>(const Level&, const Gas&, double);
template GhostRules<3> ghostRules<3>(const Level&, const Gas&, double, const Box&);
template GhostRules<1> diffusionRules<1>(const Level&, const Gas&, double);
template GhostRules<2> diffusionRules<2>(const Level&, const Gas&, double);
template GhostRules<3> diffusionRules<3>(const Level&, const Gas&, double);
template GhostRule<1> ruleAt<1>(const Level&, const GhostRules<1>&, int, int, const Index<1>&);
template GhostRule<2> ruleAt<2>(const Level&, const GhostRules<2>&, int, int, const Index<2>&);
template GhostRule<3> ruleAt<3>(const Level&, const GhostRules<3>&, int, int, const Index<3>&);
template bool isWall<1>(const Place&, const Gas&);
template bool isWall<2>(const Place&, const Gas&);
template bool isWall<3>(const Place&, const Gas&);

}  // namespace tushar::euler
