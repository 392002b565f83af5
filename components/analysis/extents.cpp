#include "components/analysis/extents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/output/archive_files.hpp"

namespace tushar::analysis {

using grid::Box;
using grid::Level;
using input::Schema;

namespace {

constexpr double slack = 1e-9;  ///< fraction of a cell within which a point is considered to be on a face

Schema<Extent> extentSchema(const std::string& tag, const std::string& sentence) {
  return Schema<Extent>(tag, sentence)
      .location(&Extent::where)
      .location(&Extent::whereOfName, "name")
      .requiredAttribute("name", &Extent::name, "1", "the folder in the archive")
      .required("startingPt", &Extent::start, "m", "first point")
      .required("endingPt", &Extent::end, "m", "last point");
}

std::string pathOf(int axes) {
  return axes == 1 ? "DataAnalysis/Module/lines/line" : "DataAnalysis/Module/planes/plane";
}

/// The reason why a name is invalid; empty if it can be the name of a folder in an archive.
std::string problemOfName(const std::string& name) {
  static const std::set<std::string> taken{"checkpoints", "slice", "particleExtract", "MinMax", "planeAverage"};
  const bool isPath = name.empty() || name.starts_with('.') || name.find('/') != std::string::npos;
  if (isPath) return fmt::format("found '{}', expected the name of a folder, without '/' or leading dots", name);
  if (taken.contains(name) || output::stepOf(name) || name.find('.') != std::string::npos)
    return fmt::format("found '{}', a name that the archive may use itself; choose another name", name);
  return {};
}

/// The width of the coarsest cells along an axis of the scene [m]; 0 if the grid does not use the axis.
double coarsestWidth(const Level& level, int axis) {
  for (int d = 0; d < level.dimension(); ++d)
    if (level.axis(d) == axis) return std::ldexp(level.spacing(d), level.number());
  return 0;
}

/// The reason why the points are invalid; empty if there are cells of the grid between them. Uintah's grid has one more
/// layer of cells beyond each side. Scenes may sample it, but here an extent ends at the side.
std::string problemOf(const Extent& extent, int axes, const Level& level) {
  const Vec3 lower = level.domain().lower, upper = level.domain().upper;
  int along = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double from = extent.start[axis], to = extent.end[axis];
    const double rounding = slack * (upper[axis] - lower[axis]), beyond = rounding + coarsestWidth(level, axis);
    if (from > to)
      return fmt::format("found endingPt at {} = {:g} m, expected {:g} m or more, the coordinate of startingPt",
                         "xyz"[axis], to, from);
    if (from < lower[axis] - beyond || to > upper[axis] + beyond || from > upper[axis] + rounding ||
        to < lower[axis] - rounding)
      return fmt::format("found {} from {:g} to {:g} m, expected positions on the grid, from {:g} to {:g} m",
                         "xyz"[axis], from, to, lower[axis], upper[axis]);
    if (from < to) ++along;
  }
  if (along == axes) return {};
  return axes == 1 ? "a line is parallel to one axis: expected startingPt and endingPt to differ in one coordinate"
                   : "a plane is parallel to two axes: expected startingPt and endingPt to differ in two coordinates";
}

}  // namespace

const Schema<ExtentList>& linesSchema() {
  static const Schema<Extent> line =
      extentSchema("line", "A line parallel to an axis.")
          .value("stepSize", &Extent::step, 0, "m",
                 "spacing of the cells that are written, rounded up to whole cells; 0: every cell",
                 input::nonNegative());
  static const Schema<ExtentList> schema = Schema<ExtentList>("lines", "The lines that are sampled.")
                                               .list("line", &ExtentList::list, line, "a line parallel to an axis", 1);
  return schema;
}

const Schema<ExtentList>& planesSchema() {
  static const Schema<Extent> plane = extentSchema("plane", "A part of a plane perpendicular to an axis.");
  static const Schema<ExtentList> schema =
      Schema<ExtentList>("planes", "The planes that are sampled.")
          .list("plane", &ExtentList::list, plane, "a part of a plane perpendicular to an axis", 1);
  return schema;
}

