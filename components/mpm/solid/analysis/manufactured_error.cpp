#include "components/mpm/solid/analysis/manufactured_error.hpp"

#include <stdexcept>

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "core/simulation/plain_module.hpp"

namespace tushar::mpm::solid {

namespace {

constexpr ReductionLabel<Norm> displacementError{"DisplacementError", "m", "error of the particles' displacement"};
constexpr ReductionLabel<Norm> velocityError{"VelocityError", "m/s", "error of the particles' velocity"};

template <int D>
class ManufacturedError : public simulation::Analysis {
 public:
  /// The problem must outlive the module.
  explicit ManufacturedError(const Problem& problem) : problem_(&problem) {}

  void schedule(TaskList& tasks) const override {
    tasks.perMaterial("mpm::measureManufacturedError", measureManufacturedError<D>, problem_->materials,
                      with(problem_->start.solution.get()), with(&time_), requiresOld(p::x<D>),
                      requiresOld(p::displacement<D>), requiresOld(p::velocity<D>), computes(displacementError),
                      computes(velocityError));
  }
  void setTime(double time, double) override { time_ = time; }
  std::vector<simulation::MeasuredError> errors() const override {
    const std::vector<std::string> norms{"L1", "L2", "max", "relative"};
    return {{"displacement", "particle", &displacementError, norms}, {"velocity", "particle", &velocityError, norms}};
  }

 private:
  const Problem* problem_;
  double time_ = 0;
};

std::unique_ptr<simulation::Analysis> make(const Problem& problem, int dimension) {
  if (dimension == 1) return std::make_unique<ManufacturedError<1>>(problem);
  if (dimension == 2) return std::make_unique<ManufacturedError<2>>(problem);
  return std::make_unique<ManufacturedError<3>>(problem);
}

std::unique_ptr<simulation::Analysis> makeManufacturedError(const Component& component, const Level& level) {
  const auto* solids = dynamic_cast<const Solids*>(&component);
  if (!solids || !solids->problem().start.solution)
    throw std::invalid_argument(
        "compares with the solution of <RunMMSProblem> in <MPM>, which is missing; remove the module");
  return make(solids->problem(), level.dimension());
}

}  // namespace

simulation::AnalysisKind manufacturedErrorKind() {
  return simulation::plainModule("manufacturedError", "errors of particles relative to the solution of RunMMSProblem",
                                 "Errors of particles relative to the solution of RunMMSProblem.",
                                 makeManufacturedError);
}

}  // namespace tushar::mpm::solid
