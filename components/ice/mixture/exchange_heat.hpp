#pragma once

#include <Eigen/Cholesky>
#include <limits>

#include "components/ice/heat_coefficients.hpp"
#include "components/ice/heating.hpp"
#include "components/ice/mixture/tasks.hpp"

namespace tushar::ice {

/// The mass fraction of a gas in a cell below which the gas takes no part in the heat exchange: its heat is negligible,
/// and its values are too small to divide by.
inline constexpr double leastPartOfMass = 1e-30;

/// The participants in the heat exchange of a cell: first the bodies in their order, then the gases. There are at most
/// `Most` of them, or any number. All quantities are per cell volume; a participant that is absent has the capacity 0.
template <int Most = Eigen::Dynamic>
struct WarmThings {
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Most, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Most, Most>;

  Vector mass;           ///< mass per volume of the cell [kg/m³]
  Vector capacity;       ///< heat capacity at constant volume, per volume of the cell [J/(m³ K)]
  Vector temperature;    ///< temperature [K]
  Vector volume;         ///< volume fraction of the cell
  Vector expansion;      ///< m R of gases that share their volume [J/(m³ K)]; 0 for bodies
  Vector stiffPressure;  ///< p + p_inf of the gases that share their volume [Pa]
  Vector given;          ///< heat added to each, per volume of the cell [J/m³]

  explicit WarmThings(Eigen::Index count)
      : mass(Vector::Zero(count)),
        capacity(mass),
        temperature(capacity),
        volume(capacity),
        expansion(capacity),
        stiffPressure(capacity),
        given(capacity) {}

  int present() const { return static_cast<int>((capacity.array() > 0).count()); }
  /// Sets one of several gases at a common pressure [Pa], given its mass [kg/m³] and its volume, both per cell volume.
  /// A gas without mass or volume is absent, and so is a gas that cannot have this pressure.
  void setGas(Eigen::Index at, const euler::Gas& gas, double massOfIt, double share, double pressure) {
    if (!(massOfIt > 0) || !(share > 0) || !(pressure + gas.pInfinity > 0)) return;
    mass[at] = massOfIt;
    capacity[at] = massOfIt * gas.specificHeat;
    expansion[at] = massOfIt * gas.gasConstant();
    volume[at] = share;
    stiffPressure[at] = pressure + gas.pInfinity;
    temperature[at] = stiffPressure[at] * share / expansion[at];
  }
};

/// The increase d of the common pressure at which the gases still fill the same volume: the root d > -min P_k of sum
/// (a_k + b_k d) / (P_k + d) = 0. It is unique, because the volume of each gas falls with the pressure. It is found by
/// Newton's method within bounds.
template <class Vector>
double pressureRise(const Vector& a, const Vector& b, const Vector& stiffPressure) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const double p : stiffPressure)
    if (p > 0) {
      least = std::min(least, p);
      greatest = std::max(greatest, p);
    }
  if (least == greatest) return -a.sum() / b.sum();
  double rise = 0, low = -least, high = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 100; ++iteration) {
    double sum = 0, slope = 0;
    for (Eigen::Index k = 0; k < a.size(); ++k) {
      if (!(stiffPressure[k] > 0)) continue;
      const double inverse = 1 / (stiffPressure[k] + rise), term = (a[k] + b[k] * rise) * inverse;
      sum += term;
      slope += (b[k] - term) * inverse;
    }
    if (sum == 0) break;
    (sum > 0 ? low : high) = rise;
    double next = rise - sum / slope;
    if (!(next > low && next < high)) next = std::isinf(high) ? 2 * rise - low + least : 0.5 * (low + high);
    const double change = std::abs(next - rise);
    rise = next;
    if (change <= 1e-15 * (least + rise)) break;
  }
  return rise;
}

/// The changes of the participants in one step of heat exchange.
template <int Most>
struct HeatChanges {
  typename WarmThings<Most>::Vector temperature, volume;  ///< changes of temperature [K] and of volume fraction
};

