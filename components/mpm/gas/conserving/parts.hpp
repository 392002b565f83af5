#pragma once

#include "components/mpm/gas/conserving/footprint.hpp"

namespace tushar::mpm::gas::conserving {

/// The parts into which boxes are cut at the faces of cells, one box per lane. What depends on one axis only is
/// computed once for each of its cells, not once for each part. All sums have the order of Footprint::sumOverParts.
template <int D>
class Parts {
 public:
  static constexpr std::size_t most = static_cast<std::size_t>(Footprint<D>::most);
  /// A value for each cell that a box overlaps along each axis.
  template <class T>
  using AlongAxes = std::array<std::array<T, most>, D>;

  /// Divides the mass 1 and the internal energy 1 of each box among its parts, with the relative slopes `density` and
  /// `energy` [1/m] about its `centre` [m].
  Parts(const Footprint<D>& footprint, const LanesVec<D>& centre, const LanesVec<D>& density, const LanesVec<D>& energy)
      : footprint_(footprint) {
    AlongAxes<Lanes> heavier, hotter;
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t k = 0; k < cells(d); ++k) {
        const int at = static_cast<int>(k), axis = static_cast<int>(d);
        const Lanes width = footprint.along[d].upperOf(at) - footprint.along[d].lowerOf(at);
        middle[d][k] = footprint.along[d].middle(at);
        spread[d][k] = width * width / 12;
        heavier[d][k] = density[axis] * (middle[d][k] - centre[axis]);
        hotter[d][k] = energy[axis] * (middle[d][k] - centre[axis]);
      }
    footprint.forEachPart([&](const Index<D>& k, const Lanes& share) __attribute__((always_inline)) {
      mass(k) = share * (1 + sumOverAxes(heavier, k));
      internal(k) = share * (1 + sumOverAxes(hotter, k));
    });
    const auto all = sum<2>([&](const Index<D>& k) __attribute__((always_inline)) {
      return std::array{mass(k), internal(k)};
    });
    const Lanes perMass = 1 / all[0], perInternal = 1 / all[1];
    footprint.forEachPart([&](const Index<D>& k, const Lanes&) __attribute__((always_inline)) {
      mass(k) *= perMass;
      internal(k) *= perInternal;
    });
  }

  AlongAxes<Lanes> middle;  ///< middles of the parts [m]
  AlongAxes<Lanes> spread;  ///< twelfths of the squares of their lengths [m²]

  /// Shares of the part in cell k of the footprint in mass and internal energy.
  Lanes& mass(const Index<D>& k) { return mass_[Footprint<D>::number(k)]; }
  Lanes& internal(const Index<D>& k) { return internal_[Footprint<D>::number(k)]; }

  LanesVec<D> centroid() {
    const auto sums = sum<D>([&](const Index<D>& k) __attribute__((always_inline)) {
      std::array<Lanes, D> moment;
      for (std::size_t d = 0; d < D; ++d) moment[d] = mass(k) * middle[d][static_cast<std::size_t>(k[int(d)])];
      return moment;
    });
    return matrixOf<D, 1>(sums);
  }
  /// What each axis adds to the velocity at the middle of a part, `gradient` times the distance from `centre`.
  AlongAxes<LanesVec<D>> velocities(const LanesTensor<D>& gradient, const LanesVec<D>& centre) const {
    AlongAxes<LanesVec<D>> all;
    for (std::size_t d = 0; d < D; ++d)
      for (std::size_t k = 0; k < cells(d); ++k) {
        const int axis = static_cast<int>(d);
        const Lanes offset = middle[d][k] - centre[axis];
        for (int c = 0; c < D; ++c) all[d][k][c] = gradient(c, axis) * offset;
      }
    return all;
  }
  /// The kinetic energy per mass of a box whose parts have these velocities.
  Lanes kineticEnergy(const AlongAxes<LanesVec<D>>& velocities) {
    return sum<1>([&](const Index<D>& k) __attribute__((always_inline)) {
      const LanesVec<D> u = sumOverAxes(velocities, k);
      return std::array{Lanes(0.5 * mass(k) * u.squaredNorm())};
    })[0];
  }
  /// Sum over the axes of the values in cell k. The first axis comes last, since the others are the same in a row.
  template <class T>
  [[gnu::always_inline]] static T sumOverAxes(const AlongAxes<T>& values, const Index<D>& k) {
    const auto of = [&](int d) -> const T& {
      return values[static_cast<std::size_t>(d)][static_cast<std::size_t>(k[d])];
    };
    if constexpr (D == 1)
      return of(0);
    else if constexpr (D == 2)
      return of(0) + of(1);
    else
      return of(0) + T(of(1) + of(2));
  }

 private:
  std::size_t cells(std::size_t d) const { return static_cast<std::size_t>(footprint_.along[d].cells); }

  /// Sums of the N numbers value(k) over the parts.
  template <std::size_t N, class Value>
  [[gnu::always_inline]] std::array<Lanes, N> sum(Value&& value) const {
    Index<D> k;
    return sumAlong<D - 1, N>(k, value);
  }
  template <int Axis, std::size_t N, class Value>
  [[gnu::always_inline]] std::array<Lanes, N> sumAlong(Index<D>& k, Value& value) const {
    const int below = footprint_.along[Axis].below, end = footprint_.along[Axis].cells;
    std::array<Lanes, N> lowerSide, upperSide;
    lowerSide.fill(0);
    upperSide.fill(0);
    const auto add = [&](int at, std::array<Lanes, N>& to) __attribute__((always_inline)) {
      k[Axis] = at;
      std::array<Lanes, N> term;
      if constexpr (Axis == 0)
        term = value(std::as_const(k));
      else
        term = sumAlong<Axis - 1, N>(k, value);
      for (std::size_t n = 0; n < N; ++n) to[n] += term[n];
    };
    for (int at = below - 1; at >= 0; --at) add(at, lowerSide);
    for (int at = below + 1; at < end; ++at) add(at, upperSide);
    for (std::size_t n = 0; n < N; ++n) lowerSide[n] += upperSide[n];
    add(below, lowerSide);
    return lowerSide;
  }

  const Footprint<D>& footprint_;
  std::array<Lanes, Footprint<D>::places> mass_, internal_;
};

}  // namespace tushar::mpm::gas::conserving
