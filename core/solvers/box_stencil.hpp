#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/solvers/box_slabs.hpp"

namespace tushar::solvers {

/// The unknowns of a linear system that belong to the cells of a box, which lie on up to three axes.
struct CellBox {
  std::array<int, 3> cells{1, 1, 1};  ///< number of cells along each axis
  std::array<bool, 3> isPeriodic{};
};

/// How values of the cells of a box are stored on a rank, which has a slab of the box: the first axis fastest, with a
/// layer of cells around the slab.
class BoxShape {
 public:
  explicit BoxShape(const CellBox& box) : BoxShape(box, BoxSlabs(box.cells[2])) {}
  BoxShape(const CellBox& box, BoxSlabs slabs) : box_(box), slabs_(std::move(slabs)) {
    for (int d = 0; d < 3; ++d) {
      strides_[d] = stored_;
      stored_ *= extent(d) + 2;
    }
  }

  const CellBox& box() const { return box_; }
  const BoxSlabs& slabs() const { return slabs_; }
  /// Number of cells of the slab along an axis.
  int extent(int axis) const { return axis == 2 ? slabs_.own() : box_.cells[axis]; }
  std::ptrdiff_t stride(int axis) const { return strides_[axis]; }
  /// Number of stored values.
  std::size_t stored() const { return static_cast<std::size_t>(stored_); }
  std::size_t cellsOfPlane() const { return std::size_t(box_.cells[0]) * std::size_t(box_.cells[1]); }
  /// Number of cells of the box.
  std::size_t cells() const { return cellsOfPlane() * std::size_t(box_.cells[2]); }
  /// The place of a cell; z counts from the first plane of the slab.
  std::ptrdiff_t offset(int x, int y, int z) const {
    return (x + 1) * strides_[0] + (y + 1) * strides_[1] + (z + 1) * strides_[2];
  }
  /// Calls visit(z) for each plane of the slab, possibly on several threads.
  template <class Visit>
  void forEachPlane(const Visit& visit) const {
    slabs_.forEachPlane(cellsOfPlane(), visit);
  }
  /// Calls visit(offset) for the first cell of each row along the first axis in a plane, in the order of storage.
  template <class Visit>
  void forEachRowIn(int z, Visit&& visit) const {
    for (int y = 0; y < extent(1); ++y) visit(offset(0, y, z));
  }
  /// The same for the rows of all planes, possibly on several threads.
  template <class Visit>
  void forEachRow(const Visit& visit) const {
    forEachPlane([&](int z) { forEachRowIn(z, visit); });
  }
  /// Calls visit(offset) for each cell of a plane, in the order of storage.
  template <class Visit>
  void forEachCellIn(int z, Visit&& visit) const {
    forEachRowIn(z, [&](std::ptrdiff_t first) {
      for (std::ptrdiff_t at = first; at < first + extent(0); ++at) visit(at);
    });
  }
  template <class Visit>
  void forEachCell(const Visit& visit) const {
    forEachPlane([&](int z) { forEachCellIn(z, visit); });
  }
  /// The sum of term(offset) over all cells of the box. It has the same bits for any slabs, threads and registers.
  template <class Term>
  double sum(const Term& term) const {
    std::vector<double> ofPlanes(static_cast<std::size_t>(box_.cells[2]));
    forEachPlane([&](int z) { ofPlanes[std::size_t(slabs_.first() + z)] = sumIn(z, term); });
    return slabs_.sum(ofPlanes);
  }
  /// The greatest values of the numbers that terms(offset) returns for the cells of the box, or 0.
  template <std::size_t N, class Terms>
  std::array<double, N> greatest(const Terms& terms) const {
    std::vector<std::array<double, N>> ofPlanes(static_cast<std::size_t>(slabs_.own()));
    forEachPlane([&](int z) {
      forEachCellIn(z, [&, &found = ofPlanes[std::size_t(z)]](std::ptrdiff_t at) {
        const std::array<double, N> here = terms(at);
        for (std::size_t k = 0; k < N; ++k) found[k] = std::max(found[k], here[k]);
      });
    });
    std::array<double, N> all{};
    for (const std::array<double, N>& found : ofPlanes)
      for (std::size_t k = 0; k < N; ++k) all[k] = std::max(all[k], found[k]);
    slabs_.ranks().max(all);
    return all;
  }

 private:
  template <class Term>
  double sumIn(int z, const Term& term) const {
    constexpr int parts = 8;
    std::array<double, parts> sums{};
    forEachRowIn(z, [&](std::ptrdiff_t first) {
      const int cells = extent(0), whole = cells / parts * parts;
      for (int i = 0; i < whole; i += parts)
        for (int k = 0; k < parts; ++k) sums[k] += term(first + i + k);
      for (int i = whole; i < cells; ++i) sums[i - whole] += term(first + i);
    });
    double sum = 0;
    for (const double part : sums) sum += part;
    return sum;
  }

  CellBox box_;
  BoxSlabs slabs_;
  std::array<std::ptrdiff_t, 3> strides_{};
  std::ptrdiff_t stored_ = 1;
};

/// A symmetric matrix that couples cells of a box across their faces: (A x)_i = diagonal_i x_i - sum over the faces of
/// link_f x_n, where n is the cell beyond face f. Vectors have the layout of `shape`; in the layer around the box, they
/// are arbitrary.
template <class Real>
struct BoxStencil {
  explicit BoxStencil(BoxShape of)
      : shape(std::move(of)), diagonal(shape.stored()), links{diagonal, diagonal, diagonal} {}

  BoxShape shape;
  std::vector<Real> diagonal;
  /// For each axis, the link through the upper face of a cell; 0 on sides that are not periodic.
  std::array<std::vector<Real>, 3> links;

  /// Fills the links of the layer before the first cells, from other ranks and along periodic axes.
  void close();
  /// r = r - A z. Fills the layer around z.
  void subtract(std::vector<Real>& z, std::vector<Real>& r) const;
  /// r = A z. Fills the layer around z.
  void multiply(std::vector<Real>& z, std::vector<Real>& r) const;
};

/// Whether a matrix can be one of a BoxSystem: whether it is symmetric, and no link is negative.
class LinkCheck {
 public:
  /// Takes the link of a cell to the next one along an axis, upwards or downwards.
  void add(int axis, bool isUp, double link) {
    (isUp ? up_ : down_)[axis] += link;
    least_ = std::min(least_, link);
  }
  void add(const LinkCheck& other);
  /// The result for all ranks.
  bool passes(const mpi::Communicator& ranks) const;

 private:
  std::array<double, 3> up_{}, down_{};  ///< sums of the links through upper and lower faces
  double least_ = 0;
};

extern template struct BoxStencil<double>;
extern template struct BoxStencil<float>;

}  // namespace tushar::solvers
