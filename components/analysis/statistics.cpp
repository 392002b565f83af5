#include "components/analysis/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "components/analysis/summed_variable.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using input::Element;
using input::Schema;
using simulation::AnalysisKind;
using simulation::SampledVariable;

namespace {

constexpr const char* variablesPath = "DataAnalysis/Module/Variables/analyze";

struct Averaged {
  Location where, whereOfMaterial;
  std::string label, material;
  bool isVelocity = false;  ///< whether it is the velocity with which products are formed
};
struct AveragedList {
  std::vector<Averaged> list;
};
struct StatisticsSettings : SamplesBetween {
  Location where;
  std::string name, material;
  bool isOfHigherOrder = false, isOfFluxes = false;
  AveragedList variables;
};

Schema<AveragedList> averagedSchema(const std::string& velocityAttribute, const std::string& sentence) {
  static std::map<std::string, Schema<Averaged>> schemas;
  const auto [found, isNew] = schemas.try_emplace(velocityAttribute, "analyze", "A variable of cells.");
  if (isNew)
    found->second.location(&Averaged::where, "label")
        .location(&Averaged::whereOfMaterial, "matl")
        .requiredAttribute("label", &Averaged::label, "1", "its name, such as press_CC or c.pressure")
        .attributeValue("matl", &Averaged::material, "", "1", "index of its material; by default that of the module")
        .attributeValue(velocityAttribute, &Averaged::isVelocity, false, "1", sentence);
  return Schema<AveragedList>("Variables", "The variables whose statistics are computed.")
      .list("analyze", &AveragedList::list, found->second, "a variable of cells", 1);
}

void checkWindow(const StatisticsSettings& read, const Element& module, input::Diagnostics& diagnostics) {
  if (read.start > read.stop)
    diagnostics.error(*module.child("timeStop"),
                      fmt::format("found {:g} s, expected timeStart, {:g} s, or later", read.stop, read.start));
  const auto& all = read.variables.list;
  if (std::count_if(all.begin(), all.end(), [](const Averaged& one) { return one.isVelocity; }) > 1)
    diagnostics.error(module, "two variables are said to be the velocity; keep one");
}

Schema<StatisticsSettings> commonSchema(const std::string& name, const std::string& sentence,
                                        const Schema<AveragedList>& variables) {
  double StatisticsSettings::*const start = &SamplesBetween::start;
  double StatisticsSettings::*const stop = &SamplesBetween::stop;
  return Schema<StatisticsSettings>("Module", sentence)
      .requiredAttribute("name", &StatisticsSettings::name, "1", name)
      .location(&StatisticsSettings::where)
      .value("material", &StatisticsSettings::material, "", "1",
             "name of the material of variables without matl; the first by default")
      .required("timeStart", start, "s", "steps that end before this time are no samples")
      .required("timeStop", stop, "s", "steps that end after this time are no samples")
      .ignored("samplingFrequency", "every step from timeStart to timeStop is a sample")
      .ignored("monitorCell", "the statistics of every cell can be saved")
      .requiredSection("Variables", &StatisticsSettings::variables, variables, "the variables")
      .check(checkWindow);
}

const Schema<StatisticsSettings>& statisticsSchema() {
  static const Schema<AveragedList> variables =
      averagedSchema("computeReynoldsStress", "whether to compute uv_vw_wu_prime with this variable, the velocity");
  static const Schema<StatisticsSettings> schema =
      commonSchema("statistics",
                   "Means and central moments of variables over time: mean_X, variance_X, …, which can be saved.",
                   variables)
          .value("computeHigherOrderStats", &StatisticsSettings::isOfHigherOrder, false, "1",
                 "whether to compute skewness_X and kurtosis_X, the third and the fourth central moment");
  return schema;
}

const Schema<StatisticsSettings>& fluxesSchema() {
  static const Schema<AveragedList> variables =
      averagedSchema("fluidVelocityLabel", "whether this variable is the velocity, of which each scene needs one");
  static const Schema<StatisticsSettings> schema =
      commonSchema("turbulentFluxes",
                   "Means and variances of variables over time, and their covariances with the velocity: mean_X, "
                   "variance_X, covariance_X, …, which can be saved.",
                   variables)
          .check([](const StatisticsSettings& read, const Element& module, input::Diagnostics& diagnostics) {
            const auto& all = read.variables.list;
            if (std::none_of(all.begin(), all.end(), [](const Averaged& one) { return one.isVelocity; }))
              diagnostics.error(module, "missing attribute fluidVelocityLabel=\"true\" at the velocity");
          });
  return schema;
}

/// The variables of cells without a material that exist after a step, by name.
std::map<std::string, CellVariable, std::less<>> cellVariablesOf(const Component& component) {
  std::map<std::string, CellVariable, std::less<>> found;
  TaskList state, derived;
  component.scheduleInitialize(state);
  component.scheduleDiagnostics(derived);
  for (const TaskList* list : {&state, &derived})
    for (const tasks::Task& task : list->tasks())
      for (const tasks::Access& access : task.accesses)
        if (access.writes() && access.label->centring == data::Centring::cell && !task.perMaterial(access))
          found.emplace(access.label->name, CellVariable{access.label, list == &derived});
  return found;
}

std::string withoutPrefix(const std::string& name) { return name.starts_with("c.") ? name.substr(2) : name; }

NamesOfSums namesFor(const StatisticsSettings& settings, const Averaged& one) {
  const std::string name = withoutPrefix(one.label);
  if (settings.isOfFluxes)
    return {name,
            "mean_" + name + "2",
            "sum_" + name + "2",
            "covariance_" + name,
            "mean_Qu_Qv_Qw_" + name,
            "sum_Qu_Qv_Qw_" + name};
  return {name, "mean2_" + name, "sum2_" + name, "uv_vw_wu_prime", "mean_uv_vw_wu", "sum_uv_vw_wu"};
}

template <int D>
class Statistics : public simulation::Analysis {
 public:
  Statistics(const StatisticsSettings& settings, const Component& component)
      : settings_(settings), component_(component), known_(cellVariablesOf(component)) {
    const auto& list = settings.variables.list;
    const auto velocity = std::find_if(list.begin(), list.end(), [](const Averaged& one) { return one.isVelocity; });
    if (velocity != list.end()) {
      velocity_ = known(*velocity);
      if (velocity_.label && !isVectorOfAxes(*velocity_.label))
        refuse(*velocity, fmt::format("found '{}', which is not a vector, expected a velocity", velocity->label));
      velocity_name_ = withoutPrefix(velocity->label);
    }
    for (const Averaged& one : list) add(one);
  }

