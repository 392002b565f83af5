#pragma once

#include <Eigen/LU>

#include <limits>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// The number of cells that the fastest of several waves crosses per second, along the axes in use; NaN if a speed is
/// NaN. (In Uintah, an axis with one cell counts, too.)
template <int D>
class CrossingRate {
 public:
  explicit CrossingRate(const Level& level) {
    for (int d = 0; d < D; ++d) inverse_spacing_[d] = level.inverseSpacing(d);
  }

  /// Adds waves with the speed c [m/s] in a material that moves with velocity v.
  void add(double c, const Vec<D>& v) { add(&c, &v, 1); }
  /// Adds `count` speeds, each in a material with its own velocity.
  void add(const double* c, const Vec<D>* v, int count) {
    for (int k = 0; k < count; k += Lanes::count) {
      const int left = count - k;
      const std::array<Lanes, D> velocity = vectorsOf<D>(v + k, left);
      const Lanes speed = left >= Lanes::count ? Lanes::at(c + k)
                                               : Lanes::of([&](int lane) { return c[k + std::min(lane, left - 1)]; });
      for (std::size_t d = 0; d < D; ++d)
        rates_ = greater(rates_, (speed + abs(velocity[d])) * inverse_spacing_[static_cast<int>(d)]);
    }
  }
  /// Time in which the fastest wave crosses a cell [s]; infinite without waves, NaN if a speed is NaN.
  double time() const { return isKnown() ? 1 / greatest(rates_) : std::numeric_limits<double>::quiet_NaN(); }
  bool isKnown() const { return all(rates_ >= rates_); }

 private:
  /// The larger number in each lane; NaN is preserved.
  static Lanes greater(const Lanes& so_far, const Lanes& other) {
    return select(so_far > other, so_far, select(isNaN(so_far), so_far, other));
  }

  Lanes rates_ = 0.0;
  Vec<D> inverse_spacing_;
};

/// Computes the stable time step for the initial state, with wave speeds at the density that follows from F.
template <int D>
void computeInitialTimeStep(const Patch& patch, const Material& material, ParticleView<const Vec<D>> velocity,
                            ParticleView<const double> temperature, ParticleView<const Matrix3> deformation,
                            Minimum& stableTimeStep, std::optional<CellView<double>> stableTimeSteps) {
  const CrossingRate<D> none(patch.level());
  if (stableTimeSteps) stableTimeSteps->fill(none.time());
  velocity.template forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    CrossingRate<D> rate = none;
    for (const int p : range) {
      const double density = material.density / deformation[p].determinant();
      rate.add(material.model->initialWaveSpeed(density, temperature[p]), velocity[p]);
    }
    stableTimeStep.add(rate.time());
    if (stableTimeSteps) (*stableTimeSteps)[cell] = rate.time();
  });
}

/// Limits the time step to the stable time step that the previous step has computed for this state.
inline void limitByWaves(const Patch&, double stableTimeStep, Minimum& dt) { dt.add(stableTimeStep, "wave speed"); }

}  // namespace tushar::mpm::solid
