#include "core/simulation/refinement_marks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// |q(i+1) - q(i-1)| / 2.
double halfJump(const Neighbours& near, int components) {
  double sum = 0;
  for (int k = 0; k < components; ++k) {
    const double jump = valueAt(near.above, near.middle, k) - valueAt(near.below, near.middle, k);
    sum += jump * jump;
  }
  return 0.5 * std::sqrt(sum);
}

double relativeJump(const Neighbours& near, int components) {
  const double jump = halfJump(near, components);
  if (components > 1 || jump == 0) return jump;
  const double least = std::min({std::abs(valueAt(near.below, near.middle, 0)), std::abs(near.middle[0]),
                                 std::abs(valueAt(near.above, near.middle, 0))});
  return least > 0 ? jump / least : std::numeric_limits<double>::infinity();
}

double secondDerivative(const std::vector<Neighbours>& axes, int components) {
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

double gradient(const std::vector<Neighbours>& axes, const std::vector<double>& spacing, int components) {
  double sum = 0;
  for (std::size_t d = 0; d < axes.size(); ++d) {
    const double slope = halfJump(axes[d], components) / spacing[d];
    sum += slope * slope;
  }
  return std::sqrt(sum);
}

/// What one criterion asks for, 0, 1 or 2.
int markOf(const Criterion& criterion, const std::vector<Neighbours>& axes, const std::vector<double>& spacing,
           int components) {
  const double value = indicatorOf(criterion.indicator, axes, spacing, components);
  const bool isBelow = criterion.indicator == Indicator::below;
  const auto isBeyond = [&](double limit) { return isBelow ? value < limit : value > limit; };
  return isBeyond(criterion.refine) ? 2 : isBeyond(criterion.coarsen) ? 1 : 0;
}

/// The last access is that of the marks.
void findMarks(const tasks::TaskContext& context, const std::vector<BoundCriterion>& criteria) {
  const grid::Level& level = context.patch().level();
  const int dimension = level.dimension();
  std::vector<double> spacing;
  for (int d = 0; d < dimension; ++d) spacing.push_back(level.spacing(d));
  const data::Variable marks = context.variable(static_cast<int>(criteria.size()));
  std::vector<Neighbours> axes(static_cast<std::size_t>(dimension));
  grid::forEach<3>(context.patch().cells(), [&](const Index3& cell) {
    int mark = 0;
    for (std::size_t k = 0; k < criteria.size(); ++k) {
      const int components = criteria[k].label->components;
      const data::Variable values = context.variable(static_cast<int>(k));
      const auto at = [&](const Index3& place) -> const double* {
        if (!values.stored.contains(place) || !level.clipCells({place, place + Index3::filled(1)}).size())
          return nullptr;
        return reinterpret_cast<const double*>(values.values) +
               values.stored.offset(place) * static_cast<std::size_t>(components);
      };
      for (int d = 0; d < dimension; ++d)
        axes[static_cast<std::size_t>(d)] = {at(cell - Index3::unit(d)), at(cell), at(cell + Index3::unit(d))};
      mark = std::max(mark, markOf(criteria[k].criterion, axes, spacing, components));
    }
    reinterpret_cast<int*>(marks.values)[marks.stored.offset(cell)] = mark;
  });
}

}  // namespace

double indicatorOf(Indicator indicator, const std::vector<Neighbours>& axes, const std::vector<double>& spacing,
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

tasks::Task markTask(std::vector<BoundCriterion> criteria) {
  tasks::Task task;
  task.name = "findRefinementMarks";
  for (const BoundCriterion& one : criteria)
    task.accesses.push_back(
        {one.label, one.isDiagnosed ? tasks::AccessKind::requiresNew : tasks::AccessKind::requiresOld, 1});
  task.accesses.push_back({&refinementMark, tasks::AccessKind::computes});
  task.body = [criteria = std::move(criteria)](const tasks::TaskContext& context) { findMarks(context, criteria); };
  return task;
}

}  // namespace tushar::simulation
