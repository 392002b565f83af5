#pragma once

#include <optional>
#include <vector>

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas::paper {

/// How particles are redistributed in cells that contain too few or too many of them.
struct Redistribution {
  enum class Mode {
    splitMerge,  ///< halve large particles, merge close ones
    reseed,      ///< replace the particles by new ones at the centres of equal parts of the cell
  };
  Location where;  ///< location of its tag in the scene
  Mode mode = Mode::splitMerge;
  int minParticles = 2;     ///< smallest number of particles per cell
  int maxParticles = 16;    ///< largest number of particles per cell
  int targetParticles = 4;  ///< number of particles per cell for `reseed`; along each axis, its D-th root, rounded up

  /// Number of particles along each axis of a reseeded cell.
  int seededAlongAxis(int dimension) const {
    int number = 1;
    while (std::pow(number, dimension) < targetParticles) ++number;
    return number;
  }
};

/// The properties of a particle that are needed for redistribution.
template <int D>
struct Piece {
  ParticleId id = 0;
  Vec<D> x = Vec<D>::Zero(), velocity = Vec<D>::Zero();
  double mass = 0, volume = 0, internalEnergy = 0, divergence = 0;

  double density() const { return mass / volume; }
};

/// The geometry of a cell and, for `reseed`, the slopes of its mean density, velocity and pressure along each axis, per
/// metre.
template <int D>
struct CellShape {
  Vec<D> lower, spacing;  ///< lower corner and widths [m]
  double volume = 0;      ///< volume [m³]
  Vec<D> densitySlope = Vec<D>::Zero(), pressureSlope = Vec<D>::Zero();
  std::array<Vec<D>, D> velocitySlope;  ///< slopes of each velocity component

  CellShape() { velocitySlope.fill(Vec<D>::Zero()); }
  CellShape(const Level& level, const Index<D>& cell) : CellShape() {
    volume = level.cellVolume();
    for (int d = 0; d < D; ++d) {
      lower[d] = level.nodePosition(d, cell[d]);
      spacing[d] = level.spacing(d);
    }
  }
};

/// Halves pieces larger than V_c / (2 N_min), in the order of their ids, until there are N_min. The halves have equal
/// mass and volume, and lie at x ± min(V, V_c) / V_c h / 4 along the longest axis of the cell (moved inside where they
/// would leave it); velocity, energy and density stay the same.
template <int D>
void split(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, int minParticles);

/// Merges the two closest pieces until there are N_max. Positions and velocities are averaged, weighted by mass, and
/// volumes are added. The lost kinetic energy, m1 m2 |v1 - v2|² / (2 (m1 + m2)), becomes heat.
template <int D>
void merge(std::vector<Piece<D>>& pieces, int maxParticles);

/// Places n^D pieces of equal volume at the midpoints of equal parts of the cell. Density, velocity and pressure have
/// the slopes of the cell; velocity slopes are taken about the centre of mass, and scaled so that the kinetic energy
/// does not increase. Lost kinetic energy becomes heat. Mass, momentum and total energy are conserved.
template <int D>
void reseed(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, const Gas& gas, int alongAxis);

/// Computes the slopes for `reseed` from the means over the particles of a cell and of its neighbours, limited by
/// minmod.
template <int D>
void setSlopes(CellShape<D>& cell, const std::vector<Piece<D>>& here,
               const std::array<std::vector<Piece<D>>, 2 * D>& around, const Gas& gas);

/// Redistributes the particles of one cell.
template <int D>
void redistributeCell(std::vector<Piece<D>>& pieces, const CellShape<D>& cell, const Gas& gas,
                      const Redistribution& how);

/// Views of the particles that redistribution reads.
template <int D>
struct OldParticles {
  ParticleView<const ParticleId> ids;
  ParticleView<const Vec<D>> x, velocity;
  std::optional<ParticleView<const double>> mass;  ///< masses, if particles keep their mass
  ParticleView<const double> density, internalEnergy, divergence;

  static OldParticles from(auto& take, bool keepsMass, int ghost) {
    return {.ids = take(requiresNew(data::particleId, ghost)),
            .x = take(requiresNew(p::x<D>, ghost)),
            .velocity = take(requiresNew(p::velocity<D>, ghost)),
            .mass = take(when(keepsMass, requiresNew(p::mass, ghost))),
            .density = take(requiresNew(p::density, ghost)),
            .internalEnergy = take(requiresNew(p::internalEnergy, ghost)),
            .divergence = take(requiresNew(p::velocityDivergence, ghost))};
  }

  /// The particles of a cell of volume `cellVolume`; empty for a cell outside the grid. If particles keep their mass, a
  /// particle has the volume m_p / rho_p, otherwise an equal share of the cell's volume, (5) of Tran, Kim & Berzins.
  std::vector<Piece<D>> in(const Index<D>& cell, double cellVolume) const {
    std::vector<Piece<D>> pieces;
    if (!x.cells().contains(cell)) return pieces;
    const double share = cellVolume / std::max(x.in(cell).size(), 1);
    for (const int p : x.in(cell)) {
      const double m = mass ? (*mass)[p] : density[p] * share, volume = mass ? m / density[p] : share;
      pieces.push_back({ids[p], x[p], velocity[p], m, volume, internalEnergy[p], divergence[p]});
    }
    return pieces;
  }
};

/// The values of the new particles made by redistribution.
template <int D>
struct NewParticles {
  std::vector<Vec<D>>&x, &velocity;
  std::vector<double>* mass;  ///< masses; null if particles do not keep their mass
  std::vector<double>&density, &internalEnergy, &divergence;

  static NewParticles from(auto& take, bool keepsMass) {
    return {.x = take(creates(p::x<D>)),
            .velocity = take(creates(p::velocity<D>)),
            .mass = keepsMass ? &take(creates(p::mass)) : nullptr,
            .density = take(creates(p::density)),
            .internalEnergy = take(creates(p::internalEnergy)),
            .divergence = take(creates(p::velocityDivergence))};
  }

  void add(const Piece<D>& piece) const {
    x.push_back(piece.x);
    velocity.push_back(piece.velocity);
    if (mass) mass->push_back(piece.mass);
    density.push_back(piece.density());
    internalEnergy.push_back(piece.internalEnergy);
    divergence.push_back(piece.divergence);
  }
};

/// Redistributes the cells of a patch that contain too few or too many particles.
template <int D>
void redistribute(const Patch& patch, const Gas& gas, ParticleMaker& maker, const Redistribution& how,
                  const OldParticles<D>& old, const NewParticles<D>& fresh) {
  const Level& level = patch.level();
  const double volume = level.cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    std::vector<Piece<D>> pieces = old.in(cell, volume);
    const int count = static_cast<int>(pieces.size());
    if (count < how.minParticles || count > how.maxParticles) {
      CellShape<D> shape(level, cell);
      if (how.mode == Redistribution::Mode::reseed) {
        std::array<std::vector<Piece<D>>, 2 * D> around;
        for (int d = 0; d < D; ++d) {
          around[2 * d] = old.in(cell - Index<D>::unit(d), volume);
          around[2 * d + 1] = old.in(cell + Index<D>::unit(d), volume);
        }
        setSlopes<D>(shape, pieces, around, gas);
      }
      redistributeCell<D>(pieces, shape, gas, how);
    }
    for (const Piece<D>& piece : pieces) {
      maker.add(cell, piece.id);
      fresh.add(piece);
    }
  });
}

}  // namespace tushar::mpm::gas::paper
