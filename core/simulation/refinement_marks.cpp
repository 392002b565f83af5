#include "core/simulation/refinement_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tushar::simulation {

namespace {

constexpr double filter = 0.01;  // Löhner's epsilon: ripples of a hundredth of the value do not count

using Indicator = Criterion::Indicator;

double valueAt(const double* cell, const double* otherwise, int component) {
  return (cell ? cell : otherwise)[component];
}

double norm(const double* values, int components) {
  double sum = 0;
  for (int k = 0; k < components; ++k) sum += values[k] * values[k];
  return components == 1 ? std::abs(values[0]) : std::sqrt(sum);
}

/// Half the central difference: |q(i+1) - q(i-1)| / 2.
double halfJump(const Neighbours& near, int components) {
  if (components == 1) return 0.5 * std::abs(valueAt(near.above, near.middle, 0) - valueAt(near.below, near.middle, 0));
  double sum = 0;
  for (int k = 0; k < components; ++k) {
    const double jump = valueAt(near.above, near.middle, k) - valueAt(near.below, near.middle, k);
    sum += jump * jump;
  }
  return 0.5 * std::sqrt(sum);
}

/// Half the difference between the outer two values, divided by the smallest magnitude of the three; infinite if that
/// is 0.
double relativeJump(double below, double middle, double above) {
  const double jump = 0.5 * std::abs(above - below), a = std::abs(below), b = std::abs(middle), c = std::abs(above);
  const double least = b < a ? b : a;
  return jump == 0 ? 0 : jump / (c < least ? c : least);
}

double relativeJump(const Neighbours& near, int components) {
  if (components > 1) return halfJump(near, components);
  return relativeJump(valueAt(near.below, near.middle, 0), near.middle[0], valueAt(near.above, near.middle, 0));
}

double secondDerivative(std::span<const Neighbours> axes, int components) {
  double over = 0, under = 0;
  for (const Neighbours& near : axes)
    for (int k = 0; k < components; ++k) {
      const double a = valueAt(near.below, near.middle, k), b = near.middle[k], c = valueAt(near.above, near.middle, k);
      const double second = (c - b) - (b - a);
      const double first = std::abs(c - b) + std::abs(b - a) + filter * (std::abs(a) + 2 * std::abs(b) + std::abs(c));
      over += second * second;
      under += first * first;
    }
  return under > 0 ? std::sqrt(over / under) : 0;
}

double gradient(std::span<const Neighbours> axes, std::span<const double> spacing, int components) {
  double sum = 0;
  for (std::size_t d = 0; d < axes.size(); ++d) {
    const double slope = halfJump(axes[d], components) / spacing[d];
    sum += slope * slope;
  }
  return std::sqrt(sum);
}

/// The mark that one criterion gives to a cell: 0, 1 or 2.
int markOf(const Criterion& criterion, std::span<const Neighbours> axes, std::span<const double> spacing,
           int components) {
  const double value = indicatorOf(criterion.indicator, axes, spacing, components);
  const bool isBelow = criterion.indicator == Indicator::below;
  const auto isBeyond = [&](double limit) { return isBelow ? value < limit : value > limit; };
  return isBeyond(criterion.refine) ? 2 : isBeyond(criterion.coarsen) ? 1 : 0;
}

/// Raises `most` to a number that increases with the jump of the `N` components from the cell below to the cell above:
/// the jump itself or, for vectors, the square of twice the jump.
template <int N>
void raiseJump(const double* below, const double* middle, const double* above, double& most) {
  double jump = 0;
  if constexpr (N == 1)
    jump = relativeJump(*below, *middle, *above);
  else
    for (int k = 0; k < N; ++k) jump += (above[k] - below[k]) * (above[k] - below[k]);
  most = jump > most ? jump : most;
}

/// Like raiseMarks, for jumps of variables with `N` components, row by row along the first axis. Most criteria are of
/// this kind. The loops are vectorised.
template <int N>
void raiseMarksOfJumps(const grid::Patch& patch, const Criterion& criterion, const data::Variable& values,
                       const data::Variable& marks) {
  const int dimension = patch.level().dimension();
  const grid::Box& stored = values.stored;
  const auto* numbers = reinterpret_cast<const double*>(values.values);
  const double refine = criterion.refine, coarsen = criterion.coarsen;
  std::vector<double> greatest(static_cast<std::size_t>(patch.cells().extent(0)));
  double* const most = greatest.data();
  grid::forEachRow<3>(patch.cells(), [&](const Index3& first, int count) {
    const double* row = numbers + stored.offset(first) * N;
    int* mark = reinterpret_cast<int*>(marks.values) + marks.stored.offset(first);
    std::ptrdiff_t stride = N;
    // Cells from one place in the row to another, with or without cells on both sides.
    const auto raise = [&](std::ptrdiff_t from, std::ptrdiff_t to, bool hasBelow, bool hasAbove) {
      const double *below = hasBelow ? row - stride : row, *above = hasAbove ? row + stride : row;
#pragma GCC ivdep
      for (std::ptrdiff_t k = from; k < to; ++k) raiseJump<N>(below + k * N, row + k * N, above + k * N, most[k]);
    };
    std::fill(greatest.begin(), greatest.end(), 0.0);
    const bool hasLower = first[0] > stored.lower[0], hasUpper = first[0] + count < stored.upper[0];
    if (!hasLower) raise(0, 1, false, hasUpper || count > 1);
    raise(hasLower ? 0 : 1, hasUpper ? count : count - 1, true, true);
    if (!hasUpper && (hasLower || count > 1)) raise(count - 1, count, true, false);
    for (int d = 1; d < dimension; ++d) {
      stride *= stored.extent(d - 1);
      raise(0, count, first[d] > stored.lower[d], first[d] + 1 < stored.upper[d]);
    }
#pragma GCC ivdep
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      const double jump = N == 1 ? most[k] : 0.5 * std::sqrt(most[k]);
      const int here = jump > refine ? 2 : jump > coarsen ? 1 : 0;
      mark[k] = mark[k] > here ? mark[k] : here;
    }
  });
}

