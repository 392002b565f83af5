#pragma once

#include <cmath>
#include <optional>

#include "components/mpm/shapes/diagonals.hpp"
#include "components/mpm/shapes/tensor_shape.hpp"
#include "components/mpm/solid/labels.hpp"

namespace tushar::mpm::solid {

/// The axis of the scene that corresponds to a kernel axis; in three dimensions, they are the same.
template <int D>
int sceneAxis(const Level& level, int kernelAxis) {
  if constexpr (D == 3)
    return kernelAxis;
  else
    return level.axis(kernelAxis);
}

/// A view of a variable that only some scenes have.
template <class T>
using OptionalView = std::optional<ParticleView<T>>;

/// The values of a view, or null if there is no view.
template <class T>
T* valuesOf(const ParticleView<T>& view) {
  return view.set().hasNone() ? nullptr : view.values();
}
template <class T>
T* valuesOf(const OptionalView<T>& view) {
  return view ? valuesOf(*view) : nullptr;
}

/// Whether the particles of a scene have individual sizes, and whether these are parallelepipeds.
struct KeptSizes {
  bool each = false, domains = false;
  double longestDiagonal = 0;  ///< limit on half the diagonals of deformed sizes, in cells; 0: none

  constexpr KeptSizes(bool keepsEach = false, bool keepsDomains = false, double longest = 0)
      : each(keepsEach), domains(keepsDomains), longestDiagonal(longest) {}
};

/// The initial sizes of particles, in cells; without either view, all particles have the same size.
template <int D>
struct Sizes {
  OptionalView<const Vec<D>> each;
  OptionalView<const Matrix3> domain;  ///< matrices whose columns are the edges
  double longestDiagonal = 0;          ///< limit on half the diagonals of deformed sizes, in cells; 0: none

  Sizes(std::nullopt_t = std::nullopt) {}
  Sizes(ParticleView<const Vec<D>> eachSize) : each(std::move(eachSize)) {}
  Sizes(OptionalView<const Vec<D>> eachSize, OptionalView<const Matrix3> eachDomain = {}, double longest = 0)
      : each(std::move(eachSize)), domain(std::move(eachDomain)), longestDiagonal(longest) {}
  static Sizes from(auto& take, KeptSizes kept, int ghost = 0) {
    auto size = take(when(kept.each, requiresOld(p::size<D>, ghost)));
    return {size, take(when(kept.domains, requiresOld(p::domain, ghost))), kept.longestDiagonal};
  }
};

/// Whether all particles of a cell contribute to the nodes of this cell and to no others.
template <class Shape>
inline constexpr bool sharesNodes = Shape::ghostNodes == 0;

/// Prefetches the values of `count` particles starting with `first`, for reading or, if they are not const, for
/// writing.
template <class T>
[[gnu::always_inline]] inline void prefetch(T* values, int first, int count) {
  constexpr std::size_t line = 64;
  const char* const from = reinterpret_cast<const char*>(values + first);
  for (std::size_t at = 0; at < sizeof(T) * static_cast<std::size_t>(count); at += line)
    __builtin_prefetch(from + at, std::is_const_v<T> ? 0 : 1);
}

/// Loads up to Lanes::count consecutive vectors, one vector per lane; missing ones repeat the last one.
template <int D>
[[gnu::always_inline]] inline std::array<Lanes, D> vectorsOf(const Vec<D>* vectors, int count) {
  if (count >= Lanes::count) return unpack<D>(vectors->data());
  return columnsOf<D>([&](int lane) { return vectors[std::min(lane, count - 1)].data(); });
}
/// Stores the first `count` vectors of the lanes, at most Lanes::count, consecutively.
template <int D>
[[gnu::always_inline]] inline void storeVectors(const std::array<Lanes, D>& lanes, int count, Vec<D>* vectors) {
  if (count >= Lanes::count)
    pack(lanes, vectors->data());
  else
    storeColumns(lanes, count, [&](int lane) { return vectors[lane].data(); });
}

/// Shortens half the diagonals of a parallelepiped with the given half edges, in cells, to at most `longest`. `across`
/// is the square of its half extent along axes that the grid does not use, which counts for the length of a diagonal.
template <int D>
void shortenDiagonals(Eigen::Matrix<double, D, D>& halfEdges, double across, double longest) {
  mpm::shortenDiagonals<D>(halfEdges, longest,
                           [&](const Vec<D>& diagonal) { return std::sqrt(diagonal.squaredNorm() + across); });
}

/// Extents of the particles of a material for shape functions: a common size or individual ones, deformed by F.
template <class Shape>
class Extents {
 public:
  static constexpr int D = Shape::dimension;

  Extents(const Level& level, const Vec3& common, const Sizes<D>& sizes, const OptionalView<const Matrix3>& deformation)
      : level_(level),
        common_(level.reduce<D>(common)),
        whole_(common),
        longest_(sizes.longestDiagonal),
        each_(valuesOf(sizes.each)),
        domain_(valuesOf(sizes.domain)),
        deformation_(valuesOf(deformation)) {}

