#include "components/mpm/solid/contact/contact.hpp"

#include <algorithm>

namespace tushar::mpm::solid {

bool Contact::concerns(int material) const {
  return materials.empty() || std::find(materials.begin(), materials.end(), material) != materials.end();
}

std::optional<Vec3> Contact::prescribedVelocity(double time) const {
  if (time > stopTime) return velocityAfterStop;
  if (profile.empty()) return std::nullopt;
  if (time <= profile.front().first) return profile.front().second;
  if (time >= profile.back().first) return profile.back().second;
  const auto next = std::lower_bound(profile.begin(), profile.end(), time,
                                     [](const auto& entry, double t) { return entry.first < t; });
  const auto& [t0, v0] = *(next - 1);
  const double share = (time - t0) / (next->first - t0);
  return share * next->second + (1 - share) * v0;
}

namespace {

/// Whether the material that keeps a contact from acting is at a node.
template <int D>
bool isExcluded(const Contact& contact, const Records& records, const Index<D>& node) {
  return contact.excluded >= 0 && records[contact.excluded][node][lane::mass] != 0;
}

/// Whether a contact acts at a node: its master is there, and no material that excludes it.
template <int D>
bool isAt(const Contact& contact, const Records& records, const Index<D>& node) {
  return records[contact.master][node][lane::mass] != 0 && !isExcluded<D>(contact, records, node);
}

}  // namespace

template <int D>
void moveAsOne(const Patch&, const Contact& contact, const Records& records) {
  forEach<D>(records.front().box(), [&](const Index<D>& node) {
    if (isExcluded<D>(contact, records, node)) return;
    Vec<D> momentum = Vec<D>::Zero();
    double total = 0;
    for (std::size_t m = 0; m < records.size(); ++m) {
      if (!contact.concerns(static_cast<int>(m))) continue;
      const NodeRecord& record = records[m][node];
      momentum += record[lane::mass] * lanes<D>(record, lane::velocity);
      total += record[lane::mass];
    }
    if (total == 0) return;
    for (std::size_t m = 0; m < records.size(); ++m)
      if (contact.concerns(static_cast<int>(m))) setLanes<D>(records[m][node], lane::velocity, momentum / total);
  });
}

template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, const Records& records) {
  const auto master = static_cast<std::size_t>(contact.master);
  const auto prescribed = contact.prescribedVelocity(time);
  forEach<D>(records.front().box(), [&](const Index<D>& node) {
    if (!isAt<D>(contact, records, node)) return;
    if (prescribed) setLanes<D>(records[master][node], lane::velocity, patch.level().reduce<D>(*prescribed));
    const Vec<D> velocity = lanes<D>(records[master][node], lane::velocity);
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
    if (!isOwned<D>(patch, node) || !isAt<D>(contact, records, node)) return;
    for (std::size_t m = 0; m < records.size(); ++m) {
      const NodeRecord& record = records[m][node];
      if (static_cast<int>(m) == contact.master || !contact.concerns(static_cast<int>(m)) || record[lane::mass] == 0)
        continue;
      const Vec<D> before = lanes<D>(record, lane::before), after = lanes<D>(record, lane::velocity);
      const Vec<D> forced = (after - before) / dt - gravity + acceleration.damping * before;
      reaction.add(patch.level().expandDirection<D>(-record[lane::mass] * forced));
    }
  });
}

template void moveAsOne<1>(const Patch&, const Contact&, const Records&);
template void moveAsOne<2>(const Patch&, const Contact&, const Records&);
template void moveAsOne<3>(const Patch&, const Contact&, const Records&);
template void followMaster<1>(const Patch&, const Contact&, double, const Records&);
template void followMaster<2>(const Patch&, const Contact&, double, const Records&);
template void followMaster<3>(const Patch&, const Contact&, double, const Records&);
template void sumReaction<1>(const Patch&, const Contact&, const Acceleration&, double, const Records&, VectorSum&);
template void sumReaction<2>(const Patch&, const Contact&, const Acceleration&, double, const Records&, VectorSum&);
template void sumReaction<3>(const Patch&, const Contact&, const Acceleration&, double, const Records&, VectorSum&);

}  // namespace tushar::mpm::solid
