#include "components/analysis/plane_extract.hpp"

#include <fmt/format.h>

#include "components/analysis/extents.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using simulation::AnalysisKind;

namespace {

const input::Schema<ExtentSettings>& planeExtractSchema() {
  static const input::Schema<ExtentSettings> schema =
      samplingSchema<ExtentSettings>("planeExtract", "Variables on parts of planes, in a file for each at each time.")
          .requiredSection("planes", &ExtentSettings::extents, planesSchema(), "where it samples");
  return schema;
}

class PlaneExtract : public ExtentModule {
 public:
  PlaneExtract(const ExtentSettings& settings, const Level& level) : ExtentModule(settings, 2, level) {}

  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& archive) override {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const auto folder = archive / extents_[k].name / output::stepName(parts[k].step) / "L-0";
      output::makeFolder(folder);
      for (const Found& found : findAll(parts[k])) {
        const std::string name = fmt::format("{}_{}", found.variable->called, found.variable->material);
        output::replaceFile(folder / ("0:" + output::nameInPath(name) + ".dat"), textOf(extents_[k], parts[k], found));
      }
    }
  }

 private:
  std::string textOf(const Extent& plane, const Snapshot& part, const Found& found) const {
    const output::Array& array = found.field->array;
    const std::size_t components = array.components;
    const std::string name = fmt::format("{}({})", found.variable->called, found.variable->material);
    std::string text =
        fmt::format("# Simulation time: {:16.15E}\n#    X                      Y                     Z ", part.time);
    for (int i = 0; i < array.components; ++i)
      text += std::string(i == 0 && array.components <= 3 ? 23 : 6, ' ') + nameOfComponent(name, i, array.components);
    text += '\n';
    std::size_t entry = 0;
    grid::forEach<3>(cellsOf(plane, *level_), [&](const Index3& cell) {
      const Vec3 place = placeOf(cell, found.field->centring == output::Centring::node, *level_);
      text += fmt::format("{:16.15E} {:16.15E} {:16.15E}    ", place[0], place[1], place[2]);
      for (std::size_t i = 0; i < components; ++i)
        text += fmt::format(" {:16.15E}", numberAt(array, entry * components + i));
      text += '\n';
      ++entry;
    });
    return text;
  }
};

}  // namespace

AnalysisKind planeExtractKind() {
  return simulation::moduleWithTags<PlaneExtract>(
      "planeExtract", "variables on parts of planes, in a file for each at each time", planeExtractSchema());
}

}  // namespace tushar::analysis
