#include "components/analysis/plane_average.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "components/analysis/sampling.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using grid::Level;
using simulation::AnalysisKind;

namespace {

struct Weight {
  Location where;
  std::string label;
};

struct AverageSettings : Sampling {
  int axis = 0;  ///< axis perpendicular to the planes
  std::optional<Weight> weight;
};

void checkWeight(const AverageSettings& read, const input::Element& module, input::Diagnostics& diagnostics) {
  const auto& all = read.variables.list;
  const auto refuseNodes = [&](const std::string& label, const Location& where, std::string_view tag) {
    if (label.starts_with("g.") || label.starts_with("p."))
      diagnostics.error(where, fmt::format("{}/{}", module.path(), tag),
                        fmt::format("found '{}', expected a cell variable (c.)", label));
  };
  for (const Analyzed& one : all) refuseNodes(one.label, one.where, "Variables/analyze");
  if (read.weight) refuseNodes(read.weight->label, read.weight->where, "weight");
  const auto isWeighted = [](const Analyzed& one) { return one.weighting == Weighting::weight; };
  if (!read.weight && std::any_of(all.begin(), all.end(), isWeighted))
    diagnostics.error(module, "missing tag <weight> in <Module>: weighting=\"mass\" needs it");
}

const input::Schema<AverageSettings>& averageSchema() {
  static const input::Schema<Weight> weight =
      input::Schema<Weight>("weight", "The variable whose sum divides the sums of variables with weighting=\"mass\".")
          .location(&Weight::where, "label")
          .requiredAttribute("label", &Weight::label, "1", "a cell variable, such as c.density");
  static const input::Schema<AverageSettings> schema =
      samplingSchema<AverageSettings>(
          "planeAverage",
          "Means over planes of cells (of the coarsest ones, if there are several levels), one "
          "file per variable and time.",
          weightedSchema())
          .requiredChoice("planeOrientation", &AverageSettings::axis, {{"YZ", 0}, {"XZ", 1}, {"XY", 2}},
                          "the axes along which the planes lie")
          .section("weight", &AverageSettings::weight, weight,
                   "the variable whose sum divides the sums of variables with weighting=\"mass\"")
          .check(checkWeight);
  return schema;
}

class PlaneAverage : public SamplingModule {
 public:
  PlaneAverage(const AverageSettings& settings, const Level& level) : SamplingModule(settings), level_(&level) {
    for (int d = 0; d < level.dimension(); ++d)
      if (level.axis(d) == settings.axis) across_ = d;
    for (const Analyzed& one : settings.variables.list) weightings_[one.where.text()] = one.weighting;
    if (!settings.weight) return;
    const auto& [where, label] = *settings.weight;
    weight_ = where.text();
    variables_.push_back({{label, settings.material, where, settings.where}, label});
  }

  std::optional<collect::SummaryOver> summary() const override { return collect::SummaryOver{across_}; }

  std::vector<simulation::OwnFile> files() const override {
    std::vector<simulation::OwnFile> files = filesIn("planeAverage");
    std::erase_if(files, [&](const simulation::OwnFile& file) { return file.where.text() == weight_; });
    return files;
  }

  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& archive) override {
    const Snapshot& sums = parts[2];
    const auto folder = archive / "planeAverage" / output::stepName(sums.step) / "L-0";
    output::makeFolder(folder);
    const std::vector<Found> all = findAll(sums);
    const auto weight = std::find_if(all.begin(), all.end(),
                                     [&](const Found& one) { return one.variable->request.where.text() == weight_; });
    for (const Found& found : all) {
      const auto weighting = weightings_.find(found.variable->request.where.text());
      const bool isOfCells = found.field->centring == output::Centring::cell;
      if (weighting == weightings_.end() || !isOfCells) continue;
      const bool isWeighted = weighting->second == Weighting::weight;
      if (isWeighted && weight == all.end()) continue;  // a note says that no task computes it
      if (isWeighted && weight->field->array.components != 1)
        throw InputError({{weight->variable->request.where, "DataAnalysis/Module/weight",
                           fmt::format("'{}' has {} components; a weight has one", weight->field->array.label,
                                       weight->field->array.components)}});
      output::replaceFile(folder / nameOf(*found.variable), textOf(sums.time, found.field->array, weighting->second,
                                                                   isWeighted ? &weight->field->array : nullptr));
    }
  }

 private:
  /// Number of cells per plane. On a grid of several levels, it counts coarsest cells; finer cells count by their
  /// volume.
  int cellsPerPlane() const {
    int cells = 1;
    for (int d = 0; d < level_->dimension(); ++d)
      if (d != across_) cells *= level_->cells().extent(d) >> level_->number();
    return cells;
  }

  Vec3 middleOf(std::size_t plane) const {
    Vec3 middle = 0.5 * (level_->domain().lower + level_->domain().upper);
    if (across_ >= 0) {
      const auto node = [&](int at) { return level_->nodePosition(across_, at << level_->number()); };
      const int cell = static_cast<int>(plane);
      middle[level_->axis(across_)] = 0.5 * (node(cell) + node(cell + 1));
    }
    return middle;
  }

  std::string textOf(double time, const output::Array& sums, Weighting weighting, const output::Array* weights) const {
    std::string text = fmt::format("# Simulation time: {:16.15E}\n# {} [{}] of planes of {} cells\n", time, sums.label,
                                   sums.unit, cellsPerPlane());
    text += fmt::format("# X  Y  Z  {}{}\n", weighting == Weighting::none ? "sum" : "average",
                        weighting == Weighting::none    ? ""
                        : weighting == Weighting::cells ? "  nCells"
                                                        : "  weight");
    const std::size_t components = sums.components;
    for (std::size_t plane = 0; plane < sums.entries(); ++plane) {
      const Vec3 middle = middleOf(plane);
      const double by = weighting == Weighting::none ? 1 : weights ? numberAt(*weights, plane) : cellsPerPlane();
      text += fmt::format("{:15.14E}  {:15.14E}  {:15.14E} ", middle[0], middle[1], middle[2]);
      for (std::size_t k = 0; k < components; ++k)
        text += fmt::format(" {:15.14E}", numberAt(sums, plane * components + k) / by);
      if (weighting == Weighting::cells) text += fmt::format("  {}", cellsPerPlane());
      if (weights) text += fmt::format("  {:15.14E}", by);
      text += '\n';
    }
    return text;
  }

  const Level* level_;
  int across_ =
      -1;  ///< kernel axis perpendicular to the planes; -1 if the grid does not use it, so that there is one plane
  std::map<std::string, Weighting> weightings_;  ///< weighting of each variable, in the order of the scene
  std::string weight_;                           ///< position of the variable named in <weight>
};

}  // namespace

AnalysisKind planeAverageKind() {
  return simulation::moduleWithTags<PlaneAverage>("planeAverage", "means of variables over planes of cells",
                                                  averageSchema());
}

}  // namespace tushar::analysis