/// Computes the changes in a time dt from C_a dT_a/dt = sum_b H_ab theta_a theta_b (T_b - T_a), implicitly: the stiffer
/// the exchange, the closer all participants are to one temperature at the end.
///
/// Gases that share a volume expand at their common pressure p' at the end of the step. The heat that a gas receives is
/// m c_v dT + (p' + p_inf) dV, with V = m R T / (p' + p_inf). So the energy of all gases changes by the heat from the
/// bodies, and the total volume is constant.
template <int Most>
HeatChanges<Most> changesByHeat(const WarmThings<Most>& things, const HeatCoefficients& coefficients, double dt) {
  using Vector = typename WarmThings<Most>::Vector;
  const Eigen::Index count = things.capacity.size();
  typename WarmThings<Most>::Matrix system = WarmThings<Most>::Matrix::Zero(count, count);
  Vector heat = things.given;
  std::size_t pair = 0;
  for (Eigen::Index a = 0; a < count; ++a)
    for (Eigen::Index b = a + 1; b < count; ++b, ++pair) {
      // With a stiffer exchange, temperatures would differ by less than 1e-8 of the difference, and round-off would
      // show.
      constexpr double stiffest = 1e8;
      if (!(things.capacity[a] > 0) || !(things.capacity[b] > 0)) continue;
      const double perShares = coefficients.of(pair, things.mass[a], things.mass[b]) * dt;
      const double flow = std::min(perShares * things.volume[a] * things.volume[b],
                                   stiffest * (things.capacity[a] + things.capacity[b]));
      const double gained = flow * (things.temperature[b] - things.temperature[a]);
      heat[a] += gained;
      heat[b] -= gained;
      system(a, a) += flow;
      system(b, b) += flow;
      system(a, b) -= flow;
      system(b, a) -= flow;
    }
  if (heat.isZero(0)) return {Vector::Zero(count), Vector::Zero(count)};
  for (Eigen::Index a = 0; a < count; ++a)
    system(a, a) += things.capacity[a] > 0 ? things.capacity[a] + things.expansion[a] : 1;
  const Eigen::LDLT<typename WarmThings<Most>::Matrix> solver(system);
  HeatChanges<Most> changes{solver.solve(heat), Vector::Zero(count)};
  if (!(things.expansion.array() > 0).any()) return changes;
  const Vector sharing = (things.expansion.array() > 0).select(things.volume, Vector::Zero(count));
  const Vector byPressure = solver.solve(sharing);
  const double rise = pressureRise<Vector>(things.expansion.cwiseProduct(changes.temperature),
                                           things.expansion.cwiseProduct(byPressure) - sharing, things.stiffPressure);
  changes.temperature += rise * byPressure;
  for (Eigen::Index k = 0; k < count; ++k)
    if (things.expansion[k] > 0)
      changes.volume[k] =
          (things.expansion[k] * changes.temperature[k] - rise * sharing[k]) / (things.stiffPressure[k] + rise);
  return changes;
}

/// Adds heat to several gases; the gases of a cell expand.
template <int Most>
void giveHeat(WarmThings<Most>& things, const Heating& heating, double time, double dt, Eigen::Index first) {
  for (std::size_t k = 0; k < heating.perMass.size(); ++k) {
    const auto at = first + static_cast<Eigen::Index>(k);
    things.given[at] = things.mass[at] * heating.inStep(k, time, dt);
  }
}

/// Updates the volume fractions of the gases after their volumes have changed.
template <int Most, class Shares>
void changeShares(const HeatChanges<Most>& changes, Eigen::Index first, double room, Shares&& shares) {
  double sum = 0;
  const auto count = changes.volume.size() - first;
  for (Eigen::Index k = 0; k < count; ++k) {
    double& share = shares(k);
    share = std::max(0.0, share + changes.volume[first + k] / room);
    sum += share;
  }
  for (Eigen::Index k = 0; k < count; ++k) shares(k) /= sum;
}

/// The variables of one gas that the heat exchange reads and changes.
struct WarmGas {
  CellView<const double> mass;
  CellView<double> share;

  static WarmGas from(auto& take) {
    return {.mass = take(requiresNew(euler::c::gasMass)), .share = take(modifies(euler::c::gasShare))};
  }
};

/// Exchanges heat between several gases in the cells that they share, with Uintah's coefficients, and adds heat from
/// outside. Masses and momentum stay constant, and the energy changes only by the heat from outside; the volume
/// fractions and the pressure change.
template <int D>
void exchangeHeat(const Patch& patch, const Gases& gases, const HeatCoefficients& coefficients, const Heating& heating,
                  double time, double dt, CellView<const double> density, CellView<const Vec<D>> momentum,
                  CellView<double> totalEnergy, const std::vector<WarmGas>& held) {
  const auto count = static_cast<Eigen::Index>(gases.size());
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    WarmThings<euler::kMostGases> things(count);
    if (gases.front().blend) {  // they have one temperature already
      for (Eigen::Index k = 0; k < count; ++k) things.mass[k] = held[k].mass[cell];
      giveHeat(things, heating, time, dt, 0);
      totalEnergy[cell] += things.given.sum();
      return;
    }
    const double energy = euler::internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]);
    const double pressure = euler::mixedAt(gases, held, cell).pressure(density[cell], energy);
    for (Eigen::Index k = 0; k < count; ++k)
      if (held[k].mass[cell] > leastPartOfMass * density[cell])
        things.setGas(k, gases[k].gas, held[k].mass[cell], held[k].share[cell], pressure);
    giveHeat(things, heating, time, dt, 0);
    totalEnergy[cell] += things.given.sum();
    if (things.present() < 2) return;
    changeShares(changesByHeat(things, coefficients, dt), 0, 1,
                 [&](Eigen::Index k) -> double& { return held[k].share[cell]; });
  });
}

}  // namespace tushar::ice
