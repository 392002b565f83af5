#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/core.hpp"
#include "core/input/expression.hpp"
#include "core/solvers/numbering.hpp"

namespace tushar::poisson {

/// One cell's row of a system: sum_n weight_n phi_n + constant.
template <int D>
struct Balance {
  static constexpr std::size_t most = 2 * D + 1;

  std::array<Index<D>, most> cells{};  ///< the cell itself first; of the grid or their periodic images
  std::array<double, most> weights{};
  std::size_t count = 1;
  double constant = 0;

  /// Their numbers in the system.
  std::vector<int> columns(const solvers::CellNumbering& number) const {
    std::vector<int> columns;
    for (std::size_t k = 0; k < count; ++k) columns.push_back(number(cells[k]));
    return columns;
  }
  /// With the values of a field that has a ghost cell.
  double operator()(const CellView<const double>& phi) const {
    double sum = constant;
    for (std::size_t k = 0; k < count; ++k) sum += weights[k] * phi[cells[k]];
    return sum;
  }
};

/// k in the middle of a cell of the grid or of its periodic images.
template <int D>
double coefficientIn(const Level& level, const input::Expression& k, const Index<D>& cell) {
  return k(level.expandPoint<D>(level.cellCentre<D>(level.wrapped(cell))));
}

/// What a face of the grid adds to the balance of its cell: k A (value - phi) / (h/2) where the scene keeps the value,
/// k A times the outward derivative where it gives that, else nothing. k is that of the face.
template <int D>
void addBoundary(const Level& level, const input::Expression& coefficient, const char* variable, int d, int side,
                 Balance<D>& balance) {
  const auto* condition = level.boundary(d, side, variable);
  if (!condition) return;
  Vec<D> x = level.cellCentre<D>(balance.cells[0]);
  x[d] = level.nodePosition(d, side == 0 ? 0 : level.cells().upper[d]);
  const double k = coefficient(level.expandPoint<D>(x));
  const double area = level.cellVolume() / level.spacing(d), value = condition->value[0];
  if (condition->kind == "Dirichlet") {
    const double weight = 2 * k * area / level.spacing(d);
    balance.weights[0] -= weight;
    balance.constant += weight * value;
  } else {
    balance.constant += k * area * value;
  }
}

/// The integral of div(k grad phi) over a cell: sum over its faces of A k (phi_n - phi) / h. k at faces is the harmonic
/// mean of both cells, so that the flux is right where k jumps (Patankar, Numerical Heat Transfer and Fluid Flow, 4.2).
/// `variable` names phi in the boundary conditions of the scene.
template <int D>
Balance<D> balanceOf(const Level& level, const input::Expression& k, const char* variable, const Index<D>& cell) {
  const double own = coefficientIn<D>(level, k, cell);
  Balance<D> balance;
  balance.cells[0] = cell;
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      const Index<D> next = side == 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
      if (!level.isPeriodic(d) && !level.cells().contains(next)) {
        addBoundary<D>(level, k, variable, d, side, balance);
        continue;
      }
      const double other = coefficientIn<D>(level, k, next), mean = 2 * own * other / (own + other);
      const double weight = mean * level.cellVolume() / (level.spacing(d) * level.spacing(d));
      balance.cells[balance.count] = next;
      balance.weights[balance.count++] = weight;
      balance.weights[0] -= weight;
    }
  return balance;
}

/// Calls `visit(p, cell)` for the cells of all patches, p the place of the patch.
template <int D, class Visit>
void forEachCell(const RankPatches& patches, Visit&& visit) {
  for (std::size_t p = 0; p < patches.size(); ++p)
    forEach<D>(patches[p]->cells(), [&](const Index<D>& cell) { visit(p, cell); });
}

/// The unknowns of a system with a row for each cell.
template <int D>
solvers::Unknowns cellUnknowns(const solvers::CellNumbering& number, const mpi::Communicator& ranks) {
  solvers::Unknowns unknowns;
  unknowns.ranks = &ranks;
  unknowns.owned = number.owned();
  unknowns.ghosts = number.ghosts();
  unknowns.entries.assign(number.owned(), Balance<D>::most);
  return unknowns;
}

/// The middle of the cell with a number, m; none for one of another rank.
template <int D>
std::optional<Vec3> placeOf(const RankPatches& patches, const solvers::CellNumbering& number, int wanted) {
  std::optional<Vec3> place;
  forEachCell<D>(patches, [&](std::size_t p, const Index<D>& cell) {
    const Level& level = patches[p]->level();
    if (wanted >= 0 && number(cell) == wanted) place = level.expandPoint<D>(level.cellCentre<D>(cell));
  });
  return place;
}

}  // namespace tushar::poisson
