#pragma once

#include "components/mpm/gas/conserving/box_sums.hpp"
#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/symmetry_planes.hpp"

namespace tushar::mpm::gas::conserving {

/// Sums over boxes: mass and momentum at nodes; mass, internal energy and, if `Fills`, volume in cells.
template <int D, bool Fills>
struct Gathering {
  static constexpr std::size_t nodeSums = 1 + D, cellSums = Fills ? 3 : 2;
  static constexpr Computes<SpanValues::weights> weights{};
  /// Whether weights along rows are computed where the extent is known. In three dimensions, the code would be longer
  /// than the cache of instructions, and take 1.1 times as long.
  static constexpr bool weighsRows = D < 3;

  BoxSums<D, nodeSums, 1> nodes;
  BoxSums<D, cellSums, 0> cells;

  explicit Gathering(const RowsAround<D>& around)
      : nodes(around.rows, around.blocks), cells(around.rows, around.blocks) {}

  [[gnu::always_inline]] static Footprint<D> footprintOf(const CellsOf<D>& grid, const Batch<D>& batch,
                                                         const LanesVec<D>& centre, const LanesVec<D>& size) {
    if constexpr (weighsRows)
      return Footprint<D>(grid, batch, centre, size, weights, OnlyEnds());
    else
      return Footprint<D>(grid, batch, centre, size, weights);
  }
  [[gnu::always_inline]] void add(const CellsOf<D>& grid, Footprint<D>& footprint,
                                  const std::array<Lanes, 3>& massEnergyVolume,
                                  const typename Footprint<D>::template Field<D - 1>& velocity) {
    const auto addAll = [&](auto extent) __attribute__((always_inline)) {
      addToCells(extent, footprint, massEnergyVolume);
      addToNodes(extent, footprint, massEnergyVolume[0], velocity);
    };
    if constexpr (weighsRows)
      footprint.weighRows(grid, weights, addAll);
    else
      footprint.withExtentOfRows(addAll);
  }

 private:
  template <int Below, int Cells>
  [[gnu::always_inline]] void addToCells(Extent<Below, Cells> extent, const Footprint<D>& footprint,
                                         const std::array<Lanes, 3>& massEnergyVolume) {
    footprint.forEachRowOfCells([&](const Index<D>& k, const Lanes& part) __attribute__((always_inline)) {
      cells.add(
          footprint, k, [&](std::size_t n) __attribute__((always_inline)) {
            const Lanes held = part * massEnergyVolume[n];
            std::array<Lanes, Cells> terms;
            for (std::size_t c = 0; c < Cells; ++c) terms[c] = footprint.along[0].part[c] * held;
            return cells.widened(extent, terms);
          });
    });
  }
  template <int Below, int Cells>
  [[gnu::always_inline]] void addToNodes(Extent<Below, Cells> extent, const Footprint<D>& footprint, const Lanes& mass,
                                         const typename Footprint<D>::template Field<D - 1>& velocity) {
    const auto& span = footprint.along[0];
    footprint.forEachRowOfNodes(
        velocity, [&](const Index<D>& k, const Lanes& w, const auto& field) __attribute__((always_inline)) {
          const Lanes inRow = w * mass;
          std::array<Lanes, Cells + 1> m;
          for (std::size_t c = 0; c <= Cells; ++c) m[c] = span.weight[c] * inRow;
          nodes.add(
              footprint, k, [&](std::size_t n) __attribute__((always_inline)) {
                if (n == 0) return nodes.widened(extent, m);
                const int axis = static_cast<int>(n) - 1;
                std::array<Lanes, Cells + 1> momentum;
                for (std::size_t c = 0; c <= Cells; ++c)
                  momentum[c] = m[c] * multiplyAdd(span.arm[c], field[1][axis], field[0][axis]);
                return nodes.widened(extent, momentum);
              });
        });
  }
};

/// Views of particles, and of the grid state that is gathered from them.
template <int D>
struct ParticlesToGrid {
  ParticleView<const Vec<D>> x, edges;
  ParticleView<const double> mass;
  ParticleView<const Vec<D>> velocity;
  ParticleView<const Modes<D>> modes;
  ParticleView<const double> internalEnergy;
  NodeView<double> nodeMass;
  NodeView<Vec<D>> nodeVelocity;
  CellView<double> cellMass, cellInternalEnergy;

