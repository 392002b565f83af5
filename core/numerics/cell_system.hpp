#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/numerics/diffusion.hpp"
#include "core/solvers/numbering.hpp"
#include "core/solvers/report.hpp"
#include "core/tasks/access.hpp"

namespace tushar::numerics {

/// An equation of a linear system: sum_n weight_n x_n = right, with the weights of `left`.
template <int D>
struct CellEquation {
  Balance<D> left;
  double right;
};

/// A linear system with one unknown and one equation for each cell of the grid, solved by all ranks together. One step
/// makes it, solves it, and takes the solution out.
template <int D>
class CellSystem {
 public:
  /// `ranks` are those of togetherOnRanks().
  CellSystem(const tasks::RankPatches& patches, const mpi::Communicator& ranks)
      : patches_(patches), number_(patches.front()->level()) {
    unknowns_.ranks = &ranks;
    unknowns_.owned = number_.owned();
    unknowns_.ghosts = number_.ghosts();
    unknowns_.entries.assign(number_.owned(), Balance<D>::most);
  }

  /// A constant added to the solution makes another one: that of mean 0 is taken.
  void freeConstant() { unknowns_.constantIsFree = true; }

  /// Solves for the unknowns, from the values in `guess` of each patch. `equationOf(p, cell)` gives the CellEquation of
  /// a cell of patch number p of the rank.
  template <class EquationOf>
  solvers::Outcome solve(const solvers::LinearSettings& settings,
                         const std::vector<data::CellView<const double>>& guess, EquationOf&& equationOf) {
    std::vector<double> right(unknowns_.entries.size());
    solution_.resize(right.size());
    const auto assemble = [&](solvers::Matrix& matrix) {
      forEachCell([&](std::size_t p, const Index<D>& cell) {
        const CellEquation<D> equation = equationOf(p, cell);
        add(equation.left, matrix);
        right[rowOf(cell)] = equation.right;
      });
    };
    forEachCell([&](std::size_t p, const Index<D>& cell) { solution_[rowOf(cell)] = guess[p][cell]; });
    return solvers::solver().solve(unknowns_, {assemble, right}, settings, solution_);
  }
  /// Throws NumericalError if the solver gave up on `what`; `section` holds the settings of the solver, `quantity` is
  /// the label of the solution, and `also` is one more thing to try.
  void requireConvergence(const solvers::Outcome& outcome, const std::string& what, const std::string& section,
                          const std::string& quantity, const std::string& also = "") const {
    if (outcome.converged) return;
    throw NumericalError(
        solvers::sentenceOf(what, outcome) +
            solvers::worstPlace(*unknowns_.ranks, middleOf(outcome.worst), "in the cell"),
        "another <preconditioner>, a larger <tolerance> or more <maxiterations> in <" + section + ">/<Solver>" + also,
        quantity);
  }
  /// Writes the solution to the fields of the patches.
  void take(const std::vector<data::CellView<double>>& values) const {
    forEachCell([&](std::size_t p, const Index<D>& cell) { values[p][cell] = solution_[rowOf(cell)]; });
  }

 private:
  template <class Visit>
  void forEachCell(Visit&& visit) const {
    for (std::size_t p = 0; p < patches_.size(); ++p)
      grid::forEach<D>(patches_[p]->cells(), [&](const Index<D>& cell) { visit(p, cell); });
  }
  std::size_t rowOf(const Index<D>& cell) const { return static_cast<std::size_t>(number_(cell)); }
  void add(const Balance<D>& left, solvers::Matrix& matrix) const {
    std::array<int, Balance<D>::most> columns;
    for (std::size_t k = 0; k < left.count; ++k) columns[k] = number_(left.cells[k]);
    matrix.add({columns.data(), 1}, {columns.data(), left.count}, {left.weights.data(), left.count});
  }
  /// The centre of the cell with a number, m; none for one of another rank.
  std::optional<Vec3> middleOf(int wanted) const {
    std::optional<Vec3> middle;
    forEachCell([&](std::size_t p, const Index<D>& cell) {
      const grid::Level& level = patches_[p]->level();
      if (wanted >= 0 && number_(cell) == wanted)
        middle = level.template expandPoint<D>(level.template cellCentre<D>(cell));
    });
    return middle;
  }

  const tasks::RankPatches& patches_;
  solvers::CellNumbering number_;
  solvers::Unknowns unknowns_;
  std::vector<double> solution_;
};

}  // namespace tushar::numerics
