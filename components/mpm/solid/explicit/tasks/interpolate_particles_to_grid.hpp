#pragma once

#include <Eigen/LU>

#include <bit>
#include <cstdint>

#include "components/mpm/solid/explicit/keeps.hpp"
#include "components/mpm/solid/transfer/boundary.hpp"
#include "components/mpm/solid/transfer/cell_run.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/mirror_images.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"
#include "components/mpm/solid/transfer/stress_source.hpp"

namespace tushar::mpm::solid {

/// Views of mass and momentum of the particles within reach of shape functions.
template <int D>
struct MomentumSources {
  ParticleView<const Vec<D>> x;
  Sizes<D> size;
  ParticleView<const double> mass;
  ParticleView<const Vec<D>> velocity;
  OptionalView<const Matrix3> deformation;  ///< F, if shape functions or stresses depend on it

  /// `velocity` and `deformation` are the accesses to the variables of these names.
  static MomentumSources from(auto& take, int reach, KeptSizes keepsSizes, auto velocity, auto deformation) {
    return {.x = take(requiresOld(p::x<D>, reach)),
            .size = Sizes<D>::from(take, keepsSizes, reach),
            .mass = take(requiresOld(p::mass, reach)),
            .velocity = take(velocity),
            .deformation = take(deformation)};
  }
};

/// Views of the variables, in addition to F, that determine the forces of particles.
template <int D>
struct ForceSources {
  OptionalView<const double> volume;
  OptionalView<const Matrix3> stress;  ///< stress, if it is not a function of F alone
  OptionalView<const double> viscosity;
  OptionalView<const Vec<D>> externalForce;

  /// `stressed` reads variables that depend on the stress: at the start of the step, or as computed in the step.
  static ForceSources from(auto& take, int reach, const Keeps& keeps, auto stressed) {
    return {.volume = take(when(keeps.stress, stressed(p::volume, reach))),
            .stress = take(when(keeps.stress, stressed(p::stress, reach))),
            .viscosity = take(when(keeps.viscosity, stressed(p::viscosity, reach))),
            .externalForce = take(when(keeps.externalForce, requiresNew(p::externalForce<D>, reach)))};
  }
};

/// Scatters the particles of a material to their nodes; `forces` is null if only mass and momentum are needed. It
/// stores pointers instead of views, because its loops run in every step.
template <class Shape>
class Scatter {
 public:
  static constexpr int D = Shape::dimension;

  Scatter(const Level& level, const Material& material, const Vec3& commonSize, const MomentumSources<D>& from,
          const ForceSources<D>* forces, const NodeView<NodeRecord>& record)
      : level_(level),
        material_(material),
        extents_(level, commonSize, from.size, from.deformation),
        x_(valuesOf(from.x)),
        velocity_(valuesOf(from.velocity)),
        mass_(valuesOf(from.mass)),
        stresses_{.deformation = valuesOf(from.deformation)},
        record_(record) {
    if (!forces) return;
    stresses_.stress = valuesOf(forces->stress);
    stresses_.volume = valuesOf(forces->volume);
    viscosity_ = valuesOf(forces->viscosity);
    external_force_ = valuesOf(forces->externalForce);
    has_stress_ = !material.isRigid;
  }

