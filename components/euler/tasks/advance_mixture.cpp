#include "components/euler/tasks/advance_mixture.hpp"

#include <fmt/ranges.h>

#include "components/euler/tasks/advance_patch.hpp"
#include "components/euler/tasks/mend_new_cells.hpp"

namespace tushar::euler {

namespace {

/// Whether the state of a cell is possible for its gases.
template <int D, class Held, class T>
bool isPossible(const std::vector<Settings>& gases, const std::vector<Held>& held, const StateViews<D, T>& state,
                const Index<D>& cell) {
  const double energy = internalEnergyIn<D>(state, cell);
  if (gases.front().blend) return state.density[cell] > 0 && blendAt(gases, held, energy, cell).isPossible;
  const Gas alike = mixedAt(gases, held, cell).alike();
  return canBe<D>(alike, &state.density[cell], state.momentum[cell].data(), &state.totalEnergy[cell], 1);
}

}  // namespace

template <int D, class Held, class T>
void refuseBrokenMixture(const Patch& patch, const std::vector<Settings>& gases, const std::vector<Held>& held,
                         const StateViews<D, T>& state) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (isPossible<D>(gases, held, state, cell)) return;
    if (gases.front().blend)
      refuseBlend<D>(*gases.front().blend, patch.level(), cell, massesIn(held, cell), internalEnergyIn<D>(state, cell));
    refuseState<D, T>(patch.level(), mixedAt(gases, held, cell).alike(), cell, state, nullptr);
  });
}

namespace {

template <int D, class Shape, int K>
void advanceMixture(const Patch& patch, const std::vector<Settings>& gases, const OldState<D>& old,
                    const std::vector<OldGas>& oldGases, double time, double dt, const NewState<D>& fresh,
                    const std::vector<NewGas>& newGases, const RimFluxes<D>& rims,
                    const std::vector<GasRims>& gasRims) {
  const Level& level = patch.level();
  RimFluxes<D> allRims = rims;
  allRims.gases = gasRims;
  const GhostRules<D> rules =
      ghostRulesOf<D>(level, gases.front().gas, gases, time, patch.cells().grown(Shape::reach, D));
  const Mixture<K> mixture = mixtureOf<K>(gases);
  const auto before = viewsOf<const double, D>(old, oldGases);
  const auto after = viewsOf<double, D>(fresh, newGases);
  advanceCells<D, Hllc, Shape>(mixture, level, rules, patch.cells(), dt, before, after, allRims, [](const Box&) {});
  if (!mixture.blend) refuseBrokenMixture<D>(patch, gases, newGases, fresh);
}

template <int D, int K>
AdvanceMixture<D> chooseOf(const Method& method) {
  if (method.reconstruction == Reconstruction::firstOrder) return advanceMixture<D, Constant, K>;
  return advanceMixture<D, Sloped<VanLeer>, K>;
}

}  // namespace

template <int D>
AdvanceMixture<D> chooseAdvanceMixture(const Method& method, std::size_t gases) {
  return gases == 2 ? chooseOf<D, 2>(method) : chooseOf<D, 3>(method);
}

template <int D>
void closeRefluxed(const Patch&, const std::vector<Settings>&, const std::vector<Box>& besideFiner,
                   const std::vector<CellView<double>>& shares) {
  constexpr double roundOff = 1e-12;
  for (const Box& box : besideFiner)
    forEach<D>(box, [&](const Index<D>& cell) {
      double sum = 0;
      for (const CellView<double>& share : shares) sum += share[cell];
      if (std::abs(sum - 1) > roundOff)
        for (const CellView<double>& share : shares) share[cell] /= sum;
    });
}

template <int D>
void closeShares(const Patch& patch, const std::vector<Settings>& gases, const std::vector<CellView<double>>& shares) {
  closeRefluxed<D>(patch, gases, {patch.cells()}, shares);
}

template <int D>
void checkRefluxedMixture(const Patch& patch, const std::vector<Settings>& gases, const std::vector<Box>& besideFiner,
                          const ChangedState<D>& state, const std::vector<ChangedGas>& held) {
  const auto isFine = [&](const Index<D>& cell) { return isPossible<D, ChangedGas, double>(gases, held, state, cell); };
  const std::optional<Index<D>> broken = firstFailing<D>(patch.level(), besideFiner, isFine);
  const BlendLaws* laws = gases.front().blend.get();
  if (broken && laws)
    refuseBlend<D>(*laws, patch.level(), *broken, massesIn(held, *broken), internalEnergyIn<D, double>(state, *broken));
  if (broken) refuseState<D, double>(patch.level(), mixedAt(gases, held, *broken).alike(), *broken, state, nullptr);
  for (const Box& box : besideFiner)
    forEach<D>(box, [&](const Index<D>& cell) {
      if (!laws) return;
      const Blend blend = blendAt(gases, held, internalEnergyIn<D, double>(state, cell), cell);
      for (std::size_t k = 0; k < held.size(); ++k) held[k].share[cell] = blend.shares[k];
    });
}

template <int D>
void refuseBlend(const BlendLaws& laws, const Level& level, const Index<D>& cell,
                 const std::array<double, kMostGases>& masses, double energy) {
  const Vec3 at = level.expandPoint<D>(level.cellCentre<D>(cell));
  throw NumericalError(fmt::format("the gases of the cell at ({:g}, {:g}, {:g}) m became impossible: {:.6g} kg/m^3 "
                                   "with the internal energy {:.6g} J/m^3{}",
                                   at[0], at[1], at[2], fmt::join(masses, " + "), energy, laws.limits()),
                       "", "c.density", level.cellNumber<D>(cell));
}

