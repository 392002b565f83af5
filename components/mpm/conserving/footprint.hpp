#pragma once

#include <algorithm>
#include <array>

#include "components/mpm/conserving/batch.hpp"
#include "components/mpm/conserving/modes.hpp"

namespace tushar::mpm {

/// What intervals of a line of cells touch, one interval per lane.
///
/// Weights are means of the linear shape functions over the interval, w_i = 1/L integral S_i dx; parts are the shares
/// of the interval that lie in each cell. Ends nearer to a node than 1e-12 h count as on it. Nodes and cells that an
/// interval does not reach have weight and part 0; what reaches further than `Overhang` counts to the outermost cell.
template <int Overhang, int Most>
struct Span {
  LaneIntegers first;                            ///< cell, and node below it
  int cells = 1;                                 ///< that any of the intervals overlaps
  std::array<Lanes, Most> part;                  ///< by cell; they sum to 1
  std::array<Lanes, Most + 1> weight;            ///< by node; they sum to 1
  std::array<Lanes, Most + 1> arm;               ///< of nodes from the centre, m
  std::array<Lanes, Most + 1> atLower, atUpper;  ///< shares of nodes in the value at the ends
  Lanes inertia = 0;                             ///< sum of weight times arm², m²
  Lanes lower, upper;                            ///< ends, m

  /// Along kernel axis `d`; `cell` is that of the centre. What reaches beyond the grid is cut off.
  Span(const Level& level, int d, const Lanes& cell, const Lanes& centre, const Lanes& length) {
    const double h = level.spacing(d), inverse = level.inverseSpacing(d);
    const Lanes origin = level.nodePosition(d, 0) + h * cell, middle = inverse * (centre - origin);
    Lanes from = snap(middle - 0.5 * inverse * length), to = snap(middle + 0.5 * inverse * length);
    if (!level.isPeriodic(d)) {
      from = max(from, -cell);
      to = min(to, static_cast<double>(level.cells().upper[d]) - cell);
    }
    const Lanes below = clamp(floor(from), -Overhang, 0);
    first = truncate(cell + below);
    lower = origin + from * h;
    upper = origin + to * h;
    distribute(from - below, to - below);
    const Lanes offset = origin + below * h - 0.5 * (lower + upper);
    for (int k = 0; k <= cells; ++k) {
      const auto at = static_cast<std::size_t>(k);
      arm[at] = offset + k * h;
      inertia += weight[at] * arm[at] * arm[at];
    }
  }

  int nodes() const { return cells + 1; }
  Lanes length() const { return upper - lower; }
  /// Ends and middle of the part in the k-th cell, m.
  Lanes lowerOf(int k) const { return max(lower, centre() + arm[static_cast<std::size_t>(k)]); }
  Lanes upperOf(int k) const { return min(upper, centre() + arm[static_cast<std::size_t>(k) + 1]); }
  Lanes middle(int k) const { return 0.5 * (lowerOf(k) + upperOf(k)); }

 private:
  Lanes centre() const { return 0.5 * (lower + upper); }
  static Lanes snap(const Lanes& x) {
    const Lanes whole = nearbyint(x);
    return select(abs(x - whole) < 1e-12, whole, x);
  }
  /// Shares out the interval from `start` to `end`, in cells from the lower end of the first one.
  void distribute(const Lanes& start, const Lanes& end) {
    const double furthest = greatest(end);
    while (cells < Most && furthest > cells) ++cells;
    const Lanes scale = 1 / (end - start);
    Lanes from = start, carried = 0, reached = 1;
    for (int k = 0; k < cells; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const Lanes rest = max(end - k, 0), to = k == Most - 1 ? rest : min(rest, 1);
      const Lanes share = (to - from) * scale, above = 0.5 * share * (from + to);
      part[at] = share;
      weight[at] = carried + (share - above);
      atLower[at] = k == 0 ? 1 - start : k == 1 ? start : 0;
      atUpper[at] = reached - to;
      carried = above;
      reached = to;
      from = 0;
    }
    const auto last = static_cast<std::size_t>(cells);
    weight[last] = carried;
    atLower[last] = cells == 1 ? start : 0;
    atUpper[last] = reached;
  }
};

/// What particles that fill boxes touch, one per lane: the product of their spans.
template <int D>
struct Footprint {
  /// How many cells away from that of its centre a particle may reach: boxes of less than 2 h, on a line of 3 h.
  static constexpr int overhang = D == 1 ? 2 : 1;
  /// Cells beyond a patch whose particles may touch its nodes.
  static constexpr int reach = overhang + 1;
  /// Cells along an axis that a box may overlap.
  static constexpr int most = 2 * overhang + (D > 1);
  /// Cells along an axis that no particle may be longer than.
  static constexpr double longest = D == 1 ? 3 : 2;

