#pragma once

#include "components/ice/mixture/tasks.hpp"
#include "components/ice/tasks/advance_implicitly.hpp"
#include "components/ice/tasks/limit_implicit_step.hpp"
#include "components/ice/tasks/solve_pressure.hpp"

// Implicit steps of several gases: the steps of one gas, with the law of the mixture in each cell.

namespace tushar::ice {

namespace c {

/// Labels of the coefficients in the law of the gases in a cell before a step; the solve uses this law.
inline constexpr CellLabel<double> softness{"c.softness", "1", "sum of z / (gamma - 1) of several gases"};
inline constexpr CellLabel<double> stiffness{"c.stiffness", "J/m^3",
                                             "sum of z gamma p_inf / (gamma - 1) of several gases"};

}  // namespace c

/// A view of the new volume fraction of a gas.
struct NewShare {
  CellView<const double> share;

  static NewShare from(auto& take) { return {.share = take(requiresNew(euler::c::gasShare))}; }
};

/// Computes the pressure of the gases [Pa]; in the first step, it is used as the pressure of a previous step.
template <int D>
void initializeMixedPressure(const Patch& patch, const Gases& gases, CellView<const double> density,
                             CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                             const std::vector<NewShare>& held, CellView<double> pressure) {
  const euler::StateViews<D, const double> state{density, momentum, totalEnergy};
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    pressure[cell] = euler::mixedAt(gases, held, cell)
                         .pressure(density[cell], euler::internalEnergyIn<D, const double>(state, cell));
  });
}

template <int D>
void computeLaw(const Patch& patch, const Gases& gases, const std::vector<euler::OldGas>& held,
                CellView<double> softness, CellView<double> stiffness) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const euler::MixedGas law = euler::mixedAt(gases, held, cell);
    softness[cell] = law.softness;
    stiffness[cell] = law.stiffness;
  });
}

/// Views of what the solve reads of several gases: their joint state, with two ghost layers, and their law.
template <int D>
struct LawfulState : euler::OldState<D> {
  CellView<const double> softness, stiffness;

  static LawfulState from(auto& take) {
    return {{euler::OldState<D>::from(take, 2)}, take(requiresNew(c::softness, 2)), take(requiresNew(c::stiffness, 2))};
  }
  /// Views with G and S in place of the volume fractions of two gases; with lawsOfShares, these have the law of the
  /// mixture.
  euler::MixtureViews<D, const double> views() const {
    return {*this, {this->density, this->density}, {softness, stiffness}};
  }
};
inline constexpr euler::Mixture<2> lawsOfShares{.softness = {1, 0}, .stiffness = {0, 1}};

/// Solves for the pressure of several gases, like solvePressure. `gas` is the first gas; its method and its boundary
/// conditions apply to all.
template <int D>
void solveMixedPressure(const RankPatches& patches, const Workers& workers, const euler::Settings& gas,
                        const IceSettings& settings, double time, double dt, const std::vector<LawfulState<D>>& before,
                        const std::vector<CellView<const double>>& guess, const std::vector<PressureViews>& fresh,
                        const SolveTotals& totals) {
  const Level& level = patches.front()->level();
  const euler::GhostRules<D> rules = euler::withLaws<D>(euler::ghostRules<D>(level, gas.gas, time), lawsOfShares);
  std::vector<FaceFlow<D, 2>> flows;
  for (const Patch* patch : patches)
    flows.emplace_back(level, lawsOfShares, gas.method, settings, rules, patch->cells(), dt);
  forEachOn(workers, patches, [&](std::size_t p) { flows[p].hold(patches[p]->cells(), before[p].views()); });
  const ChangeEquations equations{
      [](std::size_t, const Index<D>&) { return false; },
      [&](std::size_t p, const Index<D>& cell) { return equationByLaw<D>(level, flows[p], cell, dt); },
      [&](std::size_t p, const Index<D>& cell) {
        return stiffPressureIn(flows[p], cell) * softnessIn(flows[p], cell);
      }};
  solveForChange<D>(patches, workers, settings, flows, guess, fresh, totals, equations);
}

/// Calls `use(laws)` with the laws of two or three gases.
template <class Use>
void withLaws(const Gases& gases, Use&& use) {
  if (gases.size() == 2) return use(euler::mixtureOf<2>(gases));
  use(euler::mixtureOf<3>(gases));
}

/// Performs one step of several gases on a patch, like advanceImplicitly; u_f carries the masses and the volume
/// fractions.
template <int D>
void advanceMixtureImplicitly(const Patch& patch, const Gases& gases, const IceSettings& settings,
                              const euler::OldState<D>& before, const std::vector<euler::OldGas>& oldGases, double time,
                              double dt, CellView<const double> change, const euler::NewState<D>& fresh,
                              const std::vector<euler::NewGas>& newGases) {
  const Level& level = patch.level();
  const euler::GhostRules<D> rules = euler::ghostRulesOf<D>(level, gases.front().gas, gases, time);
  const auto old = euler::viewsOf<const double, D>(before, oldGases);
  const auto after = euler::viewsOf<double, D>(fresh, newGases);
  double most = 0;
  withLaws(gases, [&]<int K>(const euler::Mixture<K>& laws) {
    ImplicitStep<D, K> step(level, laws, gases.front().method, settings, rules, euler::largestBlock<D>(patch.cells()),
                            dt);
    euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
      most = std::max(most, advanceBlockImplicitly<D, K>(level, block, old, dt, change, step, after, {}));
    });
  });
  euler::refuseBrokenMixture<D, euler::NewGas, double>(patch, gases, newGases, fresh);
  refuseCrossing(most, dt);
}

/// Limits the time step of several gases, like limitImplicitStep; a separate task limits it by diffusion.
template <int D>
void limitImplicitMixture(const Patch& patch, const Gases& gases, const euler::Courant& courant,
                          const IceSettings& settings, const euler::OldState<D>& before,
                          const std::vector<euler::OldGas>& held, double time, CellView<const double> pressure,
                          Minimum& dt) {
  const Level& level = patch.level();
  euler::refuseBrokenMixture<D, euler::OldGas, const double>(patch, gases, held, before);
  const euler::GhostRules<D> rules = euler::ghostRulesOf<D>(level, gases.front().gas, gases, time);
  const Box cells = patch.cells().grown(1, D);
  double greatest = 0;
  withLaws(gases, [&]<int K>(const euler::Mixture<K>& laws) {
    GasBefore<D, K> gas(level, laws, settings, rules, cells.size());
    gas.hold(cells, euler::viewsOf<const double, D>(before, held));
    euler::Rows<D, K> pushing = gas.old();
    gas.fillWithPressure(pressure, pushing);
    greatest = greatestImplicitRate<D, K>(patch, gas, pushing, settings.soundSpeedKnob, courant,
                                          [](const Index<D>&, int) { return 0.0; });
  });
  if (greatest > 0) dt.add(courant.number / greatest, "CFL");
}

}  // namespace tushar::ice
