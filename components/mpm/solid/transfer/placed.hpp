#pragma once

#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// The properties of shape functions that affect the schedule.
struct ShapeTraits {
  bool haveSizes = false;  ///< whether shape functions depend on the sizes of particles
  bool deform = false;     ///< whether shape functions follow F
  /// Number of layers of cells around a patch whose particles contribute to the nodes of the patch.
  int reach = 1;
  int ghostNodes = 0;  ///< number of layers of nodes beyond those of a patch to which its particles contribute
};
template <class Shape>
inline constexpr ShapeTraits traitsOf{Shape::hasSize, Shape::deforms, Shape::reach, Shape::ghostNodes};

/// Views of the particle variables of a material that shape functions read: positions, sizes and deformations.
template <int D>
struct Placed {
  ParticleView<const Vec<D>> x;             ///< position [m]
  Sizes<D> size;                            ///< initial sizes
  OptionalView<const Matrix3> deformation;  ///< F [1], if shape functions follow it

  /// Reads values at the start of the step, with `ghost` layers of cells around the patch; F only if shape functions
  /// follow it.
  static Placed from(auto& take, const ShapeTraits& shape, KeptSizes keepsSizes, int ghost = 0) {
    return from(take, keepsSizes, ghost, when(shape.deform, requiresOld(p::deformationMeasure, ghost)));
  }
  /// Reads F by the access `deformation`, of the form `when(on, access)`.
  static Placed from(auto& take, KeptSizes keepsSizes, int ghost, auto deformation) {
    return {.x = take(requiresOld(p::x<D>, ghost)),
            .size = Sizes<D>::from(take, keepsSizes, ghost),
            .deformation = take(deformation)};
  }
};

/// Calls `visit(p, stencil)` for each particle of `cells`, cell by cell and by id.
template <class Shape, class Visit, int D = Shape::dimension>
void forEachStencil(const Patch& patch, const Box& cells, const Placed<D>& particles, const Vec3& commonSize,
                    Visit&& visit) {
  const Extents<Shape> extents(patch.level(), commonSize, particles.size, particles.deformation);
  forEachStencil<Shape>(patch, cells, particles.x, extents, visit);
}

}  // namespace tushar::mpm::solid
