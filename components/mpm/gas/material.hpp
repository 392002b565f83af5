#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/reference/riemann_solution.hpp"
#include "core/core.hpp"
#include "core/input/expression.hpp"
#include "core/input/geometry.hpp"

namespace tushar::mpm::gas {

/// The positions in a cell at which the particles of a body start.
enum class Placement {
  midpoint,  ///< at the centres of equal parts of the cell
  jittered,  ///< at a random point in each of these parts
  random,    ///< at independent random points of the cell
};

/// A body of gas at the start: its shape and its state, which may vary in space.
struct GasObject {
  Location where;  ///< in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  Index3 particlesPerCell{{1, 1, 1}};  ///< along x, y, z
  input::Expression density;           ///< kg/m³
  input::Expression pressure;          ///< Pa
  input::VectorExpression velocity;    ///< m/s
  Placement placement = Placement::midpoint;
  int seed = 0;  ///< seed of random positions
};

/// A source of heat, de/dt = -rate (e - internalEnergy), such as radiation or a wall of constant temperature.
struct Relaxation {
  double rate = 0;            ///< 1/s
  double internalEnergy = 0;  ///< internal energy in the limit, J/kg
};

/// A stiffened gas: p = (gamma - 1) rho epsilon - p_inf; with p_inf = 0 an ideal gas, (3) of Tran, Kim & Berzins.
///
/// epsilon is e - p_inf / rho: the part of the internal energy e that waves exchange. In terms of epsilon and P = p +
/// p_inf all laws are those of an ideal gas. Particles of a single gas carry epsilon as p.internalEnergy: totals of
/// energy then lack p_inf times the volume of the grid, which a stiffened gas fills. In a mixture, where gases exchange
/// volume, particles carry all of e. Source: F. H. Harlow & A. A. Amsden, Fluid Dynamics, LANL report
/// LA-4700 (1971).
struct Gas {
  std::string name;
  double gamma = 1.4;    ///< ratio of specific heats
  double pInfinity = 0;  ///< Pa
  double carried = 0;    ///< the part of p_inf in the energy that particles carry, Pa: 0 or all
  Location where;        ///< of the constitutive model, in the scene
  std::vector<GasObject> objects;
  std::optional<Relaxation> relaxation;

  /// epsilon [J/kg] for a density rho [kg/m³] and the energy that particles carry [J/kg].
  double heat(double rho, double energy) const { return energy - carried / rho; }
  /// p [Pa] for a density rho [kg/m³] and the energy that particles carry [J/kg].
  double pressure(double rho, double energy) const { return pressureOf(rho, heat(rho, energy)); }
  /// p [Pa] for a density rho [kg/m³] and epsilon [J/kg].
  double pressureOf(double rho, double epsilon) const { return (gamma - 1) * rho * epsilon - pInfinity; }
  /// The energy that particles carry [J/kg] at density rho [kg/m³] and p [Pa].
  double internalEnergy(double rho, double p) const { return (p + pInfinity) / ((gamma - 1) * rho) + carried / rho; }
  /// e [J/kg] for a density rho [kg/m³] and the energy that particles carry [J/kg].
  double fullEnergy(double rho, double energy) const { return energy + (pInfinity - carried) / rho; }
  /// Square of the speed of sound [m²/s²].
  double soundSpeedSquared(double epsilon) const { return gamma * (gamma - 1) * epsilon; }
};

/// The laws of the gases for exact solutions; none if a gas has a source of heat.
inline std::vector<reference::GasLaw> lawsOf(const std::vector<Gas>& gases) {
  std::vector<reference::GasLaw> laws;
  for (const Gas& gas : gases) {
    if (gas.relaxation) return {};
    laws.push_back({gas.gamma, gas.pInfinity});
  }
  return laws;
}

}  // namespace tushar::mpm::gas
