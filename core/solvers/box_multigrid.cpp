#include "core/solvers/box_multigrid.hpp"

#include <algorithm>
#include <cmath>

namespace tushar::solvers {

namespace {

constexpr int sweeps = 2;          ///< degree of the smoother
constexpr double leastLinks = .3;  ///< an axis is coarsened if its links add up to this part of the strongest ones
/// If links balance at most this part of each diagonal entry, smoothing is enough.
constexpr double fewLinks = .5;

bool isLastOf(int ratio, int place, int extent) { return place % ratio == ratio - 1 || place + 1 == extent; }

/// The cells of the next level, and in `ratio` the number of cells along each axis that become one.
CellBox nextBox(const BoxStencil<double>& matrix, std::array<int, 3>& ratio) {
  const BoxShape& shape = matrix.shape;
  std::array<double, 3> strength{};
  for (int d = 0; d < 3; ++d) shape.forEachCell([&](std::ptrdiff_t at) { strength[d] += matrix.links[d][at]; });
  CellBox box = shape.box();
  for (int d = 0; d < 3; ++d) {
    if (shape.extent(d) == 1 || !(strength[d] > leastLinks * std::ranges::max(strength))) continue;
    ratio[d] = 2;
    box.cells[d] = (box.cells[d] + 1) / 2;
  }
  return box;
}

/// What links do not balance of each diagonal entry: terms of the cell itself, and links to given values at sides.
std::vector<double> unlinked(const BoxStencil<double>& matrix) {
  const BoxShape& shape = matrix.shape;
  std::vector<double> rest(shape.stored());
  shape.forEachCell([&](std::ptrdiff_t at) {
    rest[at] = matrix.diagonal[at];
    for (int d = 0; d < 3; ++d) rest[at] -= matrix.links[d][at] + matrix.links[d][at - shape.stride(d)];
  });
  return rest;
}

/// The part of `rest` of a cell that links to sides, along axes on which cells become coarser: what it has more than
/// the next cell inwards.
double linkedToSides(const BoxShape& shape, const std::array<int, 3>& ratio, const std::vector<double>& rest,
                     const std::array<int, 3>& cell, std::ptrdiff_t at) {
  double more = 0;
  for (int d = 0; d < 3; ++d) {
    if (ratio[d] == 1 || shape.box().isPeriodic[d]) continue;
    if (cell[d] == 0) more += std::max(0.0, rest[at] - rest[at + shape.stride(d)]);
    if (cell[d] + 1 == shape.extent(d)) more += std::max(0.0, rest[at] - rest[at - shape.stride(d)]);
  }
  return std::clamp(more, 0.0, std::max(0.0, rest[at]));
}

/// Sets the matrix of the next level. Links to sides get half as strong, like others; otherwise, coarse levels would
/// correct too little there, and each halving of the cells would take further iterations.
void takeCoarser(const BoxStencil<double>& fine, const std::array<int, 3>& ratio, BoxStencil<double>& coarse) {
  const BoxShape &shape = fine.shape, &to = coarse.shape;
  const std::vector<double> rest = unlinked(fine);
  for (int z = 0; z < shape.extent(2); ++z)
    for (int y = 0; y < shape.extent(1); ++y)
      for (int x = 0; x < shape.extent(0); ++x) {
        const std::array<int, 3> cell{x, y, z};
        const std::ptrdiff_t at = shape.offset(x, y, z), into = to.offset(x / ratio[0], y / ratio[1], z / ratio[2]);
        coarse.diagonal[into] += rest[at] - 0.5 * linkedToSides(shape, ratio, rest, cell, at);
        for (int d = 0; d < 3; ++d)
          if (isLastOf(ratio[d], cell[d], shape.extent(d))) coarse.links[d][into] += fine.links[d][at] / ratio[d];
      }
  coarse.close();
  to.forEachCell([&](std::ptrdiff_t at) {
    for (int d = 0; d < 3; ++d) coarse.diagonal[at] += coarse.links[d][at] + coarse.links[d][at - to.stride(d)];
  });
}

}  // namespace

BoxMultigrid::BoxMultigrid(const BoxStencil<double>& matrix) {
  const double greatest = std::ranges::max(matrix.diagonal);
  scale_ = greatest > 0 ? 1 / greatest : 1;
  levels_.emplace_back(matrix, scale_);
  BoxStencil<double> finer = matrix;
  while (levels_.back().linked > Real(fewLinks)) {
    BoxStencil<double> next(nextBox(finer, levels_.back().ratio));
    if (next.shape.cells() == finer.shape.cells()) return;
    takeCoarser(finer, levels_.back().ratio, next);
    levels_.emplace_back(next, scale_);
    finer = std::move(next);
  }
}

BoxMultigrid::Grid::Grid(const BoxStencil<double>& of, double scale)
    : matrix(of.shape.box()), inverse(of.shape.stored()), x(inverse), r(inverse), z(inverse) {
  const auto round = [&](const std::vector<double>& from, std::vector<Real>& to) {
    std::ranges::transform(from, to.begin(), [&](double value) { return static_cast<Real>(scale * value); });
  };
  round(of.diagonal, matrix.diagonal);
  for (int d = 0; d < 3; ++d) round(of.links[d], matrix.links[d]);
  const BoxShape& shape = matrix.shape;
  shape.forEachCell([&](std::ptrdiff_t at) {
    if (!(matrix.diagonal[at] > 0)) return;
    Real sum = 0;
    for (int d = 0; d < 3; ++d) sum += matrix.links[d][at] + matrix.links[d][at - shape.stride(d)];
    inverse[at] = 1 / matrix.diagonal[at];
    linked = std::max(linked, sum * inverse[at]);
  });
  for (Real& cell : inverse) cell /= 1 + linked;  // Gershgorin's bound of the eigenvalues
}

void BoxMultigrid::smooth(Grid& grid) {
  Real *x = grid.x.data(), *z = grid.z.data();
  const Real *r = grid.r.data(), *inverse = grid.inverse.data();
  const int cells = grid.matrix.shape.extent(0);
  for (int k = 1; k <= sweeps; ++k) {
    const Real kept = k == 1 ? 0 : Real(2 * k - 3) / Real(2 * k + 1), taken = Real(8 * k - 4) / Real(2 * k + 1);
    grid.matrix.shape.forEachRow([&](std::ptrdiff_t first) {
#pragma GCC ivdep
      for (std::ptrdiff_t at = first; at < first + cells; ++at) {
        z[at] = kept * z[at] + taken * inverse[at] * r[at];
        x[at] += z[at];
      }
    });
    grid.matrix.subtract(grid.z, grid.r);
  }
}

void BoxMultigrid::takeResidual(const Grid& fine, Grid& coarse) {
  std::ranges::fill(coarse.r, Real(0));
  std::ranges::fill(coarse.x, Real(0));
  const BoxShape &from = fine.matrix.shape, &to = coarse.matrix.shape;
  const int cells = from.extent(0);
  for (int z = 0; z < from.extent(2); ++z)
    for (int y = 0; y < from.extent(1); ++y) {
      const Real* r = fine.r.data() + from.offset(0, y, z);
      Real* sum = coarse.r.data() + to.offset(0, y / fine.ratio[1], z / fine.ratio[2]);
      if (fine.ratio[0] == 1) {
        for (int x = 0; x < cells; ++x) sum[x] += r[x];
        continue;
      }
      for (int x = 0; x < cells / 2; ++x) sum[x] += r[2 * x] + r[2 * x + 1];
      if (cells % 2) sum[cells / 2] += r[cells - 1];
    }
}

void BoxMultigrid::correct(const Grid& coarse, Grid& fine) {
  const BoxShape &from = coarse.matrix.shape, &to = fine.matrix.shape;
  for (int z = 0; z < to.extent(2); ++z)
    for (int y = 0; y < to.extent(1); ++y) {
      const Real* change = coarse.x.data() + from.offset(0, y / fine.ratio[1], z / fine.ratio[2]);
      const std::ptrdiff_t first = to.offset(0, y, z);
      for (int x = 0; x < to.extent(0); ++x) fine.z[first + x] = change[x / fine.ratio[0]];
      for (int x = 0; x < to.extent(0); ++x) fine.x[first + x] += fine.z[first + x];
    }
  fine.matrix.subtract(fine.z, fine.r);
}

void BoxMultigrid::cycle(std::size_t level) {
  Grid& grid = levels_[level];
  smooth(grid);
  if (level + 1 < levels_.size()) {
    takeResidual(grid, levels_[level + 1]);
    cycle(level + 1);
    correct(levels_[level + 1], grid);
  }
  smooth(grid);
}

void BoxMultigrid::apply(const std::vector<double>& b, std::vector<double>& z) {
  Grid& finest = levels_.front();
  double greatest = 0;
  for (const double value : b) greatest = std::max(greatest, std::abs(value));
  if (greatest == 0) greatest = 1;
  std::ranges::transform(b, finest.r.begin(), [&](double value) { return static_cast<Real>(value / greatest); });
  std::ranges::fill(finest.x, Real(0));
  cycle(0);
  for (std::size_t k = 0; k < z.size(); ++k)  // cells without an equation get part of their neighbours' correction
    z[k] = finest.inverse[k] > 0 ? greatest * scale_ * double(finest.x[k]) : 0;
}

}  // namespace tushar::solvers
