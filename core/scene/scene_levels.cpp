#include "core/scene/scene_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/scene/scene_blocks.hpp"

namespace tushar::scene {

using input::Diagnostics, input::Element, input::Schema;

namespace {

const Schema<GridBox>& boxSchema() {
  static const Schema<GridBox> schema =
      Schema<GridBox>(
          "Box", "A box of cells. For solids with explicit steps, the first Level may have several, which share faces.")
          .attributeValue("label", &GridBox::label, "", "1", "name")
          .required("lower", &GridBox::lower, "m", "lower corner")
          .required("upper", &GridBox::upper, "m", "upper corner")
          .optional("resolution", &GridBox::resolution, "1", "cells along x, y, z (or give <spacing> of the Level)",
                    input::atLeast(1))
          .optional("patches", &GridBox::patches, "1",
                    "number of patches along x, y, z at the start (during a run, the patches of solids may change); if "
                    "neither "
                    "this nor autoPatch is given, it depends on the number of threads and ranks",
                    input::atLeast(1))
          .optional("autoPatch", &GridBox::autoPatch, "1", "approximate number of patches, instead of <patches>",
                    input::atLeast(1))
          .value(
              "extraCells", &GridBox::extraCells, Index3{}, "1",
              "accepted for compatibility with Uintah: the shape function determines the extra cells around the grid",
              input::nonNegative())
          .check([](const GridBox& box, const Element& element, Diagnostics& diagnostics) {
            if (box.patches && box.autoPatch) diagnostics.error(element, "gives both patches and autoPatch; keep one");
            for (int axis = 0; axis < 3; ++axis)
              if (box.upper[axis] < box.lower[axis])
                diagnostics.error(element, fmt::format("upper is below lower along {}: {:g} < {:g} m", "xyz"[axis],
                                                       box.upper[axis], box.lower[axis]));
          });
  return schema;
}

}  // namespace

const Schema<LevelSection>& levelSchema() {
  static const Schema<LevelSection> schema =
      Schema<LevelSection>(
          "Level", "Cells of one size: the whole grid or, for a further Level, boxes in which no cell is wider.")
          .list("Box", &LevelSection::boxes, boxSchema(),
                "the box that is divided into cells. For solids with explicit steps, the first Level may have several "
                "boxes, with cells of one size, which share faces of cells: the grid has no cells but theirs, and "
                "conditions of a side hold wherever the grid ends in its direction. Several boxes that fill a box are "
                "as this box. Further Levels may have any number of boxes, each enlarged to whole blocks (see "
                "AMR/Regridder/min_patch_size)",
                1)
          .optional("spacing", &LevelSection::spacing, "m",
                    "cell widths along x, y, z, instead of the resolution of the Box", input::positive())
          .value("periodic", &LevelSection::periodic, Index3{}, "1", "1 along periodic axes; the same for all Levels",
                 input::between(0, 1))
          .check([](const LevelSection& level, const Element& element, Diagnostics& diagnostics) {
            for (const GridBox& box : level.boxes)
              if (box.resolution.has_value() == level.spacing.has_value())
                diagnostics.error(element, box.resolution ? "gives both spacing and resolution; keep one"
                                                          : "gives neither <resolution> of its Box nor <spacing>");
          });
  return schema;
}

Index3 resolutionOf(const GridBox& box, const LevelSection& level, const Element& element, Diagnostics& diagnostics) {
  if (box.resolution) return *box.resolution;
  Index3 resolution = Index3::filled(1);
  for (int axis = 0; level.spacing && axis < 3; ++axis) {
    const double cells = (box.upper[axis] - box.lower[axis]) / (*level.spacing)[axis];
    if (cells > mostCells || (cells > 0.5 && std::abs(cells - std::round(cells)) > 1e-6 * cells))
      diagnostics.error(
          element, fmt::format("spacing along {} gives {:g} cells, which is not a whole number", "xyz"[axis], cells));
    else
      resolution[axis] = std::max(1, static_cast<int>(std::lround(cells)));
  }
  return resolution;
}

namespace {

constexpr int mostLevels = 16;       ///< largest number of levels of a tree of blocks
constexpr int mostBlocks = 1 << 20;  ///< largest number of blocks of the finest level along an axis

/// Reads the Box tags of further Level tags, and chooses blocks for them.
class Refiner {
 public:
  Refiner(const Element& grid, const std::vector<LevelSection>& levels, const AmrSettings& amr, grid::Domain& domain,
          Diagnostics& diagnostics)
      : elements_(grid.children("Level")),
        levels_(levels),
        amr_(amr),
        coarsest_(domain),
        refinement_(domain.refinement),
        diagnostics_(diagnostics) {}

