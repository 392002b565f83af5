#include "components/analysis/particle_extract.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "components/analysis/sampling.hpp"
#include "core/data/label.hpp"
#include "core/input/schema.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using input::Diagnostics;
using input::Element;
using input::Schema;
using output::Array;
using simulation::AnalysisKind;

namespace {

constexpr std::string_view colorLabel = "p.color";

struct Variable {
  Location where;
  std::string label;
};

struct Variables {
  std::vector<Variable> list;
};

struct ExtractSettings : Times {
  std::string name;
  Location where;
  std::string material;
  double threshold = 0;
  Variables variables;
};

const Schema<Variables>& variablesSchema() {
  static const Schema<Variable> variable =
      Schema<Variable>("analyze", "A particle variable.")
          .location(&Variable::where, "label")
          .requiredAttribute("label", &Variable::label, "1", "its name, such as p.velocity")
          .ignoredAttribute("matl", "<material> of the module applies to all variables");
  static const Schema<Variables> schema = Schema<Variables>("Variables", "The variables that are written.")
                                              .list("analyze", &Variables::list, variable, "a particle variable", 1);
  return schema;
}

void checkVariables(const ExtractSettings& read, const input::Element& module, input::Diagnostics& diagnostics) {
  for (const Variable& variable : read.variables.list)
    if (!variable.label.starts_with("p."))
      diagnostics.error(variable.where, module.path() + "/Variables/analyze",
                        fmt::format("found '{}', expected a particle variable (p.)", variable.label));
}

const Schema<ExtractSettings>& extractSchema() {
  static const Schema<ExtractSettings> schema = [] {
    Schema<ExtractSettings> tags("Module", "Variables of selected particles over time, one file per particle.");
    addTimes(tags);
    return tags.requiredAttribute("name", &ExtractSettings::name, "1", "particleExtract")
        .location(&ExtractSettings::where)
        .value("material", &ExtractSettings::material, "", "1",
               "name of the material whose particles are sampled; the first by default")
        .required("colorThreshold", &ExtractSettings::threshold, "1",
                  "only particles whose p.color is greater than this are written")
        .requiredSection("Variables", &ExtractSettings::variables, variablesSchema(), "the variables that are written")
        .check(checkVariables);
  }();
  return schema;
}

/// The values of a variable; null if no task computes it in this scene, which a note says.
const Array* column(const std::vector<Array>& columns, std::string_view label) {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Array& array) { return array.label == label; });
  return found == columns.end() ? nullptr : &*found;
}

class ParticleExtract : public Analysis {
 public:
  explicit ParticleExtract(ExtractSettings settings) : settings_(std::move(settings)), times_(settings_) {}

  bool takesSeveralBoxes() const override { return true; }
  void schedule(tasks::TaskList&) const override {}
  void setTime(double time, double sinceStart) override {
    time_ = time;
    times_.pass(time, sinceStart);
  }

  std::vector<SaveRequest> samples() const override {
    std::vector<SaveRequest> requests{request({settings_.where, std::string(colorLabel)}),
                                      request({settings_.where, std::string(data::particleId.name)})};
    for (const Variable& variable : settings_.variables.list) requests.push_back(request(variable));
    return requests;
  }
  bool isSampleDue(int) const override { return times_.isDue(); }
  std::vector<simulation::OwnFile> files() const override { return {{"particleExtract", settings_.where}}; }

  void sample(const std::vector<output::Snapshot>& parts, const std::filesystem::path& archive) override {
    const output::Snapshot& snapshot = parts.front();
    const auto block = std::find_if(snapshot.particles.begin(), snapshot.particles.end(), [&](const auto& b) {
      return settings_.material.empty() || b.material == settings_.material;
    });
    if (block == snapshot.particles.end()) return;
    const auto folder = archive / "particleExtract" / "L-0";
    output::makeFolder(folder);
    const auto& color = std::get<std::vector<double>>(column(block->arrays, colorLabel)->values);
    const auto& ids = std::get<std::vector<std::uint64_t>>(column(block->arrays, data::particleId.name)->values);
    Columns columns{block->arrays.front()};
    for (const Variable& variable : settings_.variables.list)
      if (const Array* values = column(block->arrays, variable.label)) columns.emplace_back(*values);
    std::stable_sort(columns.begin() + 1, columns.end(),
                     [](const Array& a, const Array& b) { return a.components < b.components; });
    const std::string header = extractHeader(columns);
    for (std::size_t p = 0; p < ids.size(); ++p)
      if (color[p] > settings_.threshold)
        files_.add(folder / std::to_string(ids[p]), header, extractLine(time_, columns, p), time_);
  }

 private:
  SaveRequest request(const Variable& variable) const {
    return {variable.label, settings_.material, variable.where, settings_.where};
  }

  ExtractSettings settings_;
  double time_ = 0;
  SampleTimes times_;
  SampleFiles files_;
};

}  // namespace

std::string extractHeader(const Columns& columns) {
  std::string line = "# Time    X      Y      Z     ";
  for (std::size_t k = 1; k < columns.size(); ++k) {
    const Array& array = columns[k];
    if (array.components == 1) line += fmt::format("     {}", array.label);
    if (array.components == 3) line += fmt::format("     {0}.x      {0}.y      {0}.z", array.label);
    for (int row = 0; row < 3 && array.components == 9; ++row)
      line += fmt::format("     {0}({1},0)      {0}({1},1)      {0}({1},2)", array.label, row);
  }
  return line + '\n';
}

std::string extractLine(double time, const Columns& columns, std::size_t entry) {
  std::string line = fmt::format("{:E}\t", time);
  const auto end = std::back_inserter(line);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Array& array = columns[k];
    const std::size_t components = array.components;
    std::visit(
        [&](const auto& values) {
          for (std::size_t i = 0; i < components; ++i) {
            const auto value = values[entry * components + i];
            if constexpr (!std::is_floating_point_v<std::decay_t<decltype(value)>>)
              fmt::format_to(end, "    {}", value);
            else if (k == 0)
              fmt::format_to(end, " {:E}\t", value);
            else
              fmt::format_to(end, "    {:16E}", value);
          }
        },
        array.values);
  }
  return line + '\n';
}

AnalysisKind particleExtractKind() {
  return simulation::moduleWithTags<ParticleExtract>(
      "particleExtract", "variables of selected particles over time, one file per particle", extractSchema());
}

}  // namespace tushar::analysis
