#include "core/solvers/box_stencil.hpp"

#include <cmath>

namespace tushar::solvers {

namespace {

/// Copies values to the layer beyond periodic sides: on both sides, or only below the box.
template <class Real>
void wrap(const BoxShape& shape, std::vector<Real>& values, bool alsoAbove) {
  for (int d = 0; d < 3; ++d) {
    if (!shape.box().isPeriodic[d]) continue;
    const int a = d == 0 ? 1 : 0, b = d == 2 ? 1 : 2;
    const std::ptrdiff_t step = shape.stride(d), length = shape.extent(d) * step;
    for (int j = 0; j < shape.extent(b); ++j)
      for (int i = 0; i < shape.extent(a); ++i) {
        const std::ptrdiff_t first = shape.offset(0, 0, 0) + i * shape.stride(a) + j * shape.stride(b);
        values[first - step] = values[first - step + length];
        if (alsoAbove) values[first + length] = values[first];
      }
  }
}

/// Calls take(offset, (A z) at it) for all cells.
template <class Real, class Take>
void forProducts(const BoxStencil<Real>& matrix, std::vector<Real>& z, Take&& take) {
  const BoxShape& shape = matrix.shape;
  wrap(shape, z, true);
  const std::ptrdiff_t y = shape.stride(1), x = shape.stride(2);
  shape.forEachRow([&](std::ptrdiff_t first) {
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
}

}  // namespace

template <class Real>
void BoxStencil<Real>::close() {
  for (std::vector<Real>& link : links) wrap(shape, link, false);
}

template <class Real>
void BoxStencil<Real>::subtract(std::vector<Real>& z, std::vector<Real>& r) const {
  forProducts(*this, z, [to = r.data()](std::ptrdiff_t at, Real product) { to[at] -= product; });
}

template <class Real>
void BoxStencil<Real>::multiply(std::vector<Real>& z, std::vector<Real>& r) const {
  forProducts(*this, z, [to = r.data()](std::ptrdiff_t at, Real product) { to[at] = product; });
}

bool BoxAssembly::finish() {
  constexpr double roundOff = 1e-9;
  matrix_.close();
  bool isSymmetric = true;
  for (int d = 0; d < 3; ++d) isSymmetric &= std::abs(up_[d] - down_[d]) <= roundOff * (up_[d] + down_[d]);
  return isSymmetric && least_ >= 0;
}

template struct BoxStencil<double>;
template struct BoxStencil<float>;

}  // namespace tushar::solvers
