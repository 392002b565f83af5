#include "core/grid/level.hpp"

#include <algorithm>

#include "core/grid/grid.hpp"

namespace tushar::grid {

Level::Level(const Domain& domain, int number, int levels, const Grid* grid)
    : number_(number), halvings_(levels - 1 - number), grid_(grid), domain_(domain) {
  chooseAxes();
  for (int d = 0; d < dimension(); ++d) domain_.resolution[axis(d)] <<= number;
  measure();
  if (!domain_.boxes.empty()) takeBoxes();
}

/// Takes the boxes of the domain, along the kernel axes.
void Level::takeBoxes() {
  std::vector<Box> boxes;
  for (const Box& given : domain_.boxes) {
    Box box{{}, Index3::filled(1)};
    for (int d = 0; d < dimension(); ++d) {
      box.lower[d] = given.lower[axis(d)];
      box.upper[d] = given.upper[axis(d)];
    }
    boxes.push_back(box);
  }
  boxes_ = std::make_unique<const SeveralBoxes>(std::move(boxes), cells_, dimension(), domain_.nodesBeyond);
}

void Level::chooseAxes() {
  const auto isPlane = [&](int axis, int side) {
    const auto& conditions = domain_.boundaries.face(axis, side);
    const auto has = [&](BoundaryKind kind) {
      return std::any_of(conditions.begin(), conditions.end(),
                         [&](const BoundaryCondition& c) { return c.kind == kind; });
    };
    return has(BoundaryKind::symmetry) && !has(BoundaryKind::dirichlet) &&
           domain_.boundaries.parts[2 * axis + side].empty();
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = domain_.upper[axis] - domain_.lower[axis];
    const bool flat = extent == 0;
    const bool thin =
        domain_.resolution[axis] == 1 && ((isPlane(axis, 0) && isPlane(axis, 1)) || domain_.periodic[axis] != 0);
    if (!flat && !thin) axes_.push_back(axis);
  }
  if (axes_.empty()) axes_.push_back(0);
  for (int d = 0; d < dimension(); ++d) is_periodic_ = is_periodic_ || isPeriodic(d);
}

void Level::measure() {
  cells_.upper = Index3::filled(1);
  for (int d = 0; d < dimension(); ++d) {
    const int cells = domain_.resolution[axis(d)];
    const double extent = domain_.upper[axis(d)] - domain_.lower[axis(d)];
    lower_[d] = domain_.lower[axis(d)];
    spacing_[d] = extent > 0 ? extent / cells : 1.0;
    inverse_spacing_[d] = 1.0 / spacing_[d];
    cells_.upper[d] = cells;
  }
  for (int axis = 0; axis < 3; ++axis)
    if (const double extent = domain_.upper[axis] - domain_.lower[axis]; extent != 0)
      cellVolume_ *= extent / domain_.resolution[axis];
}

const Level& Level::finest() const { return halvings_ > 0 ? grid_->finest() : *this; }

Box Level::nodes() const {
  Box nodes = nodesOfCells();
  for (int d = 0; d < dimension(); ++d) {
    if (isPeriodic(d)) continue;
    nodes.lower[d] -= domain_.nodesBeyond;
    nodes.upper[d] += domain_.nodesBeyond;
  }
  return nodes;
}

double Level::minSpacing() const {
  double least = spacing(0);
  for (int d = 1; d < dimension(); ++d) least = std::min(least, spacing(d));
  return least;
}

int Level::cellAlong(int kernelAxis, double x) const {
  const int cells = cells_.upper[kernelAxis];
  const double first = nodePosition(kernelAxis, 0), last = nodePosition(kernelAxis, cells);
  if (!(x >= first)) return -1;
  if (x >= last) return x == last ? cells - 1 : cells;
  int cell = std::min(static_cast<int>((x - first) / spacing(kernelAxis)), cells - 1);
  while (x < nodePosition(kernelAxis, cell)) --cell;
  while (cell + 1 < cells && x >= nodePosition(kernelAxis, cell + 1)) ++cell;
  return cell;
}

Box Level::cellsNear(const Vec3& lower, const Vec3& upper) const {
  Box near = cells_;
  for (int d = 0; d < dimension(); ++d) {
    near.lower[d] = std::max(0, cellAlong(d, lower[axis(d)]) - 1);
    near.upper[d] = std::min(cells_.upper[d], cellAlong(d, upper[axis(d)]) + 2);
  }
  return near;
}

std::string Level::axesLeftOut() const {
  std::string names;
  for (int axis = 0; axis < 3; ++axis)
    if (std::find(axes_.begin(), axes_.end(), axis) == axes_.end())
      names += (names.empty() ? "" : ", ") + std::string(1, "xyz"[axis]);
  return names;
}

Box Level::clip(const Box& box, const Box& grid) const {
  Box clipped = box;
  for (int d = 0; d < 3; ++d) {
    if (d < dimension() && isPeriodic(d)) continue;
    clipped.lower[d] = std::max(box.lower[d], grid.lower[d]);
    clipped.upper[d] = std::min(box.upper[d], grid.upper[d]);
  }
  return clipped;
}

std::vector<Index3> Level::imagesOverlapping(const Box& cells) const {
  Box images{{}, Index3::filled(1)};
  for (int d = 0; d < dimension(); ++d) {
    if (!isPeriodic(d)) continue;
    const int count = cells_.upper[d];
    const auto imageOf = [&](int cell) { return cell >= 0 ? cell / count : -((count - 1 - cell) / count); };
    images.lower[d] = imageOf(cells.lower[d]);
    images.upper[d] = imageOf(cells.upper[d] - 1) + 1;
  }
  std::vector<Index3> shifts;
  forEach<3>(images, [&](Index3 image) {
    for (int d = 0; d < 3; ++d) image[d] *= cells_.upper[d];
    shifts.push_back(image);
  });
  return shifts;
}

const BoundaryCondition* Level::condition(int kernelAxis, int side, const BoundaryVariable& variable, int material,
                                          int part) const {
  const auto* conditions = &domain_.boundaries.face(axis(kernelAxis), side);
  if (part != restOfSide) {
    const auto& own = parts(kernelAxis, side)[part].conditions;
    if (own.empty() ||
        std::any_of(own.begin(), own.end(), [&](const BoundaryCondition& one) { return one.isOf(material); }))
      conditions = &own;
  }
  for (const BoundaryCondition& condition : *conditions)
    if (condition.variable == variable && condition.isOf(material)) return &condition;
  return nullptr;
}

int Level::partOf(int kernelAxis, int side, const Vec3& x) const {
  const auto& all = parts(kernelAxis, side);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const ConditionsOfPart& part) { return part.shape.holds(x); });
  return found == all.end() ? restOfSide : static_cast<int>(found - all.begin());
}

}  // namespace tushar::grid
