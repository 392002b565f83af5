#include "components/analysis/exact_solution.hpp"

#include <map>
#include <optional>

#include "core/data/reduction.hpp"
#include "core/input/schema.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::analysis {

using data::CellLabel;
using data::Centring;
using data::Label;
using data::NodeLabel;
using data::Norm;
using data::ReductionLabel;
using grid::forEach;
using grid::Level;
using grid::Patch;
using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::Analysis;
using simulation::AnalysisKind;
using simulation::Component;
using simulation::MakeAnalysis;
using simulation::MeasuredError;
using tasks::computes;
using tasks::requiresNew;
using tasks::requiresOld;
using tasks::TaskList;
using tasks::with;

namespace {

struct Settings {
  std::string name, label;
  input::Expression value{0.0};
};

const Schema<Settings>& schema() {
  static const Schema<Settings> schema =
      Schema<Settings>("Module", "Errors of a variable against a formula, in the middle of cells or at nodes.")
          .requiredAttribute("name", &Settings::name, "1", "exactSolution")
          .required("label", &Settings::label, "1",
                    "a scalar variable of cells (c.) or nodes (g.) that belongs to no material")
          .ours()
          .required("value", &Settings::value, "SI unit of the variable", "its exact value")
          .ours();
  return schema;
}

/// A variable that can be measured, and whether diagnostics compute it from the state.
struct Measurable {
  Label label;
  bool derived;
};

/// The scalar variables of cells and nodes that a component has without a material, by name.
std::map<std::string, Measurable> measurables(const Component& component) {
  TaskList state, derived;
  component.scheduleInitialize(state);
  component.scheduleDiagnostics(derived);
  std::map<std::string, Measurable> found;
  for (const TaskList* list : {&state, &derived})
    for (const tasks::Task& task : list->tasks())
      for (const tasks::Access& access : task.accesses) {
        const Label& label = *access.label;
        const bool onGrid = label.centring == Centring::cell || label.centring == Centring::node;
        const bool scalar = label.number == data::Number::real && label.components == 1 && !label.isVector;
        if (access.writes() && onGrid && scalar && !task.perMaterial())
          found.try_emplace(std::string(label.name), Measurable{label, list == &derived});
      }
  return found;
}

/// The variable of that name. Throws InputError naming those that there are.
Measurable findMeasurable(const Component& component, const std::string& name, const Location& where) {
  const std::map<std::string, Measurable> found = measurables(component);
  if (const auto entry = found.find(name); entry != found.end()) return entry->second;
  std::vector<std::string> names;
  for (const auto& entry : found) names.push_back(entry.first);
  const std::string none =
      "this component has no scalar variable of cells or nodes without a material; take the module out";
  throw InputError({{where, "DataAnalysis/Module/label", names.empty() ? none : input::choiceProblem(name, names)}});
}

template <Centring C, int D>
void measure(const Patch& patch, const input::Expression& exact, const double* time,
             data::GridView<C, const double> field, Norm& error) {
  const Level& level = patch.level();
  forEach<D>(C == Centring::cell ? patch.cells() : patch.nodes(), [&](const Index<D>& at) {
    Vec<D> x;
    for (int d = 0; d < D; ++d) {
      if (C == Centring::node && at[d] == patch.cells().upper[d] && !patch.isAtBoundary(d, 1)) return;
      x[d] = C == Centring::cell ? level.cellCentre<D>(at)[d] : level.nodePosition(d, at[d]);
    }
    error.add(field[at] - exact(level.expandPoint<D>(x), *time), 0, level.weight());
  });
}

template <int D>
class ExactSolution : public Analysis {
 public:
  ExactSolution(Settings settings, const Measurable& measured)
      : settings_(std::move(settings)),
        derived_(measured.derived),
        error_name_(settings_.label + " error"),
        error_(error_name_, measured.label.unit, "error against the formula") {
    const Label& label = measured.label;
    if (label.centring == Centring::cell)
      cell_.emplace(label.name, label.unit, label.description);
    else
      node_.emplace(label.name, label.unit, label.description);
  }

  void schedule(TaskList& tasks) const override {
    if (cell_)
      add(tasks, *cell_);
    else
      add(tasks, *node_);
  }
  void setTime(double time, double) override { time_ = time; }
  std::vector<MeasuredError> errors() const override {
    return {{settings_.label.substr(2), cell_ ? "cell" : "node", &error_, {"L1", "L2", "max"}}};
  }
  std::vector<output::Array> exactProfile(const Level& level) const override {
    if constexpr (D > 1) return {};
    std::vector<double> x, value;
    constexpr int points = 1000;
    const double first = level.nodePosition(0, 0), last = level.nodePosition(0, level.cells().upper[0]);
    for (int k = 0; k <= points; ++k) {
      Vec<1> at;
      at[0] = first + (last - first) * k / points;
      x.push_back(at[0]);
      value.push_back(settings_.value(level.expandPoint<1>(at), time_));
    }
    return {{"x", "m", "position", 1, x},
            {settings_.label.substr(2), std::string(error_.unit), "exact value", 1, value}};
  }

 private:
  template <Centring C>
  void add(TaskList& tasks, const data::FieldLabel<C, double>& field) const {
    const auto measureFrom = [&](const auto& access) {
      tasks.perPatch("exactSolution::measure", measure<C, D>, with(settings_.value), with(&time_), access,
                     computes(error_));
    };
    derived_ ? measureFrom(requiresNew(field)) : measureFrom(requiresOld(field));
  }

  Settings settings_;
  bool derived_;
  std::optional<CellLabel<double>> cell_;
  std::optional<NodeLabel<double>> node_;
  std::string error_name_;
  ReductionLabel<Norm> error_;
  double time_ = 0;
};

}  // namespace

AnalysisKind exactSolutionKind() {
  AnalysisKind kind{"exactSolution", "errors of a variable against a formula in x, y, z, t", {}, {}};
  kind.describe = [](std::ostream& out) { schema().describe(out); };
  kind.schema = [] { return &schema(); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) -> MakeAnalysis {
    const Settings settings = schema().read(module, diagnostics);
    const Location where = (module.child("label") ? *module.child("label") : module).where();
    return [=](const Component& component, const Level& level) -> std::unique_ptr<Analysis> {
      const Measurable measured = findMeasurable(component, settings.label, where);
      if (level.dimension() == 1) return std::make_unique<ExactSolution<1>>(settings, measured);
      if (level.dimension() == 2) return std::make_unique<ExactSolution<2>>(settings, measured);
      return std::make_unique<ExactSolution<3>>(settings, measured);
    };
  };
  return kind;
}

}  // namespace tushar::analysis
