#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/error.hpp"
#include "core/numerics/diffusion.hpp"
#include "core/solvers/box_solve.hpp"
#include "core/solvers/direct.hpp"
#include "core/solvers/numbering.hpp"
#include "core/solvers/report.hpp"
#include "core/solvers/stopwatch.hpp"
#include "core/solvers/unsymmetric.hpp"
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

/// A linear system with one unknown and one equation for each cell of the grid, on all levels, solved by all ranks
/// together. It is assembled, solved and read out within one step. On several levels, the matrix need not be symmetric,
/// and the solver does not assume that it is.
template <int D>
class CellSystem {
 public:
  /// `ranks` must be togetherOnRanks().
  CellSystem(const tasks::RankPatches& patches, const mpi::Communicator& ranks)
      : patches_(patches), grid_(patches.front()->level().grid()), number_(grid_) {
    unknowns_.ranks = &ranks;
    unknowns_.axes = D;
    unknowns_.owned = number_.owned();
    unknowns_.ghosts = number_.ghosts();
    unknowns_.entries.assign(number_.owned(), Balance<D>::most);
  }

  /// Declares that the solution is unique only up to a constant; the solution with mean 0 is then used.
  void freeConstant() { unknowns_.constantIsFree = true; }

  /// Solves for the unknowns, starting from the values in `guess` of each patch. `equationOf(p, cell)` returns the
  /// CellEquation of a cell of patch number p of the rank; on several levels it is called twice for cells at the faces
  /// of a patch. `scale`: see solvers::LinearProblem. For speed, `fillRow(p, first, count, BoxRow)` may write the same
  /// equations, of `count` cells along the first axis.
  template <class EquationOf, class FillRow = NoRows>
  solvers::Outcome solve(const solvers::LinearSettings& settings,
                         const std::vector<data::CellView<const double>>& guess, EquationOf&& equationOf,
                         double scale = 0, const FillRow& fillRow = {}) {
    const bool isRefined = grid_.levels() > 1;
    if (!isRefined && unknowns_.ranks->isAlone() && solvers::suitsBox(settings) &&
        !solvers::isDirect(unknowns_, settings))
      if (auto outcome = solveOnBox(settings, guess, equationOf, scale, fillRow)) return *std::move(outcome);
    if (isRefined) meetOthers(equationOf);
    std::vector<double> right(unknowns_.entries.size());
    solution_.resize(right.size());
    const auto assemble = [&](solvers::Matrix& matrix) {
      forEachCell([&](std::size_t p, const Index<D>& cell) {
        const CellEquation<D> equation = equationOf(p, cell);
        add(equation.left, matrix);
        right[rowOf(p, cell)] = equation.right;
      });
    };
    forEachCell([&](std::size_t p, const Index<D>& cell) { solution_[rowOf(p, cell)] = guess[p][cell]; });
    const solvers::Outcome outcome = solvers::solve(
        unknowns_, {assemble, right, scale}, isRefined ? solvers::withoutSymmetry(settings) : settings, solution_);
    if (isRefined && unknowns_.constantIsFree) takeOutMean();
    return outcome;
  }
  /// Throws NumericalError if the solver has not converged. `what` names the system, `section` is the section of the
  /// scene with the settings of the solver, `quantity` is the label of the solution, and `also` is further advice.
  void requireConvergence(const solvers::Outcome& outcome, const std::string& what, const std::string& section,
                          const std::string& quantity, const std::string& also = "") const {
    if (outcome.converged) return;
    throw NumericalError(
        solvers::sentenceOf(what, outcome) +
            solvers::worstPlace(*unknowns_.ranks, middleOf(outcome.worst), "in the cell"),
        "another <preconditioner>, a larger <tolerance> or more <maxiterations> in <" + section + ">/<Solver>" + also,
        quantity);
  }
  /// Copies the solution to the fields of the patches.
  void take(const std::vector<data::CellView<double>>& values) const {
    forEachCell([&](std::size_t p, const Index<D>& cell) { values[p][cell] = solution_[rowOf(p, cell)]; });
  }