  std::array<Span<overhang, most>, D> along;

  Footprint(const Level& level, const Batch<D>& batch, const LanesVec<D>& centre, const LanesVec<D>& edges)
      : Footprint(level, batch, centre, edges, std::make_index_sequence<D>()) {}

  LanesVec<D> inertia() const {
    LanesVec<D> all;
    for (int d = 0; d < D; ++d) all[d] = along[static_cast<std::size_t>(d)].inertia;
    return all;
  }

  /// The first cell of each, and the node below it.
  std::array<LaneIntegers, D> first() const {
    std::array<LaneIntegers, D> all;
    for (std::size_t d = 0; d < D; ++d) all[d] = along[d].first;
    return all;
  }

  /// Calls `visit(k, part)` for each place of the footprint that a cell may have.
  template <class Visit>
  void forEachPart(Visit&& visit) const {
    Index<D> k;
    parts<D - 1>(k, Lanes(1), visit);
  }
  /// Coefficients of a multilinear field about the centre, sum of f_a phi_a; `Axis` is the last one it depends on.
  template <int Axis>
  using Field = std::array<LanesVec<D>, (1 << (Axis + 1))>;

  /// Calls `visit(k, w, f)` for each place of the footprint that a node may have, with the weights and the fields
  /// there.
  template <class Visit>
  void forEachWeight(const Field<D - 1>& field, Visit&& visit) const {
    Index<D> k;
    weights<D - 1>(k, Lanes(1), field, visit);
  }
  /// The field on a plane across its last axis, `arm` from the centre.
  template <int Axis>
  static Field<Axis - 1> slice(const Field<Axis>& field, const Lanes& arm) {
    constexpr std::size_t half = std::size_t{1} << Axis;
    Field<Axis - 1> result;
    for (std::size_t a = 0; a < half; ++a) result[a] = field[a] + arm * field[a + half];
    return result;
  }

  /// Places that nodes or cells may have in a footprint, numbered with the first axis fastest.
  static constexpr int stride(int axis) { return axis == 0 ? 1 : (most + 1) * stride(axis - 1); }
  static constexpr std::size_t places = D == 1   ? most + 1
                                        : D == 2 ? (most + 1) * (most + 1)
                                                 : (most + 1) * (most + 1) * (most + 1);
  static constexpr std::size_t number(const Index<D>& k) {
    int number = 0;
    for (int d = 0; d < D; ++d) number += k[d] * stride(d);
    return static_cast<std::size_t>(number);
  }

 private:
  template <std::size_t... Axis>
  Footprint(const Level& level, const Batch<D>& batch, const LanesVec<D>& centre, const LanesVec<D>& edges,
            std::index_sequence<Axis...>)
      : along{{{level, static_cast<int>(Axis), widen(batch.cell[Axis]), centre[Axis], edges[Axis]}...}} {}

  template <int Axis, class Visit>
  void parts(Index<D>& k, const Lanes& part, Visit& visit) const {
    const auto& span = along[Axis];
    for (k[Axis] = 0; k[Axis] < span.cells; ++k[Axis]) {
      const Lanes share = part * span.part[static_cast<std::size_t>(k[Axis])];
      if constexpr (Axis == 0)
        visit(k, share);
      else
        parts<Axis - 1>(k, share, visit);
    }
  }

  template <int Axis, class Visit>
  void weights(Index<D>& k, const Lanes& weight, const Field<Axis>& field, Visit& visit) const {
    const auto& span = along[Axis];
    for (k[Axis] = 0; k[Axis] < span.nodes(); ++k[Axis]) {
      const auto at = static_cast<std::size_t>(k[Axis]);
      const Lanes w = weight * span.weight[at];
      if constexpr (Axis == 0)
        visit(k, w, LanesVec<D>(field[0] + span.arm[at] * field[1]));
      else
        weights<Axis - 1>(k, w, slice<Axis>(field, span.arm[at]), visit);
    }
  }
};

}  // namespace tushar::mpm
