#include "components/analysis/plane_extract.hpp"

#include <fmt/format.h>

#include "components/analysis/extents.hpp"
#include "components/analysis/sampling.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/module_with_tags.hpp"

namespace tushar::analysis {

using grid::Level;
using output::Snapshot;
using simulation::AnalysisKind;

namespace {

struct PlaneSettings : Sampling {
  ExtentList planes;
};

const input::Schema<PlaneSettings>& planeExtractSchema() {
  static const input::Schema<PlaneSettings> schema =
      samplingSchema<PlaneSettings>("planeExtract", "Variables on parts of planes, in a file for each at each time.")
          .requiredSection("planes", &PlaneSettings::planes, planesSchema(), "where it looks");
  return schema;
}

class PlaneExtract : public SamplingModule {
 public:
  PlaneExtract(const PlaneSettings& settings, const Level& level)
      : SamplingModule(settings), planes_(settings.planes.list), level_(&level) {
    checkExtents(planes_, 2, level);
  }

  std::vector<collect::Window> windows() const override {
    std::vector<collect::Window> windows;
    for (const Extent& plane : planes_) windows.push_back({cellsOf(plane, *level_), cellsOf(plane, *level_)});
    return windows;
  }

  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& archive) override {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const auto folder = archive / planes_[k].name / output::stepName(parts[k].step) / "L-0";
      output::makeFolder(folder);
      for (const Found& found : findAll(parts[k])) {
        const std::string name = fmt::format("{}_{}", found.variable->called, found.variable->material);
        output::replaceFile(folder / ("0:" + output::nameInPath(name) + ".dat"), textOf(planes_[k], parts[k], found));
      }
    }
  }

 private:
  std::string textOf(const Extent& plane, const Snapshot& part, const Found& found) const {
    const output::Array& array = found.field->array;
    const auto components = static_cast<std::size_t>(array.components);
    const std::string name = fmt::format("{}({})", found.variable->called, found.variable->material);
    std::string text =
        fmt::format("# Simulation time: {:16.15E}\n#    X                      Y                     Z ", part.time);
    for (std::size_t i = 0; i < components; ++i)
      text += components == 1   ? fmt::format("                       {}", name)
              : components == 3 ? fmt::format("{}{}.{}", i == 0 ? "                       " : "      ", name, "xyz"[i])
                                : fmt::format("      {}({},{})", name, i / 3, i % 3);
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

  std::vector<Extent> planes_;
  const Level* level_;
};

}  // namespace

AnalysisKind planeExtractKind() {
  return simulation::moduleWithTags<PlaneExtract>(
      "planeExtract", "variables on parts of planes, in a file for each at each time", planeExtractSchema());
}

}  // namespace tushar::analysis