 private:
  /// Solves without PETSc; returns nothing if that is not possible.
  template <class EquationOf, class FillRow>
  std::optional<solvers::Outcome> solveOnBox(const solvers::LinearSettings& settings,
                                             const std::vector<data::CellView<const double>>& guess,
                                             EquationOf&& equationOf, double scale, const FillRow& fillRow) {
    const grid::Level& level = grid_.level();
    solvers::CellBox box;
    for (int d = 0; d < D; ++d) {
      box.cells[d] = level.cells().extent(d);
      box.isPeriodic[d] = level.isPeriodic(d);
    }
    solvers::BoxSystem system(box);
    system.scale = scale;
    system.constantIsFree = unknowns_.constantIsFree;
    const solvers::Stopwatch assembling;
    if (!fillBox(system, guess, equationOf, fillRow)) return {};
    const double duration = assembling.seconds();
    std::optional<solvers::Outcome> outcome = solvers::solve(system, settings);
    if (!outcome) return {};
    outcome->assembly = duration;
    solution_.resize(unknowns_.entries.size());
    forEachRow([&](std::size_t p, const Index<D>& first, int count) {
      std::copy_n(system.x.begin() + offsetIn(system, first), count, solution_.begin() + rowOf(p, first));
    });
    return outcome;
  }
  /// Returns whether the equations suit a BoxSystem.
  template <class EquationOf, class FillRow>
  bool fillBox(solvers::BoxSystem& system, const std::vector<data::CellView<const double>>& guess,
               EquationOf&& equationOf, const FillRow& fillRow) const {
    solvers::BoxAssembly assembly(system.matrix);
    forEachRow([&](std::size_t p, const Index<D>& first, int count) {
      const std::ptrdiff_t start = offsetIn(system, first);
      std::copy_n(&guess[p][first], count, system.x.begin() + start);
      if constexpr (!std::is_same_v<FillRow, NoRows>) {
        fillRow(p, first, count, solvers::BoxRow<D>(system, start));
      } else {
        Index<D> cell = first;
        for (std::ptrdiff_t at = start; at < start + count; ++at, ++cell[0]) {
          const CellEquation<D> equation = equationOf(p, cell);
          const Balance<D>& left = equation.left;
          system.matrix.diagonal[at] = left.weights[0];
          system.b[at] = equation.right;
          for (std::size_t k = 1; k < left.count; ++k)
            assembly.link(at, offsetIn(system, left.cells[k]), -left.weights[k]);
        }
      }
    });
    return assembly.finish();
  }
  static std::ptrdiff_t offsetIn(const solvers::BoxSystem& system, const Index<D>& cell) {
    return system.matrix.shape.offset(cell[0], D > 1 ? cell[D > 1 ? 1 : 0] : 0, D > 2 ? cell[D - 1] : 0);
  }
  template <class Visit>
  void forEachRow(Visit&& visit) const {
    for (std::size_t p = 0; p < patches_.size(); ++p)
      grid::forEachRow<D>(patches_[p]->cells(), [&](const Index<D>& first, int count) { visit(p, first, count); });
  }
  template <class Visit>
  void forEachCell(Visit&& visit) const {
    for (std::size_t p = 0; p < patches_.size(); ++p)
      grid::forEach<D>(patches_[p]->cells(), [&](const Index<D>& cell) { visit(p, cell); });
  }
  int levelOf(std::size_t p) const { return patches_[p]->level().number(); }
  std::size_t rowOf(std::size_t p, const Index<D>& cell) const {
    return static_cast<std::size_t>(number_(levelOf(p), cell));
  }
  /// Determines, from the equations of cells at the faces of patches, which cells of other ranks are used, and the
  /// number of entries in the rows of these equations; the equations of all other cells contain only direct neighbours.
  template <class EquationOf>
  void meetOthers(EquationOf&& equationOf) {
    forEachCell([&](std::size_t p, const Index<D>& cell) {
      const grid::Box& cells = patches_[p]->cells();
      bool isInside = true;
      for (int d = 0; d < D; ++d) isInside &= cell[d] > cells.lower[d] && cell[d] < cells.upper[d] - 1;
      if (isInside) return;
      const Balance<D> left = equationOf(p, cell).left;
      for (std::size_t k = 0; k < left.count; ++k) number_.meet(left.level, left.cells[k]);
      for (const auto& far : left.far) number_.meet(far.level, far.cell);
      const auto inRow = static_cast<int>(left.count + left.far.size());
      unknowns_.entries[rowOf(p, cell)] = std::min(inRow, unknowns_.owned);
    });
    unknowns_.ghosts = number_.ghosts();
  }
  void add(const Balance<D>& left, solvers::Matrix& matrix) const {
    std::array<int, Balance<D>::most> columns;
    for (std::size_t k = 0; k < left.count; ++k) columns[k] = number_(left.level, left.cells[k]);
    matrix.add({columns.data(), 1}, {columns.data(), left.count}, {left.weights.data(), left.count});
    for (const auto& far : left.far) {
      const int column = number_(far.level, far.cell);
      matrix.add({columns.data(), 1}, {&column, 1}, {&far.weight, 1});
    }
  }
  /// Subtracts from the solution its mean, weighted by the volumes of cells.
  void takeOutMean() {
    data::Sum sum, volume;
    forEachCell([&](std::size_t p, const Index<D>& cell) {
      const double weight = patches_[p]->level().weight();
      sum.add(weight * solution_[rowOf(p, cell)]);
      volume.add(weight);
    });
    unknowns_.ranks->merge(sum);
    unknowns_.ranks->merge(volume);
    for (double& value : solution_) value -= sum.total() / volume.total();
  }
  /// The centre of the cell with a given index [m]; none if the cell belongs to another rank.
  std::optional<Vec3> middleOf(int wanted) const {
    std::optional<Vec3> middle;
    forEachCell([&](std::size_t p, const Index<D>& cell) {
      const grid::Level& level = patches_[p]->level();
      if (wanted >= 0 && number_(level.number(), cell) == wanted)
        middle = level.template expandPoint<D>(level.template cellCentre<D>(cell));
    });
    return middle;
  }

  const tasks::RankPatches& patches_;
  const grid::Grid& grid_;
  solvers::CellNumbering number_;
  solvers::Unknowns unknowns_;
  std::vector<double> solution_;
};

}  // namespace tushar::numerics
