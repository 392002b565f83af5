#pragma once

#include <algorithm>
#include <array>

#include "components/mpm/gas/conserving/batch.hpp"
#include "components/mpm/gas/conserving/modes.hpp"
#include "components/mpm/gas/mirror_symmetry.hpp"

namespace tushar::mpm::gas::conserving {

/// The positions of the cells along a kernel axis.
struct CellsAlong {
  double h, inverse;  ///< width of a cell [m], and its inverse [1/m]
  double middle;      ///< centre of the grid [m]
  double middleCell;  ///< index of the cell there; half of an odd number if a face is there
  double last;        ///< index of the last cell
  bool isPeriodic;

  CellsAlong(const Level& level, int d)
      : h(level.spacing(d)),
        inverse(level.inverseSpacing(d)),
        middle(middleOf(level, d)),
        middleCell(-fromMiddle<double>(level, d, 0)),
        last(level.cells().upper[d] - 1),
        isPeriodic(level.isPeriodic(d)) {}
  /// The centres of cells [m].
  Lanes centre(const Lanes& cell) const { return middle + h * (cell - middleCell); }
};

/// Numbers of overlapped cells along an axis, as constants: `below` cells below that of the centre, `cells` in total.
template <int Below, int Cells>
struct Extent {
  static constexpr int below = Below, cells = Cells, nodes = Cells + 1;
};

/// Calls `visit(extent)` with the Extent that has these numbers of cells below and above that of the centre, each at
/// most `Overhang`. So loops over the cells and nodes of an axis have constant lengths, and sums stay in registers.
template <int Overhang, int Case = 0, class Visit>
[[gnu::always_inline]] inline void withExtent(int below, int above, Visit&& visit) {
  constexpr int side = Overhang + 1;
  if constexpr (Case + 1 < side * side)
    if (below * side + above != Case) return withExtent<Overhang, Case + 1>(below, above, visit);
  visit(Extent<Case / side, Case / side + 1 + Case % side>());
}

/// What a Span computes: the weights of nodes and cells, or also the values marked with * in it, which updating needs.
enum class SpanValues { weights, all };
template <SpanValues Values>
using Computes = std::integral_constant<SpanValues, Values>;
/// Chooses the constructor of a Span that leaves parts and weights out.
struct OnlyEnds {};

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
  std::array<Lanes, most + 1> lever;   ///< * products of weight and arm [m]
  std::array<Lanes, most + 1> atLower, atUpper;  ///< * weights of the nodes in the values at the ends
  Lanes inertia;                                 ///< * sum of weight times arm² [m²]
  Lanes perLength;                               ///< * inverse of the length [1/m]
  Lanes lower, upper;                            ///< ends of the interval [m]

  /// Constructs intervals along kernel axis `d`; `cell` is the cell of the centre. They are cut off at the boundary of
  /// the grid.
  Span(const Level& level, int d, const LaneIntegers& cell, const Lanes& centre, const Lanes& length)
      : Span(CellsAlong(level, d), cell, centre, length) {}
  template <SpanValues Values = SpanValues::all>
  Span(const CellsAlong& along, const LaneIntegers& cell, const Lanes& centre, const Lanes& length,
       Computes<Values> values = {})
      : Span(along, cell, centre, length, OnlyEnds()) {
    withExtent<Overhang>(
        below, cells - 1 - below, [&](auto extent) __attribute__((always_inline)) { weigh(extent, along, values); });
  }
  /// Constructs intervals without parts and weights, which `weigh` computes.
  [[gnu::always_inline]] Span(const CellsAlong& along, const LaneIntegers& cell, const Lanes& centre,
                              const Lanes& length, OnlyEnds) {
    const Lanes number = widen(cell), origin = along.centre(number);
    const Lanes middle = along.inverse * (centre - origin), half = 0.5 * along.inverse * length;
    from_ = snap(middle - half);
    to_ = snap(middle + half);
    if (!along.isPeriodic) {
      from_ = max(from_, -0.5 - number);
      to_ = min(to_, along.last + 0.5 - number);
    }
    int above = 0;
    while (below < Overhang && any(from_ < -0.5 - below)) ++below;
    while (above < Overhang && any(to_ > above + 0.5)) ++above;
    cells = below + 1 + above;
    first = cell - below;
    lower = origin + from_ * along.h;
    upper = origin + to_ * along.h;
    offset_ = origin - 0.5 * (lower + upper);
  }
  /// Computes parts and weights; the extent is that of the interval.
  template <int Below, int Cells, SpanValues Values>
  [[gnu::always_inline]] void weigh(Extent<Below, Cells> extent, const CellsAlong& along, Computes<Values> values) {
    distribute(extent, from_, to_, along.inverse, values);
    measureArms(extent, offset_, along.h, values);
  }