  static ParticlesToGrid from(auto& take) {
    constexpr int reach = Footprint<D>::reach;
    return {.x = take(requiresNew(p::x<D>, reach)),
            .edges = take(requiresNew(p::edges<D>, reach)),
            .mass = take(requiresNew(p::mass, reach)),
            .velocity = take(requiresNew(p::velocity<D>, reach)),
            .modes = take(requiresNew(p::modes<D>, reach)),
            .internalEnergy = take(requiresNew(p::internalEnergy, reach)),
            .nodeMass = take(computes(g::mass)),
            .nodeVelocity = take(computes(g::velocity<D>)),
            .cellMass = take(computes(c::mass)),
            .cellInternalEnergy = take(computes(c::internalEnergy))};
  }
};

/// Computes m_i = sum w m,   v_i = sum w m u(x_i) / m_i on the patch's nodes,   M_c = sum o m,   IE_c = sum o m e in
/// its cells;
/// w and o as in Footprint, u the velocity of the particle's modes. Symmetry planes: no normal velocity.
/// If `Fills`, calls `visitFill(part, volume)` with the volumes of the boxes in the cells of each part of a row.
template <int D, bool Fills, class Visit>
void gatherOnGrid(const Patch& patch, const ParticlesToGrid<D>& t, Visit&& visitFill) {
  const RowsAround<D> around(patch, t.x.cells(), 1);
  Gathering<D, Fills> sums(around);
  const CellsOf<D> grid(patch.level());
  const auto visit = [&](const Batch<D>& batch) __attribute__((always_inline)) {
    const LanesVec<D> size = load(t.edges, batch);
    Footprint<D> footprint = sums.footprintOf(grid, batch, load(t.x, batch), size);
    const Lanes m = batch.only(load(t.mass, batch));
    sums.add(grid, footprint, {m, m * load(t.internalEnergy, batch), batch.only(size.prod())},
             fieldOf<D>(load(t.velocity, batch), load(t.modes, batch)));
  };
  const auto finish = [&](const Index<D>& row) {
    forEachPartOfRow<D>(t.cellMass.box(), row, [&](const RowPart<D>& part) {
      store(sums.cells.readRow(0, part.first), t.cellMass, part);
      store(sums.cells.readRow(1, part.first), t.cellInternalEnergy, part);
      if constexpr (Fills) visitFill(part, sums.cells.readRow(2, part.first));
    });
    forEachPartOfRow<D>(t.nodeMass.box(), row, [&](const RowPart<D>& part) {
      const Lanes m = sums.nodes.readRow(0, part.first), inverse = select(m > 0, 1 / m, 0);
      LanesVec<D> v;
      for (std::size_t d = 0; d < D; ++d) v[static_cast<int>(d)] = inverse * sums.nodes.readRow(d + 1, part.first);
      store(m, t.nodeMass, part);
      store(v, t.nodeVelocity, part);
    });
  };
  sumOverBoxes<D>(around, t.x, visit, finish, sums.nodes, sums.cells);
  stopAtSymmetryPlanes<D>(patch, t.nodeVelocity);
}

/// Gathers the particles on the grid: the task that only calls gatherOnGrid.
template <int D>
void interpolateParticlesToGrid(const Patch& patch, const Gas&, const ParticlesToGrid<D>& transfer) {
  gatherOnGrid<D, false>(patch, transfer, [](const RowPart<D>&, const Lanes&) {});
}

/// Calls gatherOnGrid, and computes the fraction of each cell that boxes fill, which is 1 if they tile the cell.
template <int D>
void interpolateAndMeasureFill(const Patch& patch, const Gas&, const ParticlesToGrid<D>& transfer,
                               CellView<double> fill, Maximum& fullest) {
  double inverse = 1;
  for (int d = 0; d < D; ++d) inverse *= patch.level().inverseSpacing(d);
  Lanes most = 0;
  gatherOnGrid<D, true>(patch, transfer, [&](const RowPart<D>& part, const Lanes& volume) {
    const Lanes filled = volume * inverse;
    store(filled, fill, part);
    if (part.isFull()) {
      most = max(most, filled);
    } else {
      for (int lane = 0; lane < part.count; ++lane) fullest.add(filled[lane]);
    }
  });
  fullest.add(greatest(most));
}

}  // namespace tushar::mpm::gas::conserving
