#include "components/mpm/solid/contact/friction.hpp"

#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

namespace {

/// All bodies that take part, seen from a node.
template <int D>
struct Gathering {
  Vec<D> momentum = Vec<D>::Zero(), position = Vec<D>::Zero(), massGradient = Vec<D>::Zero();
  double mass = 0;
};

template <int D>
Gathering<D> gatherBodies(const Contact& contact, const Records& records, const Surfaces<D>& surfaces,
                          const Index<D>& node) {
  Gathering<D> all;
  for (std::size_t m = 0; m < records.size(); ++m) {
    if (!contact.concerns(static_cast<int>(m))) continue;
    const Octet& record = records[m][node];
    all.momentum += record[lane::mass] * lanes<D>(record, lane::velocity);
    all.position += surfaces.position[m][node];
    all.massGradient += surfaces.massGradient[m][node];
    all.mass += record[lane::mass];
  }
  return all;
}

/// Whether the surface's stress pushes along its normal.
template <int D>
bool isPressed(const Level& level, const Matrix3& stress, const Vec<D>& normal) {
  double traction = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) traction += normal[i] * stress(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) * normal[j];
  return traction < 0;
}

/// How far the others' mass lies from the body's at a node, m.
template <int D>
double separation(const Gathering<D>& all, const Vec<D>& position, double mass) {
  const double others = all.mass - mass;
  return ((all.position - position) / others - position / mass).norm();
}

/// The greatest strain that a change of velocity makes in a step, over all bodies at the node, brought down to 1/2.
template <int D>
Vec<D> limited(const Level& level, const Vec<D>& change, double dt, double massRatio) {
  double strain = 0;
  for (int d = 0; d < D; ++d) strain = std::max(strain, std::abs(change[d]) * dt * level.inverseSpacing(d));
  strain *= std::max(1.0, massRatio);
  return strain > 0.5 ? Vec<D>(change * (0.5 / strain)) : change;
}

}  // namespace

template <int D>
void rub(const Patch& patch, const Contact& contact, double dt, const Records& records, const Surfaces<D>& surfaces) {
  const Level& level = patch.level();
  const double reach = contact.separationFactor * std::cbrt(level.cellVolume());
  forEach<D>(records.front().box(), [&](const Index<D>& node) {
    const Gathering<D> all = gatherBodies<D>(contact, records, surfaces, node);
    if (all.mass == 0) return;
    for (std::size_t m = 0; m < records.size(); ++m) {
      Octet& record = records[m][node];
      const double mass = record[lane::mass];
      // As in Uintah, what is left of a body after rounding does not count as one.
      if (!contact.concerns(static_cast<int>(m)) || mass < 1e-14 * all.mass || all.mass - mass < 1e-14 * all.mass) continue;
      const BodySurface<D> surface = surfaces.at(m, node);
      // One normal for both sides: that of the body alone would catch on the corners of others.
      const Vec<D> inwards = 2 * surface.massGradient - all.massGradient;
      const double steepness = inwards.norm();
      if (steepness == 0 || separation<D>(all, surface.position, mass) > reach) continue;
      const Vec<D> v = lanes<D>(record, lane::velocity), normal = -inwards / steepness;
      const Touch<D> touch{normal, v - all.momentum / all.mass, isPressed<D>(level, surface.stress, normal)};
      const Vec<D> change = frictionChange(touch, contact.friction);
      setLanes<D>(record, lane::velocity, v + limited<D>(level, change, dt, mass / (all.mass - mass)));
    }
  });
}

template void rub<1>(const Patch&, const Contact&, double, const Records&, const Surfaces<1>&);
template void rub<2>(const Patch&, const Contact&, double, const Records&, const Surfaces<2>&);
template void rub<3>(const Patch&, const Contact&, double, const Records&, const Surfaces<3>&);

}  // namespace tushar::mpm::solid
