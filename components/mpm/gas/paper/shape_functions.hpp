#pragma once

#include "components/mpm/gas/mirror_symmetry.hpp"

namespace tushar::mpm::gas::paper {

/// Quantities that are equal for all cells of a level, computed once.
template <int D>
struct CellPlaces {
  Vec<D> middle;          ///< middle of the grid [m]
  Vec<D> half;            ///< position of the middle of the grid in cells, relative to cell centres
  Vec<D> spacing;         ///< spacing [m]
  Vec<D> inverseSpacing;  ///< inverse spacing [1/m]

  explicit CellPlaces(const Level& level) {
    for (int d = 0; d < D; ++d) {
      middle[d] = middleOf(level, d);
      half[d] = -fromMiddle<double>(level, d, 0);
      spacing[d] = level.spacing(d);
      inverseSpacing[d] = level.inverseSpacing(d);
    }
  }
  /// The centre of a cell, bitwise equal to the result of positionInCell.
  Vec<D> centre(const Index<D>& cell) const {
    Vec<D> at;
    for (int d = 0; d < D; ++d) at[d] = middle[d] + (cell[d] - half[d]) * spacing[d];
    return at;
  }
};

/// S_ip = S_i(x_p) in (6), (7), (12) and (13) of Tran, Kim & Berzins: Linear, for the particles of one cell.
///
/// Positions are measured in cells from the centre of the cell, so that the factors 1/2 - xi of lower nodes and 1/2 +
/// xi of upper nodes exchange their values bitwise in the mirror image of a scene. Measured from the lower corner, 1 -
/// xi and xi would round differently.
template <int D>
class ShapeFunctions {
 public:
  ShapeFunctions(const CellPlaces<D>& places, const Index<D>& cell)
      : middle_(places.centre(cell)), inverse_spacing_(places.inverseSpacing) {}
  /// S_ip of each node i of the cell, numbered as in Linear, for a particle at x [m].
  typename Linear<D>::Weights at(const Vec<D>& x) const {
    const Vec<D> xi = (x - middle_).cwiseProduct(inverse_spacing_);
    return Linear<D>::weights([&](int d) { return 0.5 - xi[d]; }, [&](int d) { return 0.5 + xi[d]; });
  }

 private:
  Vec<D> middle_;           ///< middle [m]
  Vec<D> inverse_spacing_;  ///< inverse spacing [1/m]
};

}  // namespace tushar::mpm::gas::paper
