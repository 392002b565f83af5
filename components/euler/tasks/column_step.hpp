#pragma once

#include "components/euler/tasks/block_step.hpp"

namespace tushar::euler {

/// Performs a step for columns of cells along z, plane after plane; the result is bitwise equal to that of
/// advanceBlock. It stores only the planes that it needs at a time, and computes nothing twice along z.
template <class Flux, class Shape, class G>
class ColumnStep {
 public:
  /// Allocates space for columns no wider than `extents`.
  ColumnStep(const G& gas, const Level& level, const GhostRules<3>& rules, const Index3& extents, double dt,
             const ViewsOf<3, kGases<G>, const double>& old, const ViewsOf<3, kGases<G>, double>& fresh,
             const RimFluxes<3>& rims)
      : gas_(gas),
        level_(level),
        rules_(rules),
        dt_(dt),
        old_(old),
        fresh_(fresh),
        rims_(rims),
        work_(Work<3, kGases<G>>::ofColumns(cellsAcross(extents), Shape::reach)),
        rising_(isSingle ? 0 : cellsAcross(extents), 2) {}

  /// Calls `finish(plane)` for each plane of cells after its new state has been computed.
  template <class Finish>
  void run(const Box& column, Finish&& finish) {
    const Box around = column.grown(Shape::reach, 3);
    work_.hold(around);
    if (!isSingle) rising_.hold(around);
    const int first = column.lower[z], end = column.upper[z];
    take(planesOf(around, first - Shape::reach, first + Shape::reach));
    for (int plane = first - 1; plane <= end; ++plane) {
      if (plane > first) take(planesOf(around, plane + Shape::reach - 1, plane + Shape::reach));
      const Box cells = planesOf(column, plane, plane + 1);
      const bool isInside = plane >= first && plane < end;
      predict<3>(gas_, level_, isInside ? cells.grown(1, 2) : cells, dt_, work_, Shape{});
      if (plane >= first) rise(cells);
      // The fluxes along x and y are stored for one plane, so for a single gas that below is completed first.
      if (isInside && !isSingle) sweepPlane(cells);
      if (plane > first) {
        const Box below = planesOf(column, plane - 1, plane);
        add(below);
        finish(below);
      }
      if (isInside && isSingle) crossPlane(cells);
    }
  }

 private:
  static constexpr int z = 2;
  static constexpr bool isSingle = kGases<G> == 1;

  static std::size_t cellsAcross(const Index3& extents) {
    return static_cast<std::size_t>(extents[0] + 2 * Shape::reach) * (extents[1] + 2 * Shape::reach);
  }
  static Box planesOf(Box box, int first, int end) {
    box.lower[z] = first;
    box.upper[z] = end;
    return box;
  }
  /// Loads the state before the step in some planes, including planes outside the grid.
  void take(const Box& planes) {
    recover<3>(gas_, level_, planes, old_, work_.w);
    fillBeyondGrid<3>(level_, rules_, work_.w, planes);
  }
  /// Computes the fluxes along z through the lower faces of a plane.
  void rise(const Box& plane) {
    computeFluxes<3, Flux, Shape, z>(gas_, plane, work_, rising());
    keepAtRim<3>(rims_, plane, z, rising());
  }
  /// Computes the fluxes along x and y through the faces of a plane.
  void crossPlane(const Box& plane) {
    crossFaces<3, Flux, Shape, 0>(gas_, plane, work_, work_.flux, rims_);
    if constexpr (isSingle) crossFaces<3, Flux, Shape, 1>(gas_, plane, work_, work_.across[0], rims_);
  }
  /// Adds the change of a plane of several gases due to the fluxes along x and y.
  void sweepPlane(const Box& plane) {
    sweep<3, Flux, Shape, 0>(gas_, level_, plane, dt_, old_, work_, fresh_, rims_);
    sweep<3, Flux, Shape, 1>(gas_, level_, plane, dt_, old_, work_, fresh_, rims_);
  }
  /// Adds the change of a plane due to the fluxes along z; for a single gas, due to all fluxes.
  void add(const Box& plane) {
    rims_.masses.keep(plane, z, rising());
    if constexpr (isSingle)
      addAllFluxes<3>(level_, plane, dt_, old_, work_, fresh_);
    else
      addFluxes<3, z>(dt_ / level_.spacing(z), plane, old_, rising_, fresh_, areBlended(gas_));
  }
  /// The fluxes along z through the faces of two planes.
  Rows<3, kGases<G>>& rising() {
    if constexpr (isSingle)
      return work_.across[1];
    else
      return rising_;
  }

  const G& gas_;
  const Level& level_;
  const GhostRules<3>& rules_;
  double dt_;
  const ViewsOf<3, kGases<G>, const double>& old_;
  const ViewsOf<3, kGases<G>, double>& fresh_;
  const RimFluxes<3>& rims_;
  Work<3, kGases<G>> work_;
  Rows<3, kGases<G>> rising_;  ///< fluxes along z of several gases
};

}  // namespace tushar::euler
