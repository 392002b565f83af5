#pragma once

#include "components/mpmice/burn/reactant.hpp"
#include "components/mpmice/free_space.hpp"
#include "components/mpmice/gas_temperature.hpp"
#include "components/mpmice/near_bodies.hpp"

namespace tushar::mpmice {

/// The surface of bodies at the faces between cells.
///
/// Along each axis, a cell has an area: open part and wall together (see FreeSpace). From the gas into a body, this
/// area falls from 1 to 0. So its steps from cell to cell add up to the projection of the surface along the axis,
/// wherever the surface lies. Multiplied by the components of the normal, these steps add up to the area of the
/// surface.
template <int D>
class SurfaceAtFaces {
 public:
  SurfaceAtFaces(const Level& level, const Settings& settings, const GasInCells<D>& cells)
      : level_(level), cells_(cells), space_(level, settings, cells) {}

  const FreeSpace<D>& space() const { return space_; }
  /// The area along the axis in the cell below a face, minus the area in the cell above.
  double step(const Index<D>& above, int axis) const {
    return space_.faces(above - Index<D>::unit(axis), axis).area - space_.faces(above, axis).area;
  }
  /// The magnitude of the component along `axis` of the surface's unit normal at the lower face of a cell. The normal
  /// is the direction of the gradient of the free volume, with the weights 1 2 1 along the other axes.
  double normalAlong(const Index<D>& above, int axis) const {
    Vec<D> gradient = Vec<D>::Zero();
    for (int side = 0; side < 2; ++side) {
      const Index<D> cell = side == 0 ? above - Index<D>::unit(axis) : above;
      Box layer = cellsAround<D>(cell, 1);
      layer.lower[axis] = cell[axis];
      layer.upper[axis] = cell[axis] + 1;
      forEach<D>(layer, [&](const Index<D>& at) {
        const double free = cells_.free[space_.onGrid(at)];
        for (int d = 0; d < D; ++d) {
          const double factor = d == axis ? (side == 0 ? -1 : 1) : 0.5;
          gradient[d] += factor * weight(at - cell, axis, d) * free * level_.inverseSpacing(d);
        }
      });
    }
    const double length = gradient.norm();
    return length > 0 ? std::abs(gradient[axis]) / length : 0;
  }

 private:
  /// The weight, in the derivative along `d`, of a cell at `offset` from a cell next to the face.
  static double weight(const Index<D>& offset, int axis, int d) {
    double product = 1;
    for (int k = 0; k < D; ++k)
      if (k != axis) product *= k == d ? 0.5 * offset[k] : 0.25 * (2 - std::abs(offset[k]));
    return product;
  }

  const Level& level_;
  GasInCells<D> cells_;
  FreeSpace<D> space_;
};

/// The mode in which a cell of a body with cracks burns: c.burnMode.
enum class BurnMode { none, surface, cracks, waiting };

/// Views of how cells burn, and of the pressure at which they burn [Pa], if the body has cracks; and of the rate at
/// which surfaces burn [kg/(m² s)], if they have a state.
struct KnownModes {
  std::optional<CellView<const double>> mode, pressure, rate;

  static KnownModes from(auto& take, bool hasCracks, bool isUnsteady, int ghost) {
    return {.mode = take(when(hasCracks, requiresNew(c::burnMode, ghost))),
            .pressure = take(when(hasCracks, requiresNew(c::burnPressure, ghost))),
            .rate = take(when(isUnsteady, requiresNew(c::unsteadyRate, ghost)))};
  }
  template <int D>
  bool is(const Index<D>& cell, BurnMode one) const {
    return mode && (*mode)[cell] == double(one);
  }
  /// Whether the surface in a cell may burn.
  template <int D>
  bool allowSurface(const Index<D>& cell) const {
    return !mode || is(cell, BurnMode::surface);
  }
};

/// Views of how the surface burns at the lower faces of cells, and of what burns within cells.
template <int D>
struct NewBurning {
  CellView<Vec<D>> rate, blowing, recoil;
  CellView<double> within;

  static NewBurning from(auto& take) {
    return {.rate = take(computes(c::burnRate<D>)),
            .blowing = take(computes(c::blowing<D>)),
            .recoil = take(computes(c::recoil<D>)),
            .within = take(computes(c::burnRateWithin))};
  }
  void clear() const {
    for (const auto& field : {rate, blowing, recoil}) field.fill(Vec<D>::Zero());
    within.fill(0);
  }
};

/// Computes how the surface of a body burns, given the state at the start of the step.
template <int D>
class BurningSurface {
 public:
  BurningSurface(const Level& level, const Settings& settings, const GasInCells<D>& cells, const Reactant& reactant,
                 const KnownModes& modes)
      : level_(level),
        settings_(settings),
        cells_(cells),
        reactant_(reactant),
        modes_(modes),
        surface_(level, settings, cells) {}

