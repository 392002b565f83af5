#include "core/scene/scene_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"

namespace tushar::scene {

using input::Diagnostics, input::Element;

Element regridderTagOr(const AmrSettings& amr, const std::string& tag, const Element& other) {
  const auto regridder = amr.tag ? amr.tag->child("Regridder") : std::nullopt;
  const auto given = regridder ? regridder->child(tag) : std::nullopt;
  return given ? *given : other;
}

namespace {

constexpr int fewestCells = 4;  ///< smallest number of cells of a block along an axis in use

/// Chooses the blocks of the coarsest level.
class BlockChoice {
 public:
  BlockChoice(const Element& level, const AmrSettings& amr, const grid::Level& coarsest, grid::Refinement& refinement,
              Diagnostics& diagnostics)
      : level_(level),
        place_(regridderTagOr(amr, "min_patch_size", level)),
        amr_(amr),
        coarsest_(coarsest),
        refinement_(refinement),
        diagnostics_(diagnostics) {}

  void chooseBlock(int axis) {
    const int cells = coarsest_.domain().resolution[axis];
    const int wanted = std::max(coarsest_.dimension() == 1 ? 16 : 8, amr_.fewestCellsOfBlock);
    const std::vector<int> sizes = blockSizes(cells);
    if (amr_.block) return checkBlock(axis, cells, sizes);
    const int most = wanted + 2;  // rather than none, where a grid has 10 cells
    const auto above = std::upper_bound(sizes.begin(), sizes.end(), wanted);
    if (above != sizes.begin() || (!sizes.empty() && sizes.front() <= most)) {
      refinement_.blockCells[axis] = above != sizes.begin() ? *(above - 1) : sizes.front();
      return;
    }
    const std::string instead = sizes.empty() ? "choose another <resolution>"
                                              : fmt::format("choose another <resolution>, or give <min_patch_size> {}",
                                                            namesOfNearest(sizes, wanted));
    diagnostics_.error(
        level_.children("Box").front(),
        fmt::format("its {} along {} cannot be divided into blocks of an even number of cells from {} to {}; {}",
                    counted(cells, "cell"), "xyz"[axis], amr_.fewestCellsOfBlock, most, instead));
  }

 private:
  void checkBlock(int axis, int cells, const std::vector<int>& sizes) {
    const int size = (*amr_.block)[axis];
    refinement_.blockCells[axis] = size;
    if (size < fewestCells || size % 2 != 0)
      diagnostics_.error(place_, fmt::format("found {} along {}, expected an even number of cells, at least {}", size,
                                             "xyz"[axis], fewestCells));
    else if (cells % size == 0 && size >= amr_.fewestCellsOfBlock)
      return;
    else if (sizes.empty())
      diagnostics_.error(
          place_,
          fmt::format("{}; no even number of at least {} divides the number of cells: choose another <resolution>",
                      problemOfBlock(axis, cells, size), amr_.fewestCellsOfBlock));
    else
      takeNearestBlock(axis, cells, size, sizes);
  }

  std::string problemOfBlock(int axis, int cells, int size) const {
    if (size < amr_.fewestCellsOfBlock)
      return fmt::format("blocks of {} cells along {} are too small for the tasks of this scene, which need {}", size,
                         "xyz"[axis], amr_.fewestCellsOfBlock);
    return fmt::format("blocks of {} cells do not divide the {} of the grid along {}", size, counted(cells, "cell"),
                       "xyz"[axis]);
  }

  /// Replaces the size that the scene requests by the nearest one that can be used.
  void takeNearestBlock(int axis, int cells, int size, const std::vector<int>& sizes) {
    const auto distance = [&](int a, int b) { return std::abs(a - size) < std::abs(b - size); };
    const int nearest = *std::min_element(sizes.begin(), sizes.end(), distance);
    refinement_.blockCells[axis] = nearest;
    diagnostics_.note(
        place_, fmt::format("{}; blocks of {} are used along this axis", problemOfBlock(axis, cells, size), nearest));
  }

  /// The even divisors of a number of cells, from the smallest block upwards.
  std::vector<int> blockSizes(int cells) const {
    std::vector<int> sizes;
    const auto add = [&](int size) {
      if (size % 2 == 0 && size >= amr_.fewestCellsOfBlock) sizes.push_back(size);
    };
    for (int size = 1; static_cast<long>(size) * size <= cells; ++size) {
      if (cells % size != 0) continue;
      add(size);
      if (size * size != cells) add(cells / size);
    }
    std::sort(sizes.begin(), sizes.end());
    return sizes;
  }

  /// The sizes closest to a requested one, in words: `4, 10 or 20`.
  static std::string namesOfNearest(std::vector<int> sizes, int wanted) {
    constexpr std::size_t most = 6;
    std::stable_sort(sizes.begin(), sizes.end(),
                     [&](int a, int b) { return std::abs(a - wanted) < std::abs(b - wanted); });
    sizes.resize(std::min(sizes.size(), most));
    std::sort(sizes.begin(), sizes.end());
    std::string text;
    for (std::size_t k = 0; k < sizes.size(); ++k)
      text += (k == 0 ? "" : k + 1 == sizes.size() ? " or " : ", ") + std::to_string(sizes[k]);
    return text;
  }

  const Element level_, place_;
  const AmrSettings& amr_;
  const grid::Level& coarsest_;
  grid::Refinement& refinement_;
  Diagnostics& diagnostics_;
};

}  // namespace

void chooseBlocks(const Element& level, const AmrSettings& amr, const grid::Level& coarsest,
                  grid::Refinement& refinement, Diagnostics& diagnostics) {
  BlockChoice choice(level, amr, coarsest, refinement, diagnostics);
  for (int d = 0; d < coarsest.dimension(); ++d) choice.chooseBlock(coarsest.axis(d));
}

}  // namespace tushar::scene
