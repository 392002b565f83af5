#pragma once

#include <span>
#include <utility>

#include "core/data/label.hpp"
#include "core/grid/rim.hpp"

namespace tushar::data {

/// The label of the fluxes of a cell variable through the rims of patches; it exists until the program ends.
const Label& rimLabelOf(const Label& label);

/// Calls `visit(first, count, place)` for each row of rim faces that are normal to an axis and lie in a box of faces.
/// Rows are along the first axis; `place` is the position of the first face among the values of the rims, and those of
/// the other faces of the row follow.
template <int D, class Visit>
void forEachRimRow(std::span<const grid::RimPiece> pieces, const grid::Box& faces, int axis, Visit&& visit) {
  for (const grid::RimPiece& piece : pieces) {
    if (piece.axis != axis) continue;
    const grid::Box all = piece.cells.shifted(piece.side == 0 ? Index3{} : Index3::unit(axis));
    grid::forEachRow<D>(all.intersect(faces), [&](const Index<D>& first, int count) {
      Index3 at;
      for (int d = 0; d < D; ++d) at[d] = first[d];
      visit(first, count, piece.first + all.offset(at));
    });
  }
}

/// The fluxes of a variable through those faces of a patch at which its level ends: the amount per unit area and time,
/// along the axis. Empty on a single level, and if no task needs the fluxes. Several tasks of a step may each add a
/// part; the sum starts at 0.
template <class T>
class RimFlux {
 public:
  RimFlux() = default;
  RimFlux(T* values, std::span<const grid::RimPiece> pieces) : values_(values), pieces_(pieces) {}

  bool empty() const { return pieces_.empty(); }
  /// Calls `visit(cell, axis, side, flux)` for each face on the rim, with the flux through this face of the cell.
  template <int D, class Visit>
  void forEachFace(Visit&& visit) const {
    for (const grid::RimPiece& piece : pieces_) {
      T* through = values_ + piece.first;
      grid::forEach<D>(piece.cells, [&](const Index<D>& cell) { visit(cell, piece.axis, piece.side, *through++); });
    }
  }
  /// Calls `visit(face, flux)` for the faces normal to an axis that lie in a box of faces; the index of a face is that
  /// of the cell above it.
  template <int D, class Visit>
  void forEachFaceIn(const grid::Box& faces, int axis, Visit&& visit) const {
    forEachRowIn<D>(faces, axis, [&](Index<D> face, int count, std::size_t place) {
      for (T* through = values_ + place; count > 0; --count, ++face[0]) visit(face, *through++);
    });
  }
  /// Calls `visit(first, count, place)` for rows of these faces; `place` is the position of the first face, which is
  /// the same for all variables of a patch. See at().
  template <int D, class Visit>
  void forEachRowIn(const grid::Box& faces, int axis, Visit&& visit) const {
    forEachRimRow<D>(pieces_, faces, axis, std::forward<Visit>(visit));
  }
  /// The flux through the face at a position.
  T& at(std::size_t place) const { return values_[place]; }

 private:
  T* values_ = nullptr;
  std::span<const grid::RimPiece> pieces_;
};

}  // namespace tushar::data
