#pragma once

#include <utility>

#include "components/mpm/solid/transfer/node_windows.hpp"
#include "components/mpm/solid/transfer/placed.hpp"

namespace tushar::mpm::solid {

/// The number of nodes of a stencil.
template <class Stencil>
inline constexpr std::size_t nodesOf = Stencil::dimension == 1   ? Stencil::nodes
                                       : Stencil::dimension == 2 ? Stencil::nodes* Stencil::nodes
                                                                 : Stencil::nodes* Stencil::nodes* Stencil::nodes;

/// One number for each particle of a group, in its lane, at each node of its stencil.
template <class Stencils>
using NodeShares = std::array<Lanes, nodesOf<Stencils>>;

/// Node `at` of a stencil.
template <class Stencils, int D = Stencils::dimension>
Index<D> nodeOf(Index<D> first, std::size_t at) {
  for (int d = 0; d < D; ++d, at /= Stencils::nodes) first[d] += static_cast<int>(at % Stencils::nodes);
  return first;
}

/// The stencil of one deformed particle, with the interface of a group; all lanes have the same values.
template <class Stencil>
class GroupOfOne {
 public:
  static constexpr int dimension = Stencil::dimension, D = dimension;
  static constexpr int nodes = Stencil::nodes;
  static constexpr bool haveSameNodes = true;

  explicit GroupOfOne(const Stencil& stencil) : stencil_(stencil) {}
  const Index<D>& first(int) const { return stencil_.first; }
  /// Calls `visit(at, S, gradient)` for every node, with S = 0 where the particle does not contribute.
  template <class Visit>
  void forEachNode(Visit&& visit) const {
    NodeShares<GroupOfOne> value{};
    std::array<NodeShares<GroupOfOne>, D> slope{};
    stencil_.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
      std::size_t at = 0;
      for (int d = D - 1; d >= 0; --d) at = at * nodes + static_cast<std::size_t>(node[d] - stencil_.first[d]);
      value[at] = s;
      for (std::size_t d = 0; d < D; ++d) slope[d][at] = gradient[static_cast<int>(d)];
    });
    for (std::size_t at = 0; at < value.size(); ++at) {
      std::array<Lanes, D> gradient;
      for (std::size_t d = 0; d < D; ++d) gradient[d] = slope[d][at];
      visit(at, value[at], gradient);
    }
  }
  /// S_i / r of node `at` [1/m].
  Lanes hoop(std::size_t at) const { return hoopOf(stencil_, nodeOf<Stencil>(stencil_.first, at)); }

 private:
  Stencil stencil_;
};

/// Calls `visit(p, count, stencils)` for groups of up to Lanes::count particles of a cell, starting with particle p,
/// cell by cell and by id; lanes without a particle repeat another one.
template <class Shape, class Visit, int D = Shape::dimension>
void forEachStencilGroup(const Patch& patch, const Box& cells, const Placed<D>& particles, const Vec3& commonSize,
                         Visit&& visit) {
  const Extents<Shape> extents(patch.level(), commonSize, particles.size, particles.deformation);
  const Vec<D>* const x = valuesOf(particles.x);
  particles.x.template forEachOccupied<D>(cells, [&](const Index<D>& cell, const data::ParticleRange& range) {
    const CellFrame<D> frame(patch.level(), cell);
    if constexpr (Shape::deforms) {
      for (const int p : range) visit(p, 1, GroupOfOne(typename Shape::Stencil(frame, cell, x[p], extents[p])));
    } else {
      for (int p = range.first; p < range.last; p += Lanes::count) {
        const int count = std::min(range.last - p, Lanes::count);
        visit(p, count, typename Shape::Stencils(frame, cell, vectorsOf<D>(x + p, count), extents.sizes(p, count)));
      }
    }
  });
}

/// Loads the values of the first Lanes::count of `count` particles starting with `first`; missing ones repeat the last.
[[gnu::always_inline]] inline Lanes valuesOf(const ParticleView<const double>& view, int first, int count) {
  if (count >= Lanes::count) return Lanes::at(view.values() + first);
  return Lanes::of([&](int lane) { return view[first + std::min(lane, count - 1)]; });
}