  /// Adds the particles of cells of the patch. `moments` is work memory: one matrix per particle.
  void addCells(const CellRun<D>& cells, std::vector<Matrix3>& moments) const {
    moments.resize(std::max(moments.size(), static_cast<std::size_t>(cells.count())));
    cells.forEachGroup([&](int k, int count) { forceMoments(cells.first() + k, count, moments.data() + k); });
    cells.forEachCell([&](const Index<D>& cell, const data::ParticleRange& range) {
      addParticles<false>(cell, range.first, range.size(), moments.data() + (range.first - cells.first()));
    });
  }
  /// Adds those particles of a ghost cell that contribute to the patch's own nodes. In each group of particles, the
  /// stresses of all particles from the first to the last of these are computed, because several cost as much as one.
  void addGhostCell(const Index<D>& cell, const data::ParticleRange& range) const {
    if (hasOwnNode(cell)) {
      for (int at = range.first; at < range.last; at += stressGroup)
        addTouching(cell, at, std::min(stressGroup, range.last - at), ~Touching{0});
      return;
    }
    const CellFrame<D> frame(level_, cell);
    for (int first = range.first; first < range.last; first += stressGroup) {
      Touching touching = 0;  // a bit for each of the group
      for (int k = 0; k < std::min(stressGroup, range.last - first); ++k)
        touching |= Touching{touchesOwn(frame, cell, first + k)} << k;
      const int left = std::countr_zero(touching);
      if (touching != 0) addTouching(cell, first + left, std::bit_width(touching) - left, touching >> left);
    }
  }
  /// Adds, to the view's nodes, the mirror images of the particles of a cell beyond symmetry planes. Each patch adds
  /// them to its nodes one by one, in the order of the cells, so that their sums are equal on all patches.
  void addImages(const SymmetryPlanes<D>& planes, const Index<D>& cell, const data::ParticleRange& range) const {
    const CellFrame<D> frame(level_, cell);
    for (const int p : range) {
      const Extent<D> extent = extents_[p];
      if (!planes.mayBeTouched(cornerOf(cell) + frame.coordinates(x_[p]), Shape::support(extent))) continue;
      const typename Shape::Stencil stencil(frame, cell, x_[p], extent);
      std::optional<Share> share;
      stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
        planes.ifBeyond(node, [&](const Index<D>& image, const Vec<D>& signs) {
          if (s == 0 || !record_.box().contains(image)) return;
          if (!share) share = shareOf(p);
          Quad high = s * share->value.high + hoopOf(stencil, node) * share->hoop;
          for (int d = 0; d < D; ++d) high += gradient[d] * share->slope[static_cast<std::size_t>(d)];
          const Quad sign = quadOf<D>(signs, 1);
          NodeRecord& record = record_[image];
          record.low += sign * (s * share->value.low);
          record.high += sign * high;
        });
      });
    }
  }

 private:
  using Touching = std::uint64_t;
  static_assert(stressGroup <= 64);

  static Vec<D> cornerOf(const Index<D>& cell) {
    Vec<D> corner;
    for (int d = 0; d < D; ++d) corner[d] = cell[d];
    return corner;
  }
  /// Whether a cell has a node in the box of the view.
  bool hasOwnNode(const Index<D>& cell) const {
    const Box& nodes = record_.box();
    bool has = true;
    for (int d = 0; d < D; ++d) has &= (cell[d] + 1 >= nodes.lower[d]) & (cell[d] < nodes.upper[d]);
    return has;
  }
  /// Whether a particle contributes, or almost contributes, to a node in the box of the view.
  bool touchesOwn(const CellFrame<D>& frame, const Index<D>& cell, int p) const {
    constexpr double rounding = 1e-6;
    const Box& nodes = record_.box();
    const Vec<D> xi = frame.coordinates(x_[p]), support = Shape::support(extents_[p]);
    for (int d = 0; d < D; ++d) {
      const double at = cell[d] + xi[d], reach = support[d] + rounding;
      if (at + reach <= nodes.lower[d] || at - reach >= nodes.upper[d] - 1) return false;
    }
    return true;
  }
  /// V (sigma - q I) of up to stressGroup particles starting with `first` [N m]; 0 without stress.
  void forceMoments(int first, int count, Matrix3* moments) const {
    if (!has_stress_) {
      std::fill_n(moments, count, Matrix3(Matrix3::Zero()));
      return;
    }
    const double density = material_.undeformedDensity(), inverseDensity = 1 / density;
    const auto startVolume = [&](int p) { return mass_[p] * inverseDensity; };
    stressMoments(material_, stresses_, first, count, startVolume, moments);
    if (!viscosity_) return;
    for (int k = 0; k < count; ++k) {
      const int p = first + k;
      const double volume =
          stresses_.volume ? stresses_.volume[p] : mass_[p] / density * stresses_.deformation[p].determinant();
      moments[k].diagonal().array() -= volume * viscosity_[p];
    }
  }
  /// Adds up to stressGroup particles of a ghost cell: those whose bit in `touching` is set.
  void addTouching(const Index<D>& cell, int first, int count, Touching touching) const {
    std::array<Matrix3, stressGroup> moments;
    forceMoments(first, count, moments.data());
    addParticles<true>(cell, first, count, moments.data(), touching);
  }
  /// Adds particles of a cell to the surrounding nodes: m v and m with S_i, -V sigma with its gradient. If `isWithin`,
  /// adds only particles whose bit in `touching` is set, and only to nodes in the view's box.
  template <bool isWithin>
  void addParticles(const Index<D>& cell, int first, int count, const Matrix3* moments, Touching touching = 0) const {
    prefetch(x_, first + count, count);
    prefetch(velocity_, first + count, count);
    prefetch(mass_, first + count, count);
    if (stresses_.deformation) prefetch(stresses_.deformation, first + stressGroup, count);
    const CellFrame<D> frame(level_, cell);
    if constexpr (!isWithin && sharesNodes<Shape>) return addTogether(frame, cell, first, count, moments);
    forEachStencilOf(frame, cell, x_, extents_, first, count, [&](int k, const auto& stencil) {
      if constexpr (isWithin)
        if ((touching >> k & 1) == 0) return;
      const Share share = shareOf(first + k, moments[k]);
      if constexpr (isWithin)
        scatterWithin(stencil, record_.box(), windowFrom(record_, stencil.first), share.value, share.slope, share.hoop);
      else
        scatter(stencil, windowOf<NodeRecord>(record_, stencil), share.value, share.slope, share.hoop);
    });
  }
  /// Adds particles that contribute only to the nodes of their cell; the records of these nodes are kept in registers.
  void addTogether(const CellFrame<D>& frame, const Index<D>& cell, int first, int count, const Matrix3* moments) const
      requires(sharesNodes<Shape>) {
    CellRecords<D> records(windowFrom(record_, cell));
    forEachStencilOf(frame, cell, x_, extents_, first, count, [&](int k, const auto& stencil) {
      const Share share = shareOf(first + k, moments[k]);
      records.add(stencil, share.value, share.slope, share.hoop);
    });
    records.store();
  }
  /// The contribution of a particle to a node: m v, m and its force, weighted by S_i; and -V sigma, weighted by the
  /// gradient of S_i and by S_i / r.
  struct Share {
    NodeRecord value;
    std::array<Quad, D> slope;
    Quad hoop;
  };
  Share shareOf(int p) const {
    Matrix3 moment;
    forceMoments(p, 1, &moment);
    return shareOf(p, moment);
  }
  [[gnu::always_inline]] Share shareOf(int p, const Matrix3& moment) const {
    const Vec<D> force = external_force_ ? external_force_[p] : Vec<D>(Vec<D>::Zero());
    return {.value = NodeRecord{quadOf<D>(mass_[p] * velocity_[p], mass_[p]),
                                quadOf<D>(force, stresses_.volume ? stresses_.volume[p] : 0.0)},
            .slope = slopes(moment),
            .hoop = Quad{-moment(2, 2), 0, 0, 0}};
  }
  /// The columns of -V sigma along the kernel axes.
  [[gnu::always_inline]] std::array<Quad, D> slopes(const Matrix3& moment) const {
    std::array<Quad, D> slope;
    for (int d = 0; d < D; ++d) {
      Vec<D> traction;
      for (int i = 0; i < D; ++i) traction[i] = -moment(sceneAxis<D>(level_, i), sceneAxis<D>(level_, d));
      slope[d] = quadOf<D>(traction, 0);
    }
    return slope;
  }

  const Level& level_;
  const Material& material_;
  Extents<Shape> extents_;
  const Vec<D>*x_, *velocity_;
  const double* mass_;
  StressSource stresses_;
  const double* viscosity_ = nullptr;       ///< artificial viscosity; null if there is none
  const Vec<D>* external_force_ = nullptr;  ///< external forces; null if there are none
  bool has_stress_ = false;
  const NodeView<NodeRecord>& record_;
};

