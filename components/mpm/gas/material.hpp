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

/// Where in a cell the particles of a body are placed at the start.
enum class Placement {
  midpoint,  ///< at the centres of equal parts of the cell
  jittered,  ///< at a random point in each of these parts
  random,    ///< at independent random points of the cell
};

/// The initial shape and state of a body of gas; the state may vary in space.
struct GasObject {
  Location where;  ///< location of its tag in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  Index3 particlesPerCell{{1, 1, 1}};  ///< number of particles per cell along x, y, z
  input::Expression density;           ///< density [kg/m³]
  input::Expression pressure;          ///< pressure [Pa]
  input::VectorExpression velocity;    ///< velocity [m/s]
  Placement placement = Placement::midpoint;
  int seed = 0;  ///< seed for random positions
};

/// A heat source, de/dt = -rate (e - internalEnergy), such as radiation or a wall at constant temperature.
struct Relaxation {
  double rate = 0;            ///< rate [1/s]
  double internalEnergy = 0;  ///< internal energy that the gas approaches [J/kg]
};

/// A stiffened gas: p = (gamma - 1) rho epsilon - p_inf; with p_inf = 0 an ideal gas, (3) of Tran, Kim & Berzins.
///
/// epsilon is e - p_inf / rho, the part of the internal energy e that waves exchange. In terms of epsilon and P = p +
/// p_inf, all laws are those of an ideal gas. Particles of a single gas store epsilon as p.internalEnergy; totals of
/// energy then lack p_inf times the volume of the grid, because a stiffened gas fills the grid. In a mixture, where
/// gases exchange volume, particles store e itself. Source: F. H. Harlow & A. A. Amsden, Fluid Dynamics, LANL report
/// LA-4700 (1971).
struct Gas {
  std::string name;
  double gamma = 1.4;    ///< ratio of specific heats
  double pInfinity = 0;  ///< p_inf [Pa]
  double carried = 0;    ///< part of p_inf that is included in the energy stored by particles [Pa]: 0 or all
  Location where;        ///< location of the constitutive model in the scene
  std::vector<GasObject> objects;
  std::optional<Relaxation> relaxation;

  /// Epsilon [J/kg] for a density rho [kg/m³] and the energy stored by particles [J/kg].
  double heat(double rho, double energy) const { return energy - carried / rho; }
  /// Pressure [Pa] for a density rho [kg/m³] and the energy stored by particles [J/kg].
  double pressure(double rho, double energy) const { return pressureOf(rho, heat(rho, energy)); }
  /// Pressure [Pa] for a density rho [kg/m³] and epsilon [J/kg].
  double pressureOf(double rho, double epsilon) const { return (gamma - 1) * rho * epsilon - pInfinity; }
  /// The energy stored by particles [J/kg] at a density rho [kg/m³] and a pressure p [Pa].
  double internalEnergy(double rho, double p) const { return (p + pInfinity) / ((gamma - 1) * rho) + carried / rho; }
  /// e [J/kg] for a density rho [kg/m³] and the energy stored by particles [J/kg].
  double fullEnergy(double rho, double energy) const { return energy + (pInfinity - carried) / rho; }
  /// Squared speed of sound [m²/s²].
  double soundSpeedSquared(double epsilon) const { return gamma * (gamma - 1) * epsilon; }
};

/// The equations of state of the gases, for exact solutions; empty if any gas has a heat source.
inline std::vector<reference::GasLaw> lawsOf(const std::vector<Gas>& gases) {
  std::vector<reference::GasLaw> laws;
  for (const Gas& gas : gases) {
    if (gas.relaxation) return {};
    laws.push_back({gas.gamma, gas.pInfinity});
  }
  return laws;
}

}  // namespace tushar::mpm::gas
