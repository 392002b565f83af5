#pragma once

#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// The variables of the particles of a material that shape functions read: their positions, sizes and deformations.
template <class Shape, int D = Shape::dimension>
struct Placed {
  ParticleView<const Vec<D>> x;             ///< m
  Sizes<D> size;                            ///< at the start
  OptionalView<const Matrix3> deformation;  ///< F, 1; where shape functions follow it

  /// At the start of the step, with `ghost` cells beyond the patch. F only where shape functions follow it.
  static Placed from(auto& take, KeptSizes keepsSizes, int ghost = 0) {
    return from(take, keepsSizes, ghost, when(Shape::deforms, requiresOld(p::deformationMeasure, ghost)));
  }
  /// With F by an access of the caller's, `when(on, access)`.
  static Placed from(auto& take, KeptSizes keepsSizes, int ghost, auto deformation) {
    return {.x = take(requiresOld(p::x<D>, ghost)),
            .size = Sizes<D>::from(take, keepsSizes, ghost),
            .deformation = take(deformation)};
  }

  Extents<Shape> extents(const Level& level, const Vec3& commonSize) const {
    return {level, commonSize, size, deformation};
  }
};

/// Calls `visit(p, stencil)` for each particle of `cells`, cell by cell and by id.
template <class Shape, class Visit>
void forEachStencil(const Patch& patch, const Box& cells, const Placed<Shape>& particles, const Vec3& commonSize,
                    Visit&& visit) {
  forEachStencil<Shape>(patch, cells, particles.x, particles.extents(patch.level(), commonSize), visit);
}

}  // namespace tushar::mpm::solid
