#pragma once

#include "components/mpm/solid/explicit/tasks/meeting_nodes.hpp"
#include "components/mpm/solid/loads/load.hpp"
#include "components/mpm/solid/transfer/mirror_images.hpp"
#include "components/mpm/solid/transfer/placed.hpp"
#include "components/mpm/solid/transfer/stencil_groups.hpp"

// The planes that separate bodies at the nodes where several meet (see SeparatingPlane), as in Uintah.

namespace tushar::mpm::solid {

/// Particles with a smaller weight at a node are ignored there: those at the edge of its support, whose weight may be 0
/// or round-off.
inline constexpr double leastWeight = 1e-8;

/// Views of the variables of a material that separateBodies reads and writes.
template <int D>
struct PlaneSources {
  Placed<D> particles;
  OptionalView<const Vec<D>> size;  ///< initial edge lengths in cells, if shape functions do not read them
  ParticleView<const int> surface;
  NodeView<Vec<D>> normal;
  NodeView<double> prominence;

  /// `ofShape` are the sizes that shape functions need.
  static PlaneSources from(auto& take, const ShapeTraits& shape, KeptSizes ofShape, bool keepsSizes) {
    return {.particles = Placed<D>::from(take, shape, ofShape, shape.reach),
            .size = take(when(!shape.haveSizes && keepsSizes, requiresOld(p::size<D>, shape.reach))),
            .surface = take(requiresOld(p::surface, shape.reach)),
            .normal = take(computes(g::separatingNormal<D>)),
            .prominence = take(computes(g::prominence))};
  }
  /// Half the edges of particle p, one per column: column i is the vector [m] from the centre of the particle to the
  /// centre of the face that was initially above it along axis i.
  template <class Shape>
  Eigen::Matrix<double, D, D> halfEdges(const Level& level, const Vec3& commonSize, int p) const {
    Eigen::Matrix<double, D, D> half = Eigen::Matrix<double, D, D>::Zero();
    const auto& each = Shape::hasSize ? particles.size.each : size;
    const Vec<D> cells = each ? (*each)[p] : level.reduce<D>(commonSize);
    for (int d = 0; d < D; ++d) half(d, d) = 0.5 * cells[d] * level.spacing(d);
    if constexpr (Shape::deforms) {
      half = Extents<Shape>(level, commonSize, particles.size, particles.deformation)[p].halfEdges;
      for (int d = 0; d < D; ++d) half.row(d) *= level.spacing(d);
    }
    return half;
  }
};

/// Adds the particles of material m to the nodes at which they meet other materials.
template <class Shape, int D = Shape::dimension>
void gatherParticles(const Patch& patch, const Vec3& commonSize, const PlaneSources<D>& of, int m,
                     MeetingNodes<D>& nodes) {
  const auto& x = of.particles.x;
  forEachStencil<Shape>(patch, x.cells(), of.particles, commonSize, [&](int p, const auto& stencil) {
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) {
      const int k = nodes[node];
      if (k < 0 || s <= leastWeight) return;
      Vec<D> away;
      for (int d = 0; d < D; ++d) away[d] = x[p][d] - patch.level().nodePosition(d, node[d]);
      nodes.particles[k].push_back({away, m != nodes.leader[k]});
    });
  });
}

/// Computes the prominence of material m: the largest extent of its particles along the normal if the plane belongs to
/// it, otherwise the smallest.
template <class Shape, int D = Shape::dimension>
void measureProminence(const Patch& patch, const Vec3& commonSize, int m, const MeetingNodes<D>& nodes,
                       const std::vector<Vec<D>>& normals, const PlaneSources<D>& of) {
  of.prominence.fill(noProminence);
  const auto& x = of.particles.x;
  forEachStencil<Shape>(patch, x.cells(), of.particles, commonSize, [&](int p, const auto& stencil) {
    if (of.surface[p] == 0) return;
    const auto edges = of.template halfEdges<Shape>(patch.level(), commonSize, p);
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) {
      const int k = nodes[node];
      if (k < 0 || s <= leastWeight) return;
      const Vec<D>& normal = normals[k];
      const double middle = x[p].dot(normal), half = (edges.transpose() * normal).cwiseAbs().maxCoeff();
      double& reach = of.prominence[node];
      if (m == nodes.leader[k])
        reach = std::max(reach, middle + half);
      else
        reach = reach == noProminence ? middle - half : std::min(reach, middle - half);
    });
  });
}

