#pragma once

#include "components/mpm/solid/constitutive/polar.hpp"
#include "components/mpm/solid/loads/load.hpp"
#include "components/mpm/solid/loads/manufactured.hpp"
#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// Computes the force of loads on each particle at the start of the step. If `deformation` is given, pressures rotate
/// with the body, by R of F = R U.
template <int D>
void applyExternalLoads(const Patch& patch, const Material&, const Loads& loads, double time,
                        ParticleView<const Vec<D>> x, ParticleView<const double> mass,
                        ParticleView<const int> loadCurves, OptionalView<const Matrix3> deformation,
                        ParticleView<Vec<D>> externalForce) {
  const Level& level = patch.level();
  const auto turned = [&](int p, const Vec3& force) {
    return deformation ? Vec3(rotationOf((*deformation)[p]) * force) : force;
  };
  for (int p = 0; p < x.owned(); ++p) {
    externalForce[p] = Vec<D>::Zero();
    forEachLoad(
        loads, loadCurves[p],
        [&](const SurfaceLoad& load) {
          if (load.kind == LoadKind::heatFlux) return;
          const Vec3 force = load.force(level.expandPoint<D>(x[p]), time);
          externalForce[p] += level.reduce<D>(load.kind == LoadKind::pressure ? turned(p, force) : force);
        },
        [&](const BodyLoad& load) { externalForce[p] += mass[p] * level.reduce<D>(load.forceDensity); });
  }
}

/// Computes the heat flow of loads into each particle at the start of the step [W].
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

/// Computes the body force of a manufactured solution on each particle at the start of the step.
template <int D>
void applyManufacturedForce(const Patch& patch, const Material& material, const Manufactured* solution, double time,
                            ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> displacement,
                            ParticleView<const double> mass, ParticleView<Vec<D>> externalForce) {
  const auto bodyForce = solution->bodyForce(elasticOf(material), time);
  for (int p = 0; p < x.owned(); ++p) {
    const Vec3 start = patch.level().expandPoint<D>(x[p] - displacement[p]);
    externalForce[p] = mass[p] * patch.level().reduce<D>(bodyForce(start));
  }
}

}  // namespace tushar::mpm::solid
