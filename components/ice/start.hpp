#pragma once

#include <string>
#include <vector>

#include "core/base/vec.hpp"
#include "core/input/schema.hpp"

// Uintah's customInitialization: an initial state by formulas.

namespace tushar::ice {

/// A `<vortex>`: it turns the gas within its radius R around an axis through its origin. With the distances y and z
/// from there along the other two axes, v_y falls by C z / (rho R^2) exp(-(y^2 + z^2) / (2 R^2)), and v_z rises by the
/// same of y. (T. Poinsot, S. K. Lele, J. Comput. Phys. 101, 1992)
struct Vortex {
  int axis = 0;
  Vec3 origin = Vec3::Zero();       ///< m
  double strength = 0, radius = 0;  ///< C; m
};

struct VortexList {
  std::vector<Vortex> list;
};

/// `<gaussianTemperature>`: T = 300 K + A exp(-(x - x0)^2 / (2 s_x^2) - (y - y0)^2 / (2 s_y^2)), everywhere.
struct GaussianTemperature {
  double amplitude = 0;             ///< K
  Vec3 origin = Vec3::Zero();       ///< m
  double spreadX = 0, spreadY = 0;  ///< m
};

/// `<customInitialization>`.
struct CustomStart {
  std::optional<VortexList> vortices;
  std::optional<GaussianTemperature> temperature;

  /// Changes the velocity [m/s] and the temperature [K] at a point [m] where the density is rho [kg/m^3].
  void apply(const Vec3& point, double rho, Vec3& velocity, double& temperatureThere) const;
};

const input::Schema<CustomStart>& customStartSchema();

}  // namespace tushar::ice
