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

/// Computes the fluxes along an axis through the lower face of the cell at position `i` or, for Lanes, of the cells
/// that begin there.
template <int D, class Number = double>
[[gnu::always_inline]] inline State<D, 1, Number> diffusiveFluxAt(const Diffusion& diffusion,
                                                                  const typename Rows<D>::Pointers& w,
                                                                  const Spacing<D>& by, int axis, std::ptrdiff_t i) {
  const std::ptrdiff_t below = i - by.stride[axis];
  const auto number = [](const double* of, std::ptrdiff_t at) { return numberAt<Number>(of + at); };
  State<D, 1, Number> flux{};
  Number others = 0;
  const double* normal = w[kVelocity(axis)];
  const Number along = (number(normal, i) - number(normal, below)) * by.inverse[axis];
  for (int k = 0; k < D; ++k) {
    if (k == axis) continue;
    const double* v = w[kVelocity(k)];
    const std::ptrdiff_t next = by.stride[k];
    const auto slope = [&](const double* of) {
      return 0.25 * by.inverse[k] *
             ((number(of, i + next) - number(of, i - next)) + (number(of, below + next) - number(of, below - next)));
    };
    others += slope(v);
    flux[kVelocity(k)] = -diffusion.viscosity * ((number(v, i) - number(v, below)) * by.inverse[axis] + slope(normal));
  }
  flux[kVelocity(axis)] = -diffusion.viscosity * (2 * along - 2.0 / 3 * (along + others));
  Number energy =
      -diffusion.conductivity * (number(w[kTemperature], i) - number(w[kTemperature], below)) * by.inverse[axis];
  for (int k = 0; k < D; ++k)
    energy += flux[kVelocity(k)] * 0.5 * (number(w[kVelocity(k)], i) + number(w[kVelocity(k)], below));
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
