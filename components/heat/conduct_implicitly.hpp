#pragma once

#include "components/heat/heat.hpp"
#include "components/poisson/balance.hpp"

namespace tushar::heat {

/// rho c (T' - T) / dt = theta div(k grad T') + (1 - theta) div(k grad T), a linear system for T' in all cells.
/// theta = 1: backward Euler, of first order in time, and no T' is outside the range of T and the faces; theta = 1/2:
/// Crank & Nicolson, Proc. Camb. Phil. Soc. 43 (1947) 50, of second order. Both are stable for any dt.
/// Throws NumericalError if the solver gives up.
template <int D>
void conductImplicitly(const RankPatches& patches, const mpi::Communicator& ranks, const Settings& settings, double dt,
                       const std::vector<CellView<const double>>& temperature,
                       const std::vector<CellView<double>>& newTemperature, Maximum& iterationsTaken, Maximum& assembly,
                       Maximum& setup, Maximum& solution) {
  const Level& level = patches.front()->level();
  const solvers::CellNumbering number(level);
  const double theta = settings.theta, capacity = settings.capacity() * level.cellVolume() / dt;
  std::vector<double> right(static_cast<std::size_t>(number.owned())), x(right.size());
  const auto place = [&](const Index<D>& cell) { return static_cast<std::size_t>(number(cell)); };
  const auto assemble = [&](solvers::Matrix& matrix) {
    poisson::forEachCell<D>(patches, [&](std::size_t p, const Index<D>& cell) {
      poisson::Balance<D> balance = poisson::balanceOf<D>(level, settings.conductivity, "Temperature", cell);
      const double before = theta < 1 ? (1 - theta) * balance(temperature[p]) : 0.0;
      right[place(cell)] = capacity * temperature[p][cell] + before + theta * balance.constant;
      for (double& weight : balance.weights) weight *= -theta;
      balance.weights[0] += capacity;
      const std::vector<int> columns = balance.columns(number);
      matrix.add({columns.data(), 1}, columns, {balance.weights.data(), balance.count});
    });
  };
  poisson::forEachCell<D>(patches, [&](std::size_t p, const Index<D>& cell) { x[place(cell)] = temperature[p][cell]; });
  const solvers::Outcome outcome =
      solvers::solver().solve(poisson::cellUnknowns<D>(number, ranks), {assemble, right}, settings.solver, x);
  if (!outcome.converged)
    throw NumericalError(
        solvers::sentenceOf("the conduction of heat", outcome) +
            solvers::worstPlace(ranks, poisson::placeOf<D>(patches, number, outcome.worst), "in the cell"),
        "another <preconditioner>, a larger <tolerance> or more <maxiterations> in <Heat>/<Solver>, or a "
        "smaller <delt_max>",
        "c.temperature");
  poisson::forEachCell<D>(patches,
                          [&](std::size_t p, const Index<D>& cell) { newTemperature[p][cell] = x[place(cell)]; });
  iterationsTaken.add(outcome.krylovIterations);
  solvers::addTimes(outcome, assembly, setup, solution);
}

}  // namespace tushar::heat
