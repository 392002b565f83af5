#include "components/analysis/min_max.hpp"

#include <fmt/format.h>

#include "components/analysis/sampling.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using simulation::AnalysisKind;

namespace {

const input::Schema<Sampling>& minMaxSchema() {
  static const input::Schema<Sampling> schema =
      samplingSchema<Sampling>("minMax", "The minimum and maximum of variables over time, one file per variable.");
  return schema;
}

std::string textOf(const output::Array& array) {
  if (array.components == 1) return fmt::format("{:16.15E}", numberAt(array, 0));
  std::string text;
  for (std::size_t k = 0; k < static_cast<std::size_t>(array.components); ++k)
    text += fmt::format("{}{:16.15E}", k == 0 ? "" : " ", numberAt(array, k));
  return '[' + text + ']';
}

class MinMax : public SamplingModule {
 public:
  using SamplingModule::SamplingModule;

  std::optional<collect::SummaryOver> summary() const override { return collect::SummaryOver{}; }

  std::vector<simulation::OwnFile> files() const override { return filesIn("MinMax"); }

  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& archive) override {
    const auto folder = archive / "MinMax" / "L-0";
    output::makeFolder(folder);
    for (const Found& found : findAll(parts[0])) {
      const auto* greatest = find(parts[1], *found.variable);
      const double time = parts[0].time;
      files_.add(folder / nameOf(*found.variable),
                 fmt::format("# {} [{}] of all {}\n#Time                      min                       max\n",
                             found.variable->called, found.field->array.unit,
                             found.field->centring == output::Centring::node ? "nodes" : "cells"),
                 fmt::format("{:16.15E}     {}    {}\n", time, textOf(found.field->array), textOf(greatest->array)),
                 time);
    }
  }

 private:
  SampleFiles files_;
};

}  // namespace

AnalysisKind minMaxKind() {
  return simulation::moduleWithTags<MinMax>("minMax", "the minimum and maximum of variables over time", minMaxSchema());
}

}  // namespace tushar::analysis
