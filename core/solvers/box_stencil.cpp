#include "core/solvers/box_stencil.hpp"

#include <cmath>

namespace tushar::solvers {

namespace {

/// Copies values of a plane to the layer beyond periodic sides within it: on both sides, or only below the box.
template <class Real>
void wrapWithin(const BoxShape& shape, int z, Real* values, bool alsoAbove) {
  for (int d = 0; d < 2; ++d) {
    if (!shape.box().isPeriodic[d]) continue;
    const std::ptrdiff_t step = shape.stride(d), length = shape.extent(d) * step;
    for (int i = 0; i < shape.extent(1 - d); ++i) {
      Real* first = values + shape.offset(0, 0, z) + i * shape.stride(1 - d);
      first[-step] = first[length - step];
      if (alsoAbove) first[length] = first[0];
    }
  }
}

/// Calls take(offset, (A z) at it) for all cells.
template <class Real, class Take>
void forProducts(const BoxStencil<Real>& matrix, std::vector<Real>& z, const Take& take) {
  const BoxShape& shape = matrix.shape;
  const std::ptrdiff_t y = shape.stride(1), x = shape.stride(2);
  shape.slabs().fillLayers(std::span(z), shape.box().isPeriodic[2], true);
  shape.forEachPlane([&](int plane) {
    wrapWithin(shape, plane, z.data(), true);
    shape.forEachRowIn(plane, [&](std::ptrdiff_t first) {
      const Real *at = z.data() + first, *diagonal = matrix.diagonal.data() + first;
      const Real *a = matrix.links[0].data() + first, *b = matrix.links[1].data() + first,
                 *c = matrix.links[2].data() + first;
      const int cells = shape.extent(0);
#pragma GCC ivdep
      for (int i = 0; i < cells; ++i) {
        const Real beside = a[i - 1] * at[i - 1] + a[i] * at[i + 1];
        const Real before = b[i - y] * at[i - y] + b[i] * at[i + y];
        const Real below = c[i - x] * at[i - x] + c[i] * at[i + x];
        take(first + i, diagonal[i] * at[i] - (beside + before + below));
      }
    });
  });
}

}  // namespace

template <class Real>
void BoxStencil<Real>::close() {
  for (int d = 0; d < 2; ++d) shape.forEachPlane([&](int z) { wrapWithin(shape, z, links[d].data(), false); });
  shape.slabs().fillLayers(std::span(links[2]), shape.box().isPeriodic[2], false);
}

template <class Real>
void BoxStencil<Real>::subtract(std::vector<Real>& z, std::vector<Real>& r) const {
  forProducts(*this, z, [to = r.data()](std::ptrdiff_t at, Real product) { to[at] -= product; });
}

template <class Real>
void BoxStencil<Real>::multiply(std::vector<Real>& z, std::vector<Real>& r) const {
  forProducts(*this, z, [to = r.data()](std::ptrdiff_t at, Real product) { to[at] = product; });
}

void LinkCheck::add(const LinkCheck& other) {
  for (int d = 0; d < 3; ++d) {
    up_[d] += other.up_[d];
    down_[d] += other.down_[d];
  }
  least_ = std::min(least_, other.least_);
}

bool LinkCheck::passes(const mpi::Communicator& ranks) const {
  constexpr double roundOff = 1e-9;
  std::array<double, 3> up = up_, down = down_;
  ranks.sum(up);
  ranks.sum(down);
  bool isSymmetric = true;
  for (int d = 0; d < 3; ++d) isSymmetric &= std::abs(up[d] - down[d]) <= roundOff * (up[d] + down[d]);
  return !ranks.any(!isSymmetric || !(least_ >= 0));
}

template struct BoxStencil<double>;
template struct BoxStencil<float>;

}  // namespace tushar::solvers
