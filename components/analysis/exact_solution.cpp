#include "components/analysis/exact_solution.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <type_traits>
#include <variant>

#include "core/data/reduction.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/module_with_tags.hpp"
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
using input::Element;
using input::Schema;
using simulation::Analysis;
using simulation::AnalysisKind;
using simulation::Component;
using simulation::MeasuredError;
using tasks::computes;
using tasks::requiresNew;
using tasks::requiresOld;
using tasks::TaskList;
using tasks::with;

namespace {

struct ExactSolutionSettings {
  std::string name, label;
  std::optional<int> component;
  input::Expression value{0.0};

  /// The name of the variable in the report.
  std::string field() const {
    return component ? label.substr(2) + "." + std::string(1, "xyz"[*component]) : label.substr(2);
  }
};

const Schema<ExactSolutionSettings>& exactSolutionSchema() {
  static const Schema<ExactSolutionSettings> schema =
      Schema<ExactSolutionSettings>("Module",
                                    "Errors of a variable relative to a formula, at the centres of cells or at nodes.")
          .requiredAttribute("name", &ExactSolutionSettings::name, "1", "exactSolution")
          .required("label", &ExactSolutionSettings::label, "1",
                    "a cell (c.) or node (g.) variable that belongs to no material")
          .ours()
          .optionalChoice("component", &ExactSolutionSettings::component, {{"x", 0}, {"y", 1}, {"z", 2}},
                          "the component of a vector variable")
          .ours()
          .required("value", &ExactSolutionSettings::value, "SI unit of the variable", "exact value of the variable")
          .ours();
  return schema;
}

/// A variable that can be compared with an exact solution, and whether diagnostics compute it from the state.
struct Measurable {
  Label label;
  bool derived;
};

/// The cell and node variables of a component that belong to no material, by name: its vectors or its scalars.
std::map<std::string, Measurable> measurables(const Component& component, bool vectors) {
  TaskList state, derived;
  component.scheduleInitialize(state);
  component.scheduleDiagnostics(derived);
  std::map<std::string, Measurable> found;
  for (const TaskList* list : {&state, &derived})
    for (const tasks::Task& task : list->tasks())
      for (const tasks::Access& access : task.accesses) {
        const Label& label = *access.label;
        const bool onGrid = label.centring == Centring::cell || label.centring == Centring::node;
        const bool isReal = label.number == data::Number::real;
        const bool fits = isReal && (vectors ? label.isVector : label.components == 1 && !label.isVector);
        if (access.writes() && onGrid && fits && !task.perMaterial(access))
          found.try_emplace(std::string(label.name), Measurable{label, list == &derived});
      }
  return found;
}

/// The variable that the settings name. Throws InputError, which lists the available ones, if there is none.
Measurable findMeasurable(const Component& component, const ExactSolutionSettings& settings, const Location& where) {
  const std::string& name = settings.label;
  const std::map<std::string, Measurable> found = measurables(component, settings.component.has_value());
  if (const auto entry = found.find(name); entry != found.end()) return entry->second;
  if (!settings.component && measurables(component, true).contains(name))
    throw InputError(
        {{where, "DataAnalysis/Module/label", fmt::format("'{}' is a vector: give its <component>, x, y or z", name)}});
  std::vector<std::string> names;
  for (const auto& entry : found) names.push_back(entry.first);
  const std::string none =
      fmt::format("this component has no {} cell or node variable without a material; remove the module",
                  settings.component ? "vector" : "scalar");
  throw InputError({{where, "DataAnalysis/Module/label", names.empty() ? none : input::choiceProblem(name, names)}});
}

/// Adds to `error` the errors of a scalar field, or of one component of a vector field, on a patch.
template <Centring C, int D, class T>
void measure(const Patch& patch, const ExactSolutionSettings& settings, const double* time,
             data::GridView<C, const T> field, Norm& error) {
  const Level& level = patch.level();
  const auto found = [&](const T& value) {
    if constexpr (std::is_same_v<T, double>)
      return value;
    else
      return level.expandDirection<D>(value)[*settings.component];
  };
  forEach<D>(C == Centring::cell ? patch.cells() : patch.nodes(), [&](const Index<D>& at) {
    Vec<D> x;
    for (int d = 0; d < D; ++d) {
      if (C == Centring::node && at[d] == patch.cells().upper[d] && !patch.isAtBoundary(d, 1)) return;
      x[d] = C == Centring::cell ? level.cellCentre<D>(at)[d] : level.nodePosition(d, at[d]);
    }
    error.add(found(field[at]) - settings.value(level.expandPoint<D>(x), *time), 0, level.weight());
  });
}

template <int D>
class ExactSolution : public Analysis {
 public:
  ExactSolution(ExactSolutionSettings settings, const Measurable& measured)
      : settings_(std::move(settings)),
        derived_(measured.derived),
        label_(labelOf(measured.label)),
        error_name_(settings_.label.substr(0, 2) + settings_.field() + " error"),
        error_(error_name_, measured.label.unit, "error relative to the formula") {}

  void schedule(TaskList& tasks) const override {
    std::visit([&](const auto& label) { add(tasks, label); }, label_);
  }
  void setTime(double time, double) override { time_ = time; }
  std::vector<MeasuredError> errors() const override {
    const bool ofCells = label_.index() < 2;
    return {{settings_.field(), ofCells ? "cell" : "node", &error_, {"L1", "L2", "max"}}};
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
    return {{"x", "m", "position", 1, x}, {settings_.field(), std::string(error_.unit), "exact value", 1, value}};
  }

 private:
  using AnyLabel = std::variant<CellLabel<double>, CellLabel<Vec<D>>, NodeLabel<double>, NodeLabel<Vec<D>>>;

  static AnyLabel labelOf(const Label& label) {
    const bool ofCells = label.centring == Centring::cell;
    if (label.isVector)
      return ofCells ? AnyLabel(CellLabel<Vec<D>>(label.name, label.unit, label.description))
                     : AnyLabel(NodeLabel<Vec<D>>(label.name, label.unit, label.description));
    return ofCells ? AnyLabel(CellLabel<double>(label.name, label.unit, label.description))
                   : AnyLabel(NodeLabel<double>(label.name, label.unit, label.description));
  }

  template <Centring C, class T>
  void add(TaskList& tasks, const data::FieldLabel<C, T>& field) const {
    const auto measureFrom = [&](const auto& access) {
      tasks.perPatch("exactSolution::measure", measure<C, D, T>, with(settings_), with(&time_), access,
                     computes(error_));
    };
    derived_ ? measureFrom(requiresNew(field)) : measureFrom(requiresOld(field));
  }

  ExactSolutionSettings settings_;
  bool derived_;
  AnyLabel label_;
  std::string error_name_;
  ReductionLabel<Norm> error_;
  double time_ = 0;
};

}  // namespace

AnalysisKind exactSolutionKind() {
  return simulation::moduleMadeBy(
      "exactSolution", "errors of a variable relative to a formula in x, y, z, t", exactSolutionSchema(),
      [](const ExactSolutionSettings& settings, const Element& module, const Component& component, const Level& level) {
        const Location where = (module.child("label") ? *module.child("label") : module).where();
        return simulation::analysisByDimension<ExactSolution>(level, settings,
                                                              findMeasurable(component, settings, where));
      });
}

}  // namespace tushar::analysis
