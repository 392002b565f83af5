#pragma once

#include "components/mpmice/warm_cells.hpp"

namespace tushar::mpmice {

/// Views of a body in the heat exchange: what it is, the heat that it receives from neighbouring cells, and its change.
struct WarmingBody {
  WarmBody body;
  CellView<const double> atFaces;
  CellView<double> warming;

  static WarmingBody from(auto& take) {
    return {.body = WarmBody::from(take, 0),
            .atFaces = take(requiresNew(c::heatOfBodyAtFaces)),
            .warming = take(computes(c::warming))};
  }
};

/// Views of the heat that each gas receives from neighbouring cells; none if bodies exchange no heat.
struct GasAtFaces {
  std::vector<CellView<const double>> heat;

  static GasAtFaces from(auto& take, std::size_t gases) {
    return {viewsOfGases(take, std::max<std::size_t>(1, gases),
                         [](std::size_t k) { return requiresNew(c::heatOfGasAtFaces[k]); })};
  }
};

/// Largest number of bodies and gases for which the heat exchange needs no heap memory in each cell.
inline constexpr int kFewThings = 8;

/// Exchanges heat between all bodies and gases that share a cell, with Uintah's exchange coefficients; heat is
/// conserved. `Most` is the largest total number of bodies and gases.
template <int D, int Most>
class HeatExchange {
 public:
  HeatExchange(const Settings& settings, const WarmGas<D>& gas, const WarmCells<D, Most, WarmGas<D>>& cells)
      : settings_(settings), gas_(gas), cells_(cells) {
    const auto isStiffened = [](const euler::Settings& one) { return one.gas.pInfinity > 0; };
    are_stiffened_together_ =
        !areBlended(settings) && std::any_of(settings.gases.begin(), settings.gases.end(), isStiffened);
  }

  /// Exchanges heat in a cell, and adds heat from outside and through the faces of the cell: `toBodies` and `toGases`.
  /// Calls `warm(body, change)` with the changes of temperature [K]. Returns the heat that the gas loses to bodies, per
  /// cell volume [J/m³].
  template <class Warm>
  double apply(const Index<D>& cell, double time, double dt, const std::vector<WarmingBody>& toBodies,
               const GasAtFaces& toGases, Warm&& warm) const {
    const Eigen::Index first = cells_.bodies();
    ice::WarmThings<Most> things = cells_.at(cell);
    ice::giveHeat(things, settings_.heating, time, dt, first);
    double toGas = things.given.sum(), fromBeside = 0, ofBodies = 0;
    for (std::size_t k = 0; k < toGases.heat.size(); ++k) {
      const double heat = toGases.heat[k][cell];
      things.given[first + static_cast<Eigen::Index>(k)] += heat;
      fromBeside += heat;
    }
    toGas += fromBeside;
    gas_.totalEnergy[cell] += toGas;
    for (std::size_t m = 0; m < toBodies.size(); ++m) {
      const double heat = toBodies[m].atFaces[cell];
      things.given[static_cast<Eigen::Index>(m)] = heat;
      ofBodies += heat;
    }
    const auto solid = static_cast<int>((things.capacity.head(first).array() > 0).count());
    const int present = things.present();
    if (present < 2 && solid == 0) return -fromBeside;
    const auto changes = ice::changesByHeat(things, settings_.heat, dt);
    const double given = solid > 0 && present > solid ? heatToBodies(things, changes, ofBodies, toGas) : 0;
    gas_.totalEnergy[cell] -= given;
    if (solid > 0) warmBodies(things, changes, given + ofBodies, warm);
    if (present > solid && !settings_.gases.empty() && !areBlended(settings_))
      ice::changeShares(changes, first, gas_.free[cell],
                        [&](Eigen::Index k) -> double& { return gas_.shares[k][cell]; });
    return given - fromBeside;
  }

