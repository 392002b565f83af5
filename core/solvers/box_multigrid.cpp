#include "core/solvers/box_multigrid.hpp"

#include <algorithm>
#include <cmath>

namespace tushar::solvers {

namespace {

constexpr int sweeps = 2;          ///< degree of the smoother
constexpr double leastLinks = .3;  ///< an axis is coarsened if its links add up to this part of the strongest ones
/// If links balance at most this part of each diagonal entry, smoothing is enough.
constexpr double fewLinks = .5;

/// A level with fewer cells is computed by each rank for itself: messages would take longer.
constexpr std::size_t fewCells = 8192;

bool isLastOf(int ratio, int place, int extent) { return place % ratio == ratio - 1 || place + 1 == extent; }

/// The planes of a level that become planes of the next one. Places of planes count from the first one that a rank has
/// of a level.
class PlanePairs {
 public:
  PlanePairs(const BoxShape& fine, const BoxShape& coarse, int ratio)
      : ratio_(ratio), end_(fine.extent(2)), shift_(fine.slabs().first() / ratio - coarse.slabs().first()) {}

  /// Calls visit(Z) for each coarse plane into which planes of this rank go.
  template <class Visit>
  void forEach(const BoxShape& fine, const Visit& visit) const {
    fine.slabs().coarser(ratio_).forEachPlane(fine.cellsOfPlane(), [&](int pair) { visit(pair + shift_); });
  }
  /// Calls visit(z) for the fine planes that go into the coarse plane Z.
  template <class Visit>
  void forEachIn(int Z, const Visit& visit) const {
    const int first = (Z - shift_) * ratio_;
    for (int z = first; z < std::min(first + ratio_, end_); ++z) visit(z);
  }
  int coarse(int z) const { return z / ratio_ + shift_; }

