#include "core/output/archive_vtkhdf_boxes.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/output/archive_vtkhdf_items.hpp"

namespace tushar::output {

namespace {

using Shape = std::vector<std::uint64_t>;

/// The rows of a dataset that belong to a box.
struct Rows {
  Item item;
  std::uint64_t first;
};

struct ShownBox {
  int level = 0;
  Shape cells;                          ///< along z, y, x
  std::vector<double> corner, spacing;  ///< along x, y, z, m
  std::map<std::string, Rows> fields;   ///< by name in the VTKHDF file

  std::uint64_t count() const { return cells[0] * cells[1] * cells[2]; }
};

/// The boxes of a level at all times, one after the other.
struct ShownLevel {
  std::vector<double> spacing;
  std::vector<std::uint64_t> counts, starts;  ///< of boxes, at each time
  std::vector<std::uint64_t> cellsBefore;     ///< at each time
  std::vector<const ShownBox*> boxes;
};

/// A time without boxes has one grid, whose values have the axes z, y and x.
Rows rowsOf(const pugi::xml_node& item) {
  const pugi::xml_node slab = item.child("DataItem");
  if (!slab) return {itemOf(item), 0};
  return {itemOf(slab.next_sibling("DataItem")), numbersIn<std::uint64_t>(slab.text().as_string()).front()};
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
  for (const pugi::xml_node& attribute : grid.children("Attribute"))
    box.fields[nameOf(attribute)] = rowsOf(attribute.child("DataItem"));
  return box;
}

/// The boxes of each output, by time [s].
std::map<double, std::vector<ShownBox>> boxesOf(const pugi::xml_node& times) {
  std::map<double, std::vector<ShownBox>> found;
  for (const pugi::xml_node& output : times.children("Grid")) {
    std::vector<ShownBox>& boxes = found[output.child("Time").attribute("Value").as_double()];
    if (output.child("Topology")) boxes.push_back(boxOf(output));
    for (const pugi::xml_node& grid : output.children("Grid")) boxes.push_back(boxOf(grid));
  }
  return found;
}

std::map<int, ShownLevel> levelsOf(const std::map<double, std::vector<ShownBox>>& times) {
  std::map<int, ShownLevel> levels;
  for (const auto& [time, boxes] : times)
    for (const ShownBox& box : boxes) levels[box.level].spacing = box.spacing;
  for (auto& [number, level] : levels) {
    std::uint64_t cells = 0;
    for (const auto& [time, boxes] : times) {
      level.starts.push_back(level.boxes.size());
      level.cellsBefore.push_back(cells);
      for (const ShownBox& box : boxes) {
        if (box.level != number) continue;
        level.boxes.push_back(&box);
        cells += box.count();
      }
      level.counts.push_back(level.boxes.size() - level.starts.back());
    }
  }
  return levels;
}

/// The corner of the grid [m]: along each axis, that of some box.
std::vector<double> cornerOf(const std::map<int, ShownLevel>& levels) {
  std::vector<double> corner(3, HUGE_VAL);
  for (const auto& [number, level] : levels)
    for (const ShownBox* box : level.boxes)
      for (int axis = 0; axis < 3; ++axis) corner[axis] = std::min(corner[axis], box->corner[axis]);
  return corner;
}

/// First and last cell of each box along x, y and z.
std::vector<std::int32_t> cellsOf(const ShownLevel& level, const std::vector<double>& corner) {
  std::vector<std::int32_t> numbers;
  for (const ShownBox* box : level.boxes)
    for (int axis = 0; axis < 3; ++axis) {
      const auto first =
          static_cast<std::int32_t>(std::lround((box->corner[axis] - corner[axis]) / level.spacing[axis]));
      numbers.push_back(first);
      numbers.push_back(first + static_cast<std::int32_t>(box->cells[2 - axis]) - 1);
    }
  return numbers;
}

/// Adds rows, merged with those before if they are contiguous in the file.
void addPart(std::vector<VirtualPart>& parts, const Rows& rows, std::uint64_t at, std::uint64_t count) {
  const Item& item = rows.item;
  if (!parts.empty()) {
    VirtualPart& last = parts.back();
    if (last.file == item.file && last.first[0] + last.extent[0] == at && last.from[0] + last.extent[0] == rows.first) {
      last.extent[0] += count;
      return;
    }
  }
  Shape first{at}, extent{count}, from{rows.first};
  if (item.shape.size() % 2 == 0) {  // (entries, components), or (z, y, x, components)
    first.push_back(0);
    from.push_back(0);
    extent.push_back(item.shape.back());
  }
  parts.push_back({item.file, item.path, item.shape, first, extent, from});
}

void addField(Hdf5File& file, const std::string& name, const std::string& place, const ShownLevel& level) {
  std::vector<VirtualPart> parts;
  std::uint64_t at = 0;
  Array::Values type;
  for (const ShownBox* box : level.boxes) {
    if (const auto found = box->fields.find(name); found != box->fields.end()) {
      addPart(parts, found->second, at, box->count());
      type = found->second.item.type;
    }
    at += box->count();
  }
  if (parts.empty()) return;
  Shape shape = parts.front().extent;
  shape[0] = at;
  file.virtualDataset(inRoot(place), type, shape, parts);
}

}  // namespace

bool hasBoxes(const pugi::xml_node& times) {
  const auto grids = times.children("Grid");
  return std::any_of(grids.begin(), grids.end(), [](const pugi::xml_node& output) { return output.child("Grid"); });
}

void writeBoxes(Hdf5File& file, const pugi::xml_node& times) {
  const auto outputs = boxesOf(times);
  const std::map<int, ShownLevel> levels = levelsOf(outputs);
  std::vector<double> values;
  std::map<std::string, bool> names;
  for (const auto& [time, boxes] : outputs) {
    values.push_back(time);
    for (const ShownBox& box : boxes)
      for (const auto& field : box.fields) names[field.first] = true;
  }
  addHead(file, "OverlappingAMR", {2, 2}, values);
  const std::vector<double> corner = cornerOf(levels);
  file.attribute(inRoot(""), "Origin", corner);
  file.fixedText(inRoot(""), "GridDescription", "XYZ");
  int number = 0;
  for (const auto& [depth, level] : levels) {
    const std::string own = "Level" + std::to_string(number++);
    file.group(inRoot(own));
    file.attribute(inRoot(own), "Spacing", level.spacing);
    addNumbers(file, own + "/AMRBox", cellsOf(level, corner), 6);
    addNumbers(file, "Steps/" + own + "/AMRBoxOffset", level.starts);
    addNumbers(file, "Steps/" + own + "/NumberOfAMRBox", level.counts);
    for (const auto& [name, shown] : names) {
      addField(file, name, own + "/" + name, level);
      addNumbers(file, "Steps/" + own + "/CellDataOffset/" + name.substr(name.find('/') + 1), level.cellsBefore);
    }
  }
}

}  // namespace tushar::output
