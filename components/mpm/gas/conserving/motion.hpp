#pragma once

#include "components/mpm/gas/conserving/grid_fields.hpp"
#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/conserving/scheme.hpp"

namespace tushar::mpm::gas::conserving {

/// Views of the variables that updateParticles reads and writes.
template <int D>
struct ParticleUpdate {
  // Particles at the start of the step.
  ParticleView<const Vec<D>> x, edges, velocity;
  ParticleView<const Modes<D>> modes;
  ParticleView<const double> internalEnergy, affineEnergy;
  // The grid.
  NodeView<const Vec<D>> nodeVelocity, acceleration;
  NodeView<const double> relaxation;
  CellView<const double> work;
  // Particles at the end of the step.
  ParticleView<Vec<D>> newX, newEdges, newVelocity;
  ParticleView<Modes<D>> newModes;
  ParticleView<double> newInternalEnergy, newAffineEnergy;

  static ParticleUpdate from(auto& take) {
    constexpr int overhang = Footprint<D>::overhang;
    return {.x = take(requiresOld(p::x<D>)),
            .edges = take(requiresOld(p::edges<D>)),
            .velocity = take(requiresOld(p::velocity<D>)),
            .modes = take(requiresOld(p::modes<D>)),
            .internalEnergy = take(requiresOld(p::internalEnergy)),
            .affineEnergy = take(requiresOld(p::affineEnergy)),
            .nodeVelocity = take(requiresOld(g::velocity<D>, overhang)),
            .acceleration = take(requiresNew(g::acceleration<D>, overhang)),
            .relaxation = take(requiresNew(g::relaxation, overhang)),
            .work = take(requiresNew(c::work, overhang)),
            .newX = take(computes(p::x<D>)),
            .newEdges = take(computes(p::edges<D>)),
            .newVelocity = take(computes(p::velocity<D>)),
            .newModes = take(computes(p::modes<D>)),
            .newInternalEnergy = take(computes(p::internalEnergy)),
            .newAffineEnergy = take(computes(p::affineEnergy))};
  }
};

/// The sum of the squares of the components of vectors.
template <int D>
[[gnu::always_inline]] inline Lanes squareOf(const LanesVec<D>& v) {
  Lanes sum = v[0] * v[0];
  for (int d = 1; d < D; ++d) sum = multiplyAdd(v[d], v[d], sum);
  return sum;
}

/// Grid fields from which particles are updated: at nodes, v; y = v + dt a (apic) or dt a; |y|² or |dt a|²; without
/// apic also v + faceTime dt a, beta, and beta (2 - beta) / 2; in cells, f.
template <int D, bool apic>
struct Motion : GridFields<D, apic ? 2 * D + 2 : 3 * D + 4> {
  static constexpr std::size_t later = D, square = 2 * D, work = square + 1, moving = work + 1, beta = moving + D,
                               slip = beta + 1;
  using Fields = GridFields<D, apic ? 2 * D + 2 : 3 * D + 4>;

  bool relaxes = apic;  ///< whether any beta is not 0

  Motion(const Patch& patch, const ParticleUpdate<D>& update, double dt) : Fields(patch.cells()) {
    constexpr double faceTime = apic ? Apic::faceTime : AffineFlip::faceTime;
    Lanes greatestBeta = 0;
    forEachRowPart<D>(update.nodeVelocity.box(), [&](const RowPart<D>& nodes) {
      const LanesVec<D> v = load(update.nodeVelocity, nodes), dv = dt * load(update.acceleration, nodes);
      const LanesVec<D> y = apic ? LanesVec<D>(v + dv) : dv;
      put(0, nodes, v);
      put(later, nodes, y);
      this->writeRow(square, nodes, squareOf<D>(y));
      if constexpr (!apic) {
        const Lanes b = load(update.relaxation, nodes);
        greatestBeta = max(greatestBeta, b);
        put(moving, nodes, v + faceTime * dv);
        this->writeRow(beta, nodes, b);
        this->writeRow(slip, nodes, 0.5 * b * (2 - b));
      }
    });
    if (!apic) relaxes = any(greatestBeta > 0);
    forEachRowPart<D>(update.work.box(),
                      [&](const RowPart<D>& cells) { this->writeRow(work, cells, load(update.work, cells)); });
  }

 private:
  void put(std::size_t field, const RowPart<D>& nodes, const LanesVec<D>& values) {
    for (std::size_t d = 0; d < D; ++d) this->writeRow(field + d, nodes, values[static_cast<int>(d)]);
  }
};

template <int D, class Scheme>
using MotionOf = Motion<D, Scheme::transfer == Transfer::apic>;

/// Reads the grid fields in a row of nodes or cells near a batch.
template <int D>
struct RowReader {
  const double* first;
  std::size_t size;  ///< distance between fields

  [[gnu::always_inline]] Lanes operator()(std::size_t field, int k) const {
    return Lanes::at(first + field * size + k);
  }
  [[gnu::always_inline]] LanesVec<D> vector(std::size_t field, int k) const {
    LanesVec<D> values;
    for (std::size_t d = 0; d < D; ++d) values[static_cast<int>(d)] = (*this)(field + d, k);
    return values;
  }
};

/// Reads the grid fields near a batch.
template <int D, class Fields>
struct Reader {
  const Fields& motion;
  const double* first;

  Reader(const Fields& of, const Footprint<D>& footprint) : motion(of), first(of.addressOf(footprint.first())) {}
  [[gnu::always_inline]] RowReader<D> row(const Index<D>& at) const {
    return {first + motion.distance(at), motion.size()};
  }
};

}  // namespace tushar::mpm::gas::conserving