 private:
  /// The heat that bodies receive from gases of the cell [J/m³], in addition to what is given to bodies and gases. It
  /// is better known from what the gases gain, because the round-off of the heat of bodies may exceed all heat of a
  /// trace of gas. Stiffened gases that share a cell are the exception: they gain p_inf dV in addition to m c_v dT.
  double heatToBodies(const ice::WarmThings<Most>& things, const ice::HeatChanges<Most>& changes, double toBodies,
                      double toGases) const {
    const Eigen::Index bodies = cells_.bodies();
    return are_stiffened_together_ ? gained(things, changes, 0, bodies) - toBodies
                                   : toGases - gained(things, changes, bodies, things.capacity.size());
  }
  /// The heat that the things from `begin` to `end` gain by changes of temperature [J/m³].
  static double gained(const ice::WarmThings<Most>& things, const ice::HeatChanges<Most>& changes, Eigen::Index begin,
                       Eigen::Index end) {
    double sum = 0;
    for (Eigen::Index k = begin; k < end; ++k)
      if (things.capacity[k] > 0) sum += things.capacity[k] * changes.temperature[k];
    return sum;
  }
  /// Calls `warm(body, change)` with the changes of temperature [K]. The round-off of a stiff exchange is divided among
  /// the bodies, so that together they receive the heat `received` [J/m³].
  template <class Warm>
  void warmBodies(const ice::WarmThings<Most>& things, const ice::HeatChanges<Most>& changes, double received,
                  Warm&& warm) const {
    const Eigen::Index bodies = cells_.bodies();
    const double missing = received - gained(things, changes, 0, bodies);
    const double each = missing / things.capacity.head(bodies).sum();
    for (Eigen::Index m = 0; m < bodies; ++m)
      if (things.capacity[m] > 0) warm(m, changes.temperature[m] + each);
  }

  const Settings& settings_;
  const WarmGas<D>& gas_;
  const WarmCells<D, Most, WarmGas<D>>& cells_;
  bool are_stiffened_together_;  ///< whether several gases share cells, one of which is stiffened
};

/// Exchanges heat between bodies and gases.
template <int D, int Most>
void exchangeHeat(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
                  double time, double dt, const WarmGas<D>& gas, const GasAtFaces& toGases,
                  const std::vector<WarmingBody>& toBodies, const std::optional<CellView<double>>& heat) {
  if (heat) heat->fill(0);
  std::vector<WarmBody> bodies;
  for (const WarmingBody& one : toBodies) {
    bodies.push_back(one.body);
    one.warming.fill(0);
  }
  const WarmCells<D, Most, WarmGas<D>> cells(materials, settings, gas, bodies);
  const HeatExchange<D, Most> exchange(settings, gas, cells);
  const bool hasGasAlone = (!settings.gases.empty() && !areBlended(settings)) || settings.heating.acts();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const bool isWarmed = std::any_of(toGases.heat.begin(), toGases.heat.end(),
                                      [&](const CellView<const double>& ofGas) { return ofGas[cell] != 0; });
    if (!hasGasAlone && !isWarmed && !cells.hasBody(cell)) return;
    const double given = exchange.apply(cell, time, dt, toBodies, toGases, [&](Eigen::Index m, double change) {
      toBodies[static_cast<std::size_t>(m)].warming[cell] = change;
    });
    if (heat) (*heat)[cell] = given;
  });
}

/// Exchanges heat between several gases that exchange no heat with bodies.
template <int D>
void heatGases(const Patch& patch, const Settings& settings, double time, double dt, const WarmGas<D>& gas) {
  const std::vector<WarmBody> none;
  const std::vector<mpm::solid::Material> noMaterials;
  const WarmCells<D, euler::kMostGases, WarmGas<D>> cells(noMaterials, settings, gas, none);
  const HeatExchange<D, euler::kMostGases> exchange(settings, gas, cells);
  forEach<D>(patch.cells(),
             [&](const Index<D>& cell) { exchange.apply(cell, time, dt, {}, {}, [](Eigen::Index, double) {}); });
}

}  // namespace tushar::mpmice
