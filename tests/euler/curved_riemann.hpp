#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "components/euler/gas.hpp"

// The exact solution of a shock tube of a gas with any law, computed numerically: shocks from their jump conditions,
// fans in fine steps along isentropes.

namespace tushar::euler {

/// Density, velocity and the last component of a gas state.
struct TubeState {
  double density = 0, velocity = 0, last = 0;
};

/// One outer wave of a shock tube: the states between the gas in front of it and the contact.
class OuterWave {
 public:
  /// `sign` is -1 for the wave to the left, 1 for the wave to the right.
  OuterWave(const Gas& gas, const TubeState& front, double sign) : gas_(gas), front_(front), sign_(sign) {}

  /// Returns the state behind the wave for a density there, on the wave's Hugoniot curve or isentrope.
  TubeState behind(double density) const { return density > front_.density ? shocked(density) : fan(density).back(); }
  /// Returns the density behind the wave for a given pressure there.
  double densityAt(double pressure) const {
    double least = 1e-6 * front_.density, most = front_.density;
    while (pressureOf(behind(most)) < pressure) most *= 1.2;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (least + most);
      (pressureOf(behind(middle)) < pressure ? least : most) = middle;
    }
    return 0.5 * (least + most);
  }
  double pressureOf(const TubeState& of) const { return gas_.pressureOf(of.density, of.last); }
  /// Returns the state at x / t on this side of the contact, for a given density behind the wave.
  TubeState at(double xi, double density) const {
    if (density > front_.density) {
      const TubeState back = behind(density);
      const double flow = back.density * back.velocity - front_.density * front_.velocity;
      const double speed = flow / (back.density - front_.density);
      return sign_ * xi > sign_ * speed ? front_ : back;
    }
    const std::vector<TubeState> states = fan(density);
    for (std::size_t k = 0; k < states.size(); ++k)
      if (sign_ * xi > sign_ * headOf(states[k])) {
        if (k == 0) return front_;
        const double upper = headOf(states[k - 1]), lower = headOf(states[k]), part = (xi - lower) / (upper - lower);
        const auto mix = [&](double a, double b) { return a * part + b * (1 - part); };
        return {mix(states[k - 1].density, states[k].density), mix(states[k - 1].velocity, states[k].velocity),
                mix(states[k - 1].last, states[k].last)};
      }
    return states.back();
  }

 private:
  double headOf(const TubeState& of) const {
    return of.velocity + sign_ * std::sqrt(gas_.soundSpeedSquared(of.density, of.last));
  }
  /// (p - p_0) (v_0 - v) = (u - u_0)², e - e_0 = (p + p_0) (v_0 - v) / 2.
  TubeState shocked(double density) const {
    const double before = pressureOf(front_), shrink = 1 / front_.density - 1 / density;
    const double energy = gas_.energyOf(front_.density, front_.last) / front_.density;
    const auto energyAt = [&](double pressure) { return density * (energy + 0.5 * (pressure + before) * shrink); };
    // By the secant method; the excess is linear in the pressure if the energy contains p.
    const auto excess = [&](double pressure) { return gas_.pressure(density, energyAt(pressure)) - pressure; };
    double pressure = gas_.pressure(density, density * energy), other = before, ofOther = excess(other);
    for (int k = 0; k < 30 && pressure != other; ++k) {
      const double of = excess(pressure);
      if (of == ofOther) break;
      const double next = pressure - of * (pressure - other) / (of - ofOther);
      other = std::exchange(pressure, next);
      ofOther = of;
      if (std::abs(pressure - other) < 1e-14 * std::abs(pressure)) break;
    }
    return {density, front_.velocity + sign_ * std::sqrt((pressure - before) * shrink),
            gas_.last(density, energyAt(pressure))};
  }
  /// States of the rarefaction from the front down to a density: du = sign c / rho drho, and de = p / rho² drho.
  std::vector<TubeState> fan(double density) const {
    constexpr int steps = 50;
    std::vector<TubeState> states{front_};
    double energy = gas_.energyOf(front_.density, front_.last) / front_.density, u = front_.velocity;
    const double change = (density - front_.density) / steps;
    const auto rates = [&](double rho, double of) {
      const double last = gas_.last(rho, rho * of);
      return std::pair(sign_ * std::sqrt(gas_.soundSpeedSquared(rho, last)) / rho,
                       gas_.pressureOf(rho, last) / (rho * rho));
    };
    for (int k = 0; k < steps; ++k) {
      const double rho = front_.density + k * change;
      const auto [ua, ea] = rates(rho, energy);
      const auto [ub, eb] = rates(rho + 0.5 * change, energy + 0.5 * change * ea);
      const auto [uc, ec] = rates(rho + 0.5 * change, energy + 0.5 * change * eb);
      const auto [ud, ed] = rates(rho + change, energy + change * ec);
      u += change / 6 * (ua + 2 * ub + 2 * uc + ud);
      energy += change / 6 * (ea + 2 * eb + 2 * ec + ed);
      states.push_back({rho + change, u, gas_.last(rho + change, (rho + change) * energy)});
    }
    return states;
  }

  const Gas& gas_;
  TubeState front_;
  double sign_;
};

/// The exact solution of a shock tube. The gas must outlive it.
class CurvedRiemann {
 public:
  CurvedRiemann(const Gas& gas, const TubeState& left, const TubeState& right)
      : left_(gas, left, -1), right_(gas, right, 1) {
    double least = 0, most = 2 * std::max(left_.pressureOf(left), right_.pressureOf(right));
    while (closes(most)) most *= 2;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (least + most);
      (closes(middle) ? least : most) = middle;
    }
    pressure = 0.5 * (least + most);
    densityLeft = left_.densityAt(pressure);
    densityRight = right_.densityAt(pressure);
    velocity = left_.behind(densityLeft).velocity;
  }
  TubeState at(double xi) const { return xi < velocity ? left_.at(xi, densityLeft) : right_.at(xi, densityRight); }

  double pressure = 0, velocity = 0;         ///< at the contact
  double densityLeft = 0, densityRight = 0;  ///< on its sides

 private:
  /// Whether the gases would still approach each other with a pressure p between them.
  bool closes(double p) const {
    return left_.behind(left_.densityAt(p)).velocity > right_.behind(right_.densityAt(p)).velocity;
  }

  OuterWave left_, right_;
};

}  // namespace tushar::euler