/// Raises the marks of a patch to those of one criterion. The stored values include ghosts around the patch, except
/// outside the grid.
void raiseMarks(const grid::Patch& patch, const BoundCriterion& bound, const data::Variable& values,
                const data::Variable& marks) {
  const grid::Level& level = patch.level();
  const std::size_t dimension = level.dimension();
  const int components = bound.label->components;
  if (bound.criterion.indicator == Indicator::jump) {
    if (components == 1) return raiseMarksOfJumps<1>(patch, bound.criterion, values, marks);
    if (components == 2) return raiseMarksOfJumps<2>(patch, bound.criterion, values, marks);
    if (components == 3) return raiseMarksOfJumps<3>(patch, bound.criterion, values, marks);
  }
  std::array<Neighbours, 3> axes{};
  std::array<double, 3> spacing{};
  std::array<std::ptrdiff_t, 3> stride{components, 0, 0};
  for (std::size_t d = 0; d < 3; ++d) {
    const int axis = static_cast<int>(d);
    if (d > 0) stride[d] = stride[d - 1] * values.stored.extent(axis - 1);
    if (d < dimension) spacing[d] = level.spacing(axis);
  }
  grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
    const double* here = reinterpret_cast<const double*>(values.values) +
                         static_cast<std::ptrdiff_t>(values.stored.offset(cell)) * components;
    for (std::size_t d = 0; d < dimension; ++d) {
      const int axis = static_cast<int>(d);
      axes[d] = {cell[axis] > values.stored.lower[axis] ? here - stride[d] : nullptr, here,
                 cell[axis] + 1 < values.stored.upper[axis] ? here + stride[d] : nullptr};
    }
    int& mark = reinterpret_cast<int*>(marks.values)[marks.stored.offset(cell)];
    mark = std::max(mark, markOf(bound.criterion, std::span(axes).first(dimension), std::span(spacing).first(dimension),
                                 components));
  });
}

/// Computes the marks of a patch; the last access contains the marks.
void findMarks(const tasks::TaskContext& context, const std::vector<BoundCriterion>& criteria) {
  const data::Variable marks = context.variable(static_cast<int>(criteria.size()));
  std::fill_n(reinterpret_cast<int*>(marks.values), marks.stored.size(), 0);
  for (std::size_t k = 0; k < criteria.size(); ++k) {
    const auto raise = [&](const tasks::TaskContext& of) {
      raiseMarks(context.patch(), criteria[k], of.variable(static_cast<int>(k)), marks);
    };
    const BoundCriterion& one = criteria[k];
    if (one.materials.empty()) raise(context);
    for (std::size_t m = 0; m < one.materials.size(); ++m)
      if (one.criterion.material.empty() || one.criterion.material == one.materials[m]) raise(context.ofMaterials()[m]);
  }
}

}  // namespace

double indicatorOf(Indicator indicator, std::span<const Neighbours> axes, std::span<const double> spacing,
                   int components) {
  switch (indicator) {
    case Indicator::secondDerivative:
      return secondDerivative(axes, components);
    case Indicator::gradient:
      return gradient(axes, spacing, components);
    case Indicator::above:
    case Indicator::below:
      return components == 1 ? axes.front().middle[0] : norm(axes.front().middle, components);
    case Indicator::jump:
      break;
  }
  double greatest = 0;
  for (const Neighbours& near : axes) greatest = std::max(greatest, relativeJump(near, components));
  return greatest;
}

std::vector<std::string> materialsOf(const std::vector<tasks::Task>& tasks, const data::Label& label) {
  for (const tasks::Task& task : tasks)
    for (const tasks::Access& access : task.accesses)
      if (access.writes() && access.label->name == label.name)
        return task.perMaterial(access) ? task.materials : std::vector<std::string>();
  return {};
}

tasks::Task markTask(std::vector<BoundCriterion> criteria) {
  tasks::Task task;
  task.name = "findRefinementMarks";
  for (const BoundCriterion& one : criteria)
    if (!one.materials.empty()) task.materials = one.materials;
  task.acrossMaterials = !task.materials.empty();
  for (const BoundCriterion& one : criteria)
    task.accesses.push_back({.label = one.label,
                             .kind = one.isDiagnosed ? tasks::AccessKind::requiresNew : tasks::AccessKind::requiresOld,
                             .ghost = 1,
                             .ofNone = task.acrossMaterials && one.materials.empty()});
  task.accesses.push_back(
      {.label = &tasks::refinementMark, .kind = tasks::AccessKind::computes, .ofNone = task.acrossMaterials});
  task.body = [criteria = std::move(criteria)](const tasks::TaskContext& context) { findMarks(context, criteria); };
  return task;
}

}  // namespace tushar::simulation