 private:
  int ratio_, end_, shift_;
};

/// The cells of the next level, and in `ratio` the number of cells along each axis that become one.
CellBox nextBox(const BoxStencil<double>& matrix, std::array<int, 3>& ratio) {
  const BoxShape& shape = matrix.shape;
  std::array<double, 3> strength{};
  for (int d = 0; d < 3; ++d) strength[d] = shape.sum([&](std::ptrdiff_t at) { return matrix.links[d][at]; });
  CellBox box = shape.box();
  for (int d = 0; d < 3; ++d) {
    if (box.cells[d] == 1 || !(strength[d] > leastLinks * std::ranges::max(strength))) continue;
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
    const int place = d == 2 ? cell[d] + shape.slabs().first() : cell[d];
    if (place == 0) more += std::max(0.0, rest[at] - rest[at + shape.stride(d)]);
    if (place + 1 == shape.box().cells[d]) more += std::max(0.0, rest[at] - rest[at - shape.stride(d)]);
  }
  return std::clamp(more, 0.0, std::max(0.0, rest[at]));
}

/// Calls visit(offset) for each cell of a slab with the offset of the coarse cell into which it goes.
template <class Visit>
void forEachInto(const BoxShape& shape, const BoxShape& to, const std::array<int, 3>& ratio, const Visit& visit) {
  const PlanePairs pairs(shape, to, ratio[2]);
  pairs.forEach(shape, [&](int Z) {
    pairs.forEachIn(Z, [&](int z) {
      for (int y = 0; y < shape.extent(1); ++y)
        for (int x = 0; x < shape.extent(0); ++x)
          visit({x, y, z}, shape.offset(x, y, z), to.offset(x / ratio[0], y / ratio[1], Z));
    });
  });
}

/// Sets the matrix of the next level. Links to sides get half as strong, like others; otherwise, coarse levels would
/// correct too little there, and each halving of the cells would take further iterations.
void takeCoarser(const BoxStencil<double>& fine, const std::array<int, 3>& ratio, BoxStencil<double>& coarse) {
  const BoxShape &shape = fine.shape, &to = coarse.shape;
  const std::vector<double> rest = unlinked(fine);
  forEachInto(shape, to, ratio, [&](const std::array<int, 3>& cell, std::ptrdiff_t at, std::ptrdiff_t into) {
    coarse.diagonal[into] += rest[at] - 0.5 * linkedToSides(shape, ratio, rest, cell, at);
    for (int d = 0; d < 3; ++d)
      if (isLastOf(ratio[d], cell[d], shape.extent(d))) coarse.links[d][into] += fine.links[d][at] / ratio[d];
  });
  coarse.close();
  to.forEachCell([&](std::ptrdiff_t at) {
    for (int d = 0; d < 3; ++d) coarse.diagonal[at] += coarse.links[d][at] + coarse.links[d][at - to.stride(d)];
  });
}

/// The planes of a level in a list of values with a layer around them, of which this rank has a part or all.
template <class Value>
std::span<Value> planesOf(const BoxShape& shape, std::vector<Value>& values) {
  const auto plane = static_cast<std::size_t>(shape.stride(2));
  return std::span(values).subspan(plane, values.size() - 2 * plane);
}

/// Whether ranks share the next level.
bool isShared(const BoxShape& shape) {
  return !shape.slabs().isWhole() && shape.slabs().isEven() && shape.cells() >= fewCells;
}

/// The same matrix with all planes on each of the ranks that share it.
BoxStencil<double> gathered(BoxStencil<double>& part) {
  const BoxShape& shape = part.shape;
  BoxStencil<double> whole(BoxShape(shape.box(), shape.slabs().whole()));
  const auto gather = [&](std::vector<double>& from, std::vector<double>& to) {
    std::ranges::copy(planesOf(shape, from), to.begin() + whole.shape.stride(2) * (1 + shape.slabs().first()));
    shape.slabs().complete(planesOf(whole.shape, to));
  };
  gather(part.diagonal, whole.diagonal);
  for (int d = 0; d < 3; ++d) gather(part.links[d], whole.links[d]);
  whole.close();
  return whole;
}

}  // namespace

BoxMultigrid::BoxMultigrid(const BoxStencil<double>& matrix) {
  const double greatest =
      matrix.shape.greatest<1>([&](std::ptrdiff_t at) { return std::array{matrix.diagonal[at]}; })[0];
  scale_ = greatest > 0 ? 1 / greatest : 1;
  levels_.emplace_back(matrix, scale_);
  BoxStencil<double> finer = matrix;
  while (levels_.back().linked > Real(fewLinks)) {
    std::array<int, 3>& ratio = levels_.back().ratio;
    const CellBox box = nextBox(finer, ratio);
    BoxStencil<double> next(BoxShape(box, finer.shape.slabs().coarser(ratio[2])));
    if (next.shape.cells() == finer.shape.cells()) return;
    takeCoarser(finer, ratio, next);
    finer = next.shape.slabs().isWhole() || isShared(next.shape) ? std::move(next) : gathered(next);
    levels_.emplace_back(finer, scale_);
  }
}

BoxMultigrid::Grid::Grid(const BoxStencil<double>& of, double scale)
    : matrix(of.shape), inverse(of.shape.stored()), x(inverse), r(inverse), z(inverse) {
  const BoxShape& shape = matrix.shape;
  const std::ptrdiff_t plane = shape.stride(2);
  const auto round = [&](const std::vector<double>& from, std::vector<Real>& to) {
    shape.forEachPlane([&](int place) {  // also the layer below
      const auto begin = from.begin() + (place == 0 ? 0 : plane * (place + 1)),
                 end = from.begin() + plane * (place + 2);
      std::transform(begin, end, to.begin() + (begin - from.begin()),
                     [&](double value) { return static_cast<Real>(scale * value); });
    });
  };
  round(of.diagonal, matrix.diagonal);
  for (int d = 0; d < 3; ++d) round(of.links[d], matrix.links[d]);
  const auto linkedOf = [&](std::ptrdiff_t at) {
    if (!(matrix.diagonal[at] > 0)) return std::array{0.0};
    Real sum = 0;
    for (int d = 0; d < 3; ++d) sum += matrix.links[d][at] + matrix.links[d][at - shape.stride(d)];
    inverse[at] = 1 / matrix.diagonal[at];
    return std::array{static_cast<double>(sum * inverse[at])};
  };
  linked = static_cast<Real>(shape.greatest<1>(linkedOf)[0]);
  shape.forEachCell([&](std::ptrdiff_t at) { inverse[at] /= 1 + linked; });  // Gershgorin's bound of the eigenvalues
}

void BoxMultigrid::smooth(Grid& grid) {
  Real *x = grid.x.data(), *z = grid.z.data();
  const Real *r = grid.r.data(), *inverse = grid.inverse.data();
  const int cells = grid.extent(0);
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
  const BoxShape &from = fine.matrix.shape, &to = coarse.matrix.shape;
  const std::array<int, 3>& ratio = fine.ratio;
  const PlanePairs pairs(from, to, ratio[2]);
  const int cells = fine.extent(0);
  to.forEachPlane([&](int Z) { std::fill_n(coarse.x.begin() + (Z + 1) * to.stride(2), to.stride(2), Real(0)); });
  pairs.forEach(from, [&](int Z) {
    std::fill_n(coarse.r.begin() + (Z + 1) * to.stride(2), to.stride(2), Real(0));
    pairs.forEachIn(Z, [&](int z) {
      for (int y = 0; y < from.extent(1); ++y) {
        const Real* r = fine.r.data() + from.offset(0, y, z);
        Real* sum = coarse.r.data() + to.offset(0, y / ratio[1], Z);
        if (ratio[0] == 1) {
          for (int x = 0; x < cells; ++x) sum[x] += r[x];
          continue;
        }
        for (int x = 0; x < cells / 2; ++x) sum[x] += r[2 * x] + r[2 * x + 1];
        if (cells % 2) sum[cells / 2] += r[cells - 1];
      }
    });
  });
  if (to.slabs().isWhole()) from.slabs().coarser(ratio[2]).complete(planesOf(to, coarse.r));
}

void BoxMultigrid::correct(const Grid& coarse, Grid& fine) {
  const BoxShape &from = coarse.matrix.shape, &to = fine.matrix.shape;
  const PlanePairs pairs(to, from, fine.ratio[2]);
  to.forEachPlane([&](int z) {
    for (int y = 0; y < to.extent(1); ++y) {
      const Real* change = coarse.x.data() + from.offset(0, y / fine.ratio[1], pairs.coarse(z));
      const std::ptrdiff_t first = to.offset(0, y, z);
      for (int x = 0; x < to.extent(0); ++x) fine.z[first + x] = change[x / fine.ratio[0]];
      for (int x = 0; x < to.extent(0); ++x) fine.x[first + x] += fine.z[first + x];
    }
  });
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
  const BoxShape& shape = finest.matrix.shape;
  double greatest = shape.greatest<1>([&](std::ptrdiff_t at) { return std::array{std::abs(b[at])}; })[0];
  if (greatest == 0) greatest = 1;
  shape.forEachCell([&](std::ptrdiff_t at) {
    finest.r[at] = static_cast<Real>(b[at] / greatest);
    finest.x[at] = 0;
  });
  cycle(0);
  shape.forEachCell([&](std::ptrdiff_t at) {  // cells without an equation get part of their neighbours' correction
    z[at] = finest.inverse[at] > 0 ? greatest * scale_ * double(finest.x[at]) : 0;
  });
}

}  // namespace tushar::solvers
