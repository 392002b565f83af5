#pragma once

#include "components/mpm/gas/conserving/span.hpp"

namespace tushar::mpm::gas::conserving {

/// The positions of the cells of a grid.
template <int D>
struct CellsOf {
  std::array<CellsAlong, D> along;

  CellsOf(const Level& level) : CellsOf(level, std::make_index_sequence<D>()) {}

 private:
  template <std::size_t... Axis>
  CellsOf(const Level& level, std::index_sequence<Axis...>) : along{{{level, static_cast<int>(Axis)}...}} {}
};

/// The cells and nodes that boxes overlap, one box per lane: the product of their spans along the axes.
template <int D>
struct Footprint {
  /// Number of cells by which a box may extend beyond the cell of its centre: boxes are shorter than 2 h, or 3 h in one
  /// dimension.
  static constexpr int overhang = D == 1 ? 2 : 1;
  /// Number of layers of cells around a patch whose particles may contribute to the nodes of the patch.
  static constexpr int reach = overhang + 1;
  /// Largest number of cells along an axis that the boxes of one batch overlap.
  static constexpr int most = Span<overhang>::most;
  /// Upper limit on the length of a box, in cells.
  static constexpr double longest = D == 1 ? 3 : 2;

  std::array<Span<overhang>, D> along;
  Index<D> start;  ///< cell of the first lane

  template <SpanValues Values = SpanValues::all>
  Footprint(const CellsOf<D>& grid, const Batch<D>& batch, const LanesVec<D>& centre, const LanesVec<D>& edges,
            Computes<Values> values = {})
      : Footprint(grid, batch, centre, edges, values, std::make_index_sequence<D>()) {}
  /// Constructs a footprint without parts and weights along the first axis, which `weighRows` computes.
  [[gnu::always_inline]] Footprint(const CellsOf<D>& grid, const Batch<D>& batch, const LanesVec<D>& centre,
                                   const LanesVec<D>& edges, auto values, OnlyEnds)
      : Footprint(grid, batch, centre, edges, values, OnlyEnds(), std::make_index_sequence<D - 1>()) {}

  LanesVec<D> inertia() const {
    LanesVec<D> all;
    for (int d = 0; d < D; ++d) all[d] = along[d].inertia;
    return all;
  }

  /// Index of the lowest cell that the box of the first lane overlaps, and of the node below this cell. The indices of
  /// each further lane are greater by one.
  Index<D> first() const {
    Index<D> first = start;
    for (std::size_t d = 0; d < D; ++d) first[static_cast<int>(d)] -= along[d].below;
    return first;
  }

  /// Sum of `value(k, part)` over the cells k of the footprint; bitwise equal for the mirror image.
  template <class Value>
  Lanes sumOverParts(Value&& value) const {
    Index<D> k;
    return sumAlong<D - 1>(k, Lanes(1), value);
  }
  /// Calls `visit(k, part)` for each cell k of the footprint.
  template <class Visit>
  void forEachPart(Visit&& visit) const {
    Index<D> k;
    parts<D - 1>(k, Lanes(1), visit);
  }
  /// Calls `visit(k, part)` for each row of cells along the first axis: `k` is its first cell, `part` the product of
  /// the parts along the other axes.
  template <class Visit>
  [[gnu::always_inline]] void forEachRowOfCells(Visit&& visit) const {
    Index<D> k;
    rowsOfCells<D - 1>(k, Lanes(1), visit);
  }
  /// Sum of `ofRow(k, part)` over the rows of forEachRowOfCells, in the order of sumOverParts.
  template <class OfRow>
  [[gnu::always_inline]] Lanes sumOverRowsOfCells(OfRow&& ofRow) const {
    Index<D> k;
    return sumOfRows<D - 1>(k, Lanes(1), ofRow);
  }
  /// Calls `visit(extent)` with the extent of the footprint along an axis, as constants (see Extent).
  template <int Axis, class Visit>
  [[gnu::always_inline]] void withExtentAlong(Visit&& visit) const {
    withExtent<overhang>(along[Axis].below, along[Axis].cells - 1 - along[Axis].below, visit);
  }
  template <class Visit>
  [[gnu::always_inline]] void withExtentOfRows(Visit&& visit) const {
    withExtentAlong<0>(visit);
  }
  /// Computes parts and weights along the first axis, and calls `visit(extent)` with the extent there: so these stay in
  /// registers.
  template <SpanValues Values, class Visit>
  [[gnu::always_inline]] void weighRows(const CellsOf<D>& grid, Computes<Values> values, Visit&& visit) {
    withExtentOfRows([&](auto extent) __attribute__((always_inline)) {
      along[0].weigh(extent, grid.along[0], values);
      visit(extent);
    });
  }
  /// Coefficients f_a of a multilinear field about the centre of a box, the sum of f_a phi_a (see Modes). `Axis` is the
  /// last axis on which the field depends.
  template <int Axis>
  using Field = std::array<LanesVec<D>, (1 << (Axis + 1))>;

