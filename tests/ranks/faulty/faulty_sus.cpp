#include "components/components.hpp"
#include "components/heat/heat.hpp"
#include "tools/program.hpp"

// sus, but its component heat throws on the patch with the middle of the grid once it is cold there.

namespace {

using namespace tushar;

class Faulty : public simulation::Component {
 public:
  explicit Faulty(std::unique_ptr<simulation::Component> heat) : heat_(std::move(heat)) {}

  void scheduleInitialize(tasks::TaskList& tasks) const override { heat_->scheduleInitialize(tasks); }
  void scheduleComputeStableTimeStep(tasks::TaskList& tasks) const override {
    tasks.perPatch("faulty::fail", failWhereCold, requiresOld(heat::c::temperature), computes(delT));
  }
  void scheduleTimeAdvance(tasks::TaskList& tasks) const override { heat_->scheduleTimeAdvance(tasks); }
  void scheduleDiagnostics(tasks::TaskList& tasks) const override { heat_->scheduleDiagnostics(tasks); }

 private:
  static void failWhereCold(const Patch& patch, CellView<const double> temperature, Minimum& dt) {
    constexpr double cold = 0.99;      // K
    constexpr double timeStep = 1e-5;  // s
    const Index<1> middle{{patch.level().cells().upper[0] / 2}};
    if (patch.cells().contains(middle) && temperature[middle] < cold) throw std::logic_error("made to fail");
    dt.add(timeStep, "fixed");
  }

  std::unique_ptr<simulation::Component> heat_;
};

/// Returns all components, with a faulty one in place of heat.
simulation::Catalogue faultyCatalogue(const std::vector<std::string>&) {
  const simulation::Catalogue known = catalogue();
  std::vector<simulation::ComponentKind> components;
  for (const simulation::ComponentKind* kind : known.components()) components.push_back(*kind);
  for (simulation::ComponentKind& kind : components) {
    if (kind.name != "heat") continue;
    kind.read = [read = kind.read](const input::Element& root,
                                   input::Diagnostics& diagnostics) -> simulation::MakeComponent {
      return
          [make = read(root, diagnostics)](const grid::Level& level) { return std::make_unique<Faulty>(make(level)); };
    };
  }
  std::vector<simulation::AnalysisKind> analyses;
  for (const simulation::AnalysisKind* kind : known.analyses()) analyses.push_back(*kind);
  return {components, analyses};
}

}  // namespace

int main(int count, char** words) { return runProgram(count, words, faultyCatalogue); }
