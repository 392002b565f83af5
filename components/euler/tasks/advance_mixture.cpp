#include "components/euler/tasks/advance_mixture.hpp"

#include "components/euler/tasks/advance_patch.hpp"

namespace tushar::euler {

namespace {

/// Throws NumericalError for the first cell of the patch with an impossible state, if there is one.
template <int D, class Held, class T>
void refuseBrokenMixture(const Patch& patch, const std::vector<Settings>& gases, const std::vector<Held>& held,
                         const StateViews<D, T>& state) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const Gas alike = mixedAt(gases, held, cell).alike();
    if (canBe<D>(alike, &state.density[cell], state.momentum[cell].data(), &state.totalEnergy[cell], 1)) return;
    refuseState<D, T>(patch.level(), alike, cell, state, nullptr);
  });
}

template <class T, int D, class Held>
MixtureViews<D, T> viewsOf(const StateViews<D, T>& all, const std::vector<Held>& held) {
  MixtureViews<D, T> views{all, {}, {}};
  for (const Held& one : held) {
    views.masses.push_back(one.mass);
    views.shares.push_back(one.share);
  }
  return views;
}

template <int D, class Shape, int K>
void advanceMixture(const Patch& patch, const std::vector<Settings>& gases, const OldState<D>& old,
                    const std::vector<OldGas>& oldGases, double time, double dt, const NewState<D>& fresh,
                    const std::vector<NewGas>& newGases) {
  const Level& level = patch.level();
  const GhostRules<D> rules = ghostRules<D>(level, gases.front().gas, time);
  const Mixture<K> mixture = mixtureOf<K>(gases);
  const auto before = viewsOf<const double, D>(old, oldGases);
  const auto after = viewsOf<double, D>(fresh, newGases);
  Work<D, K> work(patch.cells(), Shape::reach);
  forEachBlock<D>(patch.cells(), [&](const Box& block) {
    advanceBlock<D, Hllc, Shape>(mixture, level, rules, block, dt, before, work, after, {});
  });
  refuseBrokenMixture<D>(patch, gases, newGases, fresh);
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
void limitMixtureStep(const Patch& patch, const std::vector<Settings>& gases, double cfl, const OldState<D>& old,
                      const std::vector<OldGas>& held, Minimum& dt) {
  refuseBrokenMixture<D, OldGas, const double>(patch, gases, held, old);
  double greatest = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const MixedGas mixed = mixedAt(gases, held, cell);
    const double rho = old.density[cell], p = mixed.pressure(rho, internalEnergyIn<D, const double>(old, cell));
    const double c = std::sqrt(mixed.soundSpeedSquared(rho, p));
    double rate = 0;
    for (int d = 0; d < D; ++d) rate += (std::abs(old.momentum[cell][d]) / rho + c) * patch.level().inverseSpacing(d);
    greatest = std::max(greatest, rate);
  });
  if (greatest > 0) dt.add(cfl / greatest, "CFL");
}

template AdvanceMixture<1> chooseAdvanceMixture<1>(const Method&, std::size_t);
template AdvanceMixture<2> chooseAdvanceMixture<2>(const Method&, std::size_t);
template AdvanceMixture<3> chooseAdvanceMixture<3>(const Method&, std::size_t);
template void limitMixtureStep<1>(const Patch&, const std::vector<Settings>&, double, const OldState<1>&,
                                  const std::vector<OldGas>&, Minimum&);
template void limitMixtureStep<2>(const Patch&, const std::vector<Settings>&, double, const OldState<2>&,
                                  const std::vector<OldGas>&, Minimum&);
template void limitMixtureStep<3>(const Patch&, const std::vector<Settings>&, double, const OldState<3>&,
                                  const std::vector<OldGas>&, Minimum&);

}  // namespace tushar::euler
