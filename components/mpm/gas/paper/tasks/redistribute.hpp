#pragma once

#include <vector>

#include "components/mpm/gas/material.hpp"
#include "components/mpm/labels.hpp"

namespace tushar::mpm::gas::paper {

/// How particles are redistributed where a cell holds too few or too many.
struct Redistribution {
  enum class Mode {
    splitMerge,  ///< halve the large ones, join neighbours
    reseed,      ///< put new ones at the midpoints of equal parts of the cell
  };
  Location where;  ///< in the scene
  Mode mode = Mode::splitMerge;
  int minParticles = 2;     ///< per cell
  int maxParticles = 16;    ///< per cell
  int targetParticles = 4;  ///< per cell, of `reseed`; along each axis its D-th root, rounded up

  /// Particles along each axis of a cell that is seeded anew.
  int seededAlongAxis(int dimension) const {
    int number = 1;
    while (std::pow(number, dimension) < targetParticles) ++number;
    return number;
  }
};

/// A particle with all that redistribution needs to know of it.
template <int D>
struct Piece {
  ParticleId id = 0;
  Vec<D> x = Vec<D>::Zero(), velocity = Vec<D>::Zero();
  double mass = 0, volume = 0, internalEnergy = 0, divergence = 0;

  double density() const { return mass / volume; }
};

/// A cell's place, and for `reseed` the slopes of its mean density, velocity and pressure along each axis, per metre.
template <int D>
struct CellShape {
  Vec<D> lower, spacing;
  double volume = 0;
  Vec<D> densitySlope = Vec<D>::Zero(), pressureSlope = Vec<D>::Zero();
  std::array<Vec<D>, D> velocitySlope;  ///< of each velocity component

  CellShape() { velocitySlope.fill(Vec<D>::Zero()); }
};

/// Halves pieces larger than V_c / (2 N_min), in the order of their ids, until there are N_min: equal mass and volume
/// at x ± min(V, V_c) / V_c h / 4 along the longest axis of the cell (moved inside the cell where they would leave
/// it), same velocity, energy and density.
template <int D>
void split(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, int minParticles);

/// Joins the two nearest pieces until there are N_max: position and velocity weighted with mass, volume summed; the
/// kinetic energy m1 m2 |v1 - v2|² / (2 (m1 + m2)) that this takes becomes heat.
template <int D>
void merge(std::vector<Piece<D>>& pieces, int maxParticles);

/// Puts n^D pieces of equal volume at the midpoints of the cell with the cell's slopes of density, velocity (about
/// the centre of mass, scaled so that kinetic energy does not grow) and pressure. What kinetic energy is lost becomes
/// heat. Mass, momentum and total energy stay.
template <int D>
void reseed(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, const Gas& gas, int alongAxis);

/// Means over the particles of a cell and of its neighbours, limited by minmod: the slopes for `reseed`.
template <int D>
void setSlopes(CellShape<D>& cell, const std::vector<Piece<D>>& here,
               const std::array<std::vector<Piece<D>>, 2 * D>& around, const Gas& gas);

/// Redistributes one cell.
template <int D>
void redistributeCell(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, const Gas& gas,
                      const Redistribution& how);

/// The values of new particles.
template <int D>
struct PieceColumns {
  std::vector<Vec<D>>*x, *velocity;
  std::vector<double>*mass, *density, *internalEnergy, *divergence;  ///< mass: null where it is not a variable

  void add(const Piece<D>& piece) const {
    x->push_back(piece.x);
    velocity->push_back(piece.velocity);
    if (mass) mass->push_back(piece.mass);
    density->push_back(piece.density());
    internalEnergy->push_back(piece.internalEnergy);
    divergence->push_back(piece.divergence);
  }
};

/// Redistributes all cells of a patch; `gather(cell)` gives the pieces of a cell, ghost cells included.
template <int D, class Gather>
void redistributePatch(const Patch& patch, const Gas& gas, const Redistribution& how, ParticleMaker& maker,
                       const Gather& gather, const PieceColumns<D>& columns) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    std::vector<Piece<D>> pieces = gather(cell);
    CellShape<D> shape;
    shape.volume = level.cellVolume();
    for (int d = 0; d < D; ++d) {
      shape.lower[d] = level.nodePosition(d, cell[d]);
      shape.spacing[d] = level.spacing(d);
    }
    const int count = static_cast<int>(pieces.size());
    const bool outside = count < how.minParticles || count > how.maxParticles;
    if (outside && how.mode == Redistribution::Mode::reseed) {
      std::array<std::vector<Piece<D>>, 2 * D> around;
      for (int d = 0; d < D; ++d) {
        around[static_cast<std::size_t>(2 * d)] = gather(cell - Index<D>::unit(d));
        around[static_cast<std::size_t>(2 * d + 1)] = gather(cell + Index<D>::unit(d));
      }
      setSlopes<D>(shape, pieces, around, gas);
    }
    if (outside) redistributeCell<D>(pieces, shape, gas, how);
    for (const Piece<D>& piece : pieces) {
      maker.add(cell, piece.id);
      columns.add(piece);
    }
  });
}

/// Redistribution for particles that share the volume of their cell: V_p = V_c / N_c.
template <int D>
void redistribute(const Patch& patch, const Gas& gas, ParticleMaker& maker, const Redistribution& how,
                  ParticleView<const ParticleId> ids, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> velocity,
                  ParticleView<const double> density, ParticleView<const double> internalEnergy,
                  ParticleView<const double> divergence, std::vector<Vec<D>>& newX, std::vector<Vec<D>>& newVelocity,
                  std::vector<double>& newDensity, std::vector<double>& newInternalEnergy,
                  std::vector<double>& newDivergence) {
  const auto gather = [&](const Index<D>& cell) {
    std::vector<Piece<D>> pieces;
    if (!x.cells().contains(cell)) return pieces;
    const double volume = patch.level().cellVolume() / std::max(x.in(cell).size(), 1);
    for (const int p : x.in(cell))
      pieces.push_back({ids[p], x[p], velocity[p], density[p] * volume, volume, internalEnergy[p], divergence[p]});
    return pieces;
  };
  redistributePatch<D>(patch, gas, how, maker, gather,
                       {&newX, &newVelocity, nullptr, &newDensity, &newInternalEnergy, &newDivergence});
}

/// Redistribution for particles that carry their mass: V_p = m_p / rho_p.
template <int D>
void redistributeTracked(const Patch& patch, const Gas& gas, ParticleMaker& maker, const Redistribution& how,
                         ParticleView<const ParticleId> ids, ParticleView<const Vec<D>> x,
                         ParticleView<const Vec<D>> velocity, ParticleView<const double> mass,
                         ParticleView<const double> density, ParticleView<const double> internalEnergy,
                         ParticleView<const double> divergence, std::vector<Vec<D>>& newX,
                         std::vector<Vec<D>>& newVelocity, std::vector<double>& newMass,
                         std::vector<double>& newDensity, std::vector<double>& newInternalEnergy,
                         std::vector<double>& newDivergence) {
  const auto gather = [&](const Index<D>& cell) {
    std::vector<Piece<D>> pieces;
    if (!x.cells().contains(cell)) return pieces;
    for (const int p : x.in(cell))
      pieces.push_back({ids[p], x[p], velocity[p], mass[p], mass[p] / density[p], internalEnergy[p], divergence[p]});
    return pieces;
  };
  redistributePatch<D>(patch, gas, how, maker, gather,
                       {&newX, &newVelocity, &newMass, &newDensity, &newInternalEnergy, &newDivergence});
}

}  // namespace tushar::mpm::gas::paper