  void read() {
    const std::size_t before = diagnostics_.size();
    for (std::size_t k = 1; k < levels_.size(); ++k) readLevel(k);
    checkRatios();
    if (diagnostics_.size() > before) return;
    refinement_.levels = countLevels();
    if (refinement_.levels == 1 || diagnostics_.size() > before) return;
    chooseBlocks(elements_.front(), amr_, coarsest_, refinement_, diagnostics_);
    if (diagnostics_.size() > before) return;
    for (int d = 0; d < coarsest_.dimension(); ++d) checkCount(coarsest_.axis(d));
    noteWhatGrows();
    noteOverlaps();
    noteUnnested();
  }

 private:
  void readLevel(std::size_t k) {
    const LevelSection& section = levels_[k];
    const Element& element = elements_[k];
    const std::vector<Element> boxes = element.children("Box");
    if (element.child("periodic") && !(section.periodic == levels_.front().periodic))
      diagnostics_.error(
          *element.child("periodic"),
          fmt::format("found {}, but the first Level has {}; all Levels must be periodic along the same axes",
                      input::toText(section.periodic), input::toText(levels_.front().periodic)));
    std::optional<int> number;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      const GridBox& box = section.boxes[b];
      const std::optional<int> of = checkPlace(box, boxes[b]) ? levelOf(box, section, boxes[b]) : std::nullopt;
      if (of && number && of != number)
        diagnostics_.error(boxes[b],
                           fmt::format("its cells are {:g} times smaller than those of the first Level, but those of a "
                                       "Box above are {:g} times smaller; put this Box into a separate Level",
                                       std::ldexp(1, *of), std::ldexp(1, *number)));
      if (!of) continue;
      number = of;
      refinement_.regions.push_back({*of, box.lower, box.upper});
      boxes_.push_back(boxes[b]);
    }
    if (number) checkOrder(k, *number);
  }

  void checkOrder(std::size_t k, int number) {
    if (number <= finest_)
      diagnostics_.error(
          elements_[k],
          fmt::format("this Level is not finer than the previous one, at {}; give Levels from coarse to fine",
                      elements_[k - 1].where().text()));
    else if (number >= mostLevels)
      diagnostics_.error(
          elements_[k],
          fmt::format(
              "its cells are {:g} times smaller than those of the first Level; the largest possible ratio is {:g}",
              std::ldexp(1, number), std::ldexp(1, mostLevels - 1)));
    finest_ = std::max(finest_, number);
  }

  bool checkPlace(const GridBox& box, const Element& element) {
    const std::size_t before = diagnostics_.size();
    const grid::Domain& domain = coarsest_.domain();
    for (int axis = 0; axis < 3; ++axis) {
      const double slack = 1e-9 * (domain.upper[axis] - domain.lower[axis]);
      if (box.lower[axis] < domain.lower[axis] - slack || box.upper[axis] > domain.upper[axis] + slack)
        diagnostics_.error(
            element,
            fmt::format("found {:g} to {:g} m along {}, expected a range within the box of the first Level, from "
                        "{:g} to {:g} m",
                        box.lower[axis], box.upper[axis], "xyz"[axis], domain.lower[axis], domain.upper[axis]));
      else if (coarsest_.cellWidth(axis) > 0 && !(box.upper[axis] > box.lower[axis]))
        diagnostics_.error(element, fmt::format("the box has no extent along {}", "xyz"[axis]));
    }
    return diagnostics_.size() == before;
  }

