#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/data/views.hpp"
#include "core/grid/level.hpp"
#include "core/input/expression.hpp"

namespace tushar::numerics {

/// The mean of the coefficients of two cells that gives the correct flux through the face between them even if the
/// coefficient jumps (Patankar, Numerical Heat Transfer and Fluid Flow, 4.2).
inline double harmonicMean(double a, double b) { return 2 * a * b / (a + b); }

/// A linear function of the values in a cell and its neighbours: sum_n weight_n phi_n + constant.
template <int D>
struct Balance {
  static constexpr std::size_t most = 2 * D + 1;
  /// A cell on any level, with its weight.
  struct Far {
    int level;
    Index<D> cell;
    double weight;
  };

  int level = 0;  ///< level of the cell
  /// The cell itself, followed by some of its neighbours, which may be periodic images.
  std::array<Index<D>, most> cells{};
  std::array<double, most> weights{};
  std::size_t count = 1;
  std::vector<Far> far;  ///< cells beyond faces at which the level ends; none on a single level
  double constant = 0;

  /// Adds `weight` to the weight of a cell.
  void add(int ofLevel, const Index<D>& cell, double weight) {
    if (ofLevel == level && cell == cells[0]) {
      weights[0] += weight;
      return;
    }
    for (Far& one : far)
      if (one.level == ofLevel && one.cell == cell) {
        one.weight += weight;
        return;
      }
    far.push_back({ofLevel, cell, weight});
  }
  /// Multiplies all weights.
  void scale(double factor) {
    for (double& weight : weights) weight *= factor;
    for (Far& one : far) one.weight *= factor;
  }
};

/// div(k grad phi) by finite volumes, centred and of second order. At a side of the grid, phi is given by a Dirichlet
/// condition, or its outward derivative by a Neumann condition; other sides have no flux. Parts of a side may have
/// conditions of their own. Between cells, k is the harmonic mean.
template <int D>
class Diffusion {
 public:
  /// `k` is a formula in space and must be greater than 0.
  Diffusion(const grid::Level& level, const input::Expression& k, const grid::BoundaryLabel<double>& phi)
      : level_(level), k_(k), sides_(level.sides(phi)) {}

  /// The same, with k evaluated once in each of `cells`, and in those beside them, when this object is made; for tasks
  /// that visit these cells.
  Diffusion(const grid::Level& level, const input::Expression& k, const grid::BoundaryLabel<double>& phi,
            const grid::Box& cells)
      : Diffusion(level, k, phi) {
    if (!k.isConstant()) hold(cells);
  }

  /// div(k grad phi) in a cell, for explicit steps. At a side of the grid, k is the value in the cell. The view needs
  /// one layer of ghost cells.
  double operator()(const data::CellView<const double>& phi, const Index<D>& cell) const {
    double sum = 0;
    forEachFace(cell, [&](int d, int side, const Index<D>& next, bool isInside) {
      const double other = isInside ? phi[next] : mirrored(phi[cell], cell, d, side);
      sum += atFace(cell, next, isInside) * (other - phi[cell]) / (level_.spacing(d) * level_.spacing(d));
    });
    return sum;
  }
  /// The flux of phi along the axis through an interior face of the grid, for div(k grad phi): -k d phi / dx.
  double flux(const data::CellView<const double>& phi, const Index<D>& cell, int d, int side) const {
    const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
    const double outward = atFace(cell, next, true) * (phi[cell] - phi[next]) / level_.spacing(d);
    return side == 0 ? -outward : outward;
  }
  /// The sum of k / h² over the faces of a cell. In an explicit step of at most 1 divided by this rate, the cell does
  /// not overshoot.
  double rate(const Index<D>& cell) const {
    double sum = 0;
    forEachFace(cell, [&](int d, int, const Index<D>& next, bool isInside) {
      sum += atFace(cell, next, isInside) / (level_.spacing(d) * level_.spacing(d));
    });
    return sum;
  }
  /// The integral of div(k grad phi) over a cell, for linear systems: the sum over its faces of A k (phi_n - phi) / h.
  /// At a side of the grid, k is the value at the side.
  Balance<D> balance(const Index<D>& cell) const {
    const double own = inCell(cell);
    Balance<D> balance;
    balance.cells[0] = cell;
    forEachFace(cell, [&](int d, int side, const Index<D>& next, bool isInside) {
      if (isInside)
        addNext(own, d, next, balance);
      else
        addSide(d, side, balance);
    });
    return balance;
  }

