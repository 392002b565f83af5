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

template <int D>
void moveAsOne(const Patch&, const Contact& contact, const NodeMasses& mass, const NodeVelocities<D>& velocity) {
  forEach<D>(mass.front().box(), [&](const Index<D>& node) {
    Vec<D> momentum = Vec<D>::Zero();
    double total = 0;
    for (std::size_t m = 0; m < mass.size(); ++m) {
      if (!contact.concerns(static_cast<int>(m))) continue;
      momentum += mass[m][node] * velocity[m][node];
      total += mass[m][node];
    }
    if (total == 0) return;
    for (std::size_t m = 0; m < mass.size(); ++m)
      if (contact.concerns(static_cast<int>(m))) velocity[m][node] = momentum / total;
  });
}

template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, const NodeMasses& mass,
                  const NodeVelocities<D>& velocity) {
  const auto master = static_cast<std::size_t>(contact.master);
  const auto prescribed = contact.prescribedVelocity(time);
  forEach<D>(mass.front().box(), [&](const Index<D>& node) {
    if (mass[master][node] == 0) return;
    if (prescribed) velocity[master][node] = patch.level().reduce<D>(*prescribed);
    for (std::size_t m = 0; m < mass.size(); ++m) {
      if (m == master || !contact.concerns(static_cast<int>(m))) continue;
      for (int d = 0; d < D; ++d)
        if (contact.direction[static_cast<std::size_t>(patch.level().axis(d))])
          velocity[m][node][d] = velocity[master][node][d];
    }
  });
}

template void moveAsOne<1>(const Patch&, const Contact&, const NodeMasses&, const NodeVelocities<1>&);
template void moveAsOne<2>(const Patch&, const Contact&, const NodeMasses&, const NodeVelocities<2>&);
template void moveAsOne<3>(const Patch&, const Contact&, const NodeMasses&, const NodeVelocities<3>&);
template void followMaster<1>(const Patch&, const Contact&, double, const NodeMasses&, const NodeVelocities<1>&);
template void followMaster<2>(const Patch&, const Contact&, double, const NodeMasses&, const NodeVelocities<2>&);
template void followMaster<3>(const Patch&, const Contact&, double, const NodeMasses&, const NodeVelocities<3>&);

}  // namespace tushar::mpm::solid
