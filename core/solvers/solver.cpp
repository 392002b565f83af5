#include "core/solvers/solver.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/missing.hpp"
#include "core/solvers/direct.hpp"
#include "core/solvers/report.hpp"

namespace tushar::solvers {

namespace {

constexpr const char* library = "libtushar_petsc.so";

std::atomic<bool> wasLoaded = false;

/// Loads the solver with lazy binding, so that symbols of PETSc's dependencies are resolved only when they are used.
const Solver& load() {
  void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (!handle) {
    buildMissing("petsc");
    handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  }
  if (!handle) throw std::runtime_error(fmt::format("the solver cannot be loaded: {}", dlerror()));
  using Entry = const Solver* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(handle, "tusharSolver"));
  if (!entry) throw std::runtime_error(fmt::format("{} is not a solver: {}", library, dlerror()));
  return *entry();
}

}  // namespace

const Solver& solver() {
  static const Solver& loaded = load();
  wasLoaded = true;
  return loaded;
}

std::string petscVersion() try { return load().version(); } catch (const std::runtime_error& error) {
  return fmt::format("not available: {}", error.what());
}

bool isLoaded() { return wasLoaded; }

std::vector<std::string> unusedOptions() { return wasLoaded ? solver().unusedOptions() : std::vector<std::string>{}; }

Outcome solve(const Unknowns& unknowns, const LinearProblem& problem, const LinearSettings& settings,
              std::span<double> x) {
  if (isDirect(unknowns, settings))
    if (auto outcome = solveDirectly(unknowns, problem, settings, x)) return *std::move(outcome);
  return solver().solve(unknowns, problem, settings, x);
}

Outcome solve(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings,
              std::span<double> u) {
  if (isDirect(unknowns, settings.linear))
    if (auto outcome = solveDirectly(unknowns, problem, settings, u)) return *std::move(outcome);
  return solver().solve(unknowns, problem, settings, u);
}

void addUp(const Unknowns& unknowns, std::span<double> values) {
  if (!unknowns.ranks->isAlone()) solver().addUp(unknowns, values);
}

namespace {

/// The history of a solve: `k iterations; residuals a, b, …`, with the first and the last ones.
std::string historyOf(const std::vector<double>& residuals) {
  constexpr std::size_t shown = 8;
  std::string history;
  const std::size_t count = residuals.size(), first = count > shown ? count - shown : 0;
  for (std::size_t k = first; k < count; ++k)
    history += fmt::format("{}{:.3g}", history.empty() ? "" : ", ", residuals[k]);
  const std::string start = first > 0 ? fmt::format("{:.3g}, …, ", residuals.front()) : "";
  const std::size_t iterations = count == 0 ? 0 : count - 1;
  return fmt::format("{} iteration{}; residuals {}{}", iterations, iterations == 1 ? "" : "s", start, history);
}

}  // namespace

std::string sentenceOf(const std::string& what, const Outcome& outcome) {
  std::string sentence =
      fmt::format("{} did not converge: {}, after {}", what, outcome.reason, historyOf(outcome.residuals));
  if (!outcome.krylovResiduals.empty())
    sentence += fmt::format("; last linear solve: {}", historyOf(outcome.krylovResiduals));
  return sentence;
}

std::string worstPlace(const mpi::Communicator& ranks, const std::optional<Vec3>& mine, const std::string& what) {
  std::array<double, 3> place;
  place.fill(-std::numeric_limits<double>::infinity());
  if (mine) place = {(*mine)[0], (*mine)[1], (*mine)[2]};
  ranks.max(place);
  if (!std::isfinite(place[0])) return "";
  return fmt::format("; the largest residual is {} at ({:g}, {:g}, {:g})", what, place[0], place[1], place[2]);
}

}  // namespace tushar::solvers
