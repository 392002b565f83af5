#include "core/solvers/solver.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/solvers/report.hpp"

namespace tushar::solvers {

namespace {

constexpr const char* library = "libtushar_petsc.so";

/// Lazily bound, so that what PETSc brings along is only resolved where it is used.
const Solver& load() {
  void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (!handle) throw std::runtime_error(fmt::format("the solver cannot be loaded: {}", dlerror()));
  using Entry = const Solver* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(handle, "tusharSolver"));
  if (!entry) throw std::runtime_error(fmt::format("{} is no solver: {}", library, dlerror()));
  return *entry();
}

}  // namespace

const Solver& solver() {
  static const Solver& loaded = load();
  return loaded;
}

void addUp(const Unknowns& unknowns, std::span<double> values) {
  if (!unknowns.ranks->isAlone()) solver().addUp(unknowns, values);
}

std::string sentenceOf(const std::string& what, const Outcome& outcome) {
  constexpr std::size_t shown = 8;
  std::string history;
  const std::size_t count = outcome.residuals.size(), first = count > shown ? count - shown : 0;
  for (std::size_t k = first; k < count; ++k)
    history += fmt::format("{}{:.3g}", history.empty() ? "" : ", ", outcome.residuals[k]);
  return fmt::format("{} did not converge ({}) in {} iterations; residuals {}{}", what, outcome.reason,
                     count == 0 ? 0 : count - 1, first > 0 ? "…, " : "", history);
}

std::string worstPlace(const mpi::Communicator& ranks, const std::optional<Vec3>& mine, const std::string& what) {
  std::array<double, 3> place;
  place.fill(-std::numeric_limits<double>::infinity());
  if (mine) place = {(*mine)[0], (*mine)[1], (*mine)[2]};
  ranks.max(place);
  if (!std::isfinite(place[0])) return "";
  return fmt::format("; the greatest residual is {} at ({:g}, {:g}, {:g})", what, place[0], place[1], place[2]);
}

}  // namespace tushar::solvers
