#include "components/mpm/solid/contact/friction.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

namespace {

/// The smallest traction that does not count as round-off [Pa].
constexpr double leastTraction = 1e-12;
/// The smallest mass gradient that is normalised [kg/m].
constexpr double leastGradient = 1e-15;
/// The same, as a fraction of the mass at the node per cell: less is the rounding error of a sum that is 0, as inside a
/// body.
constexpr double leastGradientShare = 1e-10;

/// The indices of bodies that have mass at a node.
using Bodies = std::span<const std::size_t>;

/// All bodies that take part, at one node.
template <int D>
struct Gathering {
  Vec<D> momentum = Vec<D>::Zero(), position = Vec<D>::Zero();
  double mass = 0, volume = 0;
  Vec<D> normal = Vec<D>::Zero();  ///< normal out of the body with the largest mass gradient; 0 if there is none
  std::size_t steepest = 0;        ///< index of that body
};

/// Whether a mass gradient is more than a rounding error at a node with this mass.
template <int D>
bool hasDirection(const Level& level, const Vec<D>& gradient, double mass) {
  return gradient.norm() > std::max(leastGradient, leastGradientShare * mass / level.minSpacing());
}

template <int D>
Gathering<D> gatherBodies(const Level& level, Bodies bodies, const Records& records, const Surfaces& surfaces,
                          const Index<D>& node) {
  Gathering<D> all;
  for (const std::size_t m : bodies) {
    const NodeRecord& record = records[m][node];
    all.momentum += record[lane::mass] * lanes<D>(record, lane::velocity);
    const SurfaceRecord& surface = surfaces[m][node];
    all.position += surface.massPosition<D>();
    all.mass += record[lane::mass];
    all.volume += surface.volume();
    const Vec<D> gradient = surface.massGradient<D>();
    if (gradient.norm() <= (1 + tieTolerance) * all.normal.norm()) continue;
    all.normal = gradient;
    all.steepest = m;
  }
  if (hasDirection<D>(level, all.normal, all.mass))
    all.normal.normalize();
  else
    all.normal.setZero();
  return all;
}

/// Whether a body has more mass at a node than rounding errors.
template <int D>
bool isThere(const Records& records, double totalMass, std::size_t m, const Index<D>& node) {
  return records[m][node][lane::mass] >= leastShare * totalMass;
}

/// Whether the stress of a surface is compressive along a normal.
template <int D>
bool isPressed(const Level& level, const SurfaceRecord& surface, const Vec<D>& normal) {
  double traction = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      traction += normal[i] * surface.stress(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) * normal[j];
  return traction < -leastTraction;
}

template <int D>
Vec<D> gradientOf(const Surfaces& surfaces, std::size_t m, const Index<D>& node) {
  const SurfaceRecord& surface = surfaces[m][node];
  return surface.massGradient<D>();
}

/// The unit normal that points out of a body at a node, from the mass gradient of the body and, if Contact::oneNormal,
/// from those of the other bodies there, whether or not they take part; 0 if that is nearly 0.
template <int D>
Vec<D> normalOf(const Level& level, const Contact& contact, Bodies bodies, const Records& records,
                const Surfaces& surfaces, std::size_t m, const Index<D>& node) {
  Vec<D> others = Vec<D>::Zero();
  double mass = 0;
  const double own = records[m][node][lane::mass];
  for (const std::size_t n : bodies) {
    if (n == m || !contact.oneNormal) continue;
    others += records[n][node][lane::mass] * gradientOf<D>(surfaces, n, node);
    mass += records[n][node][lane::mass];
  }
  Vec<D> normal = 0.5 * (gradientOf<D>(surfaces, m, node) - (mass > 0 ? Vec<D>(others / mass) : others));
  if (!hasDirection<D>(level, normal, own + mass)) return Vec<D>::Zero();
  for (int d = 0; d < D && contact.normalsInCells; ++d) normal[d] *= level.spacing(d);
  return normal.normalized();
}

/// Whether the stresses of all bodies at a node are compressive along the node's normal.
template <int D>
bool arePressed(const Level& level, Bodies bodies, const Records& records, const Surfaces& surfaces,
                const Gathering<D>& all, const Index<D>& node) {
  for (const std::size_t m : bodies)
    if (isThere<D>(records, all.mass, m, node) && !isPressed<D>(level, surfaces[m][node], all.normal)) return false;
  return true;
}

/// The distance, at a node, between the centre of mass of this body and that of the other bodies [m].
template <int D>
double separation(const Gathering<D>& all, const Vec<D>& position, double mass) {
  return ((all.position - position) / (all.mass - mass) - position / mass).norm();
}

/// The factor by which a change of velocity at a node is reduced, so that it strains no body there by more than 1/2 in
/// a step.
template <int D>
double strainLimit(const Level& level, const Vec<D>& change, double dt, double massRatio) {
  double strain = 0;
  for (int d = 0; d < D; ++d) strain = std::max(strain, std::abs(change[d]) * dt * level.inverseSpacing(d));
  strain *= std::max(1.0, massRatio);
  return strain > 0.5 ? 0.5 / strain : 1.0;
}

}  // namespace

