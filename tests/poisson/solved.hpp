#pragma once

#include <map>
#include <string>

#include "components/poisson/poisson.hpp"
#include "tests/support/run.hpp"

namespace tushar::poisson {

inline void condition(grid::Domain& domain, int axis, int side, BoundaryKind kind, double value) {
  domain.boundaries.face(axis, side).push_back({boundary::phi, kind, Vec3(value, 0, 0)});
}

inline Settings settingsOf(const std::string& source, const std::string& coefficient = "1") {
  Settings settings;
  settings.source = *input::Expression::parse(source);
  settings.coefficient = *input::Expression::parse(coefficient);
  return settings;
}

struct Solved {
  double error;  ///< mean of |phi - exact|
  double worst;  ///< maximum of |phi - exact|
  double mean;   ///< volume mean of phi
  double iterations;
  std::map<std::uint64_t, double> phi;  ///< phi by cell number
};

template <int D>
Solved solved(const grid::Domain& domain, const Settings& settings, const std::string& exact) {
  test::Runner run(domain);
  const Poisson<D> poisson(settings);
  TaskList start, advance;
  poisson.scheduleInitialize(start);
  poisson.scheduleTimeAdvance(advance);
  tasks::TaskGraph begin = run.compile(start, {"c.phi"});
  tasks::TaskGraph step = run.compile(advance, {"c.phi", "KrylovIterations"}, true);
  run.warehouse.grow(0);
  run.warehouse.reduction<Minimum>(run.table.number(delT, -1)).value = 0.5;
  run.step(begin);
  run.step(step);
  const input::Expression phi = *input::Expression::parse(exact);
  Norm error;
  Sum sum, volume;
  std::map<std::uint64_t, double> found;
  for (const Patch& patch : run.grid.patches()) {
    const auto held = run.warehouse.variable(data::Generation::old, run.table.find("c.phi", -1), patch.id());
    const auto* values = reinterpret_cast<const double*>(held.values);
    forEach<3>(patch.cells(), [&](const Index3& cell) {
      Vec3 x = Vec3::Zero();
      for (int d = 0; d < D; ++d) x[d] = patch.level().nodePosition(d, cell[d]) + patch.level().spacing(d) / 2;
      sum.add(patch.level().weight() * values[held.stored.offset(cell)]);
      volume.add(patch.level().weight());
      error.add(values[held.stored.offset(cell)] - phi(x, 1.0));
      found[patch.level().cellNumber<3>(cell)] = values[held.stored.offset(cell)];
    });
  }
  return {error.l1(), error.max, sum.total() / volume.total(),
          run.warehouse.reductionValues(run.table.find("KrylovIterations", -1)).at(0), found};
}

template <int D>
grid::Domain keptAtOne(int cells) {
  grid::Domain domain = test::unitBox<D>(cells);
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) condition(domain, d, side, BoundaryKind::dirichlet, 1);
  return domain;
}

/// A domain with the given outward derivatives at both ends.
inline grid::Domain betweenSlopes(int cells, double lower, double upper) {
  grid::Domain domain = test::unitBox<1>(cells);
  condition(domain, 0, 0, BoundaryKind::neumann, lower);
  condition(domain, 0, 1, BoundaryKind::neumann, upper);
  return domain;
}

}  // namespace tushar::poisson
