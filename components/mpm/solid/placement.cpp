#include "components/mpm/solid/placement.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <limits>

#include "components/mpm/solid/material.hpp"
#include "core/input/geometry/smooth_cylinder.hpp"

namespace tushar::mpm::solid {

Matrix3 Body::affineMatrix() const {
  Matrix3 rows;
  rows << affineRow0.transpose(), affineRow1.transpose(), affineRow2.transpose();
  return rows;
}

Vec3 Body::inShape(const Vec3& point) const {
  const Matrix3 matrix = affineMatrix();
  if (matrix == Matrix3::Identity()) return point - affineShift;
  return matrix.inverse() * (point - affineShift);
}

namespace {

Vec3 widthsOf(const Level& level) { return {level.cellWidth(0), level.cellWidth(1), level.cellWidth(2)}; }

/// Factors that convert lengths along x, y, z to cells; 1 along an axis without width.
Vec3 inCells(const Level& level) {
  Vec3 inverse = widthsOf(level);
  for (int axis = 0; axis < 3; ++axis) inverse[axis] = inverse[axis] > 0 ? 1 / inverse[axis] : 1;
  return inverse;
}

/// A particle of a cell that is being filled.
struct Filling {
  Vec3 at, spacing;  ///< position and spacing [m]
  double share;      ///< ratio of its extent to that of the largest particle [1]
  double depth;      ///< its share of the depth of the grid [1]
};

/// Whether the eight points a quarter of `spacing` away lie in a shape; axes without width are ignored.
bool isFullyInside(const input::GeometryPiece& shape, const Vec3& at, const Vec3& spacing) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 away(corner & 1 ? 0.25 : -0.25, corner & 2 ? 0.25 : -0.25, corner & 4 ? 0.25 : -0.25);
    if (!shape.contains(at + away.cwiseProduct(spacing))) return false;
  }
  return true;
}

bool overlaps(const Filling& one, const Vec3& point) {
  return ((point - one.at).array().abs() <= 0.5 * one.spacing.array()).all();
}

/// Adds particles of 2^-k times the full size in the gaps between the existing particles.
template <int D>
void fillGaps(const Level& level, const Body& body, const Index<D>& cell, int k, std::vector<Filling>& particles) {
  Body finer = body;
  for (int d = 0; d < D; ++d) finer.particlesPerCell[level.axis(d)] *= 1 << k;
  const std::vector<Filling> before = particles;
  forEachParticleIn<D>(level, finer, cell, [&](const Index<D>&, const Vec3& at, double depth) {
    for (const Filling& one : before)
      if (overlaps(one, at)) return;
    Vec3 spacing = widthsOf(level);
    for (int axis = 0; axis < 3; ++axis) spacing[axis] /= finer.particlesPerCell[axis];
    particles.push_back({at, spacing, 1.0 / (1 << k), depth});
  });
}

/// The particles of a cell, in |`levels`| sizes, each half the previous one. If `levels` is negative, smaller particles
/// replace those that extend beyond the shape.
template <int D>
std::vector<Filling> fill(const Level& level, const Body& body, const Index<D>& cell) {
  std::vector<Filling> particles;
  fillGaps<D>(level, body, cell, 0, particles);
  Vec3 spacing = widthsOf(level);
  for (int axis = 0; axis < 3; ++axis) spacing[axis] /= body.particlesPerCell[axis];
  for (int k = 1; k < std::abs(body.levels); ++k) {
    if (body.levels < 0)
      std::erase_if(particles, [&](const Filling& one) { return !isFullyInside(*body.shape, one.at, spacing); });
    fillGaps<D>(level, body, cell, k, particles);
    for (int d = 0; d < D; ++d) spacing[level.axis(d)] *= 0.5;
  }
  return particles;
}

/// Whether a point is in the one cell along each axis along which the grid has only one.
bool isInThinAxes(const Level& level, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis)
    if (level.domain().resolution[axis] == 1 && level.cellWidth(axis) > 0 &&
        !(point[axis] >= level.domain().lower[axis] && point[axis] <= level.domain().upper[axis]))
      return false;
  return true;
}

/// Puts a seed into the cell that contains it.
template <int D>
void add(const Level& level, const Body& body, const Seed& seed, Seeds& seeds) {
  const Index<D> cell = level.cellOf<D>(level.reduce<D>(seed.at));
  if (!level.isInside<D>(cell) || (body.list && !isInThinAxes(level, seed.at)))
    throw InputError({{body.where, "geom_object",
                       fmt::format("a particle would start at ({:g}, {:g}, {:g}) m, outside the grid", seed.at[0],
                                   seed.at[1], seed.at[2])}});
  seeds[level.cellNumber<D>(cell)].push_back(seed);
}