/// Computes the planes that separate bodies, for contacts with friction along them.
template <class Shape, int D = Shape::dimension>
void separateBodies(const Patch& patch, const std::vector<Material>& materials, const std::vector<Contact>& contacts,
                    const Vec3& commonSize, const std::vector<NodeView<const NodeRecord>>& records,
                    const std::vector<PlaneSources<D>>& of) {
  const std::vector<std::size_t> present = presentIn(records);
  if (present.empty()) return;
  RowsOfNodes rows;
  for (const auto& material : of) rows.push_back(&touchedRows<D>(material.particles.x, Shape::ghostNodes));
  MeetingNodes<D> nodes(of[present.front()].normal.box(), materials, contacts, present, rows, records);
  for (const std::size_t m : present) {
    of[m].normal.fill(Vec<D>::Zero());
    gatherParticles<Shape>(patch, commonSize, of[m], static_cast<int>(m), nodes);
  }
  std::vector<Vec<D>> normals;
  for (std::size_t k = 0; k < nodes.node.size(); ++k) {
    normals.push_back(normalAt<D>(patch, nodes, k));
    of[nodes.leader[k]].normal[nodes.node[k]] = normals.back();
  }
  for (const std::size_t m : present)
    measureProminence<Shape>(patch, commonSize, static_cast<int>(m), nodes, normals, of[m]);
}

/// Computes the mass-weighted mean of p.color at the nodes of a patch; 0 without mass.
template <class Shape, int D = Shape::dimension>
void interpolateColor(const Patch& patch, const Material& material, const Vec3& commonSize, const Placed<D>& particles,
                      ParticleView<const double> mass, ParticleView<const double> color,
                      NodeView<const NodeRecord> record, NodeView<double> mean) {
  mean.fill(0.0);
  forEachStencilGroup<Shape>(
      patch, particles.x.cells(), particles, commonSize,
      [&]<class Stencils>(int p, int count, const Stencils& stencils) {
        const Lanes masses = valuesOf(mass, p, count), colors = valuesOf(color, p, count);
        NodeShares<Stencils> shares;
        stencils.forEachNode([&](std::size_t at, Lanes s, const auto&) { shares[at] = s * masses * colors; });
        addShares(stencils, count, mean, shares);
      });
  const SymmetryPlanes<D> planes(patch.level(), material);
  if (planes.any())
    forEachStencil<Shape>(patch, particles.x.cells(), particles, commonSize, [&](int p, const auto& stencil) {
      stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) {
        planes.ifBeyond(node, [&](const Index<D>& image, const Vec<D>&) {
          if (mean.box().contains(image)) mean[image] += s * mass[p] * color[p];
        });
      });
    });
  forEach<D>(mean.box(), [&](const Index<D>& node) {
    if (mean[node] != 0) mean[node] /= record[node][lane::mass];
  });
}

/// Computes whether each particle is initially at the surface of its body. If bodies may split, any particle may come
/// to be at a surface, and all count as if they were.
template <int D>
void findSurface(const Patch& patch, const Material& material, ParticleView<const Vec<D>> x,
                 ParticleView<int> surface) {
  for (int p = 0; p < x.owned(); ++p) {
    const Vec3 place = patch.level().expandPoint<D>(x[p]);
    surface[p] = 1;
    if (material.maySplit) continue;
    for (const Body& body : material.bodies)
      if (body.shape->contains(body.inShape(place))) surface[p] = isAtSurface(patch.level(), body, place) ? 1 : 0;
  }
}

}  // namespace tushar::mpm::solid
