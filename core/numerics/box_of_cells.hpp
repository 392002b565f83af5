#pragma once

#include <algorithm>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/numerics/diffusion.hpp"
#include "core/solvers/box_delivery.hpp"
#include "core/solvers/stopwatch.hpp"
#include "core/tasks/access.hpp"

namespace tushar::numerics {

/// One equation of a linear system: sum_n weight_n x_n = right, where `left` contains the weights.
template <int D>
struct CellEquation {
  Balance<D> left;
  double right;
};

/// Says that equations are not given row by row.
struct NoRows {};

/// The system of CellSystem for a grid of one level, which is solved without PETSc: ranks with patches share the box of
/// the grid in slabs.
template <int D>
class BoxOfCells {
 public:
  BoxOfCells(const tasks::RankPatches& patches, const tasks::Workers& workers)
      : patches_(patches), level_(patches.front()->level()), ranks_(workers.ranks), threads_(workers.threads) {
    for (int d = 0; d < D; ++d) axes_[d] = axisInBox(d);
    for (int d = 0; d < D; ++d) {
      box_.cells[axes_[d]] = level_.cells().extent(d);
      box_.isPeriodic[axes_[d]] = level_.isPeriodic(d);
    }
  }

  /// What a system is apart from its equations; see solvers::BoxSystem.
  struct Kind {
    double scale;
    bool constantIsFree;
  };
  /// See CellSystem::solve; returns nothing if others must solve the system.
  template <class EquationOf, class FillRow>
  std::optional<solvers::Outcome> solve(const solvers::LinearSettings& settings, const Kind& kind,
                                        const std::vector<data::CellView<const double>>& guess,
                                        const EquationOf& equationOf, const FillRow& fillRow) {
    const int planes = box_.cells[2], most = solvers::BoxSlabs::mostRanks(planes);
    const int sharing = std::min(ranks_.size(), most);
    const bool isShared = ranks_.rank() < sharing;
    const mpi::Communicator part = sharing < ranks_.size() ? ranks_.split(isShared ? 0 : 1) : mpi::Communicator();
    const mpi::Communicator& together = sharing < ranks_.size() ? part : ranks_;
    std::optional<solvers::BoxSystem> system;
    if (isShared) {
      system.emplace(solvers::BoxShape(box_, solvers::BoxSlabs(planes, together, &threads_)));
      system->scale = kind.scale;
      system->constantIsFree = kind.constantIsFree;
    }
    std::optional<solvers::BoxDelivery> delivery;
    if (!ranks_.isAlone())
      delivery.emplace(ranks_, solvers::BoxSlabs::borders(planes, sharing), std::vector(axes_.begin(), axes_.end()),
                       rows());
    const solvers::Stopwatch assembling;
    if (!fill(system, delivery, guess, equationOf, fillRow)) return {};
    const double duration = assembling.seconds();
    std::optional<solvers::Outcome> outcome;
    if (isShared) outcome = solvers::solve(*system, settings);
    if (sharing < ranks_.size()) outcome = solvers::broadcast(ranks_, outcome);
    if (!outcome) return {};
    outcome->assembly = duration;
    solution_ = delivery ? delivery->fetch(system ? &*system : nullptr) : valuesIn(*system);
    return outcome;
  }
  /// Copies the solution to the fields of the patches.
  void take(const std::vector<data::CellView<double>>& values) const {
    auto from = solution_.begin();
    forEachRow([&](std::size_t p, const Index<D>& first, int count) {
      std::copy_n(from, count, &values[p][first]);
      from += count;
    });
  }
  /// The number of a cell in the box, as in Outcome::worst.
  int numberOf(const Index<D>& cell) const {
    const std::array<int, 3> place = placeOf(cell);
    return place[0] + box_.cells[0] * (place[1] + box_.cells[1] * place[2]);
  }

