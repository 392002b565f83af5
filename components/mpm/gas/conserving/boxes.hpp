#pragma once

#include <vector>

#include "components/mpm/gas/conserving/labels.hpp"

namespace tushar::mpm::gas::conserving {

/// A particle: a box of gas.
template <int D>
struct GasBox {
  ParticleId id;
  Vec<D> x, edges;                      ///< centre and edge lengths [m]
  double mass;                          ///< mass [kg]
  Vec<D> velocity;                      ///< mean velocity [m/s]
  Modes<D> modes;                       ///< modes of the motion about the mean
  double internalEnergy, affineEnergy;  ///< internal energy and affine energy [J/kg]
};

/// Views of the particles that redistribute reads.
template <int D>
struct OldBoxes {
  ParticleView<const ParticleId> ids;
  ParticleView<const Vec<D>> x, edges;
  ParticleView<const double> mass;
  ParticleView<const Vec<D>> velocity;
  ParticleView<const Modes<D>> modes;
  ParticleView<const double> internalEnergy, affineEnergy;

  static OldBoxes from(auto& take, int ghost) {
    return {.ids = take(requiresNew(data::particleId, ghost)),
            .x = take(requiresNew(p::x<D>, ghost)),
            .edges = take(requiresNew(p::edges<D>, ghost)),
            .mass = take(requiresNew(p::mass, ghost)),
            .velocity = take(requiresNew(p::velocity<D>, ghost)),
            .modes = take(requiresNew(p::modes<D>, ghost)),
            .internalEnergy = take(requiresNew(p::internalEnergy, ghost)),
            .affineEnergy = take(requiresNew(p::affineEnergy, ghost))};
  }

  GasBox<D> at(int p) const {
    return {ids[p], x[p], edges[p], mass[p], velocity[p], modes[p], internalEnergy[p], affineEnergy[p]};
  }
};

/// The values of new particles.
template <int D>
struct NewBoxes {
  std::vector<Vec<D>>&x, &edges;
  std::vector<double>& mass;
  std::vector<Vec<D>>& velocity;
  std::vector<Modes<D>>& modes;
  std::vector<double>&internalEnergy, &affineEnergy;

  static NewBoxes from(auto& take) {
    return {.x = take(creates(p::x<D>)),
            .edges = take(creates(p::edges<D>)),
            .mass = take(creates(p::mass)),
            .velocity = take(creates(p::velocity<D>)),
            .modes = take(creates(p::modes<D>)),
            .internalEnergy = take(creates(p::internalEnergy)),
            .affineEnergy = take(creates(p::affineEnergy))};
  }

  /// Makes space for `count` particles.
  void reserve(ParticleMaker& maker, std::size_t count) const {
    maker.reserve(count);
    x.reserve(count);
    edges.reserve(count);
    mass.reserve(count);
    velocity.reserve(count);
    modes.reserve(count);
    internalEnergy.reserve(count);
    affineEnergy.reserve(count);
  }
  /// Adds a particle to a cell.
  void add(ParticleMaker& maker, const Index<D>& cell, const GasBox<D>& box) const {
    maker.add(cell, box.id);
    x.push_back(box.x);
    edges.push_back(box.edges);
    mass.push_back(box.mass);
    velocity.push_back(box.velocity);
    modes.push_back(box.modes);
    internalEnergy.push_back(box.internalEnergy);
    affineEnergy.push_back(box.affineEnergy);
  }
};

}  // namespace tushar::mpm::gas::conserving