  void schedule(TaskList& tasks) const override {
    for (const auto& one : summed_) one->scheduleDerived(tasks, count_.label());
  }
  void scheduleAfterStep(TaskList& tasks) const override {
    if (summed_.empty()) return;
    tasks.perPatch("statistics::countSample", countSample<D>, with(between()), startTime(), requiresOld(count_.label()),
                   computes(count_.label()));
    for (const auto& one : summed_) one->scheduleSums(tasks, between(), count_.label());
  }
  bool isDueAfterStep(double time) const override { return settings_.contains(time); }
  void setTime(double, double) override {}
  std::vector<SampledVariable>* variables() override { return &variables_; }
  simulation::OtherNames otherNames() const override {
    simulation::OtherNames all;
    for (const auto& one : summed_)
      for (auto& name : one->names()) all.push_back(std::move(name));
    return all;
  }

 private:
  /// The name of its first variable, which no other module has.
  std::string firstName() const {
    const auto& list = settings_.variables.list;
    return list.empty() ? "" : withoutPrefix(list.front().label);
  }
  const SamplesBetween& between() const { return settings_; }
  static bool isVectorOfAxes(const data::Label& label) { return label.isVector && label.components == D; }
  [[noreturn]] static void refuse(const Averaged& one, const std::string& sentence) {
    throw InputError({{one.where, variablesPath, sentence}});
  }
  /// The variable that the scene names; none if it is one of Uintah's that no task computes.
  CellVariable known(const Averaged& one) const {
    std::string label = one.label;
    for (const auto& [theirs, ours] : component_.otherNames())
      if (theirs == one.label) label = ours;
    if (const auto found = known_.find(label); found != known_.end()) return found->second;
    const std::vector<std::string> foreign = component_.foreignLabels();
    if (one.label != "vorticity" && std::find(foreign.begin(), foreign.end(), label) != foreign.end()) return {};
    std::vector<std::string> names;
    for (const auto& [name, variable] : known_) names.push_back(name);
    refuse(one, fmt::format("found '{}', expected a variable of cells that belongs to no material{}; available: {}",
                            one.label, didYouMean(label, names), allOf(names)));
  }
  void add(const Averaged& one) {
    if (!names_.insert(withoutPrefix(one.label)).second) refuse(one, fmt::format("'{}' is given twice", one.label));
    const std::string& material = one.material.empty() ? settings_.material : one.material;
    const CellVariable variable = known(one);
    const std::string label = variable.label ? std::string(variable.label->name) : one.label;
    variables_.push_back(
        {{label, material, one.where, one.material.empty() ? settings_.where : one.whereOfMaterial}, one.label});
    if (!variable.label) return;  // a note says so
    const bool isReal = variable.label->number == data::Number::real;
    if (isReal && isVectorOfAxes(*variable.label))
      addOf<Vec<D>>(variable, one);
    else if (isReal && variable.label->components == 1)
      addOf<double>(variable, one);
    else
      refuse(one, fmt::format("found '{}', expected a number or a vector in each cell", one.label));
  }
  template <class T>
  void addOf(const CellVariable& variable, const Averaged& one) {
    const bool hasProducts = settings_.isOfFluxes || (one.isVelocity && withoutPrefix(one.label) == velocity_name_);
    const CellVariable with = hasProducts ? velocity_ : CellVariable{};
    const NamesOfSums names = namesFor(settings_, one);
    if (settings_.isOfHigherOrder)
      summed_.push_back(std::make_unique<SummedVariableOf<D, T, 4>>(variable, with, names, velocity_name_));
    else
      summed_.push_back(std::make_unique<SummedVariableOf<D, T, 2>>(variable, with, names, velocity_name_));
  }

  StatisticsSettings settings_;
  const Component& component_;
  std::map<std::string, CellVariable, std::less<>> known_;
  CellVariable velocity_;
  std::string velocity_name_;
  std::set<std::string> names_;
  std::vector<SampledVariable> variables_;
  std::vector<std::unique_ptr<SummedVariable>> summed_;
  OwnLabel<double> count_{"samples_" + firstName(), "1", "number of samples of statistics over time"};
};

AnalysisKind kindOf(const std::string& name, const std::string& sentence, const Schema<StatisticsSettings>& schema) {
  return simulation::moduleMadeBy(
      name, sentence, schema,
      [](const StatisticsSettings& settings, const Element&, const Component& component, const Level& level) {
        StatisticsSettings all = settings;
        all.isOfFluxes = settings.name == "turbulentFluxes";
        return simulation::analysisByDimension<Statistics>(level, all, component);
      });
}

}  // namespace

AnalysisKind statisticsKind() {
  return kindOf("statistics", "means and central moments of variables over time", statisticsSchema());
}

AnalysisKind turbulentFluxesKind() {
  return kindOf("turbulentFluxes", "covariances of variables with the velocity over time", fluxesSchema());
}

}  // namespace tushar::analysis
