#include "components/mpm/solid/contact/contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tushar::mpm::solid {

bool Contact::concerns(int material) const {
  return materials.empty() || std::find(materials.begin(), materials.end(), material) != materials.end();
}

std::vector<std::size_t> Contact::bodies(std::size_t count) const {
  std::vector<std::size_t> found;
  for (std::size_t m = 0; m < count; ++m)
    if (concerns(static_cast<int>(m))) found.push_back(m);
  return found;
}

std::vector<bool> Contact::takingPart(std::size_t count) const {
  std::vector<bool> takesPart(count, false);
  for (const std::size_t m : bodies(count)) takesPart[m] = true;
  return takesPart;
}

namespace {

/// The value of a profile at a time.
Vec3 valueAt(const Profile<Vec3>& profile, double time) {
  if (time <= profile.front().first) return profile.front().second;
  if (time >= profile.back().first) return profile.back().second;
  const auto next = std::lower_bound(profile.begin(), profile.end(), time,
                                     [](const auto& entry, double t) { return entry.first < t; });
  const auto& [t0, v0] = *(next - 1);
  const double share = (time - t0) / (next->first - t0);
  return share * next->second + (1 - share) * v0;
}

}  // namespace

Vec3 Motion::at(const Vec3& point, double dt) const {
  const double speed = angularVelocity.norm();
  if (speed == 0) return velocity;
  const Vec3 r = point - centre;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(angularVelocity[axis]) <= 0.99 * speed) continue;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double angle = angularVelocity[axis] * dt, half = std::sin(0.5 * angle);
    const double along = -2 * half * half, across = std::sin(angle);  // cos - 1 and sin
    Vec3 chord = Vec3::Zero();
    chord[i] = along * r[i] - across * r[j];
    chord[j] = across * r[i] + along * r[j];
    return velocity + chord / dt;
  }
  return velocity + angularVelocity.cross(r);
}

std::optional<Vec3> Contact::prescribedVelocity(double time) const {
  if (time > stopTime) return velocityAfterStop;
  if (profile.empty()) return std::nullopt;
  return valueAt(profile, time);
}

std::optional<Motion> Contact::prescribedMotion(double time) const {
  const auto velocity = prescribedVelocity(time);
  if (!velocity) return std::nullopt;
  Motion motion{.velocity = *velocity};
  if (time <= stopTime && !angularVelocity.empty()) {
    motion.centre = valueAt(centres, time);
    motion.angularVelocity = valueAt(angularVelocity, time);
  }
  return motion;
}

namespace {

/// Whether a contact acts at a node: its master is present, and the material that disables the contact is not.
template <int D>
bool isAt(const Contact& contact, const Records& records, const Index<D>& node) {
  return isPresent<D>(records, contact.master, node) && !isExcluded<D>(contact, records, node);
}

}  // namespace

template <int D>
void moveAsOne(const Patch&, const Contact& contact, const Records& records) {
  const std::vector<std::size_t> bodies = contact.bodies(records.size());
  std::vector<NodeRecord*> of(bodies.size());  // the record of a node for each body
  grid::forEachRow<D>(records.front().box(), [&](Index<D> node, int count) {
    for (std::size_t k = 0; k < bodies.size(); ++k) of[k] = &records[bodies[k]][node];
    for (; count > 0; --count, ++node[0]) {
      double total = 0;
      for (const NodeRecord* record : of) total += (*record)[lane::mass];
      if (total != 0 && !isExcluded<D>(contact, records, node)) {
        Vec<D> momentum = Vec<D>::Zero();
        for (const NodeRecord* record : of) momentum += (*record)[lane::mass] * lanes<D>(*record, lane::velocity);
        for (NodeRecord* record : of) setLanes<D>(*record, lane::velocity, momentum / total);
      }
      for (NodeRecord*& record : of) ++record;
    }
  });
}

template <int D>
Vec<D> masterVelocity(const Patch& patch, const Contact& contact, const std::optional<Motion>& motion, double dt,
                      const Records& records, const Index<D>& node) {
  if (!motion) return lanes<D>(records[contact.master][node], lane::velocity);
  Vec<D> at;
  for (int d = 0; d < D; ++d) at[d] = patch.level().nodePosition(d, node[d]);
  return patch.level().reduce<D>(motion->at(patch.level().expandPoint<D>(at), dt));
}

template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, double dt, const Records& records) {
  const std::size_t master = contact.master;
  const auto motion = contact.prescribedMotion(time);
  forEach<D>(records.front().box(), [&](const Index<D>& node) {
    if (!isAt<D>(contact, records, node)) return;
    const Vec<D> velocity = masterVelocity<D>(patch, contact, motion, dt, records, node);
    setLanes<D>(records[master][node], lane::velocity, velocity);
    for (std::size_t m = 0; m < records.size(); ++m) {
      if (m == master || !contact.concerns(static_cast<int>(m))) continue;
      for (int d = 0; d < D; ++d)
        if (contact.direction[patch.level().axis(d)]) records[m][node][lane::velocity + d] = velocity[d];
    }
  });
}

template <int D>
void sumReaction(const Patch& patch, const Contact& contact, const Acceleration& acceleration, double dt,
                 const Records& records, VectorSum& reaction) {
  const Vec<D> gravity = patch.level().reduce<D>(acceleration.gravity);
  forEach<D>(records.front().box(), [&](const Index<D>& node) {
    if (!countsOnce<D>(patch, node) || !isAt<D>(contact, records, node)) return;
    for (std::size_t m = 0; m < records.size(); ++m) {
      const NodeRecord& record = records[m][node];
      if (static_cast<int>(m) == contact.master || !contact.concerns(static_cast<int>(m)) || record[lane::mass] == 0)
        continue;
      reaction.add(patch.level().expandDirection<D>(heldForce<D>(record, gravity, acceleration, dt)));
    }
  });
}

template void moveAsOne<1>(const Patch&, const Contact&, const Records&);
template void moveAsOne<2>(const Patch&, const Contact&, const Records&);
template void moveAsOne<3>(const Patch&, const Contact&, const Records&);
template void followMaster<1>(const Patch&, const Contact&, double, double, const Records&);
template Vec<1> masterVelocity<1>(const Patch&, const Contact&, const std::optional<Motion>&, double, const Records&,
                                  const Index<1>&);
template void followMaster<2>(const Patch&, const Contact&, double, double, const Records&);
template Vec<2> masterVelocity<2>(const Patch&, const Contact&, const std::optional<Motion>&, double, const Records&,
                                  const Index<2>&);
template void followMaster<3>(const Patch&, const Contact&, double, double, const Records&);
template Vec<3> masterVelocity<3>(const Patch&, const Contact&, const std::optional<Motion>&, double, const Records&,
                                  const Index<3>&);
template void sumReaction<1>(const Patch&, const Contact&, const Acceleration&, double, const Records&, VectorSum&);
template void sumReaction<2>(const Patch&, const Contact&, const Acceleration&, double, const Records&, VectorSum&);
template void sumReaction<3>(const Patch&, const Contact&, const Acceleration&, double, const Records&, VectorSum&);

}  // namespace tushar::mpm::solid
