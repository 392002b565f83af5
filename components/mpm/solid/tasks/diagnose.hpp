#pragma once

#include <Eigen/Geometry>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// Adds `valueOf(p)` of `count` particles.
template <class ValueOf>
void addValues(int count, Sum& total, ValueOf&& valueOf) {
  WideSum(total).addAll(count, valueOf);
}

/// Adds m_p v_p of the particles along x, y and z; along the axes that the grid does not use, v_p has the components of
/// `others`.
template <int D>
void addMoments(const Level& level, ParticleView<const double> mass, ParticleView<const Vec<D>> of, const Vec3& others,
                VectorSum& total) {
  const std::array<Sum*, 3> sums{&total.x, &total.y, &total.z};
  const int count = mass.owned();
  const double* const m = valuesOf(mass);
  const Vec<D>* const v = valuesOf(of);
  std::array<int, 3> kernelAxis{-1, -1, -1};
  for (int d = 0; d < D; ++d) kernelAxis[level.axis(d)] = d;
  for (int axis = 0; axis < 3; ++axis)
    if (const int d = kernelAxis[axis]; d >= 0)
      addValues(count, *sums[axis], [=](int p) { return m[p] * v[p][d]; });
    else if (const double other = others[axis]; other != 0)
      addValues(count, *sums[axis], [=](int p) { return m[p] * other; });
}

/// Computes the sum of a particle variable.
inline void sumParticles(const Patch&, const Material&, ParticleView<const double> values, Sum& total) {
  addValues(values.owned(), total, [&](int p) { return values[p]; });
}

/// Computes sum_p m_p c_v T_p [J].
inline void sumThermalEnergy(const Patch&, const Material& material, ParticleView<const double> mass,
                             ParticleView<const double> temperature, Sum& total) {
  addValues(mass.owned(), total, [&](int p) { return mass[p] * material.specificHeat * temperature[p]; });
}

/// Computes sum_p m_p v_p [kg m/s].
template <int D>
void sumMomentum(const Patch& patch, const Material&, ParticleView<const double> mass,
                 ParticleView<const Vec<D>> velocity, VectorSum& total) {
  addMoments<D>(patch.level(), mass, velocity, Vec3::Zero(), total);
}
/// Computes sum_p m_p x_p [kg m].
template <int D>
void sumCenterOfMass(const Patch& patch, const Material&, ParticleView<const double> mass, ParticleView<const Vec<D>> x,
                     VectorSum& total) {
  addMoments<D>(patch.level(), mass, x, patch.level().expandPoint<D>(Vec<D>::Zero()), total);
}

/// Computes sum_p m_p x_p x v_p about the origin of x, y, z, and the part of APIC's B_p: sum_p m_p (B_kj - B_jk) (Jiang
/// & al. 2015).
template <int D>
void sumAngularMomentum(const Patch& patch, const Material&, ParticleView<const double> mass,
                        ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> velocity,
                        const std::optional<ParticleView<const Matrix3>>& affine, VectorSum& total) {
  const Level& level = patch.level();
  for (int p = 0; p < mass.owned(); ++p) {
    Vec3 spin = level.expandPoint<D>(x[p]).cross(level.expandDirection<D>(velocity[p]));
    if (affine)
      for (int i = 0; i < D; ++i) {
        Vec<D> unit = Vec<D>::Zero();
        unit[i] = 1;
        const Vec<D> moment = (*affine)[p].template topLeftCorner<D, D>().col(i);
        spin += level.expandDirection<D>(unit).cross(level.expandDirection<D>(moment));
      }
    total.add(mass[p] * spin);
  }
}

/// Computes 1/2 m v^2 of all particles.
template <int D>
void sumKineticEnergy(const Patch&, const Material&, ParticleView<const double> mass,
                      ParticleView<const Vec<D>> velocity, Sum& total) {
  addValues(mass.owned(), total, [&](int p) { return 0.5 * mass[p] * velocity[p].squaredNorm(); });
}

/// Computes the edges of a particle: F times the initial edges [m].
template <int D>
void computeScaleFactor(const Patch& patch, const Material&, const Vec3& commonSize,
                        const std::optional<ParticleView<const Vec<D>>>& size,
                        const std::optional<ParticleView<const Matrix3>>& domain,
                        ParticleView<const Matrix3> deformation, ParticleView<Matrix3> scale) {
  const Level& level = patch.level();
  for (int p = 0; p < deformation.owned(); ++p) {
    Vec3 edges;
    for (int axis = 0; axis < 3; ++axis) edges[axis] = commonSize[axis] * level.cellWidth(axis);
    for (int d = 0; d < D && size; ++d) edges[level.axis(d)] = (*size)[p][d] * level.spacing(d);
    scale[p] = deformation[p] * edges.asDiagonal();
    if (!domain) continue;
    Matrix3 start = (*domain)[p];
    for (int axis = 0; axis < 3; ++axis) start.row(axis) *= level.cellWidth(axis);
    scale[p] = deformation[p] * start;
  }
}

/// Adds the tasks for totals over the particles, and for their edges. `moves`: whether p.x moves with the body;
/// otherwise p.deformedPosition does.
template <int D>
void scheduleTotals(TaskList& tasks, const std::vector<Material>& materials, const Method& method, KeptSizes sizes,
                    const ParticleLabel<Vec<D>>* deformed) {
  tasks.perMaterial("mpm::sumMass", sumParticles, materials, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumStrainEnergy", sumParticles, materials, requiresOld(p::strainEnergy),
                    computes(total::strainEnergy));
  tasks.perMaterial("mpm::sumThermalEnergy", sumThermalEnergy, materials, requiresOld(p::mass),
                    requiresOld(p::temperature), computes(total::thermalEnergy));
  tasks.perMaterial("mpm::sumKineticEnergy", sumKineticEnergy<D>, materials, requiresOld(p::mass),
                    requiresOld(p::velocity<D>), computes(total::kineticEnergy));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<D>, materials, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    computes(total::momentum));
  const auto aroundOrigin = [&](const auto& place) {
    tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<D>, materials, requiresOld(p::mass), place,
                      computes(total::centerOfMass));
    tasks.perMaterial("mpm::sumAngularMomentum", sumAngularMomentum<D>, materials, requiresOld(p::mass), place,
                      requiresOld(p::velocity<D>), when(method.affine, requiresOld(p::affineMoment)),
                      computes(total::angularMomentum));
  };
  if (deformed)
    aroundOrigin(requiresNew(*deformed));
  else
    aroundOrigin(requiresOld(p::x<D>));
  tasks.perMaterial("mpm::computeScaleFactor", computeScaleFactor<D>, materials, with(method.commonSize),
                    when(sizes.each, requiresOld(p::size<D>)), when(sizes.domains, requiresOld(p::domain)),
                    requiresOld(p::deformationMeasure), computes(p::scaleFactor));
}
// Compiled in solids_of.cpp.
extern template void scheduleTotals<1>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes,
                                       const ParticleLabel<Vec<1>>*);
extern template void scheduleTotals<2>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes,
                                       const ParticleLabel<Vec<2>>*);
extern template void scheduleTotals<3>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes,
                                       const ParticleLabel<Vec<3>>*);

}  // namespace tushar::mpm::solid
