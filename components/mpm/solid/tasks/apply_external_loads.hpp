#pragma once

#include "components/mpm/solid/loads/load.hpp"
#include "components/mpm/solid/loads/manufactured.hpp"
#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

/// The force of pressures on each particle at the start of the step.
template <int D>
void applyExternalLoads(const Patch& patch, const Material&, const std::vector<PressureLoad>& loads, double time,
                        ParticleView<const Vec<D>> x, ParticleView<const int> loadCurves,
                        ParticleView<Vec<D>> externalForce) {
  for (int p = 0; p < x.owned(); ++p) {
    externalForce[p] = Vec<D>::Zero();
    const Vec3 point = patch.level().expandPoint<D>(x[p]);
    for (int ids = loadCurves[p]; ids > 0; ids /= 256)
      externalForce[p] += patch.level().reduce<D>(loads[static_cast<std::size_t>(ids % 256 - 1)].force(point, time));
  }
}

/// The body force of a manufactured solution on each particle at the start of the step.
template <int D>
void applyManufacturedForce(const Patch& patch, const Material& material, const Manufactured* solution,
                            double time, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> displacement,
                            ParticleView<const double> mass, ParticleView<Vec<D>> externalForce) {
  const Elastic elastic = elasticOf(material);
  for (int p = 0; p < x.owned(); ++p) {
    const Vec3 start = patch.level().expandPoint<D>(x[p] - displacement[p]);
    externalForce[p] = mass[p] * patch.level().reduce<D>(solution->bodyForce(elastic, start, time));
  }
}

}  // namespace tushar::mpm::solid
