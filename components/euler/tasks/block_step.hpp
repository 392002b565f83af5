#pragma once

#include "components/euler/boundary.hpp"
#include "components/euler/tasks/advance.hpp"
#include "components/euler/tasks/lane_kernels.hpp"
#include "core/base/limiters.hpp"

namespace tushar::euler {

/// Constant reconstruction: the values at a cell's faces are those of the cell.
struct Constant {
  static constexpr int reach = 1;
};
/// Linear reconstruction with limited slopes: the values at a cell's faces are advanced by half a step.
template <class Limited>
struct Sloped {
  static constexpr int reach = 2;
};

/// Work arrays for a block of cells and the cells around it.
template <int D, int K = 1>
struct Work {
  /// Allocates space for the blocks of a patch. The values of cells are 0 at first; everything else is written before
  /// it is read.
  Work(const Box& cells, int reach) : Work(Rows<D, K>(roomOf(cells, reach)), roomOf(cells, reach), reach > 1, {}) {}
  /// Number of cells of the largest block of a patch, including the cells around it.
  static std::size_t roomOf(const Box& cells, int reach) { return largestBlock<D>(cells).grown(reach, D).size(); }
  /// Allocates space for the blocks of a patch without initialising it, for steps that write the values of all cells of
  /// a block.
  static Work unfilled(const Box& cells, int reach) {
    const std::size_t room = roomOf(cells, reach);
    return {Rows<D, K>::unfilled(room), room, reach > 1, {}};
  }
  /// Allocates space for the planes, with up to `cells` cells each, that a ColumnStep needs at a time.
  static Work ofColumns(std::size_t cells, int reach) {
    return {Rows<D, K>(cells, 2 * reach), cells, reach > 1, {1, 2}};
  }
  void hold(const Box& box) {
    w.hold(box);
    flux.hold(box);
    for (Rows<D, K>& values : across) values.hold(box);
    for (Rows<D, K>& values : lower) values.hold(box);
    for (Rows<D, K>& values : upper) values.hold(box);
  }

  /// Space for the changes of a row of cells in half a step.
  typename Rows<D, K>::Pointers changesOf(int count) {
    typename Rows<D, K>::Pointers pointers;
    changes.resize(pointers.size() * static_cast<std::size_t>(count));
    for (std::size_t k = 0; k < pointers.size(); ++k) pointers[k] = changes.data() + k * count;
    return pointers;
  }

  Rows<D, K> w;                          ///< primitive values of cells
  std::vector<Rows<D, K>> lower, upper;  ///< primitive values at faces, for each axis; empty without slopes
  Rows<D, K> flux;                       ///< fluxes through lower faces along the first axis, or one axis at a time
  std::vector<Rows<D, K>> across;        ///< fluxes through lower faces along the other axes; empty for several gases
  std::vector<double> least;             ///< smallest density and p + p_inf at faces, for one row
  std::vector<double> changes;           ///< see changesOf

