#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/explicit/keeps.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"
#include "components/mpm/solid/transfer/placed.hpp"
#include "components/mpm/solid/transfer/stress_source.hpp"

namespace tushar::mpm::solid {

// The work on particles in a step. Forces act along w = (v + v*)/2 of the nodes; constraints that prescribe the
// velocity of nodes act along this velocity; the mean of the stresses at the start and at the end of the step acts
// along the change of F. The rest of the change of kinetic energy is dissipated by the method itself: by FLIP to first
// order in dt (Bardenhagen, J. Comput. Phys. 180 (2002) 383); by APIC, PIC and XPIC through the viscosity of their
// transfer; by contact, when two bodies begin to move as one.

/// Indices of the components of p.work, as in total::work.
namespace works {
inline constexpr int external = 0, boundary = 1, contact = 2, dissipated = 3, strain = 4, plastic = 5, start = 6;
}

/// Sets the initial work to 0, and stores the initial kinetic energy.
template <int D>
void startWork(const Patch&, const Material&, ParticleView<const double> mass, ParticleView<const Vec<D>> velocity,
               ParticleView<p::Works> work) {
  for (int p = 0; p < mass.owned(); ++p) {
    work[p].setZero();
    work[p][works::start] = 0.5 * mass[p] * velocity[p].squaredNorm();
  }
}

/// Copies the current velocity from the records near particles.
template <int D>
void keepVelocity(const Patch&, const Material&, int ghostNodes, ParticleView<const Vec<D>> x,
                  NodeView<const NodeRecord> record, NodeView<Vec<D>> kept) {
  forEachTouchedNode<D>(x, ghostNodes, kept.box(),
                        [&](const Index<D>& node) { kept[node] = lanes<D>(record[node], lane::velocity); });
}

/// Computes w at the nodes near particles, and the work per mass there: of gravity, of the sides of the grid, of
/// contact, and of damping.
template <int D>
void computeNodalWork(const Patch& patch, const Material&, const Method& method, int ghostNodes,
                      ParticleView<const Vec<D>> x, double dt, NodeView<const NodeRecord> record,
                      NodeView<const Vec<D>> ofForces, const std::optional<NodeView<const Vec<D>>>& ofContact,
                      NodeView<NodeRecord> work) {
  const Vec<D> gravity = patch.level().reduce<D>(method.gravity);
  forEachTouchedNode<D>(x, ghostNodes, work.box(), [&](const Index<D>& node) {
    const Vec<D> before = lanes<D>(record[node], lane::before), after = lanes<D>(record[node], lane::velocity);
    const Vec<D> mean = 0.5 * (before + after), free = ofForces[node];
    const Vec<D> touched = ofContact ? Vec<D>((*ofContact)[node]) : free;
    const bool isDamped = record[node][lane::mass] > method.minimumMassForAcceleration;
    const double damped = isDamped ? dt * method.damping * before.dot(mean) : 0.0;
    work[node] = {quadOf<D>(mean),
                  Quad{dt * gravity.dot(mean), (after - touched).dot(after), (touched - free).dot(touched), damped}};
  });
}

/// Views of the variables that measureWork reads and writes.
template <int D>
struct ParticleWork {
  Placed<D> particles;
  ParticleView<const double> mass;
  OptionalView<const Vec<D>> externalForce;
  NodeView<const NodeRecord> nodes;  ///< w, and the work per mass
  ParticleView<const p::Works> old;
  ParticleView<p::Works> work;

  /// `deformation` is the access to F.
  static ParticleWork from(auto& take, const ShapeTraits& shape, const Keeps& keeps, auto deformation) {
    return {.particles = Placed<D>::from(take, keeps.sizes, 0, deformation),
            .mass = take(requiresOld(p::mass)),
            .externalForce = take(when(keeps.externalForce, requiresNew(p::externalForce<D>))),
            .nodes = take(requiresNew(g::workRecord, shape.ghostNodes)),
            .old = take(requiresOld(p::work)),
            .work = take(computes(p::work))};
  }
};

/// Accumulates the work of a step, except that of the stresses.
template <class Shape, int D = Shape::dimension>
void measureWork(const Patch& patch, const Material&, const Vec3& commonSize, double dt, const ParticleWork<D>& u) {
  forEachStencil<Shape>(patch, patch.cells(), u.particles, commonSize, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(u.nodes, stencil));
    p::Works& w = u.work[p];
    const double mass = u.mass[p];
    w = u.old[p];
    w[works::external] += mass * sums.value[4];
    if (u.externalForce) w[works::external] += dt * (*u.externalForce)[p].dot(lanes<D>(sums.value, lane::velocity));
    w[works::boundary] += mass * sums.value[5];
    w[works::contact] += mass * sums.value[6];
    w[works::dissipated] += mass * sums.value[7];
  });
}

