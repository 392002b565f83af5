#include "core/output/archive_vtkhdf_boxes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace tushar::output {

namespace {

using Shape = std::vector<std::uint64_t>;

/// First and last cell of a box along x, y and z.
using BoxCells = std::array<std::int32_t, 6>;

struct ShownBox {
  int level = 0;
  Shape cells;                          ///< number of cells along z, y, x
  std::vector<double> corner, spacing;  ///< corner and cell width along x, y, z [m]
  std::uint64_t first = 0;              ///< row of the first cell

  std::uint64_t count() const { return cells[0] * cells[1] * cells[2]; }
};

/// The first row of a grid; an output without boxes has one grid, whose values have the axes z, y and x.
std::uint64_t firstRowOf(const pugi::xml_node& grid) {
  const pugi::xml_node slab = grid.child("Attribute").child("DataItem").child("DataItem");
  const auto numbers = numbersIn<std::uint64_t>(slab.text().as_string());
  return numbers.empty() ? 0 : numbers.front();
}

ShownBox boxOf(const pugi::xml_node& grid) {
  ShownBox box;
  const std::string_view name = grid.attribute("Name").as_string(), before = "level ";
  if (name.starts_with(before)) std::from_chars(name.data() + before.size(), name.data() + name.size(), box.level);
  box.cells = numbersIn<std::uint64_t>(grid.child("Topology").attribute("Dimensions").as_string());
  for (std::uint64_t& extent : box.cells) --extent;
  const pugi::xml_node corner = grid.child("Geometry").child("DataItem");
  box.corner = numbersIn<double>(corner.text().as_string());
  box.spacing = numbersIn<double>(corner.next_sibling("DataItem").text().as_string());
  std::reverse(box.corner.begin(), box.corner.end());
  std::reverse(box.spacing.begin(), box.spacing.end());
  box.first = firstRowOf(grid);
  return box;
}

std::vector<ShownBox> boxesOf(const pugi::xml_node& output) {
  std::vector<ShownBox> boxes;
  if (output.child("Topology")) boxes.push_back(boxOf(output));
  for (const pugi::xml_node& grid : output.children("Grid")) boxes.push_back(boxOf(grid));
  return boxes;
}

/// The lower corner of the domain: along each axis, the minimum over all boxes.
std::vector<double> cornerOf(const std::vector<ShownBox>& boxes) {
  std::vector<double> corner(3, HUGE_VAL);
  for (const ShownBox& box : boxes)
    for (int axis = 0; axis < 3; ++axis) corner[axis] = std::min(corner[axis], box.corner[axis]);
  return corner;
}

BoxCells cellsOf(const ShownBox& box, const std::vector<double>& corner) {
  BoxCells cells;
  for (int axis = 0; axis < 3; ++axis) {
    const auto first = static_cast<std::int32_t>(std::lround((box.corner[axis] - corner[axis]) / box.spacing[axis]));
    cells[2 * axis] = first;
    cells[2 * axis + 1] = first + static_cast<std::int32_t>(box.cells[2 - axis]) - 1;
  }
  return cells;
}

/// Adds a box; if it continues the previous rows, it becomes part of them.
void addBox(std::vector<LevelRows>& all, const ShownBox& box, std::uint64_t place) {
  if (!all.empty() && all.back().level == box.level && all.back().first + all.back().rows == box.first) {
    ++all.back().boxes;
    all.back().rows += box.count();
  } else {
    all.push_back({box.level, 1, place, box.first, box.count()});
  }
}

// --- the file

/// A range of rows in an output, and the numbers of boxes and cells before it.
struct Run {
  const ShownOutput* output;
  LevelRows rows;
  std::uint64_t boxesBefore, cellsBefore;
};

/// The boxes of a level at all times.
struct ShownLevel {
  std::vector<std::uint64_t> counts, starts;  ///< number of boxes and first box, at each time
  std::vector<std::uint64_t> cellsBefore;     ///< number of cells in all previous boxes, at each time
  std::vector<Run> runs;
  std::uint64_t boxes = 0, cells = 0;
};

ShownLevel levelOf(int number, const std::vector<const ShownOutput*>& outputs) {
  ShownLevel level;
  for (const ShownOutput* output : outputs) {
    level.starts.push_back(level.boxes);
    level.cellsBefore.push_back(level.cells);
    for (const LevelRows& rows : output->levels) {
      if (rows.level != number) continue;
      level.runs.push_back({output, rows, level.boxes, level.cells});
      level.boxes += rows.boxes;
      level.cells += rows.rows;
    }
    level.counts.push_back(level.boxes - level.starts.back());
  }
  return level;
}

/// The cells of all boxes of a level, read from the scratch file.
class CellsOfBoxes : public Source {
 public:
  CellsOfBoxes(const ShownLevel& level, const Scratch& scratch) : level_(level), scratch_(scratch) {}
  std::size_t entries() const override { return level_.boxes; }
  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    auto run = std::upper_bound(level_.runs.begin(), level_.runs.end(), first,
                                [](std::size_t box, const Run& other) { return box < other.boxesBefore; }) -
               1;
    for (; count > 0; ++run) {
      const std::size_t skipped = first - run->boxesBefore, here = std::min(count, run->rows.boxes - skipped);
      scratch_.read(run->rows.place + skipped * sizeof(BoxCells), {to, here * sizeof(BoxCells)});
      first += here;
      count -= here;
      to += here * sizeof(BoxCells);
    }
  }