  int nodes() const { return cells + 1; }
  Lanes length() const { return upper - lower; }
  /// Ends and middle of the interval's part in the k-th cell [m].
  Lanes lowerOf(int k) const { return max(lower, centre() + arm[k]); }
  Lanes upperOf(int k) const { return min(upper, centre() + arm[k + 1]); }
  Lanes middle(int k) const { return 0.5 * (lowerOf(k) + upperOf(k)); }

  /// Sum over the nodes of an axis of known extent; `add(k, sum)` adds the term of node k. The nodes on either side of
  /// the middle are summed separately, from the inside out, so that the mirror image has the same sum.
  template <class Sum, int Below, int Cells, class Add>
  [[gnu::always_inline]] static Sum sumOverNodes(Extent<Below, Cells>, Add&& add) {
    Sum lowerSide{}, upperSide{};
#pragma GCC unroll 8
    for (int k = Below; k >= 0; --k) add(k, lowerSide);
#pragma GCC unroll 8
    for (int k = Below + 1; k <= Cells; ++k) add(k, upperSide);
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
  /// The same for an axis of known extent.
  template <int Below, int Cells, class Add>
  [[gnu::always_inline]] static Lanes sumOverCells(Extent<Below, Cells>, Add&& add) {
    Lanes lowerSide = 0, upperSide = 0;
#pragma GCC unroll 8
    for (int k = Below - 1; k >= 0; --k) add(k, lowerSide);
#pragma GCC unroll 8
    for (int k = Below + 1; k < Cells; ++k) add(k, upperSide);
    lowerSide += upperSide;
    add(Below, lowerSide);
    return lowerSide;
  }

 private:
  Lanes centre() const { return 0.5 * (lower + upper); }
  static Lanes snap(const Lanes& x) {
    const Lanes node = nearbyint(x - 0.5) + 0.5;
    return select(abs(x - node) < 1e-12, node, x);
  }
  /// Computes parts and weights of the interval from `from` to `to`, measured in cells from the middle of the cell that
  /// contains the interval's centre; `inverse` is that of the width of a cell.
  template <int Below, int Cells, SpanValues Values>
  [[gnu::always_inline]] void distribute(Extent<Below, Cells>, const Lanes& from, const Lanes& to, double inverse,
                                         Computes<Values>) {
    constexpr bool isAll = Values == SpanValues::all;
    const Lanes scale = 1 / (to - from);
    if constexpr (isAll) perLength = scale * inverse;
    Lanes start = -0.5 - Below, end = start, carried = 0;
#pragma GCC unroll 8
    for (int k = 0; k < Cells; ++k) {
      const std::size_t at = static_cast<std::size_t>(k);
      const int j = k - Below;
      const Lanes a = k == 0 ? min(from, j + 0.5) : clamp(from, j - 0.5, j + 0.5);
      const Lanes b = k == Cells - 1 ? max(to, j - 0.5) : clamp(to, j - 0.5, j + 0.5);
      const Lanes share = (b - a) * scale, half = 0.5 * share, lean = half * ((a + b) - 2 * j);
      part[at] = share;
      weight[at] = carried + (half - lean);
      if constexpr (isAll) atLower[at] = (start - a) + 1;
      if constexpr (isAll) atUpper[at] = (end - b) + 1;
      carried = half + lean;
      start = a;
      end = b;
    }
    constexpr double edge = Cells - Below - 0.5;
    weight[Cells] = carried;
    if constexpr (isAll) atLower[Cells] = (start - edge) + 1;
    if constexpr (isAll) atUpper[Cells] = (end - edge) + 1;
  }
  /// Computes the arms; `offset` is the distance of the cell's centre from that of the interval.
  template <int Below, int Cells, SpanValues Values>
  [[gnu::always_inline]] void measureArms(Extent<Below, Cells> extent, const Lanes& offset, double h,
                                          Computes<Values>) {
#pragma GCC unroll 8
    for (int k = 0; k <= Cells; ++k) arm[static_cast<std::size_t>(k)] = offset + (k - Below - 0.5) * h;
    if constexpr (Values == SpanValues::weights) return;
    inertia = sumOverNodes<Lanes>(
        extent, [&](int k, Lanes& sum) __attribute__((always_inline)) {
          const std::size_t at = static_cast<std::size_t>(k);
          lever[at] = weight[at] * arm[at];
          sum += lever[at] * arm[at];
        });
  }

  Lanes from_, to_;  ///< ends, in cells from the middle of the cell that contains the interval's centre
  Lanes offset_;     ///< distance of that middle from the interval's [m]
};

}  // namespace tushar::mpm::gas::conserving
