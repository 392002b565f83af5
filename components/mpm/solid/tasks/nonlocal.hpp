#pragma once

#include <cmath>
#include <numbers>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

namespace p {
inline constexpr ParticleLabel<double> plasticIncrement{"p.nonlocalSource", "1",
                                                        "plastic strain that affects other particles"};
}  // namespace p

/// The index of a variable in the State of a nonlocal model; -1 for other models.
inline int nonlocalOffset(const Material& material, std::string_view label) {
  return material.model->nonlocalLength() > 0 ? offsetOf(*material.model, label) : -1;
}

/// Copies the plastic strain of the step, one number for each particle, so that other patches can read it.
inline void findPlasticIncrement(const Patch&, const Material& material, int stateSize,
                                 ParticleView<const double> state, ParticleView<double> increment) {
  const int offset = nonlocalOffset(material, "p.plasticIncrement");
  for (int p = 0; p < increment.owned(); ++p) increment[p] = offset < 0 ? 0.0 : (&state[0])[p * stateSize + offset];
}

/// Calls `visit` for the particles of the cells within `layers` of a cell.
template <int D, class Visit>
void forEachAround(const ParticleView<const Vec<D>>& x, const Index<D>& cell, int layers, Visit&& visit) {
  Box around;
  for (int d = 0; d < D; ++d) {
    around.lower[d] = std::max(cell[d] - layers, x.cells().lower[d]);
    around.upper[d] = std::min(cell[d] + layers + 1, x.cells().upper[d]);
  }
  x.template forEachOccupied<D>(around, [&](const auto&, const auto& particles) {
    for (const int q : particles) visit(q);
  });
}

/// Computes the mean of the plastic strain of the step over the volume within the length l, with the weight exp(-(k
/// r/l)²), k = (6 pi^(1/2))^(1/3), at the distance r; Burghardt, Brannon & Guilkey, Comput. Methods Appl. Mech. Engrg.
/// 225 (2012) 55. Distances are those at the start of the step.
template <int D>
void averagePlasticIncrement(const Patch& patch, const Material& material, int layers, int stateSize,
                             ParticleView<const Vec<D>> x, ParticleView<const double> volume,
                             ParticleView<const double> increment, ParticleView<double> state) {
  const int offset = nonlocalOffset(material, "p.meanPlasticIncrement");
  if (offset < 0) return;
  const double length = material.model->nonlocalLength();
  const double steepness = std::cbrt(6 * std::sqrt(std::numbers::pi)) / length;
  for (int p = 0; p < x.owned(); ++p) {
    double sum = 0, whole = 0;
    forEachAround<D>(x, patch.level().template cellOf<D>(x[p]), layers, [&](int q) {
      const double distance = (x[q] - x[p]).norm();
      if (distance > length) return;
      const double weight = volume[q] * std::exp(-steepness * steepness * distance * distance);
      sum += weight * increment[q];
      whole += weight;
    });
    (&state[0])[p * stateSize + offset] = sum / whole;
  }
}

}  // namespace tushar::mpm::solid