  Extent<D> operator[](int p) const {
    Extent<D> extent;
    if constexpr (Shape::hasSize) extent.size = each_ ? each_[p] : common_;
    if constexpr (Shape::deforms) {
      if (domain_)
        extent = skewed(p, extent.size);
      else
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j)
            extent.halfEdges(i, j) = 0.5 * deformation_[p](sceneAxis<D>(level_, i), sceneAxis<D>(level_, j)) *
                                     extent.size[j] * level_.spacing(j) * level_.inverseSpacing(i);
      if (longest_ > 0) shortenDiagonals<D>(extent.halfEdges, squareAcross(p), longest_);
    }
    return extent;
  }
  /// The initial sizes of up to Lanes::count particles starting with `first`, in cells, one per lane.
  std::array<Lanes, D> sizes(int first, int count) const {
    if (Shape::hasSize && each_) return vectorsOf<D>(each_ + first, count);
    std::array<Lanes, D> same;
    for (int d = 0; d < D; ++d) same[d] = Shape::hasSize ? common_[d] : 1.0;
    return same;
  }

 private:
  /// Half the edges F S of a particle with the initial edges S, in cells.
  Extent<D> skewed(int p, const Vec<D>& size) const requires(Shape::deforms) {
    Extent<D> extent;
    extent.size = size;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        double edge = 0;
        for (int k = 0; k < D; ++k)
          edge += deformation_[p](sceneAxis<D>(level_, i), sceneAxis<D>(level_, k)) * level_.spacing(k) *
                  domain_[p](sceneAxis<D>(level_, k), sceneAxis<D>(level_, j));
        extent.halfEdges(i, j) = 0.5 * edge * level_.inverseSpacing(i);
      }
    return extent;
  }

  /// The square of half the deformed size of a particle along the axes that the grid does not use, in cells; its
  /// initial size along these is the common one.
  double squareAcross(int p) const requires(Shape::deforms) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      bool isUsed = D == 3;
      for (int d = 0; d < D && !isUsed; ++d) isUsed = level_.axis(d) == axis;
      if (isUsed) continue;
      const double half = 0.5 * deformation_[p](axis, axis) * whole_[axis];
      square += half * half;
    }
    return square;
  }

  const Level& level_;
  Vec<D> common_;
  Vec3 whole_;
  double longest_;
  const Vec<D>* each_;
  const Matrix3* domain_;
  const Matrix3* deformation_;
};

/// Calls `visit(k, stencil)` for each of `count` particles of a cell starting with `first`, with the k-th stencil for
/// loops over rows of nodes. Stencils of tensor products are computed for several particles together.
template <class Shape, class Visit, int D = Shape::dimension>
[[gnu::always_inline]] inline void forEachStencilOf(const CellFrame<D>& frame, const Index<D>& cell, const Vec<D>* x,
                                                    const Extents<Shape>& extents, int first, int count,
                                                    Visit&& visit) {
  if constexpr (Shape::deforms) {
    for (int k = 0; k < count; ++k) visit(k, typename Shape::Stencil(frame, cell, x[first + k], extents[first + k]));
  } else {
    for (int start = 0; start < count; start += Lanes::count) {
      const int left = std::min(count - start, Lanes::count), from = first + start;
      const typename Shape::Stencils stencils(frame, cell, vectorsOf<D>(x + from, left), extents.sizes(from, left));
      for (int lane = 0; lane < left; ++lane) visit(start + lane, stencils[lane]);
    }
  }
}

/// Calls `visit(p, stencil)` for each particle of `cells`, cell by cell and by id.
template <class Shape, class Visit, int D = Shape::dimension>
void forEachStencil(const Patch& patch, const Box& cells, ParticleView<const Vec<D>> x, const Extents<Shape>& extents,
                    Visit&& visit) {
  x.template forEachOccupied<D>(cells, [&](const Index<D>& cell, const data::ParticleRange& range) {
    const CellFrame<D> frame(patch.level(), cell);
    for (const int p : range) visit(p, typename Shape::Stencil(frame, cell, x[p], extents[p]));
  });
}

/// Calls `visit(node, S, gradient)` for the nodes of a stencil that lie within a box, in the same order as without a
/// box.
template <class Stencil, class Visit, int D = Stencil::dimension>
[[gnu::always_inline]] inline void forEachNodeWithin(const Stencil& stencil, const Box& box, Visit&& visit) {
  bool areAll = true;
  for (int d = 0; d < D; ++d)
    areAll = areAll && stencil.first[d] >= box.lower[d] && stencil.first[d] + Stencil::nodes <= box.upper[d];
  if (areAll)
    stencil.forEachNode(visit);
  else
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
      if (box.contains(node)) visit(node, s, gradient);
    });
}

}  // namespace tushar::mpm::solid
