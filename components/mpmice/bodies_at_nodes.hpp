#pragma once

#include "components/mpm/solid/transfer/node_record.hpp"
#include "components/mpmice/box_images.hpp"
#include "components/mpmice/labels.hpp"
#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// Views of one body at the start of a step: its masses and velocities at nodes and, if there are several bodies, what
/// it leaves free of cells and covers of their lower faces.
template <int D>
struct BodyAtFaces {
  NodeView<const mpm::solid::NodeRecord> records;
  std::optional<CellView<const double>> free = {};
  std::optional<CellView<const Vec<D>>> coverage = {}, coverageAtEnd = {};

  /// For `endsAtPlane`, see Settings.
  static BodyAtFaces from(auto& take, int ghost, bool isOneOfSeveral, bool endsAtPlane) {
    return {.records = take(requiresNew(g::record, ghost)),
            .free = take(when(isOneOfSeveral, requiresNew(c::freeOfBody, ghost))),
            .coverage = take(when(isOneOfSeveral, requiresNew(c::coverageOfBody<D>, ghost))),
            .coverageAtEnd = take(when(isOneOfSeveral && endsAtPlane, requiresNew(c::coverageOfBodyAtEnd<D>, ghost)))};
  }
};

/// Velocities and masses of all solids at nodes, for use at faces. A face distributes forces over the nodes of the
/// cells on both sides of it. Velocity, force and work have the same weights, so the losses of the gas equal the gains
/// of the nodes.
///
/// Bodies have parts in a face by what they cover of it; if none covers it, by what they fill of the cells on both
/// sides, and else by mass. Nodes have parts in their body by mass. So a heavy body that is near a wall of another one,
/// but not in it, does not move the wall.
///
/// A node on a side of the grid that the face meets has only half of the mass that it would have inside, and belongs to
/// half as many faces. So its mass counts twice there, and a plane wall moves as one. So does the mass of a node on a
/// symmetry plane in front of which the face is, at a distance of a cell: half of it is beyond the plane. A face on a
/// symmetry plane belongs to twice the mass, half of it beyond, and does not move along its axis: it pushes no node
/// along this axis, because the gas beyond does the opposite.
template <int D>
class BodiesAtNodes {
 public:
  using Records = std::vector<BodyAtFaces<D>>;

