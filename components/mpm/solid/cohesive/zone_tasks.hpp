#pragma once

#include <algorithm>
#include <vector>

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/solid/cohesive/zone_labels.hpp"
#include "components/mpm/solid/cohesive/zones.hpp"
#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

// A zone acts between the two bodies at the nodes k of its cell. With the multilinear S_k at the zone and the masses
// m_k of a body, its mirror images beyond symmetry planes included, the body has the weights w_k = S_k m_k / sum_j S_j
// m_j. Its velocity at the zone is sum_k w_k v_k, and its share of the zone's force F at a node is w_k F. So
// - both bodies receive the same force, up to the sign;
// - no node gets a larger acceleration than F / sum_j S_j m_j, however little mass it has;
// - the power of the force at the nodes is exactly that of F at the jump of the velocity: what the zone takes, its
//   bodies lose.
// The force of a step is that of the separation at its start, and the separation follows v* at its end.

/// The values of new zones, one list for each variable.
template <int D>
struct NewZones {
  std::vector<Vec<D>>&x, &normal, &top, &bottom, &separation, &force;
  std::vector<double>&area, &work;
  std::vector<int>&bottomMaterial, &topMaterial, &failed, &mode;

  static NewZones from(auto& take) {
    return {.x = take(creates(p::x<D>)),
            .normal = take(creates(p::czNorm<D>)),
            .top = take(creates(p::czDispTop<D>)),
            .bottom = take(creates(p::czDispBottom<D>)),
            .separation = take(creates(p::czSeparation<D>)),
            .force = take(creates(p::czForce<D>)),
            .area = take(creates(p::czArea)),
            .work = take(creates(p::czWork)),
            .bottomMaterial = take(creates(p::czBotMat)),
            .topMaterial = take(creates(p::czTopMat)),
            .failed = take(creates(p::czFailed)),
            .mode = take(creates(p::czMode))};
  }

  void add(const Level& level, const CohesiveZone& zone) const {
    x.push_back(level.reduce<D>(zone.position));
    normal.push_back(level.reduce<D>(zone.normal));
    for (std::vector<Vec<D>>* zero : {&top, &bottom, &separation, &force}) zero->push_back(Vec<D>::Zero());
    area.push_back(zone.area);
    work.push_back(0);
    bottomMaterial.push_back(zone.bottom);
    topMaterial.push_back(zone.top);
    failed.push_back(0);
    mode.push_back(zoneMode::intact);
  }
};

/// Creates the zones on a patch. Their ids are their lines in the file.
template <int D>
void createZones(const Patch& patch, const CohesiveZones& set, ParticleMaker& maker, const NewZones<D>& columns) {
  const Level& level = patch.level();
  for (const CohesiveZone& zone : set.zones) {
    const Index<D> cell = level.cellOf<D>(level.reduce<D>(zone.position));
    if (!patch.cells().contains(cell)) continue;
    maker.add(cell, static_cast<ParticleId>(zone.line));
    columns.add(level, zone);
  }
}

/// Calls `visit(zone, nodes, weights)` for the zones in a box of cells, with the nodes of their cell and the S_k.
template <int D, class Visit>
void forEachZone(const Patch& patch, ParticleView<const Vec<D>> x, const Box& cells, Visit&& visit) {
  std::array<Index<D>, Linear<D>::nodes> nodes;
  x.template forEachOccupied<D>(cells, [&](const Index<D>& cell, const data::ParticleRange& range) {
    for (int k = 0; k < Linear<D>::nodes; ++k) nodes[static_cast<std::size_t>(k)] = Linear<D>::node(cell, k);
    const CellFrame<D> frame(patch.level(), cell);
    for (const int p : range) visit(p, nodes, Linear<D>::weights(frame.coordinates(x[p])));
  });
}

/// Records of the nodes of all bodies, by material.
using BodyRecords = std::vector<NodeView<const NodeRecord>>;

/// Returns the mass of a body at a node, including its mirror images beyond symmetry planes [kg]: twice that of the
/// record for each plane on which the node lies.
template <int D>
double massWithImages(const Level& level, int material, const Index<D>& node, const NodeRecord& record) {
  double mass = record[lane::mass];
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1})
      if (node[d] == (side == 0 ? level.cells().lower[d] : level.cells().upper[d]) &&
          level.isSymmetry(d, side, material))
        mass *= 2;
  return mass;
}

/// Computes the masses sum_k S_k m_k of both bodies at each zone.
template <int D>
void weighCohesiveZones(const Patch& patch, const CohesiveZones&, const BodyRecords& records,
                        ParticleView<const Vec<D>> x, ParticleView<const int> bottom, ParticleView<const int> top,
                        ParticleView<double> massBottom, ParticleView<double> massTop) {
  forEachZone<D>(patch, x, patch.cells(), [&](int p, const auto& nodes, const auto& weights) {
    const auto sum = [&](int material) {
      double mass = 0;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        mass += weights[k] * massWithImages<D>(patch.level(), material, nodes[k], records[material][nodes[k]]);
      return mass;
    };
    massBottom[p] = sum(bottom[p]);
    massTop[p] = sum(top[p]);
  });
}