template <int D>
void closeBlend(const Patch& patch, const std::vector<Settings>& gases, CellView<const double> density,
                CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                const std::vector<CellView<const double>>& masses, const std::vector<CellView<double>>& shares) {
  const BlendLaws& laws = *gases.front().blend;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double energy = internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]);
    std::array<double, kMostGases> held{}, guess{};
    for (std::size_t k = 0; k < masses.size(); ++k) {
      held[k] = masses[k][cell];
      guess[k] = shares[k][cell];
    }
    const Blend blend = laws.at(held.data(), energy, guess.data());
    if (!(density[cell] > 0) || !blend.isPossible) refuseBlend<D>(laws, patch.level(), cell, held, energy);
    for (std::size_t k = 0; k < shares.size(); ++k) shares[k][cell] = blend.shares[k];
  });
}

template <int D>
void mendNewMixture(const Patch&, const std::vector<Settings>& gases, const std::vector<Box>& newCells,
                    const ChangedState<D>& state, const std::vector<ChangedGas>& held) {
  const auto isFine = [&](const Index<D>& cell) {
    for (const ChangedGas& one : held)
      if (one.mass[cell] < 0 || one.share[cell] < 0) return false;
    return isPossible<D, ChangedGas, double>(gases, held, state, cell);
  };
  const auto close = [&](const Index<D>& cell) {
    double shares = 0, masses = 0;
    for (const ChangedGas& one : held) shares += one.share[cell], masses += one.mass[cell];
    for (const ChangedGas& one : held) one.share[cell] /= shares;
    state.density[cell] = masses;
  };
  for (const Box& box : newCells)
    forEach<D>(box.coarsened(D), [&](const Index<D>& parent) {
      const Children<D> children(parent);
      children.forEach(close);
      if (children.areAll(isFine)) return;
      children.setToMean(state.density);
      children.setToMean(state.momentum);
      children.setToMean(state.totalEnergy);
      for (const ChangedGas& one : held) children.setToMean(one.mass), children.setToMean(one.share);
    });
}

template <int D>
void limitMixtureStep(const Patch& patch, const std::vector<Settings>& gases, const Courant& courant,
                      const OldState<D>& old, const std::vector<OldGas>& held, Minimum& dt) {
  if (!gases.front().blend) refuseBrokenMixture<D, OldGas, const double>(patch, gases, held, old);
  const CrossingRate<D> crossing(courant);
  double greatest = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double energy = internalEnergyIn<D, const double>(old, cell);
    const MixedGas mixed = lawAt(gases, held, energy, cell);
    const double rho = old.density[cell], p = mixed.pressure(rho, energy);
    if (gases.front().blend && !(mixed.softness > 0))
      refuseBlend<D>(*gases.front().blend, patch.level(), cell, massesIn(held, cell), energy);
    const double c = std::sqrt(mixed.soundSpeedSquared(rho, p));
    const double rate = crossing.ofAxes(
        [&](int d) { return (std::abs(old.momentum[cell][d]) / rho + c) * patch.level().inverseSpacing(d); });
    greatest = std::max(greatest, rate);
  });
  if (greatest > 0) dt.add(courant.number / greatest, "CFL");
}

#define TUSHAR_MIXTURE(D)                                                                                              \
  template void refuseBrokenMixture(const Patch&, const std::vector<Settings>&, const std::vector<OldGas>&,            \
                                    const StateViews<D, const double>&);                                               \
  template void refuseBrokenMixture(const Patch&, const std::vector<Settings>&, const std::vector<NewGas>&,            \
                                    const StateViews<D, double>&);                                                     \
  template AdvanceMixture<D> chooseAdvanceMixture<D>(const Method&, std::size_t);                                      \
  template void closeShares<D>(const Patch&, const std::vector<Settings>&, const std::vector<CellView<double>>&);      \
  template void closeRefluxed<D>(const Patch&, const std::vector<Settings>&, const std::vector<Box>&,                  \
                                 const std::vector<CellView<double>>&);                                                \
  template void checkRefluxedMixture<D>(const Patch&, const std::vector<Settings>&, const std::vector<Box>&,           \
                                        const ChangedState<D>&, const std::vector<ChangedGas>&);                       \
  template void mendNewMixture<D>(const Patch&, const std::vector<Settings>&, const std::vector<Box>&,                 \
                                  const ChangedState<D>&, const std::vector<ChangedGas>&);                             \
  template void closeBlend<D>(const Patch&, const std::vector<Settings>&, CellView<const double>,                      \
                              CellView<const Vec<D>>, CellView<const double>,                                          \
                              const std::vector<CellView<const double>>&, const std::vector<CellView<double>>&);       \
  template void refuseBlend<D>(const BlendLaws&, const Level&, const Index<D>&, const std::array<double, kMostGases>&, \
                               double);                                                                                \
  template void limitMixtureStep<D>(const Patch&, const std::vector<Settings>&, const Courant&, const OldState<D>&,    \
                                    const std::vector<OldGas>&, Minimum&);
TUSHAR_MIXTURE(1)
TUSHAR_MIXTURE(2)
TUSHAR_MIXTURE(3)

}  // namespace tushar::euler