 private:
  /// How many planes of face values are stored, and how many of values at upper faces along the last axis; 0: all.
  struct Planes {
    int faces = 0, above = 0;
  };
  Work(Rows<D, K> values, std::size_t cells, bool hasSlopes, const Planes& planes)
      : w(std::move(values)), flux(Rows<D, K>::unfilled(cells, planes.faces)) {
    for (int d = 1; d < D && K == 1; ++d)
      across.push_back(Rows<D, K>::unfilled(cells, planes.faces == 0 || d == 1 ? planes.faces : 2));
    for (int d = 0; d < D && hasSlopes; ++d) {
      lower.push_back(Rows<D, K>::unfilled(cells, planes.faces));
      upper.push_back(Rows<D, K>::unfilled(cells, d == D - 1 ? planes.above : planes.faces));
    }
  }
};

/// Whether loops may also run over inconsistent states, because these take no longer than others; the results for them
/// are arbitrary.
template <class G>
inline constexpr bool takesAnyStates = std::is_same_v<G, StiffenedGas>;

/// Computes rho, v, p of the cells of a box that are on the grid or are periodic images of such cells.
template <int D, class G>
void recover(const G& gas, const Level& level, const Box& box, const ViewsOf<D, kGases<G>, const double>& old,
             Rows<D, kGases<G>>& w) {
  forEachRow<D>(level.clipCells(box), [&](const Index<D>& first, int count) {
    if constexpr (constexpr int gases = kGases<G>; gases > 1) {
      for (int k = 0; k < gases; ++k) {
        std::copy_n(rowOf(old.masses[k], first, count), count, w.at(first)[kMass<D>(k)]);
        std::copy_n(rowOf(old.shares[k], first, count), count, w.at(first)[kShare<D, gases>(k)]);
      }
      if (gas.blend)
        return blendRow<D, gases>(*gas.blend, rowOf(old.density, first, count),
                                  rowOf(old.momentum, first, count)->data(), rowOf(old.totalEnergy, first, count),
                                  count, w.at(first));
    }
    if constexpr (takesAnyStates<G>)
      return recoverLanes<D>(gas, conservedRow<D>(old, first, count), count, w.at(first));
    recoverRow<D>(gas, rowOf(old.density, first, count), rowOf(old.momentum, first, count)->data(),
                  rowOf(old.totalEnergy, first, count), count, w.at(first));
  });
}

/// Adds the half-step change of a row due to one axis to `change`, and sets the row's limited values at the faces.
template <int D, class Limited, int Axis, class G>
void reconstruct(const G& gas, const Index<D>& first, int count, double ratio, Work<D, kGases<G>>& work,
                 const Pointers<D, kGases<G>>& change) {
  const auto next = Index<D>::unit(Axis);
  const auto w = work.w.at(first), below = work.w.at(first - next), above = work.w.at(first + next);
  const auto lower = work.lower[Axis].at(first), upper = work.upper[Axis].at(first);
  for (std::size_t k = 0; k < w.size(); ++k)
    reconstructRow<Limited>(below[k], w[k], above[k], count, lower[k], upper[k]);
  if constexpr (constexpr int K = kGases<G>; K > 1) {
    if (gas.blend) {
      closeBlendRow<Limited, D, K>(below, w, above, count, -1, lower);
      closeBlendRow<Limited, D, K>(below, w, above, count, 1, upper);
    } else {
      closeRow<D, K>(count, lower);
      closeRow<D, K>(count, upper);
    }
  }
  halfStepRow<D, Axis>(gas, lower, upper, ratio, count, change);
}

/// Calls `visit(first, count)` for the cells of a box: in long stretches of memory if `Long`, otherwise row by row. For
/// cells of stretches that are outside the box, loops compute values that nothing reads.
template <int D, bool Long, class Visit>
void forEachPart(const Box& box, const Box& held, Visit&& visit) {
  if constexpr (Long && D > 1)
    if (!fillRegisters(box, held)) return forEachStretch<D>(box, held, std::forward<Visit>(visit));
  forEachRow<D>(box, std::forward<Visit>(visit));
}

/// Computes the values at the faces of the cells of `box`, half a step later. It leaves the fluxes as they are: in
/// columns, those of the plane below have not been added yet.
template <int D, class G>
void predict(const G&, const Level&, const Box&, double, Work<D, kGases<G>>&, Constant) {}
template <int D, class Limited>
void predict(const StiffenedGas& gas, const Level& level, const Box& box, double dt, Work<D>& work, Sloped<Limited>) {
  std::array<double, D> ratio;
  for (int d = 0; d < D; ++d) ratio[d] = 0.5 * dt / level.spacing(d);
  forEachPart<D, true>(box, work.w.box(), [&](const Index<D>& first, int count) {
    RowOfFaces<D> row;
    row.w = work.w.at(first);
    for (int d = 0; d < D; ++d) {
      row.below[d] = work.w.at(first - Index<D>::unit(d));
      row.above[d] = work.w.at(first + Index<D>::unit(d));
      row.lower[d] = work.lower[d].at(first);
      row.upper[d] = work.upper[d].at(first);
    }
    predictRow<D, Limited>(gas, row, ratio, count);
  });
}
template <int D, class Limited, class G>
void predict(const G& gas, const Level& level, const Box& box, double dt, Work<D, kGases<G>>& work, Sloped<Limited>) {
  constexpr int gases = kGases<G>;
  forEachPart<D, takesAnyStates<G>>(box, work.w.box(), [&](const Index<D>& first, int count) {
    const auto ratio = [&](int d) { return 0.5 * dt / level.spacing(d); };
    const auto change = work.changesOf(count);
    reconstruct<D, Limited, 0>(gas, first, count, ratio(0), work, change);
    if constexpr (D > 1) reconstruct<D, Limited, 1>(gas, first, count, ratio(1), work, change);
    if constexpr (D > 2) reconstruct<D, Limited, 2>(gas, first, count, ratio(2), work, change);
    work.least.assign(count, 1.0);
    for (std::size_t d = 0; d < D; ++d)
      for (Rows<D, gases>* values : {&work.lower[d], &work.upper[d]})
        changeRow<D>(gas, change, count, values->at(first), work.least.data());
    for (std::size_t d = 0; d < D; ++d)
      flattenRow<D, gases>(work.least.data(), work.w.at(first), count, work.lower[d].at(first),
                           work.upper[d].at(first));
  });
}

/// Computes the fluxes along an axis through the lower faces of the cells of `faces`.
template <int D, class Flux, class Shape, int Axis, class G>
void computeFluxes(const G& gas, const Box& faces, Work<D, kGases<G>>& work, Rows<D, kGases<G>>& flux) {
  constexpr bool constant = Shape::reach == 1;
  auto& below = constant ? work.w : work.upper[Axis];
  auto& above = constant ? work.w : work.lower[Axis];
  constexpr bool isLong = takesAnyStates<G> && std::is_same_v<Flux, Hllc>;
  forEachPart<D, isLong>(faces, flux.box(), [&](const Index<D>& first, int count) {
    const auto left = below.at(first - Index<D>::unit(Axis)), right = above.at(first), through = flux.at(first);
    if constexpr (isLong)
      fluxLanes<D, Flux, Axis>(gas, left, right, count, through);
    else
      fluxRow<D, Flux, Axis>(gas, left, right, count, through);
  });
}

/// Adds the net inflow of each of several gases along an axis. If they `areBlended`, their volume fractions stay what
/// they are, until their equilibrium is found.
template <int D, int Axis, int K>
void addFluxesOfEach(double ratio, const Index<D>& first, int count, const MixtureViews<D, const double>& old,
                     Rows<D, K>& flux, const MixtureViews<D, double>& fresh, bool areBlended) {
  const auto below = flux.at(first), above = flux.at(first + Index<D>::unit(Axis));
  std::array<const double*, K> in, out;
  for (int k = 0; k < K; ++k) in[k] = below[kShare<D, K>(k)], out[k] = above[kShare<D, K>(k)];
  for (int k = 0; k < K; ++k) {
    const double *mass = rowOf(old.masses[k], first, count), *share = rowOf(old.shares[k], first, count);
    double *newMass = rowOf(fresh.masses[k], first, count), *newShare = rowOf(fresh.shares[k], first, count);
    updateRow(Axis == 0 ? mass : newMass, below[kMass<D>(k)], above[kMass<D>(k)], ratio, 1, count, newMass);
    if (!areBlended)
      updateShareRow<K>(share, Axis == 0 ? share : newShare, in, out, k, ratio, count, newShare);
    else if (Axis == 0)
      std::copy_n(share, count, newShare);
  }
}

/// Adds the net inflow along an axis: for the first axis, to the old state; for the others, to the new one.
/// `areBlended` is that of the gas.
template <int D, int Axis, int K>
void addFluxes(double ratio, const Box& block, const ViewsOf<D, K, const double>& old, Rows<D, K>& flux,
               const ViewsOf<D, K, double>& fresh, [[maybe_unused]] bool areBlended = false) {
  forEachRow<D>(block, [&](const Index<D>& first, int count) {
    const auto below = flux.at(first), above = flux.at(first + Index<D>::unit(Axis));
    const auto update = [&](const double* from, double* to, std::size_t number, int step) {
      updateRow(Axis == 0 ? from : to, below[number], above[number], ratio, step, count, to);
    };
    update(rowOf(old.density, first, count), rowOf(fresh.density, first, count), kDensity, 1);
    const double* momentum = rowOf(old.momentum, first, count)->data();
    double* newMomentum = rowOf(fresh.momentum, first, count)->data();
    for (int k = 0; k < D; ++k) update(momentum + k, newMomentum + k, kVelocity(k), D);
    update(rowOf(old.totalEnergy, first, count), rowOf(fresh.totalEnergy, first, count), kPressure<D>, 1);
    if constexpr (K > 1) addFluxesOfEach<D, Axis, K>(ratio, first, count, old, flux, fresh, areBlended);
  });
}

/// Stores the fluxes along an axis through the rim of the level.
template <int D, int K>
void keepAtRim(const RimFluxes<D>& rims, const Box& faces, int axis, Rows<D, K>& flux) {
  rims.mass.template forEachRowIn<D>(faces, axis, [&](const Index<D>& first, int count, std::size_t place) {
    const auto through = flux.at(first);
    for (int i = 0; i < count; ++i, ++place) {
      rims.mass.at(place) += through[kDensity][i];
      for (int d = 0; d < D; ++d) rims.momentum.at(place)[d] += through[kVelocity(d)][i];
      rims.energy.at(place) += through[kPressure<D>][i];
      if constexpr (K > 1)
        for (int k = 0; k < K; ++k) {
          rims.gases[k].mass.at(place) += through[kMass<D>(k)][i];
          rims.gases[k].share.at(place) += through[kShare<D, K>(k)][i];
        }
    }
  });
}

/// Computes the fluxes along an axis through the faces of a block, and stores those that others need.
template <int D, class Flux, class Shape, int Axis, class G>
void crossFaces(const G& gas, const Box& block, Work<D, kGases<G>>& work, Rows<D, kGases<G>>& flux,
                const RimFluxes<D>& rims) {
  Box faces = block;
  ++faces.upper[Axis];
  computeFluxes<D, Flux, Shape, Axis>(gas, faces, work, flux);
  keepAtRim<D>(rims, faces, Axis, flux);
  rims.masses.keep(block, Axis, flux);
}

/// Computes the new state of a single gas in a block from the fluxes along all axes.
template <int D>
void addAllFluxes(const Level& level, const Box& block, double dt, const StateViews<D, const double>& old,
                  Work<D>& work, const StateViews<D, double>& fresh) {
  std::array<double, D> ratio;
  for (int d = 0; d < D; ++d) ratio[d] = dt / level.spacing(d);
  forEachRow<D>(block, [&](const Index<D>& first, int count) {
    std::array<Pointers<D>, D> below, above;
    for (int d = 0; d < D; ++d) {
      Rows<D>& flux = d == 0 ? work.flux : work.across[d - 1];
      below[d] = flux.at(first);
      above[d] = flux.at(first + Index<D>::unit(d));
    }
    updateLanes<D>(conservedRow<D>(old, first, count), below, above, ratio, count,
                   conservedRow<D>(fresh, first, count));
  });
}

/// Adds to a block of several gases the fluxes along an axis.
template <int D, class Flux, class Shape, int Axis, class G>
void sweep(const G& gas, const Level& level, const Box& block, double dt,
           const ViewsOf<D, kGases<G>, const double>& old, Work<D, kGases<G>>& work,
           const ViewsOf<D, kGases<G>, double>& fresh, const RimFluxes<D>& rims) {
  crossFaces<D, Flux, Shape, Axis>(gas, block, work, work.flux, rims);
  addFluxes<D, Axis>(dt / level.spacing(Axis), block, old, work.flux, fresh, areBlended(gas));
}

/// Performs a step for a block of cells.
template <int D, class Flux, class Shape, class G>
void advanceBlock(const G& gas, const Level& level, const GhostRules<D>& rules, const Box& block, double dt,
                  const ViewsOf<D, kGases<G>, const double>& old, Work<D, kGases<G>>& work,
                  const ViewsOf<D, kGases<G>, double>& fresh, const RimFluxes<D>& rims) {
  work.hold(block.grown(Shape::reach, D));
  recover<D>(gas, level, work.w.box(), old, work.w);
  fillBeyondGrid<D>(level, rules, work.w);
  predict<D>(gas, level, block.grown(1, D), dt, work, Shape{});
  if constexpr (kGases<G> == 1) {
    crossFaces<D, Flux, Shape, 0>(gas, block, work, work.flux, rims);
    if constexpr (D > 1) crossFaces<D, Flux, Shape, 1>(gas, block, work, work.across[0], rims);
    if constexpr (D > 2) crossFaces<D, Flux, Shape, 2>(gas, block, work, work.across[1], rims);
    addAllFluxes<D>(level, block, dt, old, work, fresh);
  } else {
    sweep<D, Flux, Shape, 0>(gas, level, block, dt, old, work, fresh, rims);
    if constexpr (D > 1) sweep<D, Flux, Shape, 1>(gas, level, block, dt, old, work, fresh, rims);
    if constexpr (D > 2) sweep<D, Flux, Shape, 2>(gas, level, block, dt, old, work, fresh, rims);
  }
}

}  // namespace tushar::euler
