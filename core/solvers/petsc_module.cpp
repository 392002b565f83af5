#include "core/solvers/petsc_objects.hpp"

// The interface of the library: one solver.

namespace tushar::solvers {

namespace {

class PetscSolver : public Solver {
 public:
  Outcome solve(const Unknowns& unknowns, const LinearProblem& problem, const LinearSettings& settings,
                std::span<double> x) const override {
    return solveLinear(unknowns, problem, settings, x);
  }
  Outcome solve(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings,
                std::span<double> u) const override {
    return solveNewton(unknowns, problem, settings, u);
  }
  void addUp(const Unknowns& unknowns, std::span<double> values) const override {
    startPetsc();
    GhostedVector(unknowns).addUp(values);
  }
  std::vector<std::string> unusedOptions() const override { return PetscOptionsOfSolve::unused(); }
  std::string version() const override {
    PetscInt major = 0, minor = 0, subminor = 0;
    PetscGetVersionNumber(&major, &minor, &subminor, nullptr);
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(subminor);
  }
};

}  // namespace

}  // namespace tushar::solvers

extern "C" [[gnu::visibility("default")]] const tushar::solvers::Solver* tusharSolver() {
  static const tushar::solvers::PetscSolver solver;
  return &solver;
}