/// The cells whose particles contribute to the nodes of a box: those at the nodes, and `ghostNodes` layers around them.
template <int D>
Box cellsThatTouch(Box nodes, int ghostNodes) {
  for (int d = 0; d < D; ++d) {
    nodes.lower[d] -= 1 + ghostNodes;
    nodes.upper[d] += ghostNodes;
  }
  return nodes;
}

/// Computes velocities, masses and forces on the patch's own nodes. They are complete on nodes that particles touch; on
/// other nodes they are 0 if `clearsAll`, otherwise undefined.
template <class Shape, int D = Shape::dimension>
void scatterParticles(const Patch& patch, const Material& material, bool clearsAll, ParticleView<const Vec<D>> x,
                      const Scatter<Shape>& scatter, NodeView<NodeRecord> record) {
  const data::TouchedRows& rows = touchedRows<D>(x, Shape::ghostNodes);
  if (clearsAll)
    record.fill(NodeRecord{});
  else
    rows.forEachRow(record.box(), [&](const Index3& first, int end) {
      std::fill_n(record.values() + record.stored().offset(first), end - first[0], NodeRecord{});
    });
  const Box near = cellsThatTouch<D>(record.box(), Shape::ghostNodes).intersect(x.cells());
  CellRun<D> own;
  std::vector<Matrix3> moments;
  const auto addOwn = [&] {
    if (own.count() > 0) scatter.addCells(own, moments);
    own.clear();
  };
  x.template forEachOccupied<D>(near, [&](const Index<D>& cell, const data::ParticleRange& range) {
    const bool isOwn = patch.cells().contains(cell);
    if (!isOwn || !own.takes(range)) addOwn();
    if (isOwn)
      own.add(cell, range);
    else
      scatter.addGhostCell(cell, range);
  });
  addOwn();
  if constexpr (!sharesNodes<Shape>)
    if (const SymmetryPlanes<D> planes(patch.level(), material); planes.any())
      x.template forEachOccupied<D>(near, [&](const Index<D>& cell, const data::ParticleRange& range) {
        if (planes.mayBeNear(cell, Shape::ghostNodes)) scatter.addImages(planes, cell, range);
      });
  rows.forEachRow(record.box(), [&](const Index3& first, int end) {
    NodeRecord* node = record.values() + record.stored().offset(first);
    for (int k = first[0]; k < end; ++k, ++node)
      if ((*node)[lane::mass] > 0)
        setLanes<D>(*node, lane::velocity, lanes<D>(*node, lane::velocity) / (*node)[lane::mass]);
  });
  if (!material.transmitsForce) setSymmetry<D>(patch, material.index, rows, record);  // sides act only on these
}

