#pragma once

#include <array>
#include <cstring>
#include <limits>

#include "components/mpmice/box_images.hpp"
#include "components/mpmice/labels.hpp"
#include "components/mpmice/near_bodies.hpp"
#include "components/mpmice/particle_box.hpp"
#include "core/base/quad.hpp"

namespace tushar::mpmice {

/// The volume fractions and faces that bodies leave free on a patch, from which the boxes of particles are subtracted.
template <int D>
struct FreeShares {
  CellView<double> volume;
  CellView<Vec<D>> coverage;
  std::optional<CellView<Vec<D>>> coverageAtEnd = {};  ///< that of upper faces on symmetry planes

  /// `volume` is the label of the free volume; for `endsAtPlane`, see Settings.
  static FreeShares from(auto& take, const CellLabel<double>* volume, bool endsAtPlane) {
    return {.volume = take(computes(*volume)),
            .coverage = take(computes(c::coverage<D>)),
            .coverageAtEnd = take(when(endsAtPlane, computes(c::coverageAtEnd<D>)))};
  }
};

/// Subtracts the boxes of particles from free volumes and faces. Boxes that belong to one cell reach the same few cells
/// around it, so they are first added to each other, in vector registers.
template <int D>
class TakenShares {
 public:
  /// Everything is free at first. `planes` are the symmetry planes of the level.
  explicit TakenShares(const FreeShares<D>& free, const BoxImages<D>& planes = {}) : free_(free), planes_(planes) {
    free_.volume.fill(1);
    free_.coverage.fill(Vec<D>::Zero());
    if (free_.coverageAtEnd) free_.coverageAtEnd->fill(Vec<D>::Zero());
  }

  /// Takes the contribution of a particle's box, whose coordinates are relative to the cell `origin`. Calls for boxes
  /// of one cell are to follow each other.
  void take(const Index<D>& origin, const ParticleBox<D>& box) {
    if (!(box.edges.minCoeff() > 0)) return;  // it has burned
    const Box reach = box.reach();
    if (!(origin == origin_) || !fits(reach)) moveTo(origin, reach);
    addTo(reach, box);
  }
  const BoxImages<D>& planes() const { return planes_; }
  /// Subtracts what was taken; where bodies overlap, the free volume is 0 instead of negative.
  void settle() {
    subtract();
    forEachRow<D>(free_.volume.box(), [&](const Index<D>& first, int count) {
      double* row = &free_.volume[first];
      for (int i = 0; i < count; ++i) row[i] = std::max(0.0, row[i]);
    });
  }

 private:
  /// Number of cells of the window along each axis: the largest number that a box may reach.
  static constexpr int width = 4;
  static_assert(2 * longestEdge <= width - 1);
  /// The lengths of a box in the cells of the window along one axis, and the weights of their lower faces.
  struct Along {
    std::array<double, width> inside, hat;
  };
  /// The sums for a row of the window: the filled volume and, for each axis, what is covered of the lower faces.
  struct Row {
    Quad filled, covered[D];
  };

