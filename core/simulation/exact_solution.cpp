#include "core/simulation/exact_solution.hpp"

#include <optional>

#include "core/data/reduction.hpp"
#include "core/input/schema.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::simulation {

using data::CellLabel;
using data::NodeLabel;
using data::Norm;
using data::ReductionLabel;
using grid::forEach;
using grid::Level;
using grid::Patch;
using input::Diagnostics;
using input::Element;
using input::Schema;
using tasks::computes;
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
          .required("label", &Settings::label, "1", "a scalar cell (c.) or node (g.) variable")
          .ours()
          .required("value", &Settings::value, "SI unit of the variable", "its exact value")
          .ours()
          .check([](const Settings& settings, const Element& element, Diagnostics& diagnostics) {
            if (!settings.label.starts_with("c.") && !settings.label.starts_with("g."))
              diagnostics.error(element, "label: found '" + settings.label +
                                             "', expected a cell variable (c.…) or a node variable (g.…)");
          });
  return schema;
}

template <data::Centring C, int D>
void measure(const Patch& patch, const input::Expression& exact, const double* time,
             data::GridView<C, const double> field, Norm& error) {
  const Level& level = patch.level();
  forEach<D>(C == data::Centring::cell ? patch.cells() : patch.nodes(), [&](const Index<D>& at) {
    Vec<D> x;
    for (int d = 0; d < D; ++d) {
      if (C == data::Centring::node && at[d] == patch.cells().upper[d] && !patch.isAtBoundary(d, 1)) return;
      x[d] = C == data::Centring::cell ? level.cellCentre<D>(at)[d] : level.nodePosition(d, at[d]);
    }
    error.add(field[at] - exact(level.expandPoint<D>(x), *time));
  });
}

template <int D>
class ExactSolution : public Analysis {
 public:
  explicit ExactSolution(Settings settings)
      : settings_(std::move(settings)),
        error_name_(settings_.label + " error"),
        error_(error_name_, "", "error against the formula") {
    if (settings_.label.starts_with(CellLabel<double>::prefix()))
      cell_.emplace(settings_.label, "", "");
    else
      node_.emplace(settings_.label, "", "");
  }

  void schedule(TaskList& tasks) const override {
    if (cell_)
      add(tasks, *cell_);
    else
      add(tasks, *node_);
  }
  void setTime(double time) override { time_ = time; }
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
    return {{"x", "m", "position", 1, x}, {settings_.label.substr(2), "", "exact value", 1, value}};
  }

 private:
  template <data::Centring C>
  void add(TaskList& tasks, const data::FieldLabel<C, double>& field) const {
    tasks.perPatch("exactSolution::measure", measure<C, D>, with(settings_.value), with(&time_), requiresOld(field),
                   computes(error_));
  }

  Settings settings_;
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
  kind.read = [](const Element& module, Diagnostics& diagnostics) -> MakeAnalysis {
    const Settings settings = schema().read(module, diagnostics);
    return [settings](const Component&, const Level& level) -> std::unique_ptr<Analysis> {
      if (level.dimension() == 1) return std::make_unique<ExactSolution<1>>(settings);
      if (level.dimension() == 2) return std::make_unique<ExactSolution<2>>(settings);
      return std::make_unique<ExactSolution<3>>(settings);
    };
  };
  return kind;
}

}  // namespace tushar::simulation
