#include "core/output/inside_boxes.hpp"

namespace tushar::output {

namespace {

const char* const pathOfInside = "/grid/inside";

std::vector<std::int32_t> cornersOf(const GridInfo& grid) {
  std::vector<std::int32_t> numbers;
  for (const GridBox& box : grid.inside)
    for (const Index3* corner : {&box.lower, &box.upper})
      numbers.insert(numbers.end(), corner->at.begin(), corner->at.end());
  return numbers;
}

}  // namespace

void writeInside(Hdf5File& file, const GridInfo& grid) {
  if (!grid.inside.empty())
    file.dataset(pathOfInside,
                 {"inside", "", "boxes of which the grid consists: lower x, y, z, upper x, y, z", 6, cornersOf(grid)},
                 {grid.inside.size()});
}

bool hasSameInside(const Hdf5Input& file, const GridInfo& grid) {
  if (!file.has(pathOfInside)) return grid.inside.empty();
  return std::get<std::vector<std::int32_t>>(file.dataset(pathOfInside)) == cornersOf(grid);
}

}  // namespace tushar::output
