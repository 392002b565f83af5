#pragma once

#include <array>
#include <utility>

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/node_record.hpp"

namespace tushar::mpm::solid {

/// The symmetry planes of a level for a material, and what mirror images of particles beyond them add to nodes.
///
/// What a particle adds to a node beyond a plane, its mirror image adds to the mirror image of this node, with the
/// components normal to the plane reversed. Nodes on a plane get only what the particles in front of it add: half of
/// the whole, like nodes of linear functions. This does not matter where only ratios of sums at a node do.
template <int D>
class SymmetryPlanes {
 public:
  /// Without planes if the particles of the material have no mirror images.
  SymmetryPlanes(const Level& level, const Material& material) : level_(level) {
    if (!material.hasMirrorImages || material.transmitsForce) return;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) any_ |= has_[2 * d + side] = level.isSymmetry(d, side, material.index);
  }

  bool any() const { return any_; }
  /// Whether a cell may be one of the `layers` of cells next to a plane.
  bool mayBeNear(const Index<D>& cell, int layers) const {
    if (level_.boxes()) return any_;
    const Box& cells = level_.cells();
    bool near = false;
    for (int d = 0; d < D; ++d) {
      near |= has_[2 * d] & (cell[d] < cells.lower[d] + layers);
      near |= has_[2 * d + 1] & (cell[d] >= cells.upper[d] - layers);
    }
    return near;
  }
  /// Whether a particle at `at`, in cells, whose functions reach as far as `support`, may add something to nodes
  /// beyond.
  bool mayBeTouched(const Vec<D>& at, const Vec<D>& support) const {
    constexpr double rounding = 1e-9;  // in favour of `true`: the stencil decides
    if (level_.boxes()) return any_;
    const Box& cells = level_.cells();
    bool may = false;
    for (int d = 0; d < D; ++d) {
      may |= has_[2 * d] & (at[d] - support[d] < cells.lower[d] - 1 + rounding);
      may |= has_[2 * d + 1] & (at[d] + support[d] > cells.upper[d] + 1 - rounding);
    }
    return may;
  }
  /// Calls `visit(image, signs)` if a node lies beyond planes, with its mirror image in front of them; `signs` is -1
  /// along the axes in which it was mirrored, otherwise 1.
  template <class Visit>
  void ifBeyond(const Index<D>& node, Visit&& visit) const {
    if (!any_) return;
    Index<D> image = node;
    Vec<D> signs = Vec<D>::Ones();
    bool isBeyond = false;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const int plane = has_[2 * d + side] ? planeInFront(image, d, side) : image[d];
        if (plane == image[d]) continue;
        image[d] = 2 * plane - image[d];
        signs[d] = -1;
        isBeyond = true;
        break;
      }
    if (isBeyond) visit(std::as_const(image), std::as_const(signs));
  }

 private:
  /// The index, along an axis, of the side beyond which a node lies; that of the node itself if it does not.
  int planeInFront(const Index<D>& node, int d, int side) const {
    const Box& cells = level_.cells();
    if (side == 0 && node[d] < cells.lower[d]) return cells.lower[d];
    if (side == 1 && node[d] > cells.upper[d]) return cells.upper[d];
    if (level_.boxes())
      for (const grid::SeveralBoxes::Nodes& nodes : level_.boxes()->beyondSide(d, side))
        if (nodes.box.template contains<D>(node)) return nodes.plane;
    return node[d];
  }

  const Level& level_;
  std::array<bool, 2 * D> has_{};
  bool any_ = false;
};

/// Adds to the velocity of a node, if it is in the view's box and has mass, a velocity that a mass moves with.
template <int D>
void addVelocity(const NodeView<NodeRecord>& record, const Index<D>& node, const Vec<D>& velocity, double mass) {
  if (!record.box().template contains<D>(node)) return;
  NodeRecord& at = record[node];
  if (at[lane::mass] <= 0) return;
  const Vec<D> change = velocity * (mass / at[lane::mass]);
  setLanes<D>(at, lane::velocity, lanes<D>(at, lane::velocity) + change);
}
/// The same for the node and, if it lies beyond symmetry planes, for its mirror image.
template <int D>
void addVelocityAndImage(const SymmetryPlanes<D>& planes, const NodeView<NodeRecord>& record, const Index<D>& node,
                         const Vec<D>& velocity, double mass) {
  addVelocity<D>(record, node, velocity, mass);
  planes.ifBeyond(node, [&](const Index<D>& image, const Vec<D>& signs) {
    addVelocity<D>(record, image, velocity.cwiseProduct(signs), mass);
  });
}

}  // namespace tushar::mpm::solid