/// Views of the zones of a tag, and of those of the neighbours, that act on the nodes of a patch.
template <int D>
struct ActingZones {
  ParticleView<const Vec<D>> x, force;
  ParticleView<const int> bottom, top;
  ParticleView<const double> massBottom, massTop;

  static ActingZones from(auto& take) {
    constexpr int reach = Linear<D>::reach;
    return {.x = take(requiresOld(p::x<D>, reach)),
            .force = take(requiresOld(p::czForce<D>, reach)),
            .bottom = take(requiresOld(p::czBotMat, reach)),
            .top = take(requiresOld(p::czTopMat, reach)),
            .massBottom = take(requiresNew(p::czMassBottom, reach)),
            .massTop = take(requiresNew(p::czMassTop, reach))};
  }
};

/// Adds the forces of the zones to those of the stresses. A zone near which one of its bodies has no mass exerts none.
template <int D>
void addCohesiveZoneForces(const Patch& patch, const std::vector<Material>&, const std::vector<ActingZones<D>>& sets,
                           const Records& records) {
  const auto add = [&](int material, const Index<D>& node, double share, const Vec<D>& force) {
    NodeRecord& record = records[material][node];
    const double mass = massWithImages<D>(patch.level(), material, node, record);
    const Vec<D> sum = lanes<D>(record, lane::force) + share * mass * force;
    setLanes<D>(record, lane::force, sum);
  };
  for (const ActingZones<D>& set : sets)
    forEachZone<D>(patch, set.x, set.x.cells(), [&](int p, const auto& nodes, const auto& weights) {
      if (!(set.massBottom[p] > 0 && set.massTop[p] > 0)) return;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (!records[set.bottom[p]].box().contains(nodes[k])) continue;
        add(set.bottom[p], nodes[k], weights[k] / set.massBottom[p], set.force[p]);
        add(set.top[p], nodes[k], -weights[k] / set.massTop[p], set.force[p]);
      }
    });
}

/// The velocities of both bodies at a zone.
template <int D>
struct ZoneVelocity {
  Vec<D> bottom = Vec<D>::Zero(), top = Vec<D>::Zero();
};

/// Views of what determines the velocities of both bodies at a zone.
template <int D>
struct ZonePlaces {
  ParticleView<const Vec<D>> x;
  ParticleView<const int> bottom, top;
  ParticleView<const double> massBottom, massTop;

  static ZonePlaces from(auto& take) {
    return {.x = take(requiresOld(p::x<D>)),
            .bottom = take(requiresOld(p::czBotMat)),
            .top = take(requiresOld(p::czTopMat)),
            .massBottom = take(requiresNew(p::czMassBottom)),
            .massTop = take(requiresNew(p::czMassTop))};
  }

  /// Calls `visit(zone, velocity)` for the zones of a patch; `velocityOf` computes the velocity of a node from its
  /// record. A body without mass near a zone moves like the other one.
  template <class VelocityOf, class Visit>
  void forEach(const Patch& patch, const BodyRecords& records, VelocityOf&& velocityOf, Visit&& visit) const {
    forEachZone<D>(patch, x, patch.cells(), [&](int p, const auto& nodes, const auto& weights) {
      const auto mean = [&](int material, double mass) {
        Vec<D> sum = Vec<D>::Zero();
        for (std::size_t k = 0; k < nodes.size(); ++k)
          if (const NodeRecord& record = records[material][nodes[k]]; record[lane::mass] > 0) {
            const double here = massWithImages<D>(patch.level(), material, nodes[k], record);
            sum += weights[k] * here / mass * velocityOf(record);
          }
        return sum;
      };
      ZoneVelocity<D> velocity;
      if (massBottom[p] > 0) velocity.bottom = mean(bottom[p], massBottom[p]);
      velocity.top = massTop[p] > 0 ? mean(top[p], massTop[p]) : velocity.bottom;
      if (!(massBottom[p] > 0)) velocity.bottom = velocity.top;
      visit(p, velocity);
    });
  }
};

/// Views of the state of zones.
template <int D>
struct ZoneState {
  ZonePlaces<D> places;
  ParticleView<const double> area;
  ParticleView<const Vec<D>> normal, oldTop, oldBottom, oldSeparation;
  ParticleView<const int> oldFailed, oldMode;
  ParticleView<Vec<D>> x, top, bottom, separation, force;
  ParticleView<int> failed, mode;

