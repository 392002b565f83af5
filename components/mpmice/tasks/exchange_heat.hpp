#pragma once

#include <Eigen/Cholesky>

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// The heat of the particles of a material.
struct WarmBodies {
  ParticleView<const double> mass;
  ParticleView<const mpm::solid::Matrix3> deformation;
  ParticleView<double> temperature;

  static WarmBodies from(auto& take) {
    return {.mass = take(requiresOld(p::mass)),
            .deformation = take(requiresNew(p::deformationMeasure)),
            .temperature = take(modifies(p::temperature))};
  }
};

/// The participants in a cell's heat exchange: bodies in their order, then the gas.
struct WarmThings {
  Eigen::VectorXd capacity;     ///< J/(m³ K), of the volume of the cell
  Eigen::VectorXd temperature;  ///< K
  Eigen::VectorXd volume;       ///< share of the cell
};

/// Temperatures after dt of C_a dT_a/dt = sum_b H_ab theta_a theta_b (T_b - T_a), implicit: however stiff the exchange
/// is, all end at one temperature. `pairs` holds H [W/(m³ K)] of each pair, row by row.
inline Eigen::VectorXd temperaturesAfter(const WarmThings& things, const std::vector<double>& pairs, double dt) {
  const Eigen::Index count = things.capacity.size();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count, count);
  std::size_t pair = 0;
  for (Eigen::Index a = 0; a < count; ++a) {
    system(a, a) += things.capacity[a];
    for (Eigen::Index b = a + 1; b < count; ++b, ++pair) {
      // Beyond that all is one temperature except for 1e-8 of the difference, and round-off would show.
      constexpr double stiffest = 1e8;
      const double flow = std::min(pairs[pair] * dt * things.volume[a] * things.volume[b],
                                   stiffest * (things.capacity[a] + things.capacity[b]));
      system(a, a) += flow;
      system(b, b) += flow;
      system(a, b) -= flow;
      system(b, a) -= flow;
    }
  }
  for (Eigen::Index a = 0; a < count; ++a)
    if (!(things.capacity[a] > 0)) system(a, a) = 1;  // participants that are absent
  const Eigen::VectorXd heat = things.capacity.cwiseProduct(things.temperature);
  return system.ldlt().solve(heat);
}

/// Heat between bodies and the gas, and between bodies, in the cells where they are together, in the manner of Uintah's
/// exchange coefficients: what one gives, the others get.
template <int D>
class HeatExchange {
 public:
  HeatExchange(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
               CellView<const double> free, const std::vector<WarmBodies>& bodies)
      : patch_(patch), materials_(materials), settings_(settings), free_(free), bodies_(bodies) {}

  /// Returns the heat that the gas of the cell gives, J/m³ of the cell.
  double apply(const Index<D>& cell, double dt, CellView<const double> density, CellView<const Vec<D>> momentum,
               CellView<double> totalEnergy) const {
    const auto gas = static_cast<Eigen::Index>(bodies_.size());
    WarmThings things = bodiesIn(cell);
    if (free_[cell] >= leastFreeVolume && density[cell] > 0) {
      const double specific = settings_.gas.gas.specificHeat, mass = density[cell];
      const double internal = totalEnergy[cell] - 0.5 * momentum[cell].squaredNorm() / mass;
      things.capacity[gas] = mass * specific;
      things.temperature[gas] = internal / (mass * specific);
      if (settings_.gas.gas.law || settings_.gas.gas.pInfinity > 0)
        things.temperature[gas] = settings_.gas.gas.temperature(mass / free_[cell], internal / free_[cell]);
      things.volume[gas] = free_[cell];
    }
    if ((things.capacity.array() > 0).count() < 2) return 0;
    double given = 0;
    const Eigen::VectorXd after = temperaturesAfter(things, settings_.heat, dt);
    for (Eigen::Index m = 0; m < gas; ++m) {
      if (!(things.capacity[m] > 0)) continue;
      const double change = after[m] - things.temperature[m];
      if (things.capacity[gas] > 0) given += things.capacity[m] * change;
      for (const int p : bodies_[m].mass.template in<D>(cell)) bodies_[m].temperature[p] += change;
    }
    totalEnergy[cell] -= given;
    return given;
  }

 private:
  WarmThings bodiesIn(const Index<D>& cell) const {
    const auto count = static_cast<Eigen::Index>(bodies_.size() + 1);
    WarmThings things{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
    const double inverse = 1 / patch_.level().cellVolume();
    for (std::size_t m = 0; m < bodies_.size(); ++m) {
      const auto at = static_cast<Eigen::Index>(m);
      double heat = 0;
      for (const int p : bodies_[m].mass.template in<D>(cell)) {
        const double capacity = bodies_[m].mass[p] * materials_[m].specificHeat * inverse;
        things.capacity[at] += capacity;
        heat += capacity * bodies_[m].temperature[p];
        things.volume[at] +=
            bodies_[m].mass[p] / materials_[m].undeformedDensity() * bodies_[m].deformation[p].determinant() * inverse;
      }
      if (things.capacity[at] > 0) things.temperature[at] = heat / things.capacity[at];
    }
    return things;
  }

  const Patch& patch_;
  const std::vector<mpm::solid::Material>& materials_;
  const Settings& settings_;
  CellView<const double> free_;
  const std::vector<WarmBodies>& bodies_;
};

/// Heat between bodies and the gas. Particles count for the cell in which they started the step.
template <int D>
void exchangeHeat(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
                  double dt, CellView<const double> free, CellView<const double> density,
                  CellView<const Vec<D>> momentum, CellView<double> totalEnergy, const std::vector<WarmBodies>& bodies,
                  const std::optional<CellView<double>>& heat) {
  if (heat) heat->fill(0);
  const HeatExchange<D> exchange(patch, materials, settings, free, bodies);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (std::all_of(bodies.begin(), bodies.end(),
                    [&](const WarmBodies& body) { return body.mass.template in<D>(cell).size() == 0; }))
      return;
    const double given = exchange.apply(cell, dt, density, momentum, totalEnergy);
    if (heat) (*heat)[cell] = given;
  });
}

}  // namespace tushar::mpmice
