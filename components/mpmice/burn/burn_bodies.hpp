#pragma once

#include "components/mpmice/burn/burning_surface.hpp"
#include "components/mpmice/tasks/advance_gas.hpp"
#include "core/data/vanished.hpp"

namespace tushar::mpmice {

/// The mass that burns in a step. At a surface, the gas of a cell first burns the bodies in the same cell and, if these
/// are not enough, those in the cell behind the surface. So a body recedes at its rate, and vanishes cell by cell.
template <int D>
class BurntMass {
 public:
  /// `rate` is the rate of burning at faces, `within` the rate in cells (see NewBurning).
  BurntMass(const Level& level, CellView<const Vec<D>> rate, CellView<const double> within, CellView<const double> mass,
            double dt)
      : level_(level), rate_(rate), within_(within), mass_(mass), dt_(dt) {}

  /// The fraction of the body's mass in a cell that burns in the step.
  double shareOf(const Index<D>& cell) const {
    if (!(mass_[cell] > 0)) return 0;
    double wanted = wantedFrom(cell);
    forEachFace(cell, [&](const Index<D>& next, double burnt) {
      if (burnt < 0) wanted -= burnt * (1 - coveredBy(next));
    });
    return wanted < mass_[cell] ? wanted / mass_[cell] : 1;
  }

 private:
  /// Calls `visit(neighbour, mass)` for the faces of a cell, with the mass that burns at the face. The mass is positive
  /// if the gas of this cell burns it, and negative if that of the neighbour does.
  template <class Visit>
  void forEachFace(const Index<D>& cell, Visit&& visit) const {
    for (int d = 0; d < D; ++d) {
      const Index<D> below = cell - Index<D>::unit(d), above = cell + Index<D>::unit(d);
      if (level_.isPeriodic(d) || level_.cells().lower[d] < cell[d]) visit(below, -dt_ * rate_[cell][d]);
      if (level_.isPeriodic(d) || above[d] < level_.cells().upper[d]) visit(above, dt_ * rate_[above][d]);
    }
  }
  double wantedFrom(const Index<D>& cell) const {
    double wanted = dt_ * within_[cell];
    forEachFace(cell, [&](const Index<D>&, double burnt) { wanted += std::max(0.0, burnt); });
    return wanted;
  }
  /// Of the mass that the gas of a cell burns, the fraction that comes from particles in this cell.
  double coveredBy(const Index<D>& cell) const {
    const double wanted = wantedFrom(cell);
    return wanted > mass_[cell] ? mass_[cell] / wanted : 1;
  }

  const Level& level_;
  CellView<const Vec<D>> rate_;
  CellView<const double> within_, mass_;
  double dt_;
};

/// Computes the fraction of the mass in each cell that burns in a step.
template <int D>
void findBurntShare(const Patch& patch, const Settings& settings, double start, double dt, CellView<const Vec<D>> rate,
                    CellView<const double> within, CellView<const double> mass, CellView<double> share) {
  const BurntMass<D> burnt(patch.level(), rate, within, mass, dt);
  const auto* decay = std::get_if<ice::Decay>(&settings.burning->model.law);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (decay)
      share[cell] = start < decay->startTime ? 0 : std::min(1.0, decay->perTime * dt);
    else
      share[cell] = burnt.shareOf(cell);
  });
}

/// Computes the mass of particles after a step. All particles of a cell lose the same fraction of their mass.
template <int D>
void burnParticles(const Patch& patch, const mpm::solid::Material& material, const Settings& settings,
                   CellView<const double> share, ParticleView<const double> mass, ParticleView<const double> unburned,
                   ParticleView<double> newMass, ParticleView<double> newUnburned) {
  const bool burns = static_cast<std::size_t>(material.index) == settings.burning->body;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double left = burns ? 1 - share[cell] : 1;
    for (const int p : mass.template in<D>(cell)) {
      newMass[p] = left * mass[p];
      newUnburned[p] = left * unburned[p];
    }
  });
}

/// Removes particles that have burned completely; the others keep the strain energy [J] of their remaining mass.
template <int D>
void removeBurnt(const Patch&, const mpm::solid::Material&, ParticleView<const double> massBefore,
                 ParticleView<const double> mass, ParticleView<Vec<D>> position,
                 const std::optional<ParticleView<double>>& strainEnergy) {
  for (int p = 0; p < mass.owned(); ++p) {
    if (mass[p] == 0) position[p][0] = data::vanished;
    if (strainEnergy && mass[p] != massBefore[p]) (*strainEnergy)[p] *= mass[p] / massBefore[p];
  }
}

}  // namespace tushar::mpmice