  /// The level that has the cell width of a box: the number of times that the cells of the first Level must be halved.
  std::optional<int> levelOf(const GridBox& box, const LevelSection& section, const Element& element) {
    const std::size_t before = diagnostics_.size();
    const Index3 cells = resolutionOf(box, section, element, diagnostics_);
    std::optional<int> first;
    for (int axis = 0; axis < 3 && diagnostics_.size() == before; ++axis) {
      if (!isInUse(axis)) {
        if (cells[axis] > 1)
          diagnostics_.error(
              element, fmt::format("found {} cells along {}, expected 1: the grid does not use this axis", cells[axis],
                                   "xyz"[axis]));
        continue;
      }
      const double ratio = coarsest_.cellWidth(axis) * cells[axis] / (box.upper[axis] - box.lower[axis]);
      const auto halvings = static_cast<int>(std::lround(std::log2(ratio)));
      if (std::abs(ratio - std::ldexp(1, halvings)) > 1e-6 * ratio)
        diagnostics_.error(element, fmt::format("its cells are {:g} times smaller along {} than those of the first "
                                                "Level; the ratio must be 2, 4, 8 or another power of two",
                                                ratio, "xyz"[axis]));
      else if (first && *first != halvings)
        diagnostics_.error(
            element,
            fmt::format("its cells are {:g} times smaller along {}, but {:g} times smaller along {}; refine all axes "
                        "equally, and add another Level where one axis needs finer cells",
                        std::ldexp(1, *first), "xyz"[coarsest_.axis(0)], std::ldexp(1, halvings), "xyz"[axis]));
      if (!first) first = halvings;
    }
    return diagnostics_.size() == before ? first : std::nullopt;
  }

  bool isInUse(int axis) const {
    for (int d = 0; d < coarsest_.dimension(); ++d)
      if (coarsest_.axis(d) == axis) return coarsest_.cellWidth(axis) > 0;
    return false;
  }

  void checkRatios() {
    if (!amr_.ratios) return;
    for (const Index3& ratio : *amr_.ratios)
      for (int d = 0; d < coarsest_.dimension(); ++d) {
        const int axis = coarsest_.axis(d), wanted = ratio[coarsest_.axis(0)];
        if (ratio[axis] == wanted && wanted >= 2 && std::has_single_bit(static_cast<unsigned>(wanted))) continue;
        diagnostics_.error(regridderTagOr(amr_, "cell_refinement_ratio", elements_.front()),
                           fmt::format("found {} along {}, expected 2, 4, 8 or another power of two, the same along "
                                       "each axis that the grid uses",
                                       ratio[axis], "xyz"[axis]));
        return;
      }
  }

  /// The number of levels, each with half the cell width of the previous one, that reach cells as fine as those of
  /// `levels` levels with the ratios of the scene.
  int levelsOfTwos(int levels) {
    if (!amr_.ratios || amr_.ratios->empty()) return levels;
    int twos = 1;
    for (int k = 0; k + 1 < levels; ++k) {
      const Index3& ratio = (*amr_.ratios)[std::min<std::size_t>(k, amr_.ratios->size() - 1)];
      twos += std::countr_zero(static_cast<unsigned>(ratio[coarsest_.axis(0)]));
    }
    return twos;
  }

  /// The largest number of levels that the scene allows in the run.
  int countLevels() {
    const int given = finest_ + 1;
    const bool isAdaptive = amr_.regrid.adaptive;
    const Element place = regridderTagOr(amr_, "max_levels", elements_.front());
    const int said = amr_.maxLevels.value_or(isAdaptive ? 2 : 1);
    const int asked = amr_.maxLevels ? levelsOfTwos(said) : std::max(levelsOfTwos(said), given);
    if (asked < given)
      diagnostics_.error(place, fmt::format("found {}, but the Levels of <Grid> define {} levels", asked, given));
    else if (isAdaptive && asked < 2)
      diagnostics_.note(place, "with one level, <adaptive> does nothing");
    else if (!isAdaptive && asked > given)
      diagnostics_.note(place,
                        "does nothing: the grid is not <adaptive>, so its Levels alone determine what is refined");
    if (asked > mostLevels)
      diagnostics_.error(place, fmt::format("found {}, which corresponds to {} levels of ratio 2 because of "
                                            "<cell_refinement_ratio>; at most {} are possible",
                                            said, asked, mostLevels));
    return isAdaptive ? std::min(asked, mostLevels) : given;
  }

