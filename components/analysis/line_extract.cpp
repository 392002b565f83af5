#include "components/analysis/line_extract.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/analysis/extents.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using simulation::AnalysisKind;

namespace {

const input::Schema<ExtentSettings>& lineSchema() {
  static const input::Schema<ExtentSettings> schema =
      samplingSchema<ExtentSettings>("lineExtract", "Variables on lines over time, one file per cell.")
          .requiredSection("lines", &ExtentSettings::extents, linesSchema(), "the lines to sample");
  return schema;
}

constexpr int timeColumn = 4;

class LineExtract : public ExtentModule {
 public:
  LineExtract(const ExtentSettings& settings, const Level& level)
      : ExtentModule(settings, 1, level), files_(timeColumn) {}

  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& archive) override {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      std::vector<Found> columns = findAll(parts[k]);
      std::stable_sort(columns.begin(), columns.end(), [](const Found& a, const Found& b) {
        return std::pair(a.field->centring, a.field->array.components) <
               std::pair(b.field->centring, b.field->array.components);
      });
      if (!columns.empty()) write(k, parts[k], columns, archive / extents_[k].name);
    }
  }

 private:
  /// The stride, in cells, between those cells of a line that are written.
  int strideOf(const Extent& line, int level) const {
    const double width = std::ldexp(level_->cellWidth(axisOf(line)), level_->number() - level);
    return width > 0 ? std::max(1, static_cast<int>(std::ceil(line.step / width - 1e-9))) : 1;
  }

  void write(std::size_t line, const Snapshot& part, const std::vector<Found>& columns,
             const std::filesystem::path& folder) {
    std::size_t before = 0;
    for (const LevelBox& box : boxesOf(line, part)) {
      const auto ofLevel = folder / fmt::format("L-{}", box.level);
      output::makeFolder(ofLevel);
      write(line, part, columns, box, before, ofLevel);
      before += box.cells.size();
    }
  }

  /// Writes the cells of a box; `before` is the index, in the part, of the entry of the first cell.
  void write(std::size_t line, const Snapshot& part, const std::vector<Found>& columns, const LevelBox& box,
             std::size_t before, const std::filesystem::path& folder) {
    const bool isOfNodes = columns.front().field->centring == output::Centring::node;
    const std::string header = headerOf(columns);
    const int stride = strideOf(extents_[line], box.level);
    const Index3 first = cellsOf(extents_[line], *level_, level_->number() - box.level).lower;
    std::size_t entry = before;
    grid::forEach<3>(box.cells, [&](const Index3& cell) {
      const std::size_t here = entry++;
      const Index3 along = cell - first;
      if ((along[0] + along[1] + along[2]) % stride != 0) return;  // it is 0 except for one axis
      const Index3 index = sceneIndex(cell, *level_);
      const Vec3 place = placeOf(cell, isOfNodes, *level_, level_->number() - box.level);
      std::string text =
          fmt::format("{:<16E} {:<16E} {:<16E} {:<16} {:<16E}", place[0], place[1], place[2], part.step, part.time);
      for (const Found& column : columns) {
        const std::size_t components = column.field->array.components;
        for (std::size_t i = 0; i < components; ++i)
          text += fmt::format(" {:<16E}", numberAt(column.field->array, here * components + i));
      }
      files_.add(folder / fmt::format("i{}_j{}_k{}", index[0], index[1], index[2]), header, text + '\n', part.time);
    });
  }

  std::string headerOf(const std::vector<Found>& columns) const {
    const bool isOfNodes = columns.front().field->centring == output::Centring::node;
    const bool isMixed = columns.back().field->centring != columns.front().field->centring;
    const std::string_view centre = isOfNodes ? "NC" : "CC";
    std::string text;
    if (isMixed) text = "# positions are the centres of cells; nodes are at their lower corners\n";
    text += fmt::format("{:<16} {:<16} {:<16} {:<16} {:<16}", fmt::format("# X_{}", centre),
                        fmt::format("Y_{}", centre), fmt::format("Z_{}", centre), "Timestep", "Time [s]");
    for (const Found& column : columns) {
      const std::string name = fmt::format("{}_{}", column.variable->called, column.variable->material);
      const int components = column.field->array.components;
      for (int k = 0; k < components; ++k) text += fmt::format(" {:<16}", nameOfComponent(name, k, components));
    }
    return text + '\n';
  }

  SampleFiles files_;
};

}  // namespace

AnalysisKind lineExtractKind() {
  return simulation::moduleWithTags<LineExtract>("lineExtract", "variables on lines over time, one file per cell",
                                                 lineSchema());
}

}  // namespace tushar::analysis
