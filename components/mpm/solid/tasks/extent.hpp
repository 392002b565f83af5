#pragma once

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/shapes/tensor_shape.hpp"

namespace tushar::mpm::solid {

/// Stands for an argument that a task has no use for.
struct Nothing {};

/// A view where a scene needs it, or nothing.
template <bool On, class View>
using Optional = std::conditional_t<On, View, Nothing>;

/// p.size, where the shape functions depend on it.
template <class Shape>
using SizeView = std::conditional_t<Shape::hasSize, ParticleView<const Vec<Shape::dimension>>, Nothing>;
/// p.deformationMeasure, where the shape functions follow the deformation.
template <class Shape>
using DeformationView = std::conditional_t<Shape::deforms, ParticleView<const Matrix3>, Nothing>;

template <class Shape, int D = Shape::dimension>
Extent<D> extentOf(int p, const SizeView<Shape>& size, const DeformationView<Shape>& deformation) {
  Extent<D> extent;
  if constexpr (Shape::hasSize) extent.size = size[p];
  if constexpr (Shape::deforms) extent.deformation = deformation[p];
  return extent;
}

/// Calls `visit(p, stencil)` for each particle of `cells`, cell by cell and by id.
template <class Shape, class Visit, int D = Shape::dimension>
void forEachStencil(const Patch& patch, const Box& cells, ParticleView<const Vec<D>> x, const SizeView<Shape>& size,
                    const DeformationView<Shape>& deformation, Visit&& visit) {
  forEach<D>(cells, [&](const Index<D>& cell) {
    for (const int p : x.in(cell))
      visit(p, typename Shape::Stencil(patch.level(), cell, x[p], extentOf<Shape>(p, size, deformation)));
  });
}

}  // namespace tushar::mpm::solid
