#pragma once

#include <vector>

#include "core/tasks/access.hpp"

namespace tushar::tasks {

/// Marks of cells: 0: none, 1: do not coarsen, 2: refine.
inline constexpr data::CellLabel<int> refinementMark{"c.refinementMark", "1", "marks of the refinement criteria"};

/// Sets the refinement marks of a patch. If several criteria mark a cell, the one that requires the finest cells
/// counts.
class Marks {
 public:
  explicit Marks(const data::CellView<int>& marks) : marks_(marks) {}

  /// Marks a cell for refinement.
  template <int D>
  void refine(const Index<D>& cell) const {
    marks_[cell] = 2;
  }
  /// Marks a cell that must not be coarsened.
  template <int D>
  void keep(const Index<D>& cell) const {
    marks_[cell] = std::max(marks_[cell], 1);
  }

 private:
  data::CellView<int> marks_;
};

struct MarksAccess {
  int index = -1;

  void declare(std::vector<Access>& accesses) {
    index = static_cast<int>(accesses.size());
    accesses.push_back({&refinementMark, AccessKind::modifies});
  }
  Marks bind(const TaskContext& context) const {
    return Marks(context.grid<data::Centring::cell, int>(index, refinementMark));
  }
};
/// Passes Marks to the body. For perPatch tasks of Component::scheduleErrorEstimate.
inline MarksAccess marks() { return {}; }
template <>
inline constexpr bool isMarks<MarksAccess> = true;

struct NewCellsAccess {
  void declare(std::vector<Access>&) {}
  const std::vector<grid::Box>& bind(const TaskContext& context) const { return context.newCells(); }
};
/// Passes the boxes of the newly refined cells of a patch to the body: a const std::vector<Box>&. For tasks of
/// Component::scheduleRefine, except those of a rank.
inline NewCellsAccess newCells() { return {}; }
template <>
inline constexpr bool isNewCells<NewCellsAccess> = true;

struct BesideFinerAccess {
  void declare(std::vector<Access>&) {}
  std::vector<grid::Box> bind(const TaskContext& context) const { return context.besideFiner(); }
};
/// Passes the boxes of the cells of a patch that have faces to finer cells to the body: a const std::vector<Box>&. For
/// tasks of Component::scheduleAfterRefluxing, except those of a rank. Boxes of different axes may overlap.
inline BesideFinerAccess besideFiner() { return {}; }
template <>
inline constexpr bool isNewCells<BesideFinerAccess> = true;

}  // namespace tushar::tasks