  /// Adds the mass that burns at the lower face of a cell. The new gas leaves the body with the speed u = m (1/rho -
  /// 1/rho_s) and exerts the recoil m u, so that mass and momentum are conserved across the surface.
  void burn(const Index<D>& above, int axis, const NewBurning<D>& fresh) const {
    const Index<D> below = above - Index<D>::unit(axis);
    const double share = reactant_.shareIn(below, above), step = share > 0 ? surface_.step(above, axis) : 0;
    if (step == 0) return;
    const Index<D>&gas = step > 0 ? below : above, &body = step > 0 ? above : below;
    const euler::Gas law = lawAt<D>(settings_, cells_.held, cells_.free[gas], gas);
    const euler::State<D> w = cells_.primitive(law, gas);
    const double density = w[euler::kDensity], pressure = law.pressureOf(density, w[euler::kPressure<D>]);
    const ice::BurnModel& model = settings_.burning->model;
    if (!(pressure > model.leastPressure) || !(hottestAt(gas, body) > model.ignitionTemperature)) return;
    const Index<D>& main = reactant_.mass[body] > reactant_.mass[gas] ? body : gas;
    if (!modes_.allowSurface(main)) return;
    const double bodyDensity = reactant_.mass[main] / reactant_.volume[main];
    const double rate = rateIn(main, pressure);
    fresh.rate[above][axis] = rate * share * step * surface_.normalAlong(above, axis) * level_.inverseSpacing(axis);
    const double wall = surface_.space().faces(gas, axis).wall(step > 0 ? 1 : 0);
    if (!(wall > 0)) return;
    const double part = share * std::clamp(step / wall, -1.0, 1.0);
    const double speed = std::max(0.0, rate * (1 / density - 1 / bodyDensity));
    fresh.blowing[above][axis] = part * speed;
    fresh.recoil[above][axis] = part * rate * speed;
  }

  /// Adds the mass that burns in a cell with a remnant of a body, or with a part of a plate thinner than a cell. In
  /// such a cell, areas have no step unless a neighbouring cell is a wall; the area of one face is taken as that of the
  /// surface.
  void burnWithin(const Index<D>& cell, const NewBurning<D>& fresh) const {
    if (!(reactant_.mass[cell] > 0) || cells_.isEmpty(cell) || isBesideWall(cell)) return;
    if (!modes_.allowSurface(cell)) return;
    const euler::Gas law = lawAt<D>(settings_, cells_.held, cells_.free[cell], cell);
    const euler::State<D> w = cells_.primitive(law, cell);
    const double pressure = law.pressureOf(w[euler::kDensity], w[euler::kPressure<D>]);
    const ice::BurnModel& model = settings_.burning->model;
    if (!(pressure > model.leastPressure) || !(hottestAt(cell, cell) > model.ignitionTemperature)) return;
    double perWidth = 0;
    for (int d = 0; d < D; ++d) perWidth += level_.inverseSpacing(d) / D;
    fresh.within[cell] = perWidth * reactant_.shareIn(cell, cell) * rateIn(cell, pressure);
  }

  /// Adds the mass that burns in the cracks of a cell.
  void burnCracks(const Index<D>& cell, const NewBurning<D>& fresh) const {
    if (!modes_.is(cell, BurnMode::cracks)) return;
    const double density = reactant_.mass[cell] / reactant_.volume[cell];
    fresh.within[cell] =
        ice::Ddt::surfaceOfCracks * reactant_.volume[cell] *
        settings_.burning->model.rate({(*modes_.pressure)[cell], reactant_.temperature[cell], density});
  }

 private:
  /// The rate at which the surface of a cell of the body burns [kg/(m² s)], given the pressure of the gas [Pa].
  double rateIn(const Index<D>& cell, double pressure) const {
    if (modes_.rate) return (*modes_.rate)[cell];
    return settings_.burning->model.rate(
        {pressure, reactant_.temperature[cell], reactant_.mass[cell] / reactant_.volume[cell]});
  }
  /// Whether a body fills most of the area along an axis of a neighbouring cell.
  bool isBesideWall(const Index<D>& cell) const {
    bool is = false;
    forEach<D>(level_.clipCells(cellsAround<D>(cell, 1)), [&](const Index<D>& at) {
      for (int d = 0; d < D; ++d) is = is || surface_.space().faces(at, d).area < 0.5;
    });
    return is;
  }
  /// The highest temperature of the gas, and of the bodies that fill more than a fifth of one of the cells `gas` and
  /// `body`.
  double hottestAt(const Index<D>& gas, const Index<D>& body) const {
    double hottest = std::max(reactant_.hottest[gas], reactant_.hottest[body]);
    if (cells_.free[gas] > leastVisible) hottest = std::max(hottest, gasTemperature<D>(settings_, cells_, gas));
    return hottest;
  }

  const Level& level_;
  const Settings& settings_;
  GasInCells<D> cells_;
  const Reactant& reactant_;
  const KnownModes& modes_;
  SurfaceAtFaces<D> surface_;
};

/// Computes the mass that burns at the faces and within the cells of a patch.
template <int D>
void findBurning(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, const Reactant& reactant,
                 const KnownModes& modes, const NewBurning<D>& fresh) {
  fresh.clear();
  if (!settings.burning->model.burnsAtSurface()) return;
  const NearBodies<D> near(patch.cells(), nearLayers, cells.free, cells.held.density);
  const BurningSurface<D> surface(patch.level(), settings, cells, reactant, modes);
  const FreeSpace<D> space(patch.level(), settings, cells);
  near.forEachIn(patch.cells(), [&](const Index<D>& cell) {
    for (int d = 0; d < D; ++d)
      if (!space.isAtSide(cell, d, 0)) surface.burn(cell, d, fresh);
    surface.burnWithin(cell, fresh);
    surface.burnCracks(cell, fresh);
  });
}

}  // namespace tushar::mpmice