  /// Calls `visit(k, w, field)` for each row of nodes along the first axis: `k` is its first node, `w` the product of
  /// the weights along the other axes, `field` the field along the row.
  template <class Visit>
  [[gnu::always_inline]] void forEachRowOfNodes(const Field<D - 1>& field, Visit&& visit) const {
    Index<D> k;
    rowsOfNodes<D - 1>(k, Lanes(1), field, visit);
  }
  /// The field in a plane perpendicular to the last axis on which it depends, at the distance `arm` from the centre.
  template <int Axis>
  [[gnu::always_inline]] static Field<Axis - 1> slice(const Field<Axis>& field, const Lanes& arm) {
    constexpr std::size_t half = std::size_t{1} << Axis;
    Field<Axis - 1> result;
    for (std::size_t a = 0; a < half; ++a)
      for (int d = 0; d < D; ++d) result[a][d] = multiplyAdd(arm, field[a + half][d], field[a][d]);
    return result;
  }

  /// Distance between the numbers of neighbours along an axis: the cells of a footprint are numbered with the first
  /// axis fastest.
  static constexpr int stride(int axis) { return axis == 0 ? 1 : most * stride(axis - 1); }
  static constexpr std::size_t places = static_cast<std::size_t>(D == 1   ? most
                                                                 : D == 2 ? most * most
                                                                          : most * most * most);
  static constexpr std::size_t number(const Index<D>& k) {
    int number = 0;
    for (int d = 0; d < D; ++d) number += k[d] * stride(d);
    return static_cast<std::size_t>(number);
  }

 private:
  template <SpanValues Values, std::size_t... Axis>
  Footprint(const CellsOf<D>& grid, const Batch<D>& batch, const LanesVec<D>& centre, const LanesVec<D>& edges,
            Computes<Values> values, std::index_sequence<Axis...>)
      : along{{{grid.along[Axis], batch.cell[Axis], centre[Axis], edges[Axis], values}...}}, start(batch.start) {}
  template <SpanValues Values, std::size_t... Later>
  [[gnu::always_inline]] Footprint(const CellsOf<D>& grid, const Batch<D>& batch, const LanesVec<D>& centre,
                                   const LanesVec<D>& edges, [[maybe_unused]] Computes<Values> values, OnlyEnds,
                                   std::index_sequence<Later...>)
      : along{{{grid.along[0], batch.cell[0], centre[0], edges[0], OnlyEnds()},
               {grid.along[Later + 1], batch.cell[Later + 1], centre[Later + 1], edges[Later + 1], values}...}},
        start(batch.start) {}

  template <int Axis, class Value>
  Lanes sumAlong(Index<D>& k, const Lanes& part, Value& value) const {
    const auto& span = along[Axis];
    return span.sumOverCells([&](int at, Lanes& sum) {
      k[Axis] = at;
      const Lanes share = part * span.part[at];
      if constexpr (Axis == 0)
        sum += value(k, share);
      else
        sum += sumAlong<Axis - 1>(k, share, value);
    });
  }

  template <int Axis, class OfRow>
  [[gnu::always_inline]] Lanes sumOfRows(Index<D>& k, const Lanes& part, OfRow& ofRow) const {
    if constexpr (Axis == 0) {
      k[0] = 0;
      return ofRow(k, part);
    } else {
      const auto& span = along[Axis];
      return span.sumOverCells([&](int at, Lanes& sum) __attribute__((always_inline)) {
        k[Axis] = at;
        sum += sumOfRows<Axis - 1>(k, part * span.part[static_cast<std::size_t>(at)], ofRow);
      });
    }
  }
  template <int Axis, class Visit>
  [[gnu::always_inline]] void rowsOfCells(Index<D>& k, const Lanes& part, Visit& visit) const {
    if constexpr (Axis == 0) {
      k[0] = 0;
      visit(k, part);
    } else {
      const auto& span = along[Axis];
      for (k[Axis] = 0; k[Axis] < span.cells; ++k[Axis])
        rowsOfCells<Axis - 1>(k, part * span.part[static_cast<std::size_t>(k[Axis])], visit);
    }
  }
  template <int Axis, class Visit>
  [[gnu::always_inline]] void rowsOfNodes(Index<D>& k, const Lanes& weight, const Field<Axis>& field,
                                          Visit& visit) const {
    if constexpr (Axis == 0) {
      k[0] = 0;
      visit(k, weight, field);
    } else {
      const auto& span = along[Axis];
      for (k[Axis] = 0; k[Axis] < span.nodes(); ++k[Axis]) {
        const std::size_t at = static_cast<std::size_t>(k[Axis]);
        rowsOfNodes<Axis - 1>(k, weight * span.weight[at], slice<Axis>(field, span.arm[at]), visit);
      }
    }
  }

  template <int Axis, class Visit>
  void parts(Index<D>& k, const Lanes& part, Visit& visit) const {
    const auto& span = along[Axis];
    for (k[Axis] = 0; k[Axis] < span.cells; ++k[Axis]) {
      const Lanes share = part * span.part[k[Axis]];
      if constexpr (Axis == 0)
        visit(k, share);
      else
        parts<Axis - 1>(k, share, visit);
    }
  }
};

/// The velocities in the boxes of particles, as multilinear fields about the centres of the boxes.
template <int D>
typename Footprint<D>::template Field<D - 1> fieldOf(const LanesVec<D>& velocity, const LanesModes<D>& modes) {
  typename Footprint<D>::template Field<D - 1> field;
  field[0] = velocity;
  for (std::size_t a = 1; a < field.size(); ++a) field[a] = modes.col(static_cast<int>(a) - 1);
  return field;
}

}  // namespace tushar::mpm::gas::conserving
