#pragma once

#include "components/mpm/solid/loads/load.hpp"
#include "components/mpm/solid/loads/manufactured.hpp"
#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// Calls `onSurface(load)` or `onBody(load)` for each load of a particle; `packed` holds their numbers as p.loadCurveID
/// does.
template <class OnSurface, class OnBody>
void forEachLoad(const Loads& loads, int packed, OnSurface&& onSurface, OnBody&& onBody) {
  for (int ids = packed; ids > 0; ids /= 256) {
    const auto k = static_cast<std::size_t>(ids % 256 - 1);
    if (k < loads.surfaces.size())
      onSurface(loads.surfaces[k]);
    else
      onBody(loads.bodies[k - loads.surfaces.size()]);
  }
}

/// The force of loads on each particle at the start of the step.
template <int D>
void applyExternalLoads(const Patch& patch, const Material&, const Loads& loads, double time,
                        ParticleView<const Vec<D>> x, ParticleView<const double> mass,
                        ParticleView<const int> loadCurves, ParticleView<Vec<D>> externalForce) {
  const Level& level = patch.level();
  for (int p = 0; p < x.owned(); ++p) {
    externalForce[p] = Vec<D>::Zero();
    forEachLoad(
        loads, loadCurves[p],
        [&](const SurfaceLoad& load) {
          if (load.kind == SurfaceLoad::Kind::pressure)
            externalForce[p] += level.reduce<D>(load.force(level.expandPoint<D>(x[p]), time));
        },
        [&](const BodyLoad& load) { externalForce[p] += mass[p] * level.reduce<D>(load.forceDensity); });
  }
}

/// The heat of loads on each particle at the start of the step, W.
template <int D>
void applyHeatFlux(const Patch& patch, const Material&, const Loads& loads, double time, ParticleView<const Vec<D>> x,
                   ParticleView<const int> loadCurves, ParticleView<double> heatFlux) {
  for (int p = 0; p < loadCurves.owned(); ++p) {
    heatFlux[p] = 0;
    forEachLoad(
        loads, loadCurves[p],
        [&](const SurfaceLoad& load) {
          if (load.kind == SurfaceLoad::Kind::heatFlux)
            heatFlux[p] += load.share(patch.level().expandPoint<D>(x[p]), time);
        },
        [](const BodyLoad&) {});
  }
}

/// The body force of a manufactured solution on each particle at the start of the step.
template <int D>
void applyManufacturedForce(const Patch& patch, const Material& material, const Manufactured* solution, double time,
                            ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> displacement,
                            ParticleView<const double> mass, ParticleView<Vec<D>> externalForce) {
  const Elastic elastic = elasticOf(material);
  for (int p = 0; p < x.owned(); ++p) {
    const Vec3 start = patch.level().expandPoint<D>(x[p] - displacement[p]);
    externalForce[p] = mass[p] * patch.level().reduce<D>(solution->bodyForce(elastic, start, time));
  }
}

}  // namespace tushar::mpm::solid
