#include "core/solvers/box_solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/solvers/direct.hpp"

namespace tushar::solvers {

namespace {

/// -div(k grad x) + shift x on the cells of a box, with k between 1 and `contrast`, and links that are `strengths` as
/// strong along the axes. If `isHeld`, x is 0 on the lower side of the first axis.
struct Equations {
  CellBox box;
  std::array<double, 3> strengths{1, 1, 1};
  double shift = 0, contrast = 1;
  bool isHeld = false;

  int number(const std::array<int, 3>& cell) const {
    return cell[0] + box.cells[0] * (cell[1] + box.cells[1] * cell[2]);
  }
  double k(const std::array<int, 3>& cell) const {
    return std::sin(.37 * cell[0]) + std::sin(.29 * cell[1] + 1) + std::sin(.41 * cell[2] + 2) > .3 ? contrast : 1;
  }
  static double load(const std::array<int, 3>& cell) {
    return std::sin(1 + 1.3 * cell[0] + 2.7 * cell[1] + .6 * cell[2]);
  }
  template <class Visit>
  void forEachCell(Visit&& visit) const {
    for (int z = 0; z < box.cells[2]; ++z)
      for (int y = 0; y < box.cells[1]; ++y)
        for (int x = 0; x < box.cells[0]; ++x) visit(std::array<int, 3>{x, y, z});
  }
  /// Calls visit(next, axis, isUp, link) for each cell beyond a face, which may be at the other end of the box.
  template <class Visit>
  void forEachLink(const std::array<int, 3>& cell, Visit&& visit) const {
    for (std::size_t d = 0; d < 3; ++d)
      for (const int step : {-1, 1}) {
        std::array<int, 3> image = cell, next = cell;
        image[d] += step;
        next[d] = (image[d] + box.cells[d]) % box.cells[d];
        if (next[d] != image[d] && !box.isPeriodic[d]) continue;
        visit(next, static_cast<int>(d), step == 1, strengths[d] * 2 * k(cell) * k(next) / (k(cell) + k(next)));
      }
  }
  double diagonal(const std::array<int, 3>& cell) const {
    double sum = shift + (isHeld && cell[0] == 0 ? 2 * strengths[0] * k(cell) : 0);
    forEachLink(cell, [&](const auto&, int, bool, double link) { sum += link; });
    return sum;
  }
  BoxSystem system() const { return system(BoxShape(box)); }
  /// The system of a rank that has a slab of the box.
  BoxSystem system(const BoxShape& shape) const {
    BoxSystem system(shape);
    LinkCheck check;
    const int first = shape.slabs().first();
    forEachCell([&](const std::array<int, 3>& cell) {
      if (cell[2] < first || cell[2] >= first + shape.slabs().own()) return;
      const std::ptrdiff_t at = shape.offset(cell[0], cell[1], cell[2] - first);
      system.matrix.diagonal[at] = diagonal(cell);
      system.b[at] = load(cell);
      forEachLink(cell, [&](const auto&, int axis, bool isUp, double link) {
        check.add(axis, isUp, link);
        if (isUp) system.matrix.links[axis][at] = link;
      });
    });
    system.matrix.close();
    EXPECT_TRUE(check.passes(shape.slabs().ranks()));
    return system;
  }
  /// The greatest |b - A x|, from the equations.
  double residual(const BoxSystem& system) const {
    const auto x = [&](const std::array<int, 3>& at) {
      return system.x[system.matrix.shape.offset(at[0], at[1], at[2])];
    };
    double greatest = 0;
    forEachCell([&](const std::array<int, 3>& cell) {
      double rest = load(cell) - diagonal(cell) * x(cell);
      forEachLink(cell, [&](const auto& next, int, bool, double link) { rest += link * x(next); });
      greatest = std::max(greatest, std::abs(rest));
    });
    return greatest;
  }
};

const LinearSettings precise{"cg", "multigrid", 1e-11, 100, ""};

}  // namespace

TEST(BoxSolve, SolvesTheEquationsInAnyNumberOfDimensions) {
  const std::array<std::array<int, 3>, 6> extents{
      {{1, 1, 1}, {200, 1, 1}, {40, 33, 1}, {1, 17, 9}, {16, 16, 16}, {13, 7, 22}}};
  for (const auto& cells : extents) {
    const Equations equations{.box = {cells, {}}, .shift = .001, .isHeld = true};
    BoxSystem system = equations.system();

    const auto outcome = solve(system, precise);

    ASSERT_TRUE(outcome && outcome->converged);
    EXPECT_LT(equations.residual(system), 1e-9) << cells[0] << ' ' << cells[1] << ' ' << cells[2];
  }
}

TEST(BoxSolve, SolvesPeriodicBoxesDownToOneCell) {
  for (const int width : {1, 2, 3, 12}) {
    const Equations equations{.box = {{width, 12, width}, {true, true, true}}, .shift = .01};
    BoxSystem system = equations.system();

    ASSERT_TRUE(solve(system, precise));
    EXPECT_LT(equations.residual(system), 1e-9) << width;
  }
}

TEST(BoxSolve, NeedsAsManyIterationsForAnyNumberOfCells) {
  for (const int cells : {16, 32, 64}) {
    BoxSystem system = Equations{.box = {{cells, cells, cells}, {}}, .isHeld = true}.system();
    EXPECT_LE(solve(system, precise)->krylovIterations, 20) << cells;
  }
}

TEST(BoxSolve, TakesJumpsAndFlatCells) {
  for (const double contrast : {1e-4, 1e4})
    for (const double strength : {1., 100.}) {
      const Equations equations{
          .box = {{24, 24, 24}, {}}, .strengths = {1, strength, 1}, .shift = 1e-6, .contrast = contrast};
      BoxSystem system = equations.system();

      const auto outcome = solve(system, {"cg", "multigrid", 1e-10, 40, ""});

      EXPECT_TRUE(outcome && outcome->converged) << contrast << ' ' << strength;
    }
}

TEST(BoxSolve, LeavesCellsWithoutAnEquation) {
  BoxSystem system = Equations{.box = {{9, 9, 1}, {}}, .shift = 1}.system();
  const BoxShape& shape = system.matrix.shape;
  const std::ptrdiff_t hole = shape.offset(4, 4, 0);
  for (int d = 0; d < 2; ++d) system.matrix.links[d][hole] = system.matrix.links[d][hole - shape.stride(d)] = 0;
  system.matrix.diagonal[hole] = system.b[hole] = 0;

  ASSERT_TRUE(solve(system, precise)->converged);
  EXPECT_EQ(system.x[hole], 0);
}

TEST(BoxSolve, ChoosesTheSolutionWithMeanZero) {
  const Equations equations{.box = {{20, 15, 1}, {true, false, false}}};
  BoxSystem system = equations.system();
  system.constantIsFree = true;
  double loads = 0, sum = 0, mean = 0;
  equations.forEachCell([&](const auto& cell) {
    loads += std::abs(Equations::load(cell));
    sum += Equations::load(cell);
  });

  const auto outcome = solve(system, precise);

  ASSERT_TRUE(outcome && outcome->converged);
  system.matrix.shape.forEachCell([&](std::ptrdiff_t at) { mean += system.x[at]; });
  EXPECT_NEAR(mean, 0, 1e-10);
  EXPECT_NEAR(outcome->unbalanced, sum, 1e-12);
  EXPECT_NEAR(outcome->loads, loads, 1e-10);
  EXPECT_NEAR(equations.residual(system), std::abs(sum) / 300, 1e-9);  // what no solution balances
}

TEST(BoxSolve, EqualsTheDirectSolve) {
  const Equations equations{.box = {{14, 11, 1}, {}}, .shift = .1, .contrast = 50};
  Unknowns unknowns;
  unknowns.owned = 14 * 11;
  unknowns.entries.assign(static_cast<std::size_t>(unknowns.owned), 5);
  std::vector<double> b, direct(static_cast<std::size_t>(unknowns.owned));
  equations.forEachCell([&](const auto& cell) { b.push_back(Equations::load(cell)); });
  const auto assemble = [&](Matrix& matrix) {
    equations.forEachCell([&](const auto& cell) {
      const int row = equations.number(cell);
      const double diagonal = equations.diagonal(cell);
      matrix.add({&row, 1}, {&row, 1}, {&diagonal, 1});
      equations.forEachLink(cell, [&](const auto& next, int, bool, double link) {
        const int column = equations.number(next);
        const double weight = -link;
        matrix.add({&row, 1}, {&column, 1}, {&weight, 1});
      });
    });
  };
  ASSERT_TRUE(solveDirectly(unknowns, {assemble, b}, {"preonly", "lu", 1e-12, 10, ""}, direct));
  for (const char* preconditioner : {"multigrid", "jacobi", "none"}) {
    BoxSystem system = equations.system();
    ASSERT_TRUE(solve(system, {"cg", preconditioner, 1e-12, 1000, ""})->converged);
    std::size_t k = 0;
    system.matrix.shape.forEachCell([&](std::ptrdiff_t at) { EXPECT_NEAR(system.x[at], direct[k++], 1e-9); });
  }
}

TEST(BoxSolve, ReportsTooManyIterationsAndTheWorstCell) {
  BoxSystem system = Equations{.box = {{30, 30, 1}, {}}, .isHeld = true}.system();

  const auto outcome = solve(system, {"cg", "none", 1e-10, 3, ""});

  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->converged);
  EXPECT_EQ(outcome->reason, "more iterations than allowed");
  EXPECT_EQ(outcome->residuals.size(), 4);
  EXPECT_TRUE(outcome->worst >= 0 && outcome->worst < 900);
}