 private:
  /// Slabs are cut along the last axis of the box, so this is the longer one of the grid's second and third axes.
  int axisInBox(int d) const {
    if (d == 0) return 0;
    const bool isLonger = D == 2 || level_.cells().extent(d) > level_.cells().extent(3 - d) ||
                          (level_.cells().extent(d) == level_.cells().extent(3 - d) && d == 2);
    return isLonger ? 2 : 1;
  }
  std::array<int, 3> placeOf(const Index<D>& cell) const {
    std::array<int, 3> place{};
    for (int d = 0; d < D; ++d) place[axes_[d]] = cell[d];
    return place;
  }
  /// The offset of a cell in a system that one rank has.
  std::ptrdiff_t offsetIn(const solvers::BoxSystem& system, const Index<D>& cell) const {
    const std::array<int, 3> place = placeOf(cell);
    return system.matrix.shape.offset(place[0], place[1], place[2]);
  }
  template <class Visit>
  void forEachRow(const Visit& visit) const {
    for (std::size_t p = 0; p < patches_.size(); ++p)
      grid::forEachRow<D>(patches_[p]->cells(), [&](const Index<D>& first, int count) { visit(p, first, count); });
  }
  std::vector<solvers::BoxCells> rows() const {
    std::vector<solvers::BoxCells> rows;
    forEachRow([&](std::size_t, const Index<D>& first, int count) { rows.push_back({placeOf(first), count}); });
    return rows;
  }
  std::vector<double> valuesIn(const solvers::BoxSystem& system) const {
    std::vector<double> values;
    forEachRow([&](std::size_t, const Index<D>& first, int count) {
      const auto from = system.x.begin() + offsetIn(system, first);
      values.insert(values.end(), from, from + count);
    });
    return values;
  }
  /// Fills the systems of all ranks; returns whether the equations suit them.
  template <class EquationOf, class FillRow>
  bool fill(std::optional<solvers::BoxSystem>& system, std::optional<solvers::BoxDelivery>& delivery,
            const std::vector<data::CellView<const double>>& guess, const EquationOf& equationOf,
            const FillRow& fillRow) {
    std::vector<std::size_t> firstRows{0};
    for (const grid::Patch* patch : patches_)
      firstRows.push_back(firstRows.back() + patch->cells().size() / std::size_t(patch->cells().extent(0)));
    std::vector<solvers::LinkCheck> checks(patches_.size());
    threads_.forEach(static_cast<int>(patches_.size()), [&](int place) {
      const auto p = static_cast<std::size_t>(place);
      std::size_t row = firstRows[p];
      grid::forEachRow<D>(patches_[p]->cells(), [&](const Index<D>& first, int count) {
        double* guessed = nullptr;
        const solvers::BoxRow<D> to =
            delivery ? placesIn(*delivery, row, count, guessed) : placesIn(*system, offsetIn(*system, first), guessed);
        std::copy_n(&guess[p][first], count, guessed);
        if constexpr (!std::is_same_v<FillRow, NoRows>)
          fillRow(p, first, count, to);
        else
          fillEach([&](const Index<D>& cell) { return equationOf(p, cell); }, first, count, to, checks[p]);
        ++row;
      });
    });
    if (delivery) delivery->deliver(system ? &*system : nullptr);
    solvers::LinkCheck check;
    for (const solvers::LinkCheck& one : checks) check.add(one);
    if (system) system->matrix.close();
    return check.passes(ranks_);
  }
  solvers::BoxRow<D> placesIn(solvers::BoxDelivery& delivery, std::size_t row, int count, double*& guess) const {
    const solvers::BoxDelivery::Numbers numbers = delivery.numbersOf(row);
    guess = numbers.guess;
    solvers::BoxRow<D> to{numbers.diagonal, numbers.right, {}};
    for (int d = 0; d < D; ++d) to.links[d] = numbers.links + std::ptrdiff_t{d} * count;
    return to;
  }
  solvers::BoxRow<D> placesIn(solvers::BoxSystem& system, std::ptrdiff_t at, double*& guess) const {
    guess = system.x.data() + at;
    solvers::BoxRow<D> to{system.matrix.diagonal.data() + at, system.b.data() + at, {}};
    for (int d = 0; d < D; ++d) to.links[d] = system.matrix.links[axes_[d]].data() + at;
    return to;
  }
  template <class EquationOf>
  static void fillEach(const EquationOf& equationOf, const Index<D>& first, int count, const solvers::BoxRow<D>& to,
                       solvers::LinkCheck& check) {
    Index<D> cell = first;
    for (int i = 0; i < count; ++i, ++cell[0]) {
      const CellEquation<D> equation = equationOf(cell);
      const Balance<D>& left = equation.left;
      to.diagonal[i] = left.weights[0];
      to.right[i] = equation.right;
      for (std::size_t k = 1; k < left.count; ++k) {
        int axis = 0;
        while (left.cells[k][axis] == cell[axis]) ++axis;
        const bool isUp = left.cells[k][axis] > cell[axis];
        check.add(axis, isUp, -left.weights[k]);
        if (isUp) to.links[axis][i] = -left.weights[k];
      }
    }
  }

  const tasks::RankPatches& patches_;
  const grid::Level& level_;
  const mpi::Communicator& ranks_;
  Threads& threads_;
  solvers::CellBox box_;
  std::array<int, D> axes_{};  ///< the axis of the box for each of the grid
  std::vector<double> solution_;
};

}  // namespace tushar::numerics
