#include "components/mpm/solid/analysis/manufactured_error.hpp"

#include "components/mpm/solid/explicit/solid_mpm.hpp"
#include "core/input/schema.hpp"

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

struct Settings {
  std::string name;
};
const input::Schema<Settings>& settingsSchema() {
  static const input::Schema<Settings> schema =
      input::Schema<Settings>("Module", "Errors of particles against the solution of RunMMSProblem.")
          .requiredAttribute("name", &Settings::name, "1", "manufacturedError");
  return schema;
}

std::unique_ptr<simulation::Analysis> make(const Problem& problem, int dimension) {
  if (dimension == 1) return std::make_unique<ManufacturedError<1>>(problem);
  if (dimension == 2) return std::make_unique<ManufacturedError<2>>(problem);
  return std::make_unique<ManufacturedError<3>>(problem);
}

}  // namespace

simulation::AnalysisKind manufacturedErrorKind() {
  simulation::AnalysisKind kind{
      "manufacturedError", "errors of particles against the solution of RunMMSProblem", {}, {}};
  kind.describe = [](std::ostream& out) { settingsSchema().describe(out); };
  kind.schema = [] { return &settingsSchema(); };
  kind.read = [](const input::Element& module, input::Diagnostics& diagnostics) -> simulation::MakeAnalysis {
    settingsSchema().read(module, diagnostics);
    return [where = module.where(), path = module.path()](const Component& component,
                                                          const Level& level) -> std::unique_ptr<simulation::Analysis> {
      const auto* solids = dynamic_cast<const Solids*>(&component);
      if (!solids || !solids->problem().start.solution)
        throw InputError({{where, path,
                           "measures against the solution of <RunMMSProblem> in <MPM>, and there is none; "
                           "take the module out"}});
      return make(solids->problem(), level.dimension());
    };
  };
  return kind;
}

}  // namespace tushar::mpm::solid
