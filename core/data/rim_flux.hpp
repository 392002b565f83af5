#pragma once

#include <span>

#include "core/base/function_ref.hpp"
#include "core/data/label.hpp"
#include "core/grid/rim.hpp"

namespace tushar::data {

/// The label of the fluxes of a cell variable through the rims of patches; it exists until the program ends.
const Label& rimLabelOf(const Label& label);

/// Calls `visit(face, place)` for the rim faces normal to an axis that lie in a box of faces; `place` is the position
/// of the face among the values of the rims.
template <int D>
void forEachRimFace(std::span<const grid::RimPiece> pieces, const grid::Box& faces, int axis,
                    FunctionRef<void(const Index<D>& face, std::size_t place)> visit);

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
    if (empty()) return;
    forEachRimFace<D>(pieces_, faces, axis,
                      [&](const Index<D>& face, std::size_t place) { visit(face, values_[place]); });
  }

 private:
  T* values_ = nullptr;
  std::span<const grid::RimPiece> pieces_;
};

}  // namespace tushar::data
