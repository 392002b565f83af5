#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/contact/meeting_bodies.hpp"
#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/transfer/placed.hpp"

// Contact with friction along the plane that separates the particles of two bodies, found by logistic regression;
// Nairn, Hammerquist & Smith, Comput. Methods Appl. Mech. Engrg. 362 (2020) 112859.

namespace tushar::mpm::solid {

/// A particle near a node, as data for the regression.
template <int D>
struct SidedParticle {
  Vec<D> x;      ///< position relative to the node [m]
  bool isOther;  ///< whether it belongs to a body other than the one out of which the normal points
};

/// Normal of the plane phi . x + phi_0 = 0 that separates the particles around a node: it minimises
///   sum_p (c_p - tanh((phi . x_p + phi_0) / 2))^2 + lambda |phi|^2,   c_p = -1 on one side, 1 on the other,
/// by at most 51 Gauss-Newton steps from 0; lambda = 1e-7 width^2, m^2 (section 3.3 of the source). If the normals of
/// no two successive steps agree to 1e-7 (in the cosine of the angle between them), the result is the normal of the
/// steps that agree best.
template <int D>
Vec<D> separatingNormal(const std::vector<SidedParticle<D>>& particles, double width);

/// The planes that separate bodies at nodes, described by variables of one body.
template <int D>
struct SeparatingPlane {
  /// Unit normal out of the body, at nodes where it has the most mass of all bodies that meet there; 0 elsewhere.
  std::optional<NodeView<const Vec<D>>> normal;
  /// How far the body's surface particles extend along the plane's normal [m]: the extent of the farthest particle if
  /// the plane belongs to the body, otherwise that of the nearest particle.
  std::optional<NodeView<const double>> prominence;
  std::optional<NodeView<const double>> color;  ///< mass-weighted mean of its p.color
  /// The particles of the body, which touch the nodes up to `ghostNodes` layers around their cells.
  std::optional<ParticleView<const Vec<D>>> x = std::nullopt;
  int ghostNodes = 0;

  /// `shapes` are the shape functions of the particles.
  static SeparatingPlane from(auto& take, bool hasPlanes, bool hasColor, const ShapeTraits& shapes) {
    return {.normal = take(when(hasPlanes, requiresNew(g::separatingNormal<D>))),
            .prominence = take(when(hasPlanes, requiresNew(g::prominence))),
            .color = take(when(hasColor, requiresNew(g::color))),
            .x = take(when(hasPlanes, requiresOld(p::x<D>, shapes.reach))),
            .ghostNodes = shapes.ghostNodes};
  }
};
/// The planes of all materials.
template <int D>
using SeparatingPlanes = std::vector<SeparatingPlane<D>>;

/// The nodes at which bodies with planes meet.
template <int D>
MeetingBodies<D> meetingAtPlanes(const Records& records, const SeparatingPlanes<D>& planes);

/// The value of the prominence if a body has no surface particles near a node.
inline constexpr double noProminence = -std::numeric_limits<double>::max();

/// Stops the approach of overlapping bodies, and slows their slip by Coulomb friction: exchanges an impulse between the
/// body with the most mass at a node and each other body that overlaps it across the plane and approaches the centre of
/// mass. Momentum is conserved.
template <int D>
void slideAlongPlanes(const Level& level, const Contact& contact, const Records& records,
                      const SeparatingPlanes<D>& planes, const MeetingBodies<D>& meeting);

/// Stops bodies that overlap the master and approach it, and slows their slip by friction. Then gives the master its
/// prescribed velocity, if it has one.
template <int D>
void slideOnMaster(const Patch& patch, const Contact& contact, double time, double dt, const Records& records,
                   const SeparatingPlanes<D>& planes, const MeetingBodies<D>& meeting);

/// Adds to `reaction` the force [N] that holds the bodies that slideOnMaster will stop, as sumReaction does.
template <int D>
void sumSlidingReaction(const Patch& patch, const Contact& contact, const Acceleration& acceleration, double time,
                        double dt, const Records& records, const SeparatingPlanes<D>& planes,
                        const MeetingBodies<D>& meeting, VectorSum& reaction);

}  // namespace tushar::mpm::solid