/// Views of F and the stress of particles, at the start of a step or at its end.
struct Stressed {
  ParticleView<const Matrix3> deformation;
  OptionalView<const double> volume;
  OptionalView<const Matrix3> stress;  ///< stress, if it is not a function of F alone

  static Stressed from(auto& take, bool keepsStress, auto reads) {
    return {.deformation = take(reads(p::deformationMeasure, 0)),
            .volume = take(when(keepsStress, reads(p::volume, 0))),
            .stress = take(when(keepsStress, reads(p::stress, 0)))};
  }
  StressSource source() const {
    return {.stress = valuesOf(stress), .volume = valuesOf(volume), .deformation = valuesOf(deformation)};
  }
};

/// Views of the variables that measureStrainWork reads and writes.
struct StrainWork {
  ParticleView<const double> mass;
  Stressed before, after;
  OptionalView<const double> viscosity;
  ParticleView<p::Works> work;

  /// `old` reads a variable at the start of the step, `fresh` as computed in the step.
  static StrainWork from(auto& take, const Keeps& keeps, auto old, auto fresh) {
    return {.mass = take(requiresOld(p::mass)),
            .before = Stressed::from(take, keeps.stress, old),
            .after = Stressed::from(take, keeps.stress, fresh),
            .viscosity = take(when(keeps.viscosity, requiresNew(p::viscosity))),
            .work = take(modifies(p::work))};
  }
};

/// Adds the work of the stresses, V0 (P_old + P_new)/2 : (F_new - F_old) with V0 P = V sigma F^-T, and that of the
/// artificial viscosity, -V q ln(J_new / J_old). The stress of a rigid body exerts no force.
inline void measureStrainWork(const Patch&, const Material& material, const StrainWork& u) {
  if (material.isRigid) return;
  std::array<Matrix3, stressGroup> before, after;
  const double density = material.undeformedDensity();
  const auto startVolume = [&](int p) { return u.mass[p] / density; };
  for (int first = 0; first < u.work.owned(); first += stressGroup) {
    const int count = std::min(stressGroup, u.work.owned() - first);
    stressMoments(material, u.before.source(), first, count, startVolume, before.data());
    stressMoments(material, u.after.source(), first, count, startVolume, after.data());
    for (int k = 0; k < count; ++k) {
      const int p = first + k;
      const std::size_t at = k;
      const Matrix3& f = u.after.deformation[p];
      const Matrix3 forth = f * u.before.deformation[p].inverse(), back = forth.inverse();
      const Matrix3 unit = Matrix3::Identity();
      u.work[p][works::strain] +=
          0.5 * (before[at].cwiseProduct(forth - unit).sum() + after[at].cwiseProduct(unit - back).sum());
      if (!u.viscosity) continue;
      const double now = u.mass[p] / density * f.determinant();
      u.work[p][works::dissipated] -= now * (*u.viscosity)[p] * std::log(forth.determinant());
    }
  }
}

/// Separates plastic work from the work of the stresses: V (3/2 s:s)^(1/2) times the change of p.plasticStrain.
inline void measurePlasticWork(const Patch&, const Material& material, int stateSize,
                               ParticleView<const double> oldState, ParticleView<const double> state,
                               ParticleView<const double> volume, ParticleView<const Matrix3> stress,
                               ParticleView<p::Works> work) {
  const int offset = offsetOf(*material.model, "p.plasticStrain");
  if (offset < 0 || work.owned() == 0 || material.isRigid) return;
  const double *before = &oldState[0] + offset, *after = &state[0] + offset;
  for (int p = 0; p < work.owned(); ++p) {
    const double flow = after[p * stateSize] - before[p * stateSize];
    const double taken = volume[p] * std::sqrt(1.5) * deviator(stress[p]).norm() * flow;
    work[p][works::plastic] += taken;
    work[p][works::strain] -= taken;
  }
}

/// Computes the sum of one component of p.work over all particles.
inline void sumWork(const Patch&, const Material&, int which, ParticleView<const p::Works> work, Sum& total) {
  WideSum(total).addAll(work.owned(), [&](int p) { return work[p][which]; });
}

}  // namespace tushar::mpm::solid
