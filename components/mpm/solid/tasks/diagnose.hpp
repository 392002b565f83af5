#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "core/base/quad.hpp"

namespace tushar::mpm::solid {

/// Like WideSum, with its lanes in registers; the sums are bitwise equal.
class QuadSum {
 public:
  /// Adds four numbers, of which the last may be 0 at the end of a sum.
  [[gnu::always_inline]] void add(Quad x) {
    data::addExactly(value_, x);
    data::addExactly(error_, x);
    rest_ += x;
  }
  void mergeInto(Sum& sum) const {
    for (int lane = 0; lane < 4; ++lane) sum.merge({value_[lane], error_[lane], rest_[lane]});
  }

 private:
  Quad value_{}, error_{}, rest_{};
};

/// Adds `valueOf(p)` of `count` particles.
template <class ValueOf>
void addValues(int count, Sum& total, ValueOf&& valueOf) {
  QuadSum sum;
  for (int p = 0; p < count; p += 4) {
    Quad x{};
    for (int lane = 0; lane < std::min(4, count - p); ++lane) x[lane] = valueOf(p + lane);
    sum.add(x);
  }
  sum.mergeInto(total);
}

/// Adds the vectors `vectorOf(p)`, along x, y and z, of `count` particles.
template <class VectorOf>
void addVectors(int count, VectorSum& total, VectorOf&& vectorOf) {
  std::array<QuadSum, 3> sums;
  for (int p = 0; p < count; p += 4) {
    std::array<Quad, 3> x{};
    for (int lane = 0; lane < std::min(4, count - p); ++lane) {
      const Vec3 v = vectorOf(p + lane);
      for (int axis = 0; axis < 3; ++axis) x[axis][lane] = v[axis];
    }
    for (int axis = 0; axis < 3; ++axis) sums[axis].add(x[axis]);
  }
  for (auto [sum, of] : {std::pair(&total.x, &sums[0]), std::pair(&total.y, &sums[1]), std::pair(&total.z, &sums[2])})
    of->mergeInto(*sum);
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
  const Level& level = patch.level();
  addVectors(mass.owned(), total, [&](int p) { return Vec3(mass[p] * level.expandDirection<D>(velocity[p])); });
}
/// Computes sum_p m_p x_p [kg m].
template <int D>
void sumCenterOfMass(const Patch& patch, const Material&, ParticleView<const double> mass, ParticleView<const Vec<D>> x,
                     VectorSum& total) {
  const Level& level = patch.level();
  addVectors(mass.owned(), total, [&](int p) { return Vec3(mass[p] * level.expandPoint<D>(x[p])); });
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

/// Adds the tasks for totals over the particles, and for their edges.
template <int D>
void scheduleTotals(TaskList& tasks, const std::vector<Material>& materials, const Method& method, KeptSizes sizes) {
  tasks.perMaterial("mpm::sumMass", sumParticles, materials, requiresOld(p::mass), computes(total::mass));
  tasks.perMaterial("mpm::sumStrainEnergy", sumParticles, materials, requiresOld(p::strainEnergy),
                    computes(total::strainEnergy));
  tasks.perMaterial("mpm::sumThermalEnergy", sumThermalEnergy, materials, requiresOld(p::mass),
                    requiresOld(p::temperature), computes(total::thermalEnergy));
  tasks.perMaterial("mpm::sumKineticEnergy", sumKineticEnergy<D>, materials, requiresOld(p::mass),
                    requiresOld(p::velocity<D>), computes(total::kineticEnergy));
  tasks.perMaterial("mpm::sumMomentum", sumMomentum<D>, materials, requiresOld(p::mass), requiresOld(p::velocity<D>),
                    computes(total::momentum));
  tasks.perMaterial("mpm::sumCenterOfMass", sumCenterOfMass<D>, materials, requiresOld(p::mass), requiresOld(p::x<D>),
                    computes(total::centerOfMass));
  tasks.perMaterial("mpm::sumAngularMomentum", sumAngularMomentum<D>, materials, requiresOld(p::mass),
                    requiresOld(p::x<D>), requiresOld(p::velocity<D>),
                    when(method.affine, requiresOld(p::affineMoment)), computes(total::angularMomentum));
  tasks.perMaterial("mpm::computeScaleFactor", computeScaleFactor<D>, materials, with(method.commonSize),
                    when(sizes.each, requiresOld(p::size<D>)), when(sizes.domains, requiresOld(p::domain)),
                    requiresOld(p::deformationMeasure), computes(p::scaleFactor));
}
// Compiled in solids_of.cpp.
extern template void scheduleTotals<1>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes);
extern template void scheduleTotals<2>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes);
extern template void scheduleTotals<3>(TaskList&, const std::vector<Material>&, const Method&, KeptSizes);

}  // namespace tushar::mpm::solid
