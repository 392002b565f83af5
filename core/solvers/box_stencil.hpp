#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace tushar::solvers {

/// The unknowns of a linear system that belong to the cells of a box, which lie on up to three axes.
struct CellBox {
  std::array<int, 3> cells{1, 1, 1};  ///< number of cells along each axis
  std::array<bool, 3> isPeriodic{};
};

/// How values of the cells of a box are stored: the first axis fastest, with a layer of cells around the box.
class BoxShape {
 public:
  explicit BoxShape(const CellBox& box) : box_(box) {
    for (int d = 0; d < 3; ++d) {
      strides_[d] = stored_;
      stored_ *= box.cells[d] + 2;
    }
  }

  const CellBox& box() const { return box_; }
  int extent(int axis) const { return box_.cells[axis]; }
  std::ptrdiff_t stride(int axis) const { return strides_[axis]; }
  /// Number of stored values.
  std::size_t stored() const { return static_cast<std::size_t>(stored_); }
  std::size_t cells() const { return std::size_t(extent(0)) * std::size_t(extent(1)) * std::size_t(extent(2)); }
  std::ptrdiff_t offset(int x, int y, int z) const {
    return (x + 1) * strides_[0] + (y + 1) * strides_[1] + (z + 1) * strides_[2];
  }
  /// Calls visit(offset) for the first cell of each row along the first axis, in the order of storage.
  template <class Visit>
  void forEachRow(Visit&& visit) const {
    for (int z = 0; z < extent(2); ++z)
      for (int y = 0; y < extent(1); ++y) visit(offset(0, y, z));
  }
  /// Calls visit(offset) for each cell, in the order of storage.
  template <class Visit>
  void forEachCell(Visit&& visit) const {
    forEachRow([&](std::ptrdiff_t first) {
      for (std::ptrdiff_t at = first; at < first + extent(0); ++at) visit(at);
    });
  }

 private:
  CellBox box_;
  std::array<std::ptrdiff_t, 3> strides_{};
  std::ptrdiff_t stored_ = 1;
};

/// A symmetric matrix that couples cells of a box across their faces: (A x)_i = diagonal_i x_i - sum over the faces of
/// link_f x_n, where n is the cell beyond face f. Vectors have the layout of `shape`; in the layer around the box, they
/// are arbitrary.
template <class Real>
struct BoxStencil {
  explicit BoxStencil(const CellBox& box) : shape(box), diagonal(shape.stored()), links{diagonal, diagonal, diagonal} {}

  BoxShape shape;
  std::vector<Real> diagonal;
  /// For each axis, the link through the upper face of a cell; 0 on sides that are not periodic.
  std::array<std::vector<Real>, 3> links;

  /// Copies the links of the last cells along periodic axes to the layer before the first ones.
  void close();
  /// r = r - A z. Fills the layer around z.
  void subtract(std::vector<Real>& z, std::vector<Real>& r) const;
  /// r = A z. Fills the layer around z.
  void multiply(std::vector<Real>& z, std::vector<Real>& r) const;
};

/// Takes the links of a matrix from its rows.
class BoxAssembly {
 public:
  explicit BoxAssembly(BoxStencil<double>& matrix) : matrix_(matrix) {}

  /// Takes the link of the row at the offset `from` to the cell at the offset `to`, which has a common face with it and
  /// may be beyond a periodic side. The diagonal is set by others.
  void link(std::ptrdiff_t from, std::ptrdiff_t to, double value) {
    const bool isUp = to > from;
    const std::ptrdiff_t step = isUp ? to - from : from - to;
    int axis = 2;
    while (axis > 0 && step < matrix_.shape.stride(axis)) --axis;
    if (isUp) matrix_.links[axis][from] = value;
    (isUp ? up_ : down_)[axis] += value;
    least_ = std::min(least_, value);
  }
  /// Completes the matrix. Returns false if it is not symmetric, or if a link is negative.
  bool finish();

 private:
  BoxStencil<double>& matrix_;
  std::array<double, 3> up_{}, down_{};  ///< sums of the links through upper and lower faces
  double least_ = 0;
};

extern template struct BoxStencil<double>;
extern template struct BoxStencil<float>;

}  // namespace tushar::solvers