  bool fits(const Box& reach) const {
    bool fits = true;
    for (int d = 0; d < D; ++d) fits &= reach.lower[d] >= window_[d] && reach.upper[d] <= window_[d] + width;
    return fits;
  }
  /// Moves the window, so that it contains the cells of a box that belongs to the cell `origin`.
  void moveTo(const Index<D>& origin, const Box& reach) {
    subtract();
    origin_ = origin;
    window_ = Index<D>::filled(-1);
    if (fits(reach)) return;
    for (int d = 0; d < D; ++d) window_[d] = reach.lower[d];
  }
  void addTo(const Box& reach, const ParticleBox<D>& box) {
    Quad inside{}, hat{};           // as in Along, for the first axis
    std::array<Along, D> across{};  // for the others
    for (int d = D - 1; d >= 0; --d) {
      const Quad faces = Quad{0, 1, 2, 3} + window_[d];
      inside = box.lengthsIn(d, faces);
      hat = box.hatsAt(d, faces);
      if (d > 0) {
        std::memcpy(across[d].inside.data(), &inside, sizeof(inside));
        std::memcpy(across[d].hat.data(), &hat, sizeof(hat));
      }
      lower_[d] = std::min(lower_[d], reach.lower[d] - window_[d]);
      upper_[d] = std::max(upper_[d], reach.upper[d] - window_[d]);
    }
    if constexpr (D == 1) {
      rows_[0].filled += inside;
      rows_[0].covered[0] += hat;
    } else {
      addRows(reach, inside, hat, across);
    }
  }
  void addRows(const Box& reach, const Quad& inside, const Quad& hat, const std::array<Along, D>& across) {
    for (int j = reach.lower[1] - window_[1]; j < reach.upper[1] - window_[1]; ++j) {
      const double inY = across[1].inside[j], hatY = across[1].hat[j];
      if constexpr (D == 2) {
        Row& row = rows_[j];
        row.filled += inside * inY;
        row.covered[0] += hat * inY;
        row.covered[1] += inside * hatY;
      } else {
        for (int k = reach.lower[2] - window_[2]; k < reach.upper[2] - window_[2]; ++k) {
          const double inZ = across[2].inside[k];
          Row& row = rows_[k * width + j];
          row.filled += inside * (inY * inZ);
          row.covered[0] += hat * (inY * inZ);
          row.covered[1] += inside * (hatY * inZ);
          row.covered[2] += inside * (inY * across[2].hat[k]);
        }
      }
    }
  }
  /// Subtracts the sums of the window, which become 0.
  void subtract() {
    if (!(lower_[0] < upper_[0])) return;
    Box cells{{}, Index3::filled(1)};
    Index<D> lowest;
    for (int d = 0; d < D; ++d) {
      lowest[d] = origin_[d] + window_[d];
      cells.lower[d] = lowest[d] + lower_[d];
      cells.upper[d] = lowest[d] + upper_[d];
    }
    forEachRow<D>(cells.intersect(free_.volume.box()), [&](const Index<D>& first, int count) {
      const Index<D> at = first - lowest;
      const Row& row = rows_[rowAt(at)];
      double* room = &free_.volume[first];
      Vec<D>* faces = &free_.coverage[first];
      for (int i = 0; i < count; ++i) {
        room[i] -= row.filled[at[0] + i];
        for (int a = 0; a < D; ++a) faces[i][a] += row.covered[a][at[0] + i];
      }
    });
    if (free_.coverageAtEnd)
      for (int a = 0; a < D; ++a) coverEnd(cells, lowest, a);
    rows_ = {};
    lower_ = Index<D>::filled(width);
    upper_ = Index<D>::filled(0);
  }
  /// Adds the sums of the window to the coverage of faces at the upper end of an axis, if a symmetry plane is there.
  void coverEnd(const Box& cells, const Index<D>& lowest, int axis) {
    Box beyond = free_.volume.box();
    if (!planes_.endsAtPlane(beyond, axis)) return;
    beyond.lower[axis] = beyond.upper[axis];
    ++beyond.upper[axis];
    forEach<D>(cells.intersect(beyond), [&](const Index<D>& above) {
      const Index<D> at = above - lowest;
      (*free_.coverageAtEnd)[above - Index<D>::unit(axis)][axis] += rows_[rowAt(at)].covered[axis][at[0]];
    });
  }
  static std::size_t rowAt(const Index<D>& at) {
    if constexpr (D == 1)
      return 0;
    else if constexpr (D == 2)
      return at[1];
    else
      return at[2] * width + at[1];
  }

  FreeShares<D> free_;
  BoxImages<D> planes_;
  Index<D> origin_ = Index<D>::filled(std::numeric_limits<int>::min());  ///< the cell of the boxes; at first, none
  Index<D> window_{};                                   ///< the lowest cell of the window, relative to that cell
  Index<D> lower_ = Index<D>::filled(width), upper_{};  ///< the cells of the window that are not 0
  std::array<Row, D == 1 ? 1 : D == 2 ? width : width * width> rows_{};
};

}  // namespace tushar::mpmice
