#pragma once

#include "components/mpmice/burn/burning_surface.hpp"
#include "components/mpmice/surroundings.hpp"

namespace tushar::mpmice {

/// What a cell of a body that burns finds in the cells around it, given the state at the start of the step.
template <int D>
class Neighbourhood {
 public:
  Neighbourhood(const Level& level, const Settings& settings, const GasInCells<D>& cells, const Reactant& reactant)
      : level_(level),
        settings_(settings),
        model_(settings.burning->model),
        cells_(cells),
        reactant_(reactant),
        surface_(level, settings, cells) {}

  const SurfaceAtFaces<D>& surface() const { return surface_; }
  bool isEmpty(const Index<D>& cell) const { return cells_.isEmpty(cell); }
  double freeVolume(const Index<D>& cell) const { return cells_.isEmpty(cell) ? 0 : cells_.free[cell]; }
  /// The pressure of the gas in a cell that contains gas [Pa].
  double gasPressure(const Index<D>& cell) const {
    const euler::Gas law = lawAt<D>(settings_, cells_.held, cells_.free[cell], cell);
    const euler::State<D> w = cells_.primitive(law, cell);
    return law.pressureOf(w[euler::kDensity], w[euler::kPressure<D>]);
  }
  /// Whether the gas, or a body that fills more than a fifth of the cell, is hot enough to ignite a surface.
  bool isHot(const Index<D>& cell) const {
    double hottest = reactant_.hottest[cell];
    if (!cells_.isEmpty(cell) && cells_.free[cell] > leastVisible)
      hottest = std::max(hottest, gasTemperature<D>(settings_, cells_, cell));
    return hottest > model_.ignitionTemperature;
  }
  /// Calls a function for the cell and its neighbours, including those across corners.
  template <class Visit>
  void forEachAround(const Index<D>& cell, Visit&& visit) const {
    forEach<D>(level_.clipCells(cellsAround<D>(cell, 1)), visit);
  }
  struct Around {
    double product = 0;  ///< mean pressure of the gas in those surrounding cells with the largest free volume [Pa]
    bool isHot = false;
  };
  Around look(const Index<D>& cell) const {
    Around found;
    double most = 0;
    forEachAround(cell, [&](const Index<D>& at) {
      found.isHot = found.isHot || isHot(at);
      most = std::max(most, freeVolume(at));
    });
    if (most == 0) return found;
    typename Surroundings<D>::Set widest = Surroundings<D>::none;
    forEachAround(cell, [&](const Index<D>& at) {
      if (freeVolume(at) > most - offRoundShares) widest |= Surroundings<D>::bitOf(cell, at);
    });
    found.product =
        Surroundings<D>::sum(widest, cell, [&](const Index<D>& at) { return gasPressure(at); }) / std::popcount(widest);
    return found;
  }
  /// Whether the surface of the body passes through a face of the cell: there, the areas of the cells on both sides
  /// differ by more than `least` (see SurfaceAtFaces).
  bool isExposed(const Index<D>& cell, double least) const {
    for (int d = 0; d < D; ++d) {
      if (!surface_.space().isAtSide(cell, d, 0) && std::abs(surface_.step(cell, d)) > least) return true;
      if (!surface_.space().isAtSide(cell, d, 1) && std::abs(surface_.step(cell + Index<D>::unit(d), d)) > least)
        return true;
    }
    return false;
  }

 private:
  const Level& level_;
  const Settings& settings_;
  const ice::BurnModel& model_;
  GasInCells<D> cells_;
  const Reactant& reactant_;
  SurfaceAtFaces<D> surface_;
};

}  // namespace tushar::mpmice