/// Calls `visit(offset, at)` for the nodes of a stencil from `low` up to but excluding `high` along each axis, with the
/// offset of each from the first node of the stencil in a view.
template <class Stencils, class Visit, int D = Stencils::dimension>
[[gnu::always_inline]] inline void forEachOffset(const std::array<std::ptrdiff_t, std::size_t(D)>& stride,
                                                 const Index3& low, const Index3& high, Visit&& visit) {
  for (int k = low[2]; k < high[2]; ++k)
    for (int j = low[1]; j < high[1]; ++j) {
      std::ptrdiff_t row = 0;
      if constexpr (D > 1) row += j * stride[1];
      if constexpr (D > 2) row += k * stride[2];
      for (int i = low[0]; i < high[0]; ++i)
        visit(row + i, static_cast<std::size_t>((k * Stencils::nodes + j) * Stencils::nodes + i));
    }
}
/// Calls `visit(offset, at)` for all nodes of a stencil.
template <class Stencils, class Visit, int D = Stencils::dimension>
[[gnu::always_inline]] inline void forEachOffset(const std::array<std::ptrdiff_t, std::size_t(D)>& stride,
                                                 Visit&& visit) {
  constexpr int n = Stencils::nodes;
  forEachOffset<Stencils>(stride, {}, {{n, D < 2 ? 1 : n, D < 3 ? 1 : n}}, visit);
}

/// Calls `visit(value, at)` for each node of a stencil that is in the box of the view; `first` is its first node.
template <class Stencils, class T, class Visit, int D = Stencils::dimension>
[[gnu::always_inline]] inline void forEachNodeFrom(const Index<D>& first, const NodeView<T>& view, Visit&& visit) {
  constexpr int n = Stencils::nodes;
  const NodeWindow<T, D> window = windowFrom(view, first);
  const auto at = [&](std::ptrdiff_t offset, std::size_t number) { visit(window.origin[offset], number); };
  Index3 low, high = Index3::filled(1);
  bool areAll = true;
  for (int d = 0; d < D; ++d) {
    low[d] = std::max(0, view.box().lower[d] - first[d]);
    high[d] = std::min(n, view.box().upper[d] - first[d]);
    areAll &= (low[d] == 0) & (high[d] == n);
  }
  if (areAll)
    forEachOffset<Stencils>(window.stride, at);
  else
    forEachOffset<Stencils>(window.stride, low, high, at);
}

/// Calls `add(value, at, lane)` for each particle of a group and each of its nodes in the box of the view; a node gets
/// the particles in the order of their lanes, so that sums over particles do not depend on the groups.
template <class Stencils, class T, class Add>
[[gnu::always_inline]] inline void forEachNodeOfGroup(const Stencils& stencils, int count, const NodeView<T>& view,
                                                      Add&& add) {
  if constexpr (Stencils::haveSameNodes)
    forEachNodeFrom<Stencils>(stencils.first(0), view, [&](T& value, std::size_t at) {
      T sum = value;
      for (int lane = 0; lane < count; ++lane) add(sum, at, lane);
      value = std::move(sum);
    });
  else
    for (int lane = 0; lane < count; ++lane)
      forEachNodeFrom<Stencils>(stencils.first(lane), view, [&](T& value, std::size_t at) { add(value, at, lane); });
}

/// Adds the shares of each particle of a group to its nodes in the box of the view.
template <class Stencils>
[[gnu::always_inline]] inline void addShares(const Stencils& stencils, int count, const NodeView<double>& view,
                                             const NodeShares<Stencils>& shares) {
  forEachNodeOfGroup(stencils, count, view,
                     [&](double& value, std::size_t at, int lane) { value += shares[at][lane]; });
}

/// Loads the values of a view at the nodes of a group; all nodes must be stored.
template <class Stencils, int D = Stencils::dimension>
[[gnu::always_inline]] inline NodeShares<Stencils> nodeValues(const Stencils& stencils,
                                                              const NodeView<const double>& view) {
  constexpr int different = Stencils::haveSameNodes ? 1 : Lanes::count;
  std::array<const double*, different> origin;
  for (int lane = 0; lane < different; ++lane) {
    const Index<D> first = stencils.first(lane);
    if constexpr (data::checked) static_cast<void>(view[first] + view[nodeOf<Stencils>(first, nodesOf<Stencils> - 1)]);
    origin[lane] = windowFrom(view, first).origin;
  }
  NodeShares<Stencils> values;
  forEachOffset<Stencils>(windowFrom(view, stencils.first(0)).stride, [&](std::ptrdiff_t offset, std::size_t at) {
    if constexpr (Stencils::haveSameNodes)
      values[at] = origin[0][offset];
    else
      values[at] = Lanes::of([&](int lane) { return origin[lane][offset]; });
  });
  return values;
}

}  // namespace tushar::mpm::solid
