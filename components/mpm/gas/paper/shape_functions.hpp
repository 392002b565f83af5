#pragma once

#include "components/mpm/gas/mirror_symmetry.hpp"

namespace tushar::mpm::gas::paper {

/// S_ip = S_i(x_p) of (6), (7), (12) and (13) of Tran, Kim & Berzins: Linear, for the particles of one cell.
///
/// Positions are measured in cells from the centre of the cell, so that the factors 1/2 - xi of lower nodes and 1/2 +
/// xi of upper nodes exchange their bits in the mirror image of a scene. Measured from the lower corner, 1 - xi and xi
/// would round differently.
template <int D>
class ShapeFunctions {
 public:
  ShapeFunctions(const Level& level, const Index<D>& cell) {
    for (int d = 0; d < D; ++d) {
      middle_[d] = positionInCell(level, d, cell[d], 0);
      inverse_spacing_[d] = level.inverseSpacing(d);
    }
  }
  /// S_ip for each node i of the cell, numbered as in Linear, and a particle at x [m].
  typename Linear<D>::Weights at(const Vec<D>& x) const {
    const Vec<D> xi = (x - middle_).cwiseProduct(inverse_spacing_);
    return Linear<D>::weights([&](int d) { return 0.5 - xi[d]; }, [&](int d) { return 0.5 + xi[d]; });
  }

 private:
  Vec<D> middle_;           ///< m
  Vec<D> inverse_spacing_;  ///< 1/m
};

}  // namespace tushar::mpm::gas::paper