  BodiesAtNodes(const Level& level, const Records& records) : level_(&level), records_(&records) {
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) is_mirror_[d][side] = isPlane(level, d, side);
  }

  /// The nodes on the grid that belong to the cells on both sides of a cell's lower face along an axis.
  Box nodesAt(const Index<D>& cell, int axis) const {
    Box nodes{{}, Index3::filled(1)};
    for (int d = 0; d < D; ++d) {
      nodes.lower[d] = d == axis ? cell[d] - 1 : cell[d];
      nodes.upper[d] = cell[d] + 2;
    }
    if (level_->isPeriodic(axis)) return nodes;
    nodes.lower[axis] = std::max(nodes.lower[axis], level_->cells().lower[axis]);
    nodes.upper[axis] = std::min(nodes.upper[axis], level_->cells().upper[axis] + 1);
    return nodes;
  }
  /// Whether a cell's lower face along an axis is on a symmetry plane; the cell may be just beyond the grid.
  bool isOnPlane(const Index<D>& cell, int axis) const {
    const Box& grid = level_->cells();
    return (is_mirror_[axis][0] && cell[axis] == grid.lower[axis]) ||
           (is_mirror_[axis][1] && cell[axis] == grid.upper[axis]);
  }
  /// The mass that a force at the face accelerates [kg], that is, the force divided by the acceleration of velocityAt;
  /// 0 without mass. With one body, and away from sides of the grid, it is the mass at the nodes of nodesAt.
  double massAt(const Index<D>& cell, int axis) const {
    const double both = isOnPlane(cell, axis) ? 2 : 1;
    if (records_->size() == 1) return both * sumAt(cell, axis, 0, mpm::solid::lane::velocity).inertia();
    double whole = 0, perMass = 0;
    forEachBody(cell, axis, mpm::solid::lane::velocity, [&](std::size_t, double part, const Content& of) {
      whole += part;
      perMass += part * (part / of.inertia());
    });
    return whole > 0 ? both * whole * (whole / perMass) : 0;
  }
  /// Mean velocity of the solids at the nodes of nodesAt [m/s]; 0 without mass. `lane` selects the velocity before or
  /// after the step in the records.
  Vec<D> velocityAt(const Index<D>& cell, int axis, int lane) const {
    Vec<D> mean = meanVelocityAt(cell, axis, lane);
    if (isOnPlane(cell, axis)) mean[axis] = 0;
    return mean;
  }
  /// The component of velocityAt along the axis of the face before and after the step [m/s].
  struct Speeds {
    double before = 0, after = 0;
  };
  Speeds speedsAt(const Index<D>& cell, int axis) const {
    if (isOnPlane(cell, axis)) return {};
    if (records_->size() > 1)
      return {velocityAt(cell, axis, mpm::solid::lane::before)[axis],
              velocityAt(cell, axis, mpm::solid::lane::velocity)[axis]};
    double mass = 0;
    Speeds sum;
    forEachAt(cell, axis, 0, [&](const Index<D>&, const mpm::solid::NodeRecord& record, double m, double) {
      mass += m;
      sum.before += m * numberIn(record, mpm::solid::lane::before + axis);
      sum.after += m * numberIn(record, mpm::solid::lane::velocity + axis);
    });
    if (mass > 0) sum = {sum.before / mass, sum.after / mass};
    return sum;
  }
  /// The mean of a number of each body over their parts in the face; 0 without mass.
  double meanAt(const Index<D>& cell, int axis, const std::vector<double>& ofBodies) const {
    if (records_->size() == 1) return ofBodies.front();
    double whole = 0, sum = 0;
    forEachBody(cell, axis, mpm::solid::lane::velocity, [&](std::size_t body, double part, const Content&) {
      whole += part;
      sum += part * ofBodies[body];
    });
    return whole > 0 ? sum / whole : 0;
  }
  /// Calls `visit(body, node, share)` for each part of a force at the face; the shares add up to 1.
  template <class Visit>
  void distribute(const Index<D>& cell, int axis, Visit&& visit) const {
    double whole = 0;
    constexpr int lane = mpm::solid::lane::velocity;
    if (records_->size() == 1) {
      const double mass = sumAt(cell, axis, 0, lane).mass;
      forEachAt(cell, axis, 0, [&](const Index<D>& node, const mpm::solid::NodeRecord&, double m, double) {
        visit(std::size_t{0}, node, m / mass);
      });
      return;
    }
    forEachBody(cell, axis, lane, [&](std::size_t, double part, const Content&) { whole += part; });
    forEachBody(cell, axis, lane, [&](std::size_t body, double part, const Content& of) {
      forEachAt(cell, axis, body, [&](const Index<D>& node, const mpm::solid::NodeRecord&, double m, double) {
        visit(body, node, m / of.mass * (part / whole));
      });
    });
  }

  /// The sum of what several bodies cover of a face, which is more than 1 where they overlap; 0 for one body.
  double coverageAt(const Index<D>& cell, int axis) const {
    double sum = 0;
    for (std::size_t k = 0; k < records_->size(); ++k) sum += coverageBy(k, cell, axis);
    return sum;
  }

 private:
  Vec<D> meanVelocityAt(const Index<D>& cell, int axis, int lane) const {
    if (records_->size() == 1) return sumAt(cell, axis, 0, lane).velocity();
    double whole = 0;
    Vec<D> sum = Vec<D>::Zero();
    forEachBody(cell, axis, lane, [&](std::size_t, double part, const Content& of) {
      whole += part;
      sum += part * of.velocity();
    });
    return whole > 0 ? Vec<D>(sum / whole) : sum;
  }
  /// One lane of a record in memory. The operator of a record that cannot change is for records in registers.
  static double numberIn(const mpm::solid::NodeRecord& record, int lane) {
    return reinterpret_cast<const double*>(&record)[lane];
  }
  struct Multiplicity {
    double all = 1, withoutPlanes = 1;
  };
  /// How many times the mass of a node counts at the lower face of a cell: twice for each axis along the face at whose
  /// ends the node is, and twice if the face is in front of a symmetry plane on which the node is; and how many times
  /// without what is beyond symmetry planes.
  Multiplicity multiplicity(const Index<D>& cell, int axis, const Index<D>& node) const {
    const Box& grid = level_->cells();
    Multiplicity times;
    for (int d = 0; d < D; ++d) {
      const bool isLower = node[d] == grid.lower[d], isUpper = node[d] == grid.upper[d];
      const bool isMirrored = (isLower && is_mirror_[d][0]) || (isUpper && is_mirror_[d][1]);
      if (!(d == axis ? isMirrored && cell[d] != node[d] : !level_->isPeriodic(d) && (isLower || isUpper))) continue;
      times.all *= 2;
      if (!isMirrored) times.withoutPlanes *= 2;
    }
    return times;
  }
  /// Whether the nodes of a face may have a multiplicity other than 1.
  bool meetsSide(const Index<D>& cell) const {
    bool meets = false;
    for (int d = 0; d < D; ++d)
      meets |= !level_->isPeriodic(d) &&
               (cell[d] <= level_->cells().lower[d] + 1 || cell[d] >= level_->cells().upper[d] - 1);
    return meets;
  }
  /// Calls `visit(node, record, mass, multiplicity)` for the nodes of a body that have mass, which is multiplied by the
  /// whole multiplicity; `multiplicity` is that without planes.
  template <class Visit>
  void forEachAt(const Index<D>& cell, int axis, std::size_t body, Visit&& visit) const {
    const auto& records = (*records_)[body].records;
    const bool meets = meetsSide(cell);
    forEachRow<D>(nodesAt(cell, axis), [&](Index<D> node, int count) {
      const mpm::solid::NodeRecord* record = &records[node];
      for (int i = 0; i < count; ++i, ++node[0], ++record) {
        const double m = numberIn(*record, mpm::solid::lane::mass);
        if (!(m > 0)) continue;
        const Multiplicity times = meets ? multiplicity(cell, axis, node) : Multiplicity{};
        visit(node, *record, times.all * m, times.withoutPlanes);
      }
    });
  }
  /// Mass [kg] and momentum of a body at the nodes of a face.
  struct Content {
    double mass = 0;
    double timesMass = 0;  ///< the sum of the masses times their multiplicities without planes
    Vec<D> momentum = Vec<D>::Zero();

    Vec<D> velocity() const { return mass > 0 ? Vec<D>(momentum / mass) : momentum; }
    /// The force on this body divided by the acceleration of its velocity [kg]. Beyond symmetry planes, an equal force
    /// acts, but at another face.
    double inertia() const { return mass > 0 ? mass * (mass / timesMass) : 0; }
  };
  Content sumAt(const Index<D>& cell, int axis, std::size_t body, int lane) const {
    Content sum;
    forEachAt(cell, axis, body, [&](const Index<D>&, const mpm::solid::NodeRecord& record, double m, double times) {
      sum.mass += m;
      sum.timesMass += times * m;
      for (int d = 0; d < D; ++d) sum.momentum[d] += m * numberIn(record, lane + d);
    });
    return sum;
  }
  /// How the parts of bodies in a face are measured.
  enum class By { coverage, volume, mass };

  /// Calls `visit(body, part, content)` for the bodies that have a part in a face and mass at its nodes.
  template <class Visit>
  void forEachBody(const Index<D>& cell, int axis, int lane, Visit&& visit) const {
    std::array<Content, kFewBodies> few{};
    std::vector<Content> many(records_->size() > kFewBodies ? records_->size() : 0);
    Content* contents = many.empty() ? few.data() : many.data();
    By by = By::mass;
    for (std::size_t k = 0; k < records_->size(); ++k) {
      contents[k] = sumAt(cell, axis, k, lane);
      if (!(contents[k].mass > 0)) continue;
      if (coverageBy(k, cell, axis) > offRoundShares) by = By::coverage;
      if (by == By::mass && volumeOf(k, cell, axis) > offRoundShares) by = By::volume;
    }
    for (std::size_t k = 0; k < records_->size(); ++k) {
      const double mass = contents[k].mass;
      if (!(mass > 0)) continue;
      const double part = by == By::coverage ? coverageBy(k, cell, axis)
                          : by == By::volume ? volumeOf(k, cell, axis)
                                             : mass;
      if (part > 0) visit(k, part, contents[k]);
    }
  }
  /// The fraction of a face that one of several bodies covers; 0 if it is alone.
  double coverageBy(std::size_t body, const Index<D>& cell, int axis) const {
    const BodyAtFaces<D>& of = (*records_)[body];
    if (of.coverageAtEnd && cell[axis] == level_->cells().upper[axis] && is_mirror_[axis][1])
      return std::min(1.0, (*of.coverageAtEnd)[cell - Index<D>::unit(axis)][axis]);
    return of.coverage && of.coverage->box().contains(cell) ? std::min(1.0, (*of.coverage)[cell][axis]) : 0;
  }
  /// What one of several bodies fills of the cells on both sides of a face; 0 if it is alone.
  double volumeOf(std::size_t body, const Index<D>& cell, int axis) const {
    const auto& free = (*records_)[body].free;
    const auto filled = [&](const Index<D>& at) { return free && free->box().contains(at) ? 1 - (*free)[at] : 0.0; };
    return filled(cell) + filled(cell - Index<D>::unit(axis));
  }

  static constexpr std::size_t kFewBodies = 4;

  const Level* level_;
  const Records* records_;
  std::array<std::array<bool, 2>, D> is_mirror_{};  ///< whether the sides are symmetry planes
};

}  // namespace tushar::mpmice