template <int D>
void seedFilling(const Level& level, const Body& body, const Index<D>& cell, Seeds& seeds) {
  const Matrix3 matrix = body.affineMatrix();
  const Vec3 widths = widthsOf(level), inverse = inCells(level);
  for (const Filling& one : fill<D>(level, body, cell)) {
    Vec3 edges;
    for (int axis = 0; axis < 3; ++axis) edges[axis] = 1.0 / body.particlesPerCell[axis];
    for (int d = 0; d < D; ++d) edges[level.axis(d)] *= one.share;
    const Vec3 at = matrix * one.at + body.affineShift;
    const Vec3 lengths = (widths.array() > 0).select(edges.cwiseProduct(widths), edges);
    double volume = one.depth * matrix.determinant();
    for (int d = 0; d < D; ++d) volume *= edges[level.axis(d)];
    add<D>(level, body, {at, inverse.asDiagonal() * matrix * lengths.asDiagonal(), volume}, seeds);
  }
}

template <int D>
void seedCylinder(const Level& level, const Body& body, const input::SmoothCylinder& cylinder, Seeds& seeds) {
  const Vec3 inverse = inCells(level);
  for (const input::SmoothCylinder::Particle& one : cylinder.particles(level.cellVolume()))
    add<D>(level, body, {one.at, inverse.asDiagonal() * one.edges, one.volume / level.cellVolume()}, seeds);
}

/// The edges of a listed particle [m], one per column, in an order in which those along axes that the grid does not use
/// are their own columns, and the volume is positive: files have them in any order.
template <int D>
Matrix3 orderedEdges(const Level& level, Matrix3 edges) {
  std::array<bool, 3> isUsed{};
  for (int d = 0; d < D; ++d) isUsed[level.axis(d)] = true;
  for (int axis = 0; axis < 3; ++axis) {
    if (isUsed[axis]) continue;
    int along = axis;
    for (int k = 0; k < 3; ++k)
      if (std::abs(edges(axis, k)) > std::abs(edges(axis, along)) && (isUsed[k] || k > axis)) along = k;
    edges.col(axis).swap(edges.col(along));
  }
  if (edges.determinant() > 0) return edges;
  if constexpr (D > 1)
    edges.col(level.axis(D - 2)).swap(edges.col(level.axis(D - 1)));
  else
    edges.col(level.axis(0)) *= -1;
  return edges;
}

/// The domain and volume of a listed particle; `at` is not set.
template <int D>
Seed sizeOf(const Level& level, const Body& body, std::size_t k) {
  const ListedParticles& list = *body.list;
  Seed seed = partOfCell<D>(level, body.particlesPerCell);
  if (!list.edges.empty()) {
    const Matrix3 edges = orderedEdges<D>(level, list.edges[k]);
    seed.domain = inCells(level).asDiagonal() * edges;
    seed.volume = edges.determinant() / level.cellVolume();
  }
  if (list.volume.empty()) return seed;
  seed.volume = list.volume[k] / level.cellVolume();
  if (!list.edges.empty()) return seed;
  double cell = 1;
  for (int d = 0; d < D; ++d) cell *= level.spacing(d);
  for (int d = 0; d < D; ++d)
    seed.domain(level.axis(d), level.axis(d)) = std::pow(seed.volume * cell, 1.0 / D) / level.spacing(d);
  return seed;
}

/// Half the extent of a particle along x, y, z [m]; infinite along axes of which the grid has one cell.
template <int D>
Vec3 halfExtent(const Level& level, const Seed& seed) {
  Vec3 half = Vec3::Constant(std::numeric_limits<double>::infinity());
  for (int d = 0; d < D; ++d)
    half[level.axis(d)] = 0.5 * level.spacing(d) * seed.domain.row(level.axis(d)).cwiseAbs().sum();
  return half;
}

template <int D>
void seedList(const Level& level, Body& body, Seeds& seeds) {
  const auto list = std::make_shared<ListedParticles>(*body.list);
  std::vector<Vec3> half;
  for (std::size_t k = 0; k < list->at.size(); ++k) {
    Seed seed = sizeOf<D>(level, body, k);
    seed.at = list->at[k];
    seed.listed = k;
    add<D>(level, body, seed, seeds);
    if (k == 0 || !list->edges.empty() || !list->volume.empty()) half.push_back(halfExtent<D>(level, seed));
  }
  list->giveBoxes(std::move(half));
  body.shape = body.list = list;
}

template <int D>
void place(const Level& level, Body& body) {
  const auto* cylinder = dynamic_cast<const input::SmoothCylinder*>(body.shape.get());
  if (!cylinder && !body.list && std::abs(body.levels) <= 1 && body.affineMatrix() == Matrix3::Identity() &&
      body.affineShift.isZero(0))
    return;
  auto seeds = std::make_shared<Seeds>();
  if (cylinder)
    seedCylinder<D>(level, body, *cylinder, *seeds);
  else if (body.list)
    seedList<D>(level, body, *seeds);
  else
    forEach<D>(level.cells(), [&](const Index<D>& cell) { seedFilling<D>(level, body, cell, *seeds); });
  body.seeds = seeds;
}

}  // namespace

void placeParticles(const Level& level, std::vector<Body>& bodies) {
  for (Body& body : bodies) {
    if (level.dimension() == 1) place<1>(level, body);
    if (level.dimension() == 2) place<2>(level, body);
    if (level.dimension() == 3) place<3>(level, body);
  }
}

}  // namespace tushar::mpm::solid
