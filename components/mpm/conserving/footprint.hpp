#pragma once

#include <algorithm>
#include <array>

#include "components/mpm/conserving/modes.hpp"

namespace tushar::mpm {

/// What an interval of a line of cells touches.
///
/// Weights are means of the linear shape functions over the interval, w_i = 1/L integral S_i dx; parts are the shares
/// of the interval that lie in each cell. Ends nearer to a node than 1e-12 h count as on it.
template <int Most>
struct Span {
  int first = 0;  ///< cell, and node below it
  int cells = 0;  ///< that the interval overlaps, at most `Most`
  std::array<double, Most> part{};           ///< by cell; they sum to 1
  std::array<double, Most + 1> weight{};     ///< by node; they sum to 1
  std::array<double, Most + 1> arm{};        ///< of nodes from the centre, m
  std::array<double, Most + 1> atLower{}, atUpper{};  ///< shares of nodes in the value at the ends
  double inertia = 0;                        ///< sum of weight times arm², m²
  double lower = 0, upper = 0;               ///< ends, m
  double lowerWithin = 0, upperWithin = 0;            ///< coordinates of the ends in their cells, 0 to 1

  /// Along kernel axis `d`; `cell` is that of the centre. What reaches beyond the grid is cut off.
  Span(const Level& level, int d, int cell, double centre, double length) {
    const double h = level.spacing(d), inverse = level.inverseSpacing(d), origin = level.nodePosition(d, cell);
    double from = snap((centre - origin) * inverse - 0.5 * length * inverse);
    double to = snap((centre - origin) * inverse + 0.5 * length * inverse);
    if (!level.isPeriodic(d)) {
      from = std::max(from, static_cast<double>(-cell));
      to = std::min(to, static_cast<double>(level.cells().upper[d] - cell));
    }
    const int below = static_cast<int>(std::floor(from));
    cells = std::clamp(static_cast<int>(std::ceil(to)) - below, 1, Most);
    first = cell + below;
    lower = origin + from * h;
    upper = origin + to * h;
    lowerWithin = from - below;
    upperWithin = to - (below + cells - 1);
    distribute(1 / (to - from));
    atLower[0] = 1 - lowerWithin;
    atLower[1] = lowerWithin;
    atUpper[index(cells - 1)] = 1 - upperWithin;
    atUpper[index(cells)] = upperWithin;
    const double offset = origin + below * h - 0.5 * (lower + upper);
    for (int k = 0; k <= cells; ++k) {
      arm[index(k)] = offset + k * h;
      inertia += weight[index(k)] * arm[index(k)] * arm[index(k)];
    }
  }

  int nodes() const { return cells + 1; }
  double length() const { return upper - lower; }
 private:
  static constexpr std::size_t index(int k) { return static_cast<std::size_t>(k); }
  static double snap(double x) {
    const double whole = std::nearbyint(x);
    return std::abs(x - whole) < 1e-12 ? whole : x;
  }
  void distribute(double scale) {
    double from = lowerWithin;
    for (int k = 0; k < cells; ++k) {
      const double to = k == cells - 1 ? upperWithin : 1.0;
      const double share = (to - from) * scale, above = share * 0.5 * (from + to);
      part[index(k)] = share;
      weight[index(k)] += share - above;
      weight[index(k + 1)] += above;
      from = 0;
    }
  }
};

/// What a particle that fills a box touches: the product of its spans.
template <int D>
struct Footprint {
  /// How many cells away from that of its centre a particle may reach: boxes of less than 2 h, on a line of 3 h.
  static constexpr int overhang = D == 1 ? 2 : 1;
  /// Cells beyond a patch whose particles may touch its nodes.
  static constexpr int reach = overhang + 1;
  static constexpr int most = 2 * overhang;
  /// Cells along an axis that no particle may be longer than.
  static constexpr double longest = D == 1 ? 3 : 2;

  std::array<Span<most + (D > 1)>, D> along;

  Footprint(const Level& level, const Index<D>& cell, const Vec<D>& centre, const Vec<D>& edges)
      : Footprint(level, cell, centre, edges, std::make_index_sequence<D>()) {}

  Vec<D> inertia() const {
    Vec<D> all;
    for (int d = 0; d < D; ++d) all[d] = along[static_cast<std::size_t>(d)].inertia;
    return all;
  }

  /// Calls `visit(cell, part)` for each cell of `box` that the particle overlaps.
  template <class Visit>
  void forEachCell(const Box& box, Visit&& visit) const {
    Index<D> cell;
    cells<D - 1>(box, cell, 1.0, visit);
  }

  /// Coefficients of a multilinear field about the centre, sum of f_a phi_a; `Axis` is the last one it depends on.
  template <int Axis>
  using Field = std::array<Vec<D>, (1 << (Axis + 1))>;

  /// Calls `visit(node, w, f)` for each node of `box` that the particle touches, with the weight and the field there.
  template <class Visit>
  void forEachNode(const Box& box, const Field<D - 1>& field, Visit&& visit) const {
    Index<D> node;
    nodes<D - 1>(box, node, 1.0, field, visit);
  }

  /// The field on a plane across its last axis, `arm` from the centre.
  template <int Axis>
  static Field<Axis - 1> slice(const Field<Axis>& field, double arm) {
    constexpr std::size_t half = std::size_t{1} << Axis;
    Field<Axis - 1> result;
    for (std::size_t a = 0; a < half; ++a) result[a] = field[a] + arm * field[a + half];
    return result;
  }

 private:
  template <std::size_t... Axis>
  Footprint(const Level& level, const Index<D>& cell, const Vec<D>& centre, const Vec<D>& edges,
            std::index_sequence<Axis...>)
      : along{{{level, static_cast<int>(Axis), cell[Axis], centre[Axis], edges[Axis]}...}} {}

  template <int Axis, class Visit>
  void cells(const Box& box, Index<D>& cell, double part, Visit& visit) const {
    const auto& span = along[Axis];
    const int end = std::min(span.cells, box.upper[Axis] - span.first);
    for (int k = std::max(0, box.lower[Axis] - span.first); k < end; ++k) {
      cell[Axis] = span.first + k;
      const double share = part * span.part[static_cast<std::size_t>(k)];
      if constexpr (Axis == 0)
        visit(cell, share);
      else
        cells<Axis - 1>(box, cell, share, visit);
    }
  }

  template <int Axis, class Visit>
  void nodes(const Box& box, Index<D>& node, double weight, const Field<Axis>& field, Visit& visit) const {
    const auto& span = along[Axis];
    const int end = std::min(span.nodes(), box.upper[Axis] - span.first);
    for (int k = std::max(0, box.lower[Axis] - span.first); k < end; ++k) {
      const auto at = static_cast<std::size_t>(k);
      node[Axis] = span.first + k;
      const double w = weight * span.weight[at];
      if constexpr (Axis == 0)
        visit(node, w, Vec<D>(field[0] + span.arm[at] * field[1]));
      else
        nodes<Axis - 1>(box, node, w, slice<Axis>(field, span.arm[at]), visit);
    }
  }
};

}  // namespace tushar::mpm
