#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/numerics/box_of_cells.hpp"
#include "core/numerics/diffusion.hpp"
#include "core/solvers/direct.hpp"
#include "core/solvers/numbering.hpp"
#include "core/solvers/report.hpp"
#include "core/solvers/unsymmetric.hpp"
#include "core/tasks/access.hpp"

namespace tushar::numerics {

/// A linear system with one unknown and one equation for each cell of the grid, on all levels, solved by all ranks
/// together. It is assembled, solved and read out within one step. On several levels, the matrix need not be symmetric,
/// and the solver does not assume that it is.
template <int D>
class CellSystem {
 public:
  CellSystem(const tasks::RankPatches& patches, const tasks::Workers& workers)
      : patches_(patches), grid_(patches.front()->level().grid()), workers_(workers) {
    unknowns_.ranks = &workers.ranks;
    unknowns_.axes = D;
    for (const grid::Patch* patch : patches) unknowns_.owned += static_cast<int>(patch->cells().size());
  }

  /// Declares that the solution is unique only up to a constant; the solution with mean 0 is then used.
  void freeConstant() { unknowns_.constantIsFree = true; }

  /// Solves for the unknowns, starting from the values in `guess` of each patch. `equationOf(p, cell)` returns the
  /// CellEquation of a cell of patch number p of the rank; on several levels it is called twice for cells at the faces
  /// of a patch. `scale`: see solvers::LinearProblem. For speed, `fillRow(p, first, count, BoxRow)` may write the same
  /// equations, of `count` cells along the first axis. Both are called on several threads, on each for other patches.
  template <class EquationOf, class FillRow = NoRows>
  solvers::Outcome solve(const solvers::LinearSettings& settings,
                         const std::vector<data::CellView<const double>>& guess, EquationOf&& equationOf,
                         double scale = 0, const FillRow& fillRow = {}) {
    if (grid_.levels() == 1 && solvers::suitsBox(settings) && !solvers::isDirect(unknowns_, settings)) {
      box_.emplace(patches_, workers_);
      if (auto outcome = box_->solve(settings, {scale, unknowns_.constantIsFree}, guess, equationOf, fillRow))
        return *std::move(outcome);
      box_.reset();
    }
    return solveOnLevels(settings, guess, equationOf, scale);
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
    if (box_) return box_->take(values);
    forEachCell([&](std::size_t p, const Index<D>& cell) { values[p][cell] = solution_[rowOf(p, cell)]; });
  }

 private:
  /// Solves on any number of levels.
  template <class EquationOf>
  solvers::Outcome solveOnLevels(const solvers::LinearSettings& settings,
                                 const std::vector<data::CellView<const double>>& guess, EquationOf&& equationOf,
                                 double scale) {
    const bool isRefined = grid_.levels() > 1;
    number_.emplace(grid_);
    unknowns_.owned = number_->owned();
    unknowns_.ghosts = number_->ghosts();
    unknowns_.entries.assign(number_->owned(), Balance<D>::most);
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
  template <class Visit>
  void forEachCell(Visit&& visit) const {
    for (std::size_t p = 0; p < patches_.size(); ++p)
      grid::forEach<D>(patches_[p]->cells(), [&](const Index<D>& cell) { visit(p, cell); });
  }
  int levelOf(std::size_t p) const { return patches_[p]->level().number(); }
  std::size_t rowOf(std::size_t p, const Index<D>& cell) const {
    return static_cast<std::size_t>((*number_)(levelOf(p), cell));
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
      for (std::size_t k = 0; k < left.count; ++k) number_->meet(left.level, left.cells[k]);
      for (const auto& far : left.far) number_->meet(far.level, far.cell);
      const auto inRow = static_cast<int>(left.count + left.far.size());
      unknowns_.entries[rowOf(p, cell)] = std::min(inRow, unknowns_.owned);
    });
    unknowns_.ghosts = number_->ghosts();
  }
  void add(const Balance<D>& left, solvers::Matrix& matrix) const {
    std::array<int, Balance<D>::most> columns;
    for (std::size_t k = 0; k < left.count; ++k) columns[k] = (*number_)(left.level, left.cells[k]);
    matrix.add({columns.data(), 1}, {columns.data(), left.count}, {left.weights.data(), left.count});
    for (const auto& far : left.far) {
      const int column = (*number_)(far.level, far.cell);
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
      if (wanted >= 0 && (box_ ? box_->numberOf(cell) : (*number_)(level.number(), cell)) == wanted)
        middle = level.template expandPoint<D>(level.template cellCentre<D>(cell));
    });
    return middle;
  }

  const tasks::RankPatches& patches_;
  const grid::Grid& grid_;
  tasks::Workers workers_;
  solvers::Unknowns unknowns_;
  std::optional<BoxOfCells<D>> box_;  ///< if it has solved the system
  std::optional<solvers::CellNumbering> number_;
  std::vector<double> solution_;
};

}  // namespace tushar::numerics
