#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "components/mpm/solid/implicit/method.hpp"
#include "components/mpm/solid/tasks/shaped_tasks.hpp"

// Shape functions as implicit steps use them: the solves read only the nodes that a particle touches, so that they are
// compiled only once for each dimension.

namespace tushar::mpm::solid::implicit {

/// A node to which a particle contributes.
template <int D>
struct Touch {
  Index<D> node;
  double s, hoop;   ///< S_i and, in axisymmetric scenes, S_i / r [1/m]
  Vec<D> gradient;  ///< gradient of S_i [1/m]
};
/// A function that is called with each particle and the nodes near it; the number of nodes is always the same.
template <int D>
using VisitTouches = std::function<void(int p, std::span<const Touch<D>> touched)>;

/// The largest number of nodes to which a particle contributes: three along each axis.
template <int D>
inline constexpr std::size_t mostTouches = D == 1   ? 3
                                           : D == 2 ? 9
                                                    : 27;

/// Calls `visit` for each particle of some cells of a patch, ordered by cell and id.
template <class Shape, int D = Shape::dimension>
void forEachTouched(const Patch& patch, const Box& cells, const Placed<D>& placed, const Vec3& commonSize,
                    const VisitTouches<D>& visit) {
  static_assert(!Shape::deforms, "implicit steps support no shape functions that depend on F");
  std::array<Touch<D>, mostTouches<D>> touched;
  forEachStencil<Shape>(patch, cells, placed, commonSize, [&](int p, const auto& stencil) {
    std::size_t count = 0;
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
      touched[count++] = {node, s, hoopOf(stencil, node), gradient};
    });
    visit(p, std::span(touched).first(count));
  });
}

/// One kind of shape functions in D dimensions.
template <int D>
struct ImplicitShapes {
  ShapedTasks<D> shaped;
  int nodes;  ///< number of nodes along each axis to which a particle contributes
  void (*forEachTouched)(const Patch& patch, const Box& cells, const Placed<D>& placed, const Vec3& commonSize,
                         const VisitTouches<D>& visit);

  int touches() const {
    int count = 1;
    for (int d = 0; d < D; ++d) count *= nodes;
    return count;
  }
};
template <class Shape>
inline constexpr ImplicitShapes<Shape::dimension> shapesOf{
    .shaped = shapedTasks<Shape>(), .nodes = Shape::Stencil::nodes, .forEachTouched = forEachTouched<Shape>};

/// The particles of a material on a patch of the rank.
template <int D>
struct ParticlesOnPatch {
  const Patch* patch;
  ParticleView<const Vec<D>> x;
  int material;
};
/// The particles of a material in a cell; `source` is the place of their patch and material in a list.
struct OccupiedCell {
  std::uint64_t number;  ///< that of the cell on the level
  int material;
  std::size_t source;
  Box cell;
  data::ParticleRange particles;
};
/// The cells with particles of a list, in the order of cells and materials: sums over them are the same for any
/// patches.
template <int D>
std::vector<OccupiedCell> occupiedCells(const std::vector<ParticlesOnPatch<D>>& list) {
  std::vector<OccupiedCell> cells;
  for (std::size_t source = 0; source < list.size(); ++source) {
    const auto& [patch, x, material] = list[source];
    forEach<D>(patch->cells(), [&](const Index<D>& at) {
      const data::ParticleRange range = x.in(at);
      if (range.empty()) return;
      Box cell = patch->cells();
      for (int d = 0; d < D; ++d) {
        cell.lower[d] = at[d];
        cell.upper[d] = at[d] + 1;
      }
      cells.push_back({patch->level().template cellNumber<D>(at), material, source, cell, range});
    });
  }
  std::sort(cells.begin(), cells.end(), [](const OccupiedCell& a, const OccupiedCell& b) {
    return std::pair(a.number, a.material) < std::pair(b.number, b.material);
  });
  return cells;
}

/// The settings that are the same for all steps of a run.
template <int D>
struct ImplicitSetup {
  const Problem* problem = nullptr;
  const ImplicitShapes<D>* shapes = nullptr;
  ImplicitMethod how;
  int stateSize = 1;  ///< number of internal variables of a particle

  /// The contact that makes a material a rigid body; null if it deforms.
  const Contact* rigidContact(int material) const {
    for (const Contact& contact : problem->contacts)
      if (contact.type == Contact::Type::specified && contact.master == material) return &contact;
    return nullptr;
  }
  /// The velocity of a material at a time [m/s], if it is a master whose motion is prescribed.
  std::optional<Vec3> masterVelocity(int material, double time) const {
    const Contact* contact = rigidContact(material);
    return contact ? contact->prescribedVelocity(time) : std::nullopt;
  }
  void forEachTouched(const Patch& patch, const Placed<D>& placed, const VisitTouches<D>& visit) const {
    shapes->forEachTouched(patch, patch.cells(), placed, problem->method.commonSize, visit);
  }
};

}  // namespace tushar::mpm::solid::implicit