TEST(BoxSolve, KeepsAGuessThatIsPreciseForTheScale) {
  BoxSystem system = Equations{.box = {{30, 30, 1}, {}}, .shift = 1}.system();
  for (double& value : system.b) value *= 1e-14;
  system.scale = 1e3;

  EXPECT_EQ(solve(system, {"cg", "multigrid", 1e-10, 3, ""})->krylovIterations, 0);
}

TEST(BoxSolve, LeavesHugeJumpsAndNearlySingularMatricesToOthers) {
  BoxSystem jumps = Equations{.box = {{40, 40, 1}, {}}, .contrast = 1e12, .isHeld = true}.system();
  BoxSystem singular = Equations{.box = {{200, 200, 1}, {}}, .shift = 1e-16}.system();
  for (BoxSystem* system : {&jumps, &singular}) {
    const auto outcome = solve(*system, {"cg", "multigrid", 1e-10, 1000, ""});
    if (!outcome) continue;
    // What it accepts is a solution.
    ASSERT_TRUE(outcome->converged);
    std::vector<double> rest = system->b;
    system->matrix.subtract(system->x, rest);
    double size = 0, left = 0;
    system->matrix.shape.forEachCell([&](std::ptrdiff_t at) {
      size += system->b[at] * system->b[at];
      left += rest[at] * rest[at];
    });
    EXPECT_LE(left, 4e-20 * size);
  }
}

