#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/labels.hpp"

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
/// by at most 51 Gauss-Newton steps from 0; lambda = 1e-7 width^2, m^2 (section 3.3 of the source). Where they do not
/// settle within 1e-7 in the cosine between two steps, the normal of those that came closest.
template <int D>
Vec<D> separatingNormal(const std::vector<SidedParticle<D>>& particles, double width);

/// The plane that separates bodies at nodes, as variables of one body.
template <int D>
struct SeparatingPlane {
  /// Unit normal out of the body, at nodes where it has the most mass of all bodies that meet there; 0 elsewhere.
  std::optional<NodeView<const Vec<D>>> normal;
  /// The extent of the body's particles along that normal [m]: the farthest for the heaviest body, the nearest for
  /// others.
  std::optional<NodeView<const double>> prominence;
  std::optional<NodeView<const double>> color;  ///< mass-weighted mean of its p.color

  static SeparatingPlane from(auto& take, bool hasPlanes, bool hasColor) {
    return {.normal = take(when(hasPlanes, requiresNew(g::separatingNormal<D>))),
            .prominence = take(when(hasPlanes, requiresNew(g::prominence))),
            .color = take(when(hasColor, requiresNew(g::color)))};
  }
};
/// The planes of all materials.
template <int D>
using SeparatingPlanes = std::vector<SeparatingPlane<D>>;

/// The value of the prominence if a body has no surface particles near a node.
inline constexpr double noProminence = -std::numeric_limits<double>::max();

/// Exchanges the impulse that stops the approach of overlapping bodies and, by Coulomb's friction, slows their slip:
/// between the body with the most mass and each other body that overlaps it beyond the plane and approaches the centre
/// of mass. Momentum is conserved.
template <int D>
void slideAlongPlanes(const Contact& contact, const Records& records, const SeparatingPlanes<D>& planes);

/// Moves the master as prescribed by `motion`, or freely; bodies that overlap and approach it are stopped, and slowed
/// by friction.
template <int D>
void slideOnMaster(const Patch& patch, const Contact& contact, double time, double dt, const Records& records,
                   const SeparatingPlanes<D>& planes);

/// Like sumReaction, for the bodies that slideOnMaster is about to stop.
template <int D>
void sumSlidingReaction(const Patch& patch, const Contact& contact, const Acceleration& acceleration, double time,
                        double dt, const Records& records, const SeparatingPlanes<D>& planes, VectorSum& reaction);

}  // namespace tushar::mpm::solid