  void checkCount(int axis) {
    const double cells = std::ldexp(coarsest_.domain().resolution[axis], refinement_.levels - 1);
    const double blocks = cells / refinement_.blockCells[axis];
    if (cells <= mostCells && blocks <= mostBlocks) return;
    const Element place = regridderTagOr(amr_, "max_levels", elements_.back());
    diagnostics_.error(place, fmt::format("with {} levels there would be {:.3g} cells in {:.3g} blocks along {}; at "
                                          "most {:.3g} cells and {} blocks are possible",
                                          refinement_.levels, cells, blocks, "xyz"[axis], mostCells, mostBlocks));
  }

  void noteWhatGrows() {
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const grid::FineRegion& region = refinement_.regions[k];
      grid::FineRegion grown = region;
      bool grows = false;
      for (int d = 0; d < coarsest_.dimension(); ++d) {
        const int axis = coarsest_.axis(d);
        const double block = std::ldexp(coarsest_.cellWidth(axis) * refinement_.blockCells[axis], 1 - region.level);
        const double start = coarsest_.domain().lower[axis];
        const double slack = 1e-3 / refinement_.blockCells[axis];  // as the grid has it
        grown.lower[axis] = start + block * std::floor((region.lower[axis] - start) / block + slack);
        grown.upper[axis] = start + block * std::ceil((region.upper[axis] - start) / block - slack);
        grows = grows || region.lower[axis] - grown.lower[axis] > slack * block ||
                grown.upper[axis] - region.upper[axis] > slack * block;
      }
      if (grows)
        diagnostics_.note(
            boxes_[k],
            fmt::format("is enlarged to whole blocks: from [{:g},{:g},{:g}] to [{:g},{:g},{:g}] m", grown.lower[0],
                        grown.lower[1], grown.lower[2], grown.upper[0], grown.upper[1], grown.upper[2]));
    }
  }

  /// Notes boxes of one level that share cells, which is seldom intended.
  void noteOverlaps() {
    for (std::size_t b = 0; b < boxes_.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) {
        if (!overlap(refinement_.regions[a], refinement_.regions[b])) continue;
        diagnostics_.note(boxes_[b],
                          fmt::format("overlaps the Box of the same level at {}; the cells that both contain "
                                      "are refined once",
                                      boxes_[a].where().text()));
        break;
      }
  }

  bool overlap(const grid::FineRegion& a, const grid::FineRegion& b) const {
    return a.level == b.level && commonCells(a, b) > 0;
  }

  /// The volume that two regions share, in cells of the first Level.
  double commonCells(const grid::FineRegion& a, const grid::FineRegion& b) const {
    double cells = 1;
    for (int d = 0; d < coarsest_.dimension(); ++d) {
      const int axis = coarsest_.axis(d);
      const double width = std::min(a.upper[axis], b.upper[axis]) - std::max(a.lower[axis], b.lower[axis]);
      const double along = width / coarsest_.cellWidth(axis);
      if (along <= 1e-6) return 0;
      cells *= along;
    }
    return cells;
  }

  /// Notes boxes that are not in those of the next coarser Level: the grid nests all levels, and refines more.
  void noteUnnested() {
    const std::vector<grid::FineRegion>& regions = refinement_.regions;
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
      int coarser = 0;
      for (const grid::FineRegion& other : regions)
        if (other.level < regions[b].level) coarser = std::max(coarser, other.level);
      double inside = 0;
      for (const grid::FineRegion& other : regions)
        if (other.level == coarser) inside += commonCells(other, regions[b]);
      if (coarser > 0 && inside < (1 - 1e-6) * commonCells(regions[b], regions[b]))
        diagnostics_.note(boxes_[b],
                          "is not inside the Boxes of the previous Level; the cells around it are refined as well, so "
                          "that levels are nested");
    }
  }

  std::vector<Element> elements_;
  const std::vector<LevelSection>& levels_;
  const AmrSettings& amr_;
  grid::Level coarsest_;
  grid::Refinement& refinement_;
  Diagnostics& diagnostics_;
  std::vector<Element> boxes_;  ///< tags of the refined regions
  int finest_ = 0;              ///< level of the finest Box
};

}  // namespace

void readRefinement(const Element& grid, const std::vector<LevelSection>& levels, const AmrSettings& amr,
                    grid::Domain& domain, Diagnostics& diagnostics) {
  Refiner(grid, levels, amr, domain, diagnostics).read();
}

}  // namespace tushar::scene