 private:
  template <int>
  friend class CompositeDiffusion;

  /// Calls `visit(axis, side, neighbour, isOnGrid)` for each face; `isOnGrid`: the neighbour is on the grid or its
  /// images.
  template <class Visit>
  void forEachFace(const Index<D>& cell, Visit&& visit) const {
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
        visit(d, side, next, level_.isPeriodic(d) || (next[d] >= 0 && next[d] < level_.cells().upper[d]));
      }
  }
  /// Evaluates k in some cells of the grid and in those beside them.
  void hold(const grid::Box& cells) {
    held_ = cells.grown(1, D);
    values_.resize(static_cast<std::size_t>(held_.size()));
    const data::CellView<double> held(values_.data(), held_);
    forEach<D>(cells, [&](const Index<D>& cell) {
      held[cell] = evaluated(cell);
      forEachFace(cell, [&](int, int, const Index<D>& next, bool isInside) {
        if (isInside && !cells.contains(next)) held[next] = evaluated(next);
      });
    });
  }
  /// k at the centre of a cell of the grid or of its periodic images.
  double inCell(const Index<D>& cell) const {
    if (!values_.empty() && held_.contains(cell)) return data::CellView<const double>(values_.data(), held_)[cell];
    return evaluated(cell);
  }
  double evaluated(const Index<D>& cell) const {
    return k_(level_.template expandPoint<D>(level_.template cellCentre<D>(level_.template wrapped<D>(cell))));
  }
  double atFace(const Index<D>& cell, const Index<D>& next, bool isInside) const {
    const double own = inCell(cell);
    return k_.isConstant() || !isInside ? own : harmonicMean(own, inCell(next));
  }
  /// The value that phi must have in the cell beyond a side of the grid to satisfy the condition on that side.
  double mirrored(double phi, const Index<D>& cell, int d, int side) const {
    const auto& given = sides_(d, side, cell);
    if (!given) return phi;
    return given->isDirichlet() ? 2 * given->value - phi : phi + level_.spacing(d) * given->value;
  }
  /// Adds k A (phi_n - phi) / h for the neighbour along an axis; `own` is the value of k in the cell.
  void addNext(double own, int d, const Index<D>& next, Balance<D>& balance) const {
    const double weight =
        harmonicMean(own, inCell(next)) * level_.cellVolume() / (level_.spacing(d) * level_.spacing(d));
    balance.cells[balance.count] = next;
    balance.weights[balance.count++] = weight;
    balance.weights[0] -= weight;
  }
  /// Adds k A (value - phi) / (h/2) for a given value, or k A times a given derivative.
  void addSide(int d, int side, Balance<D>& balance) const {
    const auto& given = sides_(d, side, balance.cells[0]);
    if (!given) return;
    Vec<D> x = level_.template cellCentre<D>(balance.cells[0]);
    x[d] = level_.nodePosition(d, side == 0 ? 0 : level_.cells().upper[d]);
    const double k = k_(level_.template expandPoint<D>(x));
    const double area = level_.cellVolume() / level_.spacing(d);
    if (!given->isDirichlet()) {
      balance.constant += k * area * given->value;
      return;
    }
    const double weight = 2 * k * area / level_.spacing(d);
    balance.weights[0] -= weight;
    balance.constant += weight * given->value;
  }

  const grid::Level& level_;
  const input::Expression& k_;
  grid::BoundarySides<double> sides_;
  grid::Box held_ = {};
  std::vector<double> values_;  ///< k in the cells of `held_`, if any
};

}  // namespace tushar::numerics
