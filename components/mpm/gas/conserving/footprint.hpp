#pragma once

#include <algorithm>
#include <array>

#include "components/mpm/gas/conserving/batch.hpp"
#include "components/mpm/gas/conserving/modes.hpp"
#include "components/mpm/gas/mirror_symmetry.hpp"

namespace tushar::mpm::gas::conserving {

/// The cells and nodes of a line that intervals overlap, one interval per lane.
///
/// Weights are means of the linear shape functions over the interval, w_i = 1/L integral S_i dx; parts are the
/// fractions of the interval in each cell. An end nearer to a node than 1e-12 h is moved onto it. Nodes and cells
/// outside an interval have weight and part 0; anything beyond `Overhang` cells is assigned to the outermost cell.
///
/// All distances are measured from the centre of the cell that contains the interval's centre, so that the mirror image
/// of an interval has bitwise mirrored values.
template <int Overhang>
struct Span {
  static constexpr int most = 2 * Overhang + 1;  ///< largest number of cells overlapped in one batch

  LaneIntegers first;                  ///< index of the first cell, and of the node below it
  int below = 0;                       ///< number of overlapped cells below that of the centre, over all intervals
  int cells = 1;                       ///< number of overlapped cells, over all intervals
  std::array<Lanes, most> part;        ///< fractions of the interval in each cell; their sum is 1
  std::array<Lanes, most + 1> weight;  ///< weights of the nodes; their sum is 1
  std::array<Lanes, most + 1> arm;     ///< distances of the nodes from the centre [m]
  std::array<Lanes, most + 1> atLower, atUpper;  ///< weights of the nodes in the values at the ends
  Lanes inertia;                                 ///< sum of weight times arm² [m²]
  Lanes lower, upper;                            ///< ends of the interval [m]

  /// Constructs intervals along kernel axis `d`; `cell` is the cell of the centre. They are cut off at the boundary of
  /// the grid.
  Span(const Level& level, int d, const LaneIntegers& cell, const Lanes& centre, const Lanes& length) {
    const double h = level.spacing(d), inverse = level.inverseSpacing(d), last = level.cells().upper[d] - 1;
    const Lanes number = widen(cell), origin = middleOf(level, d) + h * fromMiddle(level, d, number);
    const Lanes middle = inverse * (centre - origin), half = 0.5 * inverse * length;
    Lanes from = snap(middle - half), to = snap(middle + half);
    if (!level.isPeriodic(d)) {
      from = max(from, -0.5 - number);
      to = min(to, last + 0.5 - number);
    }
    while (below < Overhang && any(from < -0.5 - below)) ++below;
    cells = below + 1;
    while (cells < below + 1 + Overhang && any(to > cells - below - 0.5)) ++cells;
    first = cell - below;
    lower = origin + from * h;
    upper = origin + to * h;
    distribute(from, to);
    measureArms(origin - 0.5 * (lower + upper), h);
  }

  int nodes() const { return cells + 1; }
  Lanes length() const { return upper - lower; }
  /// Ends and middle of the interval's part in the k-th cell [m].
  Lanes lowerOf(int k) const { return max(lower, centre() + arm[k]); }
  Lanes upperOf(int k) const { return min(upper, centre() + arm[k + 1]); }
  Lanes middle(int k) const { return 0.5 * (lowerOf(k) + upperOf(k)); }

  /// Sum over the nodes; `add(k, sum)` adds the term of node k. The nodes on either side of the middle are summed
  /// separately, from the inside out, so that the mirror image has the same sum.
  template <class Sum, class Add>
  [[gnu::always_inline]] Sum sumOverNodes(Add&& add) const {
    Sum lowerSide{}, upperSide{};
    for (int k = below; k >= 0; --k) add(k, lowerSide);
    for (int k = below + 1; k < nodes(); ++k) add(k, upperSide);
    lowerSide += upperSide;
    return lowerSide;
  }
  /// Sum over the cells, in the mirror-symmetric order of sumOverNodes; the term of the centre's cell is added last.
  template <class Add>
  [[gnu::always_inline]] Lanes sumOverCells(Add&& add) const {
    Lanes lowerSide = 0, upperSide = 0;
    for (int k = below - 1; k >= 0; --k) add(k, lowerSide);
    for (int k = below + 1; k < cells; ++k) add(k, upperSide);
    lowerSide += upperSide;
    add(below, lowerSide);
    return lowerSide;
  }

