#pragma once

#include <optional>

#include "components/mpm/shapes/tensor_shape.hpp"
#include "components/mpm/solid/labels.hpp"

namespace tushar::mpm::solid {

/// The axis of the scene behind a kernel axis; in three dimensions the same.
template <int D>
int sceneAxis(const Level& level, int kernelAxis) {
  if constexpr (D == 3)
    return kernelAxis;
  else
    return level.axis(kernelAxis);
}

/// A view that only some scenes have.
template <class T>
using OptionalView = std::optional<ParticleView<T>>;

/// The values of a view, or null where there are none.
template <class T>
T* valuesOf(const ParticleView<T>& view) {
  return view.set().hasNone() ? nullptr : view.values();
}
template <class T>
T* valuesOf(const OptionalView<T>& view) {
  return view ? valuesOf(*view) : nullptr;
}

/// Extents of the particles of a material for shape functions: one size for all or each its own, deformed by F.
template <class Shape>
class Extents {
 public:
  static constexpr int D = Shape::dimension;

  Extents(const Level& level, const Vec3& common, const OptionalView<const Vec<D>>& each,
          const OptionalView<const Matrix3>& deformation)
      : level_(level), common_(level.reduce<D>(common)), each_(valuesOf(each)), deformation_(valuesOf(deformation)) {}

  Extent<D> operator[](int p) const {
    Extent<D> extent;
    if constexpr (Shape::hasSize) extent.size = each_ ? each_[p] : common_;
    if constexpr (Shape::deforms)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          extent.halfEdges(i, j) = 0.5 * deformation_[p](sceneAxis<D>(level_, i), sceneAxis<D>(level_, j)) *
                                   extent.size[j] * level_.spacing(j) * level_.inverseSpacing(i);
    return extent;
  }

 private:
  const Level& level_;
  Vec<D> common_;
  const Vec<D>* each_;
  const Matrix3* deformation_;
};

/// Calls `visit(p, stencil)` for each particle of `cells`, cell by cell and by id.
template <class Shape, class Visit, int D = Shape::dimension>
void forEachStencil(const Patch& patch, const Box& cells, ParticleView<const Vec<D>> x, const Extents<Shape>& extents,
                    Visit&& visit) {
  x.template forEachOccupied<D>(cells, [&](const Index<D>& cell, const data::ParticleRange& range) {
    const CellFrame<D> frame(patch.level(), cell);
    for (const int p : range) visit(p, typename Shape::Stencil(frame, cell, x[p], extents[p]));
  });
}

}  // namespace tushar::mpm::solid
