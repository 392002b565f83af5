#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/constitutive/model.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/method.hpp"

namespace tushar::mpm::solid {

// What works on particles in a step: forces with w = (v + v*)/2 of the nodes, what holds nodes at a velocity with that
// velocity, and the mean of the stresses before and after with the change of F. What kinetic energy has changed by
// besides is what the method takes itself: a step of FLIP something of first order in dt (Bardenhagen, J. Comput. Phys.
// 180 (2002) 383); APIC, PIC and XPIC by the viscosity of their transfer; contact what two bodies lose that come to
// move as one.

/// The numbers of p.work, as in total::work.
namespace works {
inline constexpr int external = 0, boundary = 1, contact = 2, dissipated = 3, strain = 4, plastic = 5, start = 6;
}

/// Nothing has been done yet.
template <int D>
void startWork(const Patch&, const Material&, ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
               ParticleView<p::Works> work) {
  for (int p = 0; p < mass.owned(); ++p) {
    work[p].setZero();
    work[p][works::start] = 0.5 * mass[p] * velocity[p].squaredNorm();
  }
}

/// The velocity that the records hold now.
template <int D>
void keepVelocity(const Patch&, const Material&, NodeView<const NodeRecord> record, NodeView<Vec<D>> kept) {
  forEach<D>(kept.box(), [&](const Index<D>& node) { kept[node] = lanes<D>(record[node], lane::velocity); });
}

/// w of the nodes, and the work on a unit of their mass: of gravity, of the sides of the grid, of contact, and what
/// damping takes.
template <int D>
void computeNodalWork(const Patch& patch, const Material&, const Method& method, double dt,
                      NodeView<const NodeRecord> record, NodeView<const Vec<D>> ofForces,
                      const std::optional<NodeView<const Vec<D>>>& ofContact, NodeView<NodeRecord> work) {
  const Vec<D> gravity = patch.level().reduce<D>(method.gravity);
  forEach<D>(work.box(), [&](const Index<D>& node) {
    const Vec<D> before = lanes<D>(record[node], lane::before), after = lanes<D>(record[node], lane::velocity);
    const Vec<D> mean = 0.5 * (before + after), free = ofForces[node];
    const Vec<D> touched = ofContact ? Vec<D>((*ofContact)[node]) : free;
    const bool isDamped = record[node][lane::mass] > method.minimumMassForAcceleration;
    const double damped = isDamped ? dt * method.damping * before.dot(mean) : 0.0;
    work[node] = {quadOf<D>(mean),
                  Quad{dt * gravity.dot(mean), (after - touched).dot(after), (touched - free).dot(touched), damped}};
  });
}

/// Adds the work of a step to that before, but for the stresses'.
template <class Shape, int D = Shape::dimension>
void measureWork(const Patch& patch, const Material&, const Vec3& commonSize, double dt, ParticleView<const Vec<D>> x,
                 OptionalView<const Vec<D>> size, ParticleView<const double> mass,
                 OptionalView<const Matrix3> deformation, OptionalView<const Vec<D>> externalForce,
                 NodeView<const NodeRecord> nodes, ParticleView<const p::Works> old, ParticleView<p::Works> work) {
  const Extents<Shape> extents(patch.level(), commonSize, size, deformation);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(nodes, stencil));
    p::Works& w = work[p];
    w = old[p];
    w[works::external] += mass[p] * sums.value[4];
    if (externalForce) w[works::external] += dt * (*externalForce)[p].dot(lanes<D>(sums.value, lane::velocity));
    w[works::boundary] += mass[p] * sums.value[5];
    w[works::contact] += mass[p] * sums.value[6];
    w[works::dissipated] += mass[p] * sums.value[7];
  });
}

/// V sigma of particles from `first` on, of those kept or of what follows from F.
inline void stressMoments(const Material& material, const double* mass, const Matrix3* deformation,
                          const double* volume, const Matrix3* stress, int first, int count, Matrix3* moments) {
  if (!stress) material.model->kirchhoffStress(deformation + first, count, moments);
  for (int k = 0; k < count; ++k)
    moments[k] = stress ? Matrix3(volume[first + k] * stress[first + k])
                        : Matrix3(mass[first + k] / material.density * moments[k]);
}

/// Adds the work of the stresses, V0 (P_old + P_new)/2 : (F_new - F_old) with V0 P = V sigma F^-T, and that of the
/// artificial viscosity, -V q ln(J_new / J_old).
inline void measureStrainWork(const Patch&, const Material& material, ParticleView<const double> mass,
                              ParticleView<const Matrix3> oldDeformation, ParticleView<const Matrix3> deformation,
                              OptionalView<const double> oldVolume, OptionalView<const Matrix3> oldStress,
                              OptionalView<const double> volume, OptionalView<const Matrix3> stress,
                              OptionalView<const double> viscosity, ParticleView<p::Works> work) {
  std::array<Matrix3, stressGroup> before, after;
  for (int first = 0; first < work.owned(); first += stressGroup) {
    const int count = std::min(stressGroup, work.owned() - first);
    stressMoments(material, valuesOf(mass), valuesOf(oldDeformation), valuesOf(oldVolume), valuesOf(oldStress), first,
                  count, before.data());
    stressMoments(material, valuesOf(mass), valuesOf(deformation), valuesOf(volume), valuesOf(stress), first, count,
                  after.data());
    for (int k = 0; k < count; ++k) {
      const int p = first + k;
      const auto at = static_cast<std::size_t>(k);
      const Matrix3 forth = deformation[p] * oldDeformation[p].inverse(), back = forth.inverse();
      const Matrix3 unit = Matrix3::Identity();
      work[p][works::strain] +=
          0.5 * (before[at].cwiseProduct(forth - unit).sum() + after[at].cwiseProduct(unit - back).sum());
      if (!viscosity) continue;
      const double now = mass[p] / material.density * deformation[p].determinant();
      work[p][works::dissipated] -= now * (*viscosity)[p] * std::log(forth.determinant());
    }
  }
}

/// Takes from the work of the stresses what plastic flow has taken: V (3/2 s:s)^(1/2) times the change of
/// p.plasticStrain.
inline void measurePlasticWork(const Patch&, const Material& material, int stateSize,
                               ParticleView<const double> oldState, ParticleView<const double> state,
                               ParticleView<const double> volume, ParticleView<const Matrix3> stress,
                               ParticleView<p::Works> work) {
  const int offset = offsetOf(*material.model, "p.plasticStrain");
  if (offset < 0 || work.owned() == 0) return;
  const double *before = &oldState[0] + offset, *after = &state[0] + offset;
  for (int p = 0; p < work.owned(); ++p) {
    const double flow = after[p * stateSize] - before[p * stateSize];
    const double taken = volume[p] * std::sqrt(1.5) * deviator(stress[p]).norm() * flow;
    work[p][works::plastic] += taken;
    work[p][works::strain] -= taken;
  }
}

/// One of the numbers of p.work, of all particles.
inline void sumWork(const Patch&, const Material&, int which, ParticleView<const p::Works> work, Sum& total) {
  WideSum sum(total);
  for (int p = 0; p < work.owned(); ++p) sum.add(work[p][which]);
}

}  // namespace tushar::mpm::solid
