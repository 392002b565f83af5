#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "components/mpm/solid/tensor.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

struct Body;

/// A particle that does not start at the centre of one of the equal parts of a cell.
struct Seed {
  Vec3 at = Vec3::Zero();                            ///< position [m]
  Matrix3 domain = Matrix3::Zero();                  ///< edges of the particle in cells, one per column
  double volume = 0;                                 ///< volume of the particle, in cells
  std::optional<std::size_t> listed = std::nullopt;  ///< its number in the list of the body's particles, if it has one
};

/// The particles of a body, by the index of the cell in which they start.
using Seeds = std::map<std::uint64_t, std::vector<Seed>>;

/// The seed of a particle that fills one of the equal parts of a cell; `at` is not set.
template <int D>
Seed partOfCell(const Level& level, const Index3& particlesPerCell) {
  Seed seed;
  for (int axis = 0; axis < 3; ++axis) seed.domain(axis, axis) = 1.0 / particlesPerCell[axis];
  Vec<D> extent;
  for (int d = 0; d < D; ++d) extent[d] = seed.domain(level.axis(d), level.axis(d));
  seed.volume = extent.prod();
  return seed;
}

/// The extent of a particle along the axes of the kernel, in cells; if its edges are not parallel to these, the extent
/// of a cube with its volume.
template <int D>
Vec<D> extentOf(const Level& level, const Seed& seed) {
  Vec<D> extent;
  bool isAlongAxes = true;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      if (i == j)
        extent[i] = std::abs(seed.domain(level.axis(i), level.axis(i)));
      else
        isAlongAxes = isAlongAxes && seed.domain(level.axis(i), level.axis(j)) == 0;
  return isAlongAxes ? extent : Vec<D>(Vec<D>::Constant(std::pow(seed.volume, 1.0 / D)));
}

/// Finds the seeds of each body whose particles do not start in equal parts of cells: bodies with particles of several
/// sizes, transformed bodies, smooth cylinders, and bodies whose particles a file lists. Throws InputError if a
/// particle would start outside the grid.
void placeParticles(const Level& level, std::vector<Body>& bodies);

}  // namespace tushar::mpm::solid