void checkExtents(const std::vector<Extent>& extents, int axes, const Level& level) {
  std::vector<InputProblem> problems;
  std::set<std::string> names;
  for (const Extent& extent : extents) {
    if (const std::string problem = problemOfName(extent.name); !problem.empty())
      problems.push_back({extent.whereOfName, pathOf(axes), "name: " + problem});
    else if (!names.insert(extent.name).second)
      problems.push_back({extent.whereOfName, pathOf(axes), fmt::format("the name '{}' is given twice", extent.name)});
    if (const std::string problem = problemOf(extent, axes, level); !problem.empty())
      problems.push_back({extent.where, pathOf(axes), problem});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

Box cellsOf(const Extent& extent, const Level& level, int coarser) {
  Box box = level.cells();
  for (int d = 0; d < level.dimension(); ++d) {
    const int axis = level.axis(d), cells = level.cells().extent(d) >> coarser;
    const double spacing = std::ldexp(level.spacing(d), coarser);
    const double from = (extent.start[axis] - level.nodePosition(d, 0)) / spacing;  // in cells
    const double to = (extent.end[axis] - level.nodePosition(d, 0)) / spacing;
    box.lower[d] = std::clamp(static_cast<int>(std::floor(from + slack)), 0, cells - 1);
    box.upper[d] = std::clamp(static_cast<int>(std::ceil(to - slack)), box.lower[d] + 1, cells);
  }
  return box;
}

ExtentModule::ExtentModule(const ExtentSettings& settings, int axes, const Level& level)
    : SamplingModule(settings), extents_(settings.extents.list), level_(&level) {
  checkExtents(extents_, axes, level);
}

std::vector<simulation::OwnFile> ExtentModule::files() const {
  std::vector<simulation::OwnFile> files;
  for (const Extent& extent : extents_) {
    files.push_back({extent.name, extent.whereOfName});
    for (simulation::OwnFile& file : filesIn(extent.name)) files.push_back(std::move(file));
  }
  return files;
}

std::vector<collect::Window> ExtentModule::windows() const {
  std::vector<collect::Window> windows;
  for (const Extent& extent : extents_) {
    const Box coarsest = cellsOf(extent, *level_, level_->number());
    windows.push_back({coarsest, coarsest});
    for (int number = 1; number <= level_->number(); ++number)
      windows.back().finer.push_back(cellsOf(extent, *level_, level_->number() - number));
  }
  return windows;
}

std::vector<LevelBox> ExtentModule::boxesOf(std::size_t extent, const output::Snapshot& part) const {
  if (level_->number() == 0) return {{0, cellsOf(extents_[extent], *level_)}};
  std::vector<LevelBox> boxes;
  for (const output::GridBox& given : part.grid.boxes) {
    boxes.push_back({given.level, {Index3{}, Index3::filled(1)}});
    for (int d = 0; d < level_->dimension(); ++d) {
      boxes.back().cells.lower[d] = given.lower[level_->axis(d)];
      boxes.back().cells.upper[d] = given.upper[level_->axis(d)];
    }
  }
  return boxes;
}

int axisOf(const Extent& line) {
  for (int axis = 0; axis < 2; ++axis)
    if (line.start[axis] != line.end[axis]) return axis;
  return 2;
}

Index3 sceneIndex(const Index3& cell, const Level& level) {
  Index3 index{};
  for (int d = 0; d < level.dimension(); ++d) index[level.axis(d)] = cell[d];
  return index;
}

Vec3 placeOf(const Index3& cell, bool isCorner, const Level& level, int coarser) {
  Vec3 place = 0.5 * (level.domain().lower + level.domain().upper);
  for (int d = 0; d < level.dimension(); ++d) {
    const auto node = [&](int at) { return level.nodePosition(d, at << coarser); };
    place[level.axis(d)] = isCorner ? node(cell[d]) : 0.5 * (node(cell[d]) + node(cell[d] + 1));
  }
  return place;
}

}  // namespace tushar::analysis