 private:
  Lanes centre() const { return 0.5 * (lower + upper); }
  static Lanes snap(const Lanes& x) {
    const Lanes node = nearbyint(x - 0.5) + 0.5;
    return select(abs(x - node) < 1e-12, node, x);
  }
  /// Computes parts and weights of the interval from `from` to `to`, measured in cells from the middle of the cell that
  /// contains the interval's centre.
  void distribute(const Lanes& from, const Lanes& to) {
    const Lanes scale = 1 / (to - from);
    Lanes start = -0.5 - below, end = start, carried = 0;
    for (int k = 0; k < cells; ++k) {
      const std::size_t at = k;
      const int j = k - below;
      const Lanes a = j == -Overhang ? min(from, j + 0.5) : clamp(from, j - 0.5, j + 0.5);
      const Lanes b = j == Overhang ? max(to, j - 0.5) : clamp(to, j - 0.5, j + 0.5);
      const Lanes share = (b - a) * scale, half = 0.5 * share, lean = half * ((a + b) - 2 * j);
      part[at] = share;
      weight[at] = carried + (half - lean);
      atLower[at] = (start - a) + 1;
      atUpper[at] = (end - b) + 1;
      carried = half + lean;
      start = a;
      end = b;
    }
    const std::size_t last = cells;
    const double edge = cells - below - 0.5;
    weight[last] = carried;
    atLower[last] = (start - edge) + 1;
    atUpper[last] = (end - edge) + 1;
  }
  /// Computes the arms; `offset` is the distance of the cell's centre from that of the interval.
  void measureArms(const Lanes& offset, double h) {
    inertia = sumOverNodes<Lanes>([&](int k, Lanes& sum) {
      const std::size_t at = k;
      arm[at] = offset + (k - below - 0.5) * h;
      sum += weight[at] * arm[at] * arm[at];
    });
  }
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

  Footprint(const Level& level, const Batch<D>& batch, const LanesVec<D>& centre, const LanesVec<D>& edges)
      : Footprint(level, batch, centre, edges, std::make_index_sequence<D>()) {}

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
  /// Coefficients f_a of a multilinear field about the centre of a box, the sum of f_a phi_a (see Modes). `Axis` is the
  /// last axis on which the field depends.
  template <int Axis>
  using Field = std::array<LanesVec<D>, (1 << (Axis + 1))>;

  /// Calls `visit(k, w, f)` for each node k of the footprint, with its weights w and the field values f at the node.
  template <class Visit>
  void forEachWeight(const Field<D - 1>& field, Visit&& visit) const {
    Index<D> k;
    weights<D - 1>(k, Lanes(1), field, visit);
  }
  /// The field in a plane perpendicular to the last axis on which it depends, at the distance `arm` from the centre.
  template <int Axis>
  static Field<Axis - 1> slice(const Field<Axis>& field, const Lanes& arm) {
    constexpr std::size_t half = std::size_t{1} << Axis;
    Field<Axis - 1> result;
    for (std::size_t a = 0; a < half; ++a) result[a] = field[a] + arm * field[a + half];
    return result;
  }

  /// Distance between the indices of neighbours along an axis: nodes or cells of a footprint are numbered with the
  /// first axis fastest.
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
      : along{{{level, static_cast<int>(Axis), batch.cell[Axis], centre[Axis], edges[Axis]}...}}, start(batch.start) {}

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

  template <int Axis, class Visit>
  void weights(Index<D>& k, const Lanes& weight, const Field<Axis>& field, Visit& visit) const {
    const auto& span = along[Axis];
    for (k[Axis] = 0; k[Axis] < span.nodes(); ++k[Axis]) {
      const std::size_t at = k[Axis];
      const Lanes w = weight * span.weight[at];
      if constexpr (Axis == 0)
        visit(k, w, LanesVec<D>(field[0] + span.arm[at] * field[1]));
      else
        weights<Axis - 1>(k, w, slice<Axis>(field, span.arm[at]), visit);
    }
  }
};

}  // namespace tushar::mpm::gas::conserving
