#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/contact/meeting_bodies.hpp"
#include "components/mpm/solid/labels.hpp"

namespace tushar::mpm::solid {

/// Where the body with the most mass, or the steepest, determines a normal, values that differ by less than this
/// fraction are equal: rounding errors must not choose the body.
inline constexpr double tieTolerance = 1e-10;

/// The contact of a body with others at a node.
template <int D>
struct Touch {
  Vec<D> normal;    ///< normal out of the body
  Vec<D> velocity;  ///< velocity of the body relative to the centre of mass of all bodies [m/s]
  bool isPressed;   ///< whether the stress on the surface is compressive
};

/// The effect of friction on a body at a node.
template <int D>
struct FrictionImpulse {
  Vec<D> change = Vec<D>::Zero();  ///< change of the velocity [m/s]
  double heat = 0;                 ///< kinetic energy dissipated by friction [J/kg]
};

/// A body that is pressed against others or approaches them does not penetrate them, and slides as far as friction with
/// the coefficient mu allows; Bardenhagen, Guilkey, Roessig, Brackbill, Witzel & Foster, CMES 2 (2001) 509, eq. 13.
template <int D>
FrictionImpulse<D> frictionImpulse(const Touch<D>& touch, double mu);

/// The surfaces of all materials, and the frictional heat [J] at their nodes, if the scene computes it.
using Surfaces = std::vector<NodeView<const SurfaceRecord>>;
using FrictionHeats = std::vector<std::optional<NodeView<double>>>;

/// Applies the impulses of friction to all participating materials, where their volumes and distance satisfy the
/// conditions of the contact. A change that would strain a cell by more than 1/2 is reduced to that limit. Adds the
/// heat to `heat`.
///
/// As in Uintah, the normal of a body is half the difference between its mass gradient and the mass-weighted mean of
/// the gradients of all others (in axisymmetric scenes, of the gradients per cell), and only its own stress determines
/// whether it is in compression. So the sum of momenta changes with three bodies, or with two of which only one is in
/// compression. In contacts that conserve momentum, all bodies have the normal of the body with the largest mass
/// gradient, or its opposite, and count as in compression if the stresses of all are compressive.
template <int D>
void applyFriction(const Patch& patch, const Contact& contact, double dt, const MeetingBodies<D>& meeting,
                   const Records& records, const Surfaces& surfaces, const FrictionHeats& heat);

}  // namespace tushar::mpm::solid
