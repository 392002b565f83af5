#pragma once

#include "components/euler/tasks/block_step.hpp"
#include "components/euler/tasks/check_state.hpp"
#include "components/euler/tasks/column_step.hpp"

namespace tushar::euler {

/// Whether the new states of a block are possible; to be called while they are in the cache.
template <int D, class G>
bool canBe(const G& gas, const Box& block, const StateViews<D, double>& fresh) {
  bool fine = true;
  forEachRow<D>(block, [&](const Index<D>& first, int count) {
    fine &= canBe<D>(gas, rowOf(fresh.density, first, count), rowOf(fresh.momentum, first, count)->data(),
                     rowOf(fresh.totalEnergy, first, count), count);
  });
  return fine;
}

/// Performs a step for all cells of a patch, one part after the other; calls `finish(part)` while its new values are in
/// the cache. In three dimensions the parts are columns along z.
template <int D, class Flux, class Shape, class G, class Finish>
void advanceCells(const G& gas, const Level& level, const GhostRules<D>& rules, const Box& cells, double dt,
                  const ViewsOf<D, kGases<G>, const double>& old, const ViewsOf<D, kGases<G>, double>& fresh,
                  const RimFluxes<D>& rims, Finish&& finish) {
  if constexpr (D == 3) {
    const Index3 extents = columnOf(cells, Shape::reach);
    ColumnStep<Flux, Shape, G> step(gas, level, rules, extents, dt, old, fresh, rims);
    forEachBlock<D>(cells, extents, [&](const Box& column) { step.run(column, finish); });
  } else {
    // Kept for the next patch of the thread: patches of a refined grid may be small.
    thread_local auto work = Work<D, kGases<G>>::unfilled(cells, Shape::reach);
    if (work.w.room() < Work<D, kGases<G>>::roomOf(cells, Shape::reach))
      work = Work<D, kGases<G>>::unfilled(cells, Shape::reach);
    forEachBlock<D>(cells, [&](const Box& block) {
      advanceBlock<D, Flux, Shape>(gas, level, rules, block, dt, old, work, fresh, rims);
      finish(block);
    });
  }
}

/// Performs one step on a patch, for one method and the law of a gas; chooseAdvance returns it.
template <int D, class Flux, class Shape, class Law>
void advance(const Patch& patch, const Gas& gas, const OldState<D>& old, double time, double dt,
             const NewState<D>& fresh, const RimFluxes<D>& rims) {
  const Level& level = patch.level();
  const GhostRules<D> rules = ghostRules<D>(level, gas, time, patch.cells().grown(Shape::reach, D));
  const Law law = lawOf<Law>(gas);
  bool fine = true;
  advanceCells<D, Flux, Shape>(law, level, rules, patch.cells(), dt, old, fresh, rims,
                               [&](const Box& part) { fine &= canBe<D>(law, part, fresh); });
  if (!fine) refuseBroken<D>(patch, gas, fresh, &old);
}

template <int D, class Flux>
Advance<D> chooseShape(const Method& method) {
  if (method.reconstruction == Reconstruction::firstOrder) return advance<D, Flux, Constant, StiffenedGas>;
  if (method.limiter == Limiter::minmod) return advance<D, Flux, Sloped<Minmod>, StiffenedGas>;
  if (method.limiter == Limiter::vanLeer) return advance<D, Flux, Sloped<VanLeer>, StiffenedGas>;
  return advance<D, Flux, Sloped<Mc>, StiffenedGas>;
}

template <int D>
Advance<D> chooseAdvance(const Method& method, const Gas& gas) {
  if (gas.law)
    return std::visit(
        [&]<class Law>(const Law&) -> Advance<D> {
          if (method.reconstruction == Reconstruction::firstOrder) return advance<D, Hllc, Constant, Law>;
          return advance<D, Hllc, Sloped<VanLeer>, Law>;
        },
        *gas.law);
  return method.flux == FluxKind::exact ? chooseShape<D, ExactFlux>(method) : chooseShape<D, Hllc>(method);
}

}  // namespace tushar::euler
