#include "components/analysis/plane_extract.hpp"

#include <fmt/format.h>

#include <map>

#include "components/analysis/extents.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using simulation::AnalysisKind;

namespace {

const input::Schema<ExtentSettings>& planeExtractSchema() {
  static const input::Schema<ExtentSettings> schema =
      samplingSchema<ExtentSettings>("planeExtract", "Variables on parts of planes, one file per variable and time.")
          .requiredSection("planes", &ExtentSettings::extents, planesSchema(), "the planes to sample");
  return schema;
}

class PlaneExtract : public ExtentModule {
 public:
  PlaneExtract(const ExtentSettings& settings, const Level& level) : ExtentModule(settings, 2, level) {}

  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& archive) override {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const auto folder = archive / extents_[k].name / output::stepName(parts[k].step);
      const std::vector<LevelBox> boxes = boxesOf(k, parts[k]);
      for (const Found& found : findAll(parts[k]))
        for (const auto& [level, text] : textsOf(boxes, parts[k], found)) {
          const auto ofLevel = folder / fmt::format("L-{}", level);
          const std::string name = fmt::format("{}_{}", found.variable->called, found.variable->material);
          output::makeFolder(ofLevel);
          output::replaceFile(ofLevel / ("0:" + output::nameInPath(name) + ".dat"), text);
        }
    }
  }

 private:
  /// The text of the file of each level that has cells on the plane.
  std::map<int, std::string> textsOf(const std::vector<LevelBox>& boxes, const Snapshot& part,
                                     const Found& found) const {
    std::map<int, std::string> texts;
    std::size_t entry = 0;
    for (const LevelBox& box : boxes) {
      std::string& text = texts.try_emplace(box.level, headOf(part, found)).first->second;
      grid::forEach<3>(box.cells, [&](const Index3& cell) { text += lineOf(cell, box.level, found, entry++); });
    }
    return texts;
  }

  static std::string headOf(const Snapshot& part, const Found& found) {
    const output::Array& array = found.field->array;
    const std::string name = fmt::format("{}({})", found.variable->called, found.variable->material);
    std::string text =
        fmt::format("# Simulation time: {:16.15E}\n#    X                      Y                     Z ", part.time);
    for (int i = 0; i < array.components; ++i)
      text += std::string(i == 0 && array.components <= 3 ? 23 : 6, ' ') + nameOfComponent(name, i, array.components);
    return text + '\n';
  }

  std::string lineOf(const Index3& cell, int level, const Found& found, std::size_t entry) const {
    const auto components = static_cast<std::size_t>(found.field->array.components);
    const Vec3 place =
        placeOf(cell, found.field->centring == output::Centring::node, *level_, level_->number() - level);
    std::string text = fmt::format("{:16.15E} {:16.15E} {:16.15E}    ", place[0], place[1], place[2]);
    for (std::size_t i = 0; i < components; ++i)
      text += fmt::format(" {:16.15E}", numberAt(found.field->array, entry * components + i));
    return text + '\n';
  }
};

}  // namespace

AnalysisKind planeExtractKind() {
  return simulation::moduleWithTags<PlaneExtract>(
      "planeExtract", "variables on parts of planes, one file per variable and time", planeExtractSchema());
}

}  // namespace tushar::analysis