/// Computes m_i = sum_p S_i m_p, v_i = sum_p S_i m_p v_p / m_i, f_i = sum_p S_i f_p - V_p (sigma_p - q_p I) grad S_i;
/// in axisymmetric scenes, the hoop stress pulls inwards with S_i / r. The values are complete on those of the patch's
/// own nodes that particles touch; on other nodes they are 0 if `clearsAll`, otherwise undefined.
template <class Shape, int D = Shape::dimension>
void interpolateParticlesToGrid(const Patch& patch, const Material& material, const Vec3& commonSize, bool clearsAll,
                                const MomentumSources<D>& from, const ForceSources<D>& forces,
                                NodeView<NodeRecord> record) {
  const Scatter<Shape> scatter(patch.level(), material, commonSize, from, &forces, record);
  scatterParticles<Shape>(patch, material, clearsAll, from.x, scatter, record);
}

/// Computes m_i = sum_p S_i m_p,   v_i = sum_p S_i m_p v_p / m_i for any velocity of particles; no forces. The values
/// are defined where interpolateParticlesToGrid defines them.
template <class Shape, int D = Shape::dimension>
void interpolateMomentum(const Patch& patch, const Material& material, const Vec3& commonSize, bool clearsAll,
                         const MomentumSources<D>& from, NodeView<NodeRecord> record) {
  const Scatter<Shape> scatter(patch.level(), material, commonSize, from, nullptr, record);
  scatterParticles<Shape>(patch, material, clearsAll, from.x, scatter, record);
}

}  // namespace tushar::mpm::solid