template <int D>
FrictionImpulse<D> frictionImpulse(const Touch<D>& touch, double mu) {
  const double approach = touch.velocity.dot(touch.normal);
  if (!touch.isPressed && approach <= 0) return {};
  const Vec<D> slip = touch.velocity - approach * touch.normal;
  const double speed = slip.norm();
  const double share = speed > 0 ? std::min(mu * std::abs(approach) / speed, 1.0) : 0.0;
  return {-approach * touch.normal - share * slip, share * (1 - share) * speed * speed};
}

template <int D>
void applyFriction(const Patch& patch, const Contact& contact, double dt, const MeetingBodies<D>& meeting,
                   const Records& records, const Surfaces& surfaces, const FrictionHeats& heat) {
  const Level& level = patch.level();
  double widths = 1;
  for (int d = 0; d < D; ++d) widths *= level.spacing(d);
  const double reach = contact.separationFactor * std::pow(widths, 1.0 / D);
  const double leastVolume = contact.volumeConstraint * level.cellVolume();
  const Box nodes = records.front().box();
  std::vector<std::size_t> bodies;
  const std::vector<bool> takesPart = contact.takingPart(records.size());
  const Box counted = contact.keepsMomentum ? nodes : nodes.intersect(level.nodesOfCells());
  const bool skipsOutside = !contact.keepsMomentum && level.boxes();
  meeting.forEachNode([&](const Index<D>& node, Bodies there) {
    if (!counted.contains(node) || (skipsOutside && !level.isNodeInside<D>(node))) return;
    bodies.clear();
    for (const std::size_t m : there)
      if (takesPart[m]) bodies.push_back(m);
    if (bodies.size() < 2) return;
    const Gathering<D> sum = gatherBodies<D>(level, bodies, records, surfaces, node);
    if (sum.normal.isZero() || sum.volume <= leastVolume) return;
    const bool together =
        contact.keepsMomentum && !contact.onlyOnApproach && arePressed<D>(level, bodies, records, surfaces, sum, node);
    for (const std::size_t m : bodies) {
      NodeRecord& record = records[m][node];
      const double mass = record[lane::mass], others = sum.mass - mass;
      if (!isThere<D>(records, sum.mass, m, node) || others < leastShare * sum.mass) continue;
      const SurfaceRecord& surface = surfaces[m][node];
      if (separation<D>(sum, surface.massPosition<D>(), mass) >= reach) continue;
      const Vec<D> v = lanes<D>(record, lane::velocity);
      Touch<D> touch{normalOf<D>(level, contact, there, records, surfaces, m, node), v - sum.momentum / sum.mass,
                     together};
      if (contact.keepsMomentum)
        touch.normal = m == sum.steepest ? sum.normal : Vec<D>(-sum.normal);
      else if (!contact.onlyOnApproach)
        touch.isPressed = isPressed<D>(level, surface, touch.normal);
      const FrictionImpulse<D> impulse = frictionImpulse<D>(touch, contact.friction);
      const double share = strainLimit<D>(level, impulse.change, dt, mass / others);
      setLanes<D>(record, lane::velocity, v + share * impulse.change);
      if (heat[m]) (*heat[m])[node] += share * mass * impulse.heat;
    }
  });
}

template FrictionImpulse<1> frictionImpulse<1>(const Touch<1>&, double);
template FrictionImpulse<2> frictionImpulse<2>(const Touch<2>&, double);
template FrictionImpulse<3> frictionImpulse<3>(const Touch<3>&, double);
template void applyFriction<1>(const Patch&, const Contact&, double, const MeetingBodies<1>&, const Records&,
                               const Surfaces&, const FrictionHeats&);
template void applyFriction<2>(const Patch&, const Contact&, double, const MeetingBodies<2>&, const Records&,
                               const Surfaces&, const FrictionHeats&);
template void applyFriction<3>(const Patch&, const Contact&, double, const MeetingBodies<3>&, const Records&,
                               const Surfaces&, const FrictionHeats&);

}  // namespace tushar::mpm::solid