TEST(BoxSolve, LeavesMatricesThatAreNotPositiveDefiniteToOthers) {
  BoxSystem system = Equations{.box = {{30, 30, 1}, {}}, .shift = -1}.system();

  EXPECT_FALSE(solve(system, precise));
}

TEST(LinkCheck, RefusesUnsymmetricMatricesAndNegativeLinks) {
  const auto passes = [](double up, double down) {
    LinkCheck check;
    check.add(1, true, up);
    check.add(1, false, down);
    return check.passes(mpi::Communicator::alone());
  };
  EXPECT_TRUE(passes(1, 1));
  EXPECT_FALSE(passes(1, 2));
  EXPECT_FALSE(passes(-1, -1));
}

TEST(BoxSolve, GivesTheSameBitsOnSeveralThreads) {
  const Equations equations{.box = {{40, 30, 37}, {false, true, true}}, .shift = .01, .contrast = 20};
  BoxSystem one = equations.system();
  const auto outcome = solve(one, precise);
  ASSERT_TRUE(outcome && outcome->converged);
  for (const int count : {2, 3}) {
    Threads threads(count);
    BoxSystem several = equations.system(BoxShape(equations.box, BoxSlabs(equations.box.cells[2], &threads)));

    const auto same = solve(several, precise);

    ASSERT_TRUE(same);
    EXPECT_EQ(same->residuals, outcome->residuals);
    one.matrix.shape.forEachCell([&](std::ptrdiff_t at) { EXPECT_EQ(several.x[at], one.x[at]); });
  }
}

TEST(BoxSlabs, BeginAtPlanesThatCanBeHalvedAndAreEven) {
  for (const int ranks : {2, 3, 5, 8})
    for (const int planes : {32, 37, 64, 100, 129}) {
      const std::vector<int> borders = BoxSlabs::borders(planes, std::min(ranks, BoxSlabs::mostRanks(planes)));
      EXPECT_EQ(borders.front(), 0);
      EXPECT_EQ(borders.back(), planes);
      for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
        EXPECT_EQ(borders[k] % 2, 0);
        EXPECT_GE(borders[k + 1] - borders[k], 2);
        EXPECT_LE(borders[k + 1] - borders[k], 1.2 * planes / double(borders.size() - 1) + 3);
      }
    }
  EXPECT_EQ(BoxSlabs::borders(64, 2), (std::vector{0, 32, 64}));
}

TEST(BoxSolve, SuitsNeitherOtherMethodsNorOptionsOfPetsc) {
  EXPECT_TRUE(suitsBox({}));
  EXPECT_TRUE(suitsBox({"automatic", "jacobi", 1e-10, 10, ""}));
  EXPECT_FALSE(suitsBox({"gmres", "multigrid", 1e-10, 10, ""}));
  EXPECT_FALSE(suitsBox({"cg", "gamg", 1e-10, 10, ""}));
  EXPECT_FALSE(suitsBox({"cg", "multigrid", 1e-10, 10, "-ksp_monitor"}));
}

}  // namespace tushar::solvers
