#include <stdexcept>

#include "components/burgers/burgers.hpp"
#include "components/burgers/burgers_wave.hpp"
#include "core/simulation/plain_module.hpp"

namespace tushar::burgers {

using simulation::MeasuredError;

namespace {

inline constexpr ReductionLabel<Norm> waveError{"CellError.u", "m/s", "error of the mean u of cells"};

/// The exact solution for the task; it is set before the task runs.
struct Exact {
  BurgersWave wave;
  double time = 0;
};

void measure(const Patch& patch, const Exact* exact, CellView<const double> u, Norm& error) {
  if (!exact->wave.holdsAt(exact->time)) return;
  const Level& level = patch.level();
  forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    const double exactly =
        exact->wave.average(level.nodePosition(0, cell[0]), level.nodePosition(0, cell[0] + 1), exact->time);
    error.add(u[cell] - exactly, 0, level.weight());
  });
}

class WaveError : public simulation::Analysis {
 public:
  explicit WaveError(BurgersWave wave) : exact_{std::move(wave)} {}

  void schedule(TaskList& tasks) const override {
    tasks.perPatch("burgersWave::measure", measure, with(&exact_), requiresOld(c::u), computes(waveError));
  }
  void setTime(double, double sinceStart) override { exact_.time = sinceStart; }
  std::vector<MeasuredError> errors() const override { return {{"u", "cell", &waveError, {"L1", "L2", "max"}}}; }
  std::string whyUnmeasured() const override {
    return exact_.wave.holdsAt(exact_.time) ? ""
                                            : fmt::format("'burgersWave' has no solution at t = {:g} s", exact_.time);
  }
  std::vector<output::Array> exactProfile(const Level& level) const override;

 private:
  Exact exact_;
};

std::vector<output::Array> WaveError::exactProfile(const Level& level) const {
  if (!exact_.wave.holdsAt(exact_.time)) return {};
  constexpr int points = 1000;
  const double first = level.nodePosition(0, 0), last = level.nodePosition(0, level.cells().upper[0]);
  std::vector<double> x, u;
  for (int k = 0; k <= points; ++k) {
    x.push_back(first + (last - first) * k / points);
    u.push_back(exact_.wave.at(x.back(), exact_.time));
  }
  return {{"x", "m", "position", 1, x}, {"u", "m/s", "exact u", 1, u}};
}

/// The exact solution for a scene. Throws std::invalid_argument if the inflow at an end of the grid differs from the
/// initial u there, because the solution continues the profile.
BurgersWave waveOf(const Burgers<1>& burgers, const Level& level) {
  BurgersProblem problem;
  problem.velocity = [velocity = burgers.settings().velocity, &level](double x) {
    Vec<1> at;
    at[0] = x;
    return velocity(level.expandPoint<1>(at));
  };
  problem.viscosity = burgers.settings().viscosity;
  problem.lower = level.nodePosition(0, 0);
  problem.upper = level.nodePosition(0, level.cells().upper[0]);
  problem.periodic = level.isPeriodic(0);
  for (const int side : {0, 1})
    if (const auto given = level.sides(boundary::velocity)(0, side, Index<1>{}))
      if (const double end = problem.velocity(side == 0 ? problem.lower : problem.upper);
          std::abs(given->value - end) > 1e-9 * std::max(1.0, std::abs(end)))
        throw std::invalid_argument(fmt::format(
            "{:g} m/s flows in at an end of the grid where u is {:g} m/s at the start; there is no exact solution",
            given->value, end));
  return BurgersWave(std::move(problem));
}

std::unique_ptr<simulation::Analysis> makeModule(const Component& component, const Level& level) {
  const auto* burgers = dynamic_cast<const Burgers<1>*>(&component);
  if (!burgers) throw std::invalid_argument("measures the component burgers in one dimension; remove the module");
  return std::make_unique<WaveError>(waveOf(*burgers, level));
}

}  // namespace

simulation::AnalysisKind waveKind() {
  return simulation::plainModule("burgersWave", "compares a run with the exact solution of Burgers' equation",
                                 "Errors of the component burgers relative to the exact solution that follows from "
                                 "<Burgers>, in one dimension.",
                                 makeModule);
}

}  // namespace tushar::burgers