 private:
  const ShownLevel& level_;
  const Scratch& scratch_;
};

VirtualPart partOf(const Run& run, const Item& item) {
  Shape first{run.cellsBefore}, extent{run.rows.rows}, from{run.rows.first};
  if (item.shape.size() % 2 == 0) {  // (entries, components), or (z, y, x, components)
    first.push_back(0);
    from.push_back(0);
    extent.push_back(item.shape.back());
  }
  return {outputName(run.output->step), item.path, item.shapeOf(run.output->count), first, extent, from};
}

void addField(Hdf5File& file, const std::string& name, const std::string& place, const ShownLevel& level) {
  std::vector<VirtualPart> parts;
  Array::Values type;
  for (const Run& run : level.runs) {
    const auto found = run.output->items->find(name);
    if (found == run.output->items->end()) continue;
    parts.push_back(partOf(run, found->second));
    type = found->second.type;
  }
  if (parts.empty()) return;
  Shape shape = parts.front().extent;
  shape[0] = level.cells;
  file.virtualDataset(inRoot(place), type, shape, parts);
}

}  // namespace

void ShownBoxes::add(const pugi::xml_node& grid, ShownOutput& output) {
  any_ = any_ || grid.child("Grid");
  const std::vector<ShownBox> boxes = boxesOf(grid);
  if (corner_.empty()) corner_ = cornerOf(boxes);
  std::vector<BoxCells> cells;
  for (const ShownBox& box : boxes) cells.push_back(cellsOf(box, corner_));
  std::uint64_t place = scratch_->append(std::as_bytes(std::span(cells)));
  for (const ShownBox& box : boxes) {
    addBox(output.levels, box, std::exchange(place, place + sizeof(BoxCells)));
    spacing_[box.level] = box.spacing;
  }
}

void ShownBoxes::write(Hdf5File& file, const std::vector<const ShownOutput*>& outputs) const {
  std::vector<double> times;
  std::set<std::string> names;
  std::set<int> depths;
  for (const ShownOutput* output : outputs) {
    times.push_back(output->time);
    for (const auto& item : *output->items) names.insert(item.first);
    for (const LevelRows& rows : output->levels) depths.insert(rows.level);
  }
  addHead(file, "OverlappingAMR", {2, 2}, times);
  file.attribute(inRoot(""), "Origin", corner_);
  file.fixedText(inRoot(""), "GridDescription", "XYZ");
  int number = 0;
  for (const int depth : depths) {
    const ShownLevel level = levelOf(depth, outputs);
    const std::string own = "Level" + std::to_string(number++);
    file.group(inRoot(own));
    file.attribute(inRoot(own), "Spacing", spacing_.at(depth));
    const Array boxes{own, "", "", 6, std::vector<std::int32_t>{}, std::make_shared<CellsOfBoxes>(level, *scratch_)};
    file.dataset(inRoot(own + "/AMRBox"), boxes, {boxes.entries()});
    addNumbers(file, "Steps/" + own + "/AMRBoxOffset", level.starts);
    addNumbers(file, "Steps/" + own + "/NumberOfAMRBox", level.counts);
    for (const std::string& name : names) {
      addField(file, name, own + "/" + name, level);
      addNumbers(file, "Steps/" + own + "/CellDataOffset/" + name.substr(name.find('/') + 1), level.cellsBefore);
    }
  }
}

}  // namespace tushar::output
