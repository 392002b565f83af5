#pragma once

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/loads/manufactured.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// `manufacturedError`: computes the errors of the particles' displacement and velocity relative to the solution of
/// `RunMMSProblem`.
simulation::AnalysisKind manufacturedErrorKind();

/// Computes the lengths of u_p - u(X_p, t) and v_p - v(X_p, t), where X_p = x_p - u_p is the initial position of the
/// particle.
template <int D>
void measureManufacturedError(const Patch& patch, const Material& material, const Manufactured* solution,
                              const double* time, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> displacement,
                              ParticleView<const Vec<D>> velocity, Norm& displacementError, Norm& velocityError) {
  const Level& level = patch.level();
  const Elastic elastic = elasticOf(material);
  for (int p = 0; p < x.owned(); ++p) {
    const Vec3 start = level.expandPoint<D>(x[p] - displacement[p]);
    const Vec<D> u = level.reduce<D>(solution->displacement(elastic, start, *time));
    const Vec<D> v = level.reduce<D>(solution->velocity(elastic, start, *time));
    displacementError.add((displacement[p] - u).norm(), u.norm());
    velocityError.add((velocity[p] - v).norm(), v.norm());
  }
}

}  // namespace tushar::mpm::solid
