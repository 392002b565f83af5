#include "components/analysis/slice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>

#include "core/input/schema.hpp"
#include "core/output/archive.hpp"
#include "core/output/archive_files.hpp"
#include "core/simulation/module_with_tags.hpp"
#include "core/simulation/time_control.hpp"

namespace tushar::analysis {

using collect::Layer;
using grid::Level;
using input::Diagnostics;
using input::Element;
using input::Schema;
using output::Archive;
using output::Snapshot;
using simulation::Analysis;
using simulation::AnalysisKind;
using simulation::SaveRequest;

namespace {

/// The text of a tag, and its location in the scene.
struct Word {
  Location where;
  std::string text;
};

struct SliceSettings {
  std::string name;
  Location where;
  std::vector<Word> planes, labels;
  std::string material;
  double interval = 0;   ///< interval in simulated time [s]; 0: none
  int stepInterval = 0;  ///< interval in steps; 0: none
};

const Schema<Word>& planeSchema() {
  static const Schema<Word> schema =
      Schema<Word>("plane", "A plane perpendicular to an axis of the grid.")
          .location(&Word::where)
          .text(&Word::text, "m", "the common coordinate of its points, such as z = 0.5");
  return schema;
}

const Schema<Word>& labelSchema() {
  static const Schema<Word> schema = Schema<Word>("label", "A cell or node variable.")
                                         .location(&Word::where)
                                         .text(&Word::text, "1", "its name, such as c.density or g.velocity");
  return schema;
}

void checkSettings(const SliceSettings& settings, const Element& module, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (const Word& plane : settings.planes) {
    const auto read = planeOf(plane.text);
    const std::string path = module.path() + "/plane";
    if (!read)
      diagnostics.error(plane.where, path,
                        fmt::format("found '{}', expected an axis and a coordinate in m, such as z = 0.5", plane.text));
    else if (!names.insert(fmt::format("{} {}", read->axis, read->at)).second)
      diagnostics.error(plane.where, path, fmt::format("the plane {} is given twice", plane.text));
  }
  for (const Word& label : settings.labels)
    if (!label.text.starts_with("c.") && !label.text.starts_with("g."))
      diagnostics.error(label.where, module.path() + "/label",
                        fmt::format("found '{}', expected a cell variable (c.) or a node variable (g.)", label.text));
  if (settings.interval > 0 && settings.stepInterval > 0)
    diagnostics.error(module, "gives both outputInterval and outputTimestepInterval; keep one");
  if (settings.interval <= 0 && settings.stepInterval <= 0)
    diagnostics.error(module, "a slice needs one of outputInterval and outputTimestepInterval: there is no default");
}

const Schema<SliceSettings>& sliceSchema() {
  static const Schema<SliceSettings> schema =
      Schema<SliceSettings>(
          "Module", "Variables on planes, saved more often than the rest: an archive for each plane, in slice/<plane>.")
          .requiredAttribute("name", &SliceSettings::name, "1", "slice")
          .location(&SliceSettings::where)
          .list("plane", &SliceSettings::planes, planeSchema(), "a plane, whose cells and nearest nodes are written", 1)
          .ours()
          .list("label", &SliceSettings::labels, labelSchema(), "a cell or node variable", 1)
          .ours()
          .value("material", &SliceSettings::material, "", "1",
                 "name of the material whose variables are written; all by default")
          .ours()
          .value("outputInterval", &SliceSettings::interval, 0, "s", "simulated time between two slices",
                 input::positive())
          .ours()
          .value("outputTimestepInterval", &SliceSettings::stepInterval, 0, "1", "steps between two slices",
                 input::positive())
          .ours()
          .check(checkSettings);
  return schema;
}

char nameOf(int axis) { return "xyz"[axis]; }

/// The reason why a grid has no cells on a plane; empty if it has such cells.
std::string problemOf(const Plane& plane, const Level& level) {
  const double lower = level.domain().lower[plane.axis], upper = level.domain().upper[plane.axis];
  if (level.dimension() < 2) return "a slice of a grid along one axis would be a point; remove the module";
  bool isUsed = false;
  for (int d = 0; d < level.dimension(); ++d) {
    isUsed = isUsed || level.axis(d) == plane.axis;
    if (level.cells().extent(d) < 2)
      return fmt::format("a slice needs a grid with more than one cell along {}", nameOf(level.axis(d)));
  }
  if (!isUsed) return fmt::format("the grid has only one cell along {}; choose another axis", nameOf(plane.axis));
  if (plane.at >= lower && plane.at <= upper) return {};
  return fmt::format("found {} = {:g} m, expected a position on the grid, from {:g} to {:g} m", nameOf(plane.axis),
                     plane.at, lower, upper);
}

/// The layers of the planes. Throws InputError for planes on which the grid has no cells.
std::vector<Layer> layersOf(const SliceSettings& settings, const Level& level) {
  std::vector<Layer> layers;
  std::vector<InputProblem> problems;
  for (const Word& word : settings.planes) {
    const auto plane = planeOf(word.text);
    if (!plane) continue;  // the diagnostics say it
    if (const std::string problem = problemOf(*plane, level); !problem.empty())
      problems.push_back({word.where, "DataAnalysis/Module/plane", problem});
    else
      layers.push_back(layerAt(*plane, level));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return layers;
}

class Slice : public Analysis {
 public:
  Slice(SliceSettings settings, const Level& level)
      : settings_(std::move(settings)), layers_(layersOf(settings_, level)), times_(0, settings_.interval) {
    archives_.resize(layers_.size());
  }

  void schedule(tasks::TaskList&) const override {}
  void setTime(double, double sinceStart) override {
    if (sinceStart == since_start_) return;
    since_start_ = sinceStart;
    time_is_due_ = times_.isReached(sinceStart);
    times_.pass(sinceStart);
  }
  std::vector<SaveRequest> samples() const override {
    std::vector<SaveRequest> requests;
    for (const Word& label : settings_.labels)
      requests.push_back({label.text, settings_.material, label.where, settings_.where});
    return requests;
  }
  std::vector<Layer> layers() const override { return layers_; }
  bool isSampleDue(int step) const override {
    const int every = settings_.stepInterval;
    return step == 0 || (every > 0 ? step % every == 0 : time_is_due_);
  }
  void sample(const std::vector<Snapshot>& parts, const std::filesystem::path& folder) override {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (!archives_[k]) archives_[k] = open(k, parts[k], folder);
      archives_[k]->write(parts[k]);
    }
  }
  /// Updates the list of outputs in each plane's archive, because a restart removes outputs that are not listed.
  void flush() override {
    for (const auto& archive : archives_)
      if (archive) archive->flush();
  }

  std::vector<simulation::OwnFile> files() const override {
    std::vector<simulation::OwnFile> files;
    for (const Word& plane : settings_.planes)
      if (planeOf(plane.text)) files.push_back({folderOf(plane), plane.where});
    return files;
  }

 private:
  /// The folder of a plane's archive.
  static std::string folderOf(const Word& plane) {
    const Plane at = *planeOf(plane.text);
    return fmt::format("slice/{}={}", nameOf(at.axis), at.at);
  }

  /// Opens the archive of a plane. The outputs of the steps that this run repeats are removed from it.
  std::unique_ptr<Archive> open(std::size_t plane, const Snapshot& first, const std::filesystem::path& folder) const {
    const auto own = folder / folderOf(settings_.planes[plane]);
    output::makeFolder(own);
    std::ostringstream scene;
    scene << std::ifstream(folder / "input.xml").rdbuf();
    return std::make_unique<Archive>(own, "slice", output::ArchivePoint{first.step - 1, first.time, ""}, scene.str(),
                                     output::ArchiveOptions{.version = TUSHAR_VERSION});
  }

  SliceSettings settings_;
  std::vector<Layer> layers_;
  simulation::Milestones times_;  ///< output times since the start of the first run [s]
  double since_start_ = -1;
  bool time_is_due_ = false;
  std::vector<std::unique_ptr<Archive>> archives_;  ///< archive of each plane; null until it has outputs
};

}  // namespace

std::optional<Plane> planeOf(const std::string& text) {
  std::string packed = text;
  std::erase_if(packed, [](unsigned char c) { return std::isspace(c) != 0; });
  const std::size_t axis = packed.empty() ? std::string::npos : std::string("xyz").find(packed[0]);
  if (axis == std::string::npos || packed.size() < 3 || packed[1] != '=') return {};
  const auto at = input::parse<double>(packed.substr(2));
  if (!at.value) return {};
  return Plane{static_cast<int>(axis), *at.value};
}

Layer layerAt(const Plane& plane, const Level& level) {
  int d = 0;
  while (level.axis(d) != plane.axis) ++d;
  const int cells = level.cells().extent(d), finest = level.number();
  const double place = (plane.at - level.nodePosition(d, 0)) / level.spacing(d);  // in cells
  const auto cellAt = [&](int coarser) {
    return std::clamp(static_cast<int>(std::ceil(std::ldexp(place, -coarser))) - 1, 0, (cells >> coarser) - 1);
  };
  Layer layer{d, cellAt(finest), std::clamp(static_cast<int>(std::ceil(place - .5)), 0, cells)};
  for (int number = 1; number <= finest; ++number) layer.finer.push_back(cellAt(finest - number));
  return layer;
}

AnalysisKind sliceKind() {
  return simulation::moduleWithTags<Slice>("slice", "cell and node variables on planes, saved more often than the rest",
                                           sliceSchema());
}

}  // namespace tushar::analysis