  static ZoneState from(auto& take) {
    return {.places = ZonePlaces<D>::from(take),
            .area = take(requiresOld(p::czArea)),
            .normal = take(requiresOld(p::czNorm<D>)),
            .oldTop = take(requiresOld(p::czDispTop<D>)),
            .oldBottom = take(requiresOld(p::czDispBottom<D>)),
            .oldSeparation = take(requiresOld(p::czSeparation<D>)),
            .oldFailed = take(requiresOld(p::czFailed)),
            .oldMode = take(requiresOld(p::czMode)),
            .x = take(computes(p::x<D>)),
            .top = take(computes(p::czDispTop<D>)),
            .bottom = take(computes(p::czDispBottom<D>)),
            .separation = take(computes(p::czSeparation<D>)),
            .force = take(computes(p::czForce<D>)),
            .failed = take(computes(p::czFailed)),
            .mode = take(computes(p::czMode))};
  }
};

/// A point moved back to a symmetry plane through which it has drifted.
template <int D>
Vec<D> insideSymmetryPlanes(const Level& level, Vec<D> x) {
  for (int d = 0; d < D; ++d) {
    const double first = level.nodePosition(d, 0), last = level.nodePosition(d, level.cells().upper[d]);
    if (level.isSymmetry(d, 0)) x[d] = std::max(x[d], first);
    if (level.isSymmetry(d, 1)) x[d] = std::min(x[d], last);
  }
  return x;
}

/// Updates whether and how a zone has failed. As in Uintah, a zone fails if a component of its separation exceeds a
/// limit in either direction, and then loses 1/1000 of its strength in each step in which the separation grows.
template <int D>
void updateFailure(const CohesiveLaw& law, const ZoneState<D>& u, int p, double normalJump, double tangentialJump) {
  u.failed[p] = u.oldFailed[p];
  u.mode[p] = u.oldMode[p];
  if (!(u.places.massBottom[p] > 0 && u.places.massTop[p] > 0)) {
    u.failed[p] = stepsOfFailure;
    if (u.mode[p] == zoneMode::intact) u.mode[p] = zoneMode::detached;
  } else if (u.failed[p] > 0) {
    const bool grows = u.separation[p].norm() >= u.oldSeparation[p].norm();
    u.failed[p] = std::min(u.failed[p] + grows, stepsOfFailure);
  } else {
    const bool opens = std::abs(normalJump) > law.normalFailureLength;
    const bool slides = tangentialJump > law.tangentialFailureLength;
    u.mode[p] = opens * zoneMode::opened + slides * zoneMode::sheared;
    u.failed[p] = opens || slides;
  }
}

/// Moves the zones with the mean velocity of both bodies, and computes their separation, failure and force at the end
/// of the step.
template <int D>
void updateCohesiveZones(const Patch& patch, const CohesiveZones& set, double dt, const BodyRecords& records,
                         const ZoneState<D>& u) {
  const auto velocityOf = [](const NodeRecord& record) { return lanes<D>(record, lane::velocity); };
  u.places.forEach(patch, records, velocityOf, [&](int p, const ZoneVelocity<D>& v) {
    u.x[p] = insideSymmetryPlanes<D>(patch.level(), u.places.x[p] + 0.5 * dt * (v.bottom + v.top));
    u.top[p] = u.oldTop[p] + dt * v.top;
    u.bottom[p] = u.oldBottom[p] + dt * v.bottom;
    u.separation[p] = u.top[p] - u.bottom[p];
    const double normalJump = u.separation[p].dot(u.normal[p]);
    const Vec<D> tangential = u.separation[p] - normalJump * u.normal[p];
    updateFailure<D>(set.law, u, p, normalJump, tangential.norm());
    const CohesiveLaw::Traction traction = set.law.at(normalJump, tangential.norm());
    const double left = 1 - u.failed[p] / static_cast<double>(stepsOfFailure);
    u.force[p] = left * u.area[p] * (traction.normal * u.normal[p] + traction.perTangentialJump * tangential);
  });
}

/// Adds the work of the bodies on the zones in a step. As for other forces, the velocity is (v + v*)/2.
template <int D>
void measureCohesiveWork(const Patch& patch, const CohesiveZones&, double dt, const BodyRecords& records,
                         const ZonePlaces<D>& places, ParticleView<const Vec<D>> force, ParticleView<const double> old,
                         ParticleView<double> work) {
  const auto velocityOf = [](const NodeRecord& record) -> Vec<D> {
    return 0.5 * (lanes<D>(record, lane::before) + lanes<D>(record, lane::velocity));
  };
  places.forEach(patch, records, velocityOf,
                 [&](int p, const ZoneVelocity<D>& v) { work[p] = old[p] + dt * force[p].dot(v.top - v.bottom); });
}

/// Computes the sum of p.czWork.
inline void sumCohesiveWork(const Patch&, const CohesiveZones&, ParticleView<const double> work, Sum& total) {
  WideSum(total).addAll(work.owned(), [&](int p) { return work[p]; });
}

}  // namespace tushar::mpm::solid
