#pragma once

#include "components/mpm/gas/conserving/box_sums.hpp"
#include "components/mpm/gas/conserving/boxes.hpp"
#include "components/mpm/gas/conserving/scheme.hpp"
#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas::conserving {

/// Scales velocity modes down if their kinetic energy could exceed K_A by more than the fraction `spare` of the heat.
/// The mean square of x_d - centre_d, as the grid sees a box of length L, is at most L²/12 + h²/4.
template <int D>
void limitModes(const Patch& patch, const Gas&, double spare, ParticleView<const Vec<D>> edges,
                ParticleView<const double> heat, ParticleView<const double> affineEnergy,
                ParticleView<Modes<D>> modes) {
  const auto inertiaOf = [&](const auto& size) {
    std::remove_cvref_t<decltype(size)> inertia;
    for (int d = 0; d < D; ++d) {
      const double h = patch.level().spacing(d);
      inertia[d] = size[d] * size[d] / 12 + h * h / 4;
    }
    return inertia;
  };
  const auto limit = [&](int p) {
    const double energy = modalEnergy<D>(modes[p], inertiaOf(edges[p])), most = affineEnergy[p] + spare * heat[p];
    if (energy > most) modes[p] *= std::sqrt(most / energy);
  };
  int p = 0;
  for (; p + Lanes::count <= edges.owned(); p += Lanes::count) {
    const auto u = columnsOf<D*((1 << D) - 1)>([&](int lane) { return modes[p + lane].data(); });
    const LanesVec<D> size = matrixOf<D, 1>(unpack<D>(edges[p].data()));
    const Lanes energy = modalEnergy<D>(matrixOf<D, (1 << D) - 1>(u), inertiaOf(size));
    const Lanes most = Lanes::at(&affineEnergy[p]) + spare * Lanes::at(&heat[p]);
    if (any(energy > 0.999 * most))  // rarely
      for (int lane = 0; lane < Lanes::count; ++lane) limit(p + lane);
  }
  for (; p < edges.owned(); ++p) limit(p);
}

/// Halves particles longer than `longestInCells` cells along an axis: the children lie a quarter of the length L on
/// either side of the centre, with the velocities v -+ L B_d / 4. The kinetic energy of this relative motion is taken
/// from K_A, then from e. A child may lie in the next cell: of the children of its own particles and of its ghosts,
/// each patch makes those that lie in its own cells.
template <int D>
void splitLong(const Patch& patch, double longestInCells, const OldBoxes<D>& old, ParticleMaker& maker,
               const NewBoxes<D>& fresh);

/// Replaces the particles by one per cell. The new particle fills the cell or, next to an empty cell, only the part of
/// the cell that the gas fills. Its mass, momentum and energy are the sums over the parts of old particles in the cell.
/// The mass and energy of a part follow van Leer's limited slopes of the cell values (`mass`, `energy`); its velocity
/// is the particle's velocity at that point. The velocity gradient of a new particle is the regression over its parts,
/// its mixed modes are the mean over its parts, and kinetic energy that these cannot represent becomes heat.
template <int D>
void remap(const Patch& patch, const OldBoxes<D>& old, CellView<const double> mass, CellView<const double> energy,
           ParticleMaker& maker, const NewBoxes<D>& fresh);

/// Halves long particles: the task that only calls splitLong.
template <int D>
void redistribute(const Patch& patch, const Gas&, ParticleMaker& maker, double longestInCells, const OldBoxes<D>& old,
                  const NewBoxes<D>& fresh) {
  splitLong<D>(patch, longestInCells, old, maker, fresh);
}

/// Calls remap in steps in which `count` is 0, and splitLong in others.
template <int D>
void redistributeOrRemap(const Patch& patch, const Gas&, ParticleMaker& maker, double longestInCells,
                         const OldBoxes<D>& old, CellView<const double> cellMass, CellView<const double> cellEnergy,
                         double count, const NewBoxes<D>& fresh) {
  if (count == 0)
    remap<D>(patch, old, cellMass, cellEnergy, maker, fresh);
  else
    splitLong<D>(patch, longestInCells, old, maker, fresh);
}

/// Counts the steps since the latest remap. The count is 0 if this step does a remap, after `every` steps or because a
/// cell is too full.
inline void countSteps(const Patch&, const Remap& remap, double age, double fill, Maximum& count) {
  count.add(age + 1 >= remap.every || fill > 1 + remap.overfilled ? 0.0 : age + 1);
}
inline void keepCount(const Patch&, double count, Maximum& age) { age.add(count); }

/// Computes mass and internal energy of the parts of particles in each cell, in steps in which `count` is 0.
template <int D>
void gatherInCells(const Patch& patch, const Gas&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> edges,
                   ParticleView<const double> mass, ParticleView<const double> internalEnergy, double count,
                   CellView<double> cellMass, CellView<double> cellEnergy) {
  cellMass.fill(0);
  cellEnergy.fill(0);
  if (count != 0) return;
  const CellsOf<D> grid(patch.level());
  const RowsAround<D> around(patch, x.cells(), 0);
  BoxSums<D, 2, 0> sums(around.rows, around.blocks);
  const auto visit = [&](const Batch<D>& batch) {
    const Footprint<D> footprint(grid, batch, load(x, batch), load(edges, batch), Computes<SpanValues::weights>());
    const Lanes m = batch.only(load(mass, batch)), energy = m * load(internalEnergy, batch);
    footprint.withExtentOfRows([&](auto extent) __attribute__((always_inline)) {
      constexpr std::size_t cells = decltype(extent)::cells;
      footprint.forEachRowOfCells([&](const Index<D>& k, const Lanes& part) __attribute__((always_inline)) {
        sums.add(
            footprint, k, [&](std::size_t n) __attribute__((always_inline)) {
              std::array<Lanes, cells> terms;
              for (std::size_t c = 0; c < cells; ++c)
                terms[c] = part * footprint.along[0].part[c] * (n == 0 ? m : energy);
              return sums.widened(extent, terms);
            });
      });
    });
  };
  const auto finish = [&](const Index<D>& row) {
    forEachPartOfRow<D>(patch.cells(), row, [&](const RowPart<D>& part) {
      store(sums.readRow(0, part.first), cellMass, part);
      store(sums.readRow(1, part.first), cellEnergy, part);
    });
  };
  sumOverBoxes<D>(around, x, visit, finish, sums);
}

}  // namespace tushar::mpm::gas::conserving
