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
void moveAsOne(const Patch&, const Contact& contact, const Records& records) {
  forEach<D>(records.front().box(), [&](const Index<D>& node) {
    Vec<D> momentum = Vec<D>::Zero();
    double total = 0;
    for (std::size_t m = 0; m < records.size(); ++m) {
      if (!contact.concerns(static_cast<int>(m))) continue;
      const Octet& record = records[m][node];
      momentum += record[lane::mass] * lanes<D>(record, lane::velocity);
      total += record[lane::mass];
    }
    if (total == 0) return;
    for (std::size_t m = 0; m < records.size(); ++m)
      if (contact.concerns(static_cast<int>(m))) setLanes<D>(records[m][node], lane::velocity, momentum / total);
  });
}

template <int D>
void followMaster(const Patch& patch, const Contact& contact, double time, double dt, const Records& records,
                  VectorSum& reaction) {
  const auto master = static_cast<std::size_t>(contact.master);
  const auto prescribed = contact.prescribedVelocity(time);
  forEach<D>(records.front().box(), [&](const Index<D>& node) {
    if (records[master][node][lane::mass] == 0) return;
    for (std::size_t n = 0; n < records.size(); ++n) {
      const std::size_t m = n == 0 ? master : n <= master ? n - 1 : n;  // the master first
      if (m == master ? !prescribed : !contact.concerns(static_cast<int>(m))) continue;
      const Vec<D> before = lanes<D>(records[m][node], lane::velocity);
      Vec<D> after = prescribed ? patch.level().reduce<D>(*prescribed) : lanes<D>(records[master][node], lane::velocity);
      for (int d = 0; d < D; ++d)
        if (m != master && !contact.direction[static_cast<std::size_t>(patch.level().axis(d))]) after[d] = before[d];
      setLanes<D>(records[m][node], lane::velocity, after);
      if (isOwned<D>(patch, node))
        reaction.add(patch.level().expandDirection<D>(records[m][node][lane::mass] / dt * (after - before)));
    }
  });
}

template void moveAsOne<1>(const Patch&, const Contact&, const Records&);
template void moveAsOne<2>(const Patch&, const Contact&, const Records&);
template void moveAsOne<3>(const Patch&, const Contact&, const Records&);
template void followMaster<1>(const Patch&, const Contact&, double, double, const Records&, VectorSum&);
template void followMaster<2>(const Patch&, const Contact&, double, double, const Records&, VectorSum&);
template void followMaster<3>(const Patch&, const Contact&, double, double, const Records&, VectorSum&);

}  // namespace tushar::mpm::solid
