#pragma once

#include "components/euler/diffusion.hpp"
#include "components/euler/rows.hpp"
#include "components/euler/tasks/add_diffusion.hpp"

namespace tushar::euler {

/// The index of T in a State, where it takes the place of the density; the component of the pressure is unused.
inline constexpr std::size_t kTemperature = kDensity;

/// Distances in memory between neighbours, and 1/h, along each axis.
template <int D>
struct Spacing {
  std::array<std::ptrdiff_t, D> stride;
  std::array<double, D> inverse;

  Spacing(const Level& level, const Rows<D>& rows) {
    for (int d = 0; d < D; ++d) stride[d] = rows.stride(d);
    for (int d = 0; d < D; ++d) inverse[d] = level.inverseSpacing(d);
  }
};

/// Computes the fluxes along an axis through the lower face of the cell at position `i`.
template <int D>
State<D> diffusiveFluxAt(const Diffusion& diffusion, const typename Rows<D>::Pointers& w, const Spacing<D>& by,
                         int axis, std::ptrdiff_t i) {
  const std::ptrdiff_t below = i - by.stride[axis];
  State<D> flux{};
  double others = 0;
  const double* normal = w[kVelocity(axis)];
  const double along = (normal[i] - normal[below]) * by.inverse[axis];
  for (int k = 0; k < D; ++k) {
    if (k == axis) continue;
    const double* v = w[kVelocity(k)];
    const std::ptrdiff_t next = by.stride[k];
    const auto slope = [&](const double* of) {
      return 0.25 * by.inverse[k] * ((of[i + next] - of[i - next]) + (of[below + next] - of[below - next]));
    };
    others += slope(v);
    flux[kVelocity(k)] = -diffusion.viscosity * ((v[i] - v[below]) * by.inverse[axis] + slope(normal));
  }
  flux[kVelocity(axis)] = -diffusion.viscosity * (2 * along - 2.0 / 3 * (along + others));
  double energy = -diffusion.conductivity * (w[kTemperature][i] - w[kTemperature][below]) * by.inverse[axis];
  for (int k = 0; k < D; ++k) energy += flux[kVelocity(k)] * 0.5 * (w[kVelocity(k)][i] + w[kVelocity(k)][below]);
  flux[kPressure<D>] = energy;
  return flux;
}

/// Stores the fluxes along an axis through faces at the rim of the level.
template <int D>
void keepDiffused(const DiffusionRims<D>& rims, const Box& faces, int axis, Rows<D>& flux) {
  rims.momentum.template forEachFaceIn<D>(faces, axis, [&](const Index<D>& face, Vec<D>& through) {
    for (int d = 0; d < D; ++d) through[d] += *flux.at(face)[kVelocity(d)];
  });
  rims.energy.template forEachFaceIn<D>(
      faces, axis, [&](const Index<D>& face, double& through) { through += *flux.at(face)[kPressure<D>]; });
}

}  // namespace tushar::euler
