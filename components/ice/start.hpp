#pragma once

#include <string>
#include <vector>

#include "components/euler/gas.hpp"
#include "core/core.hpp"
#include "core/input/schema.hpp"

// Uintah's customInitialization: an initial state by formulas.

namespace tushar::ice {

/// The tag `<vortex>`: a rotation of the gas around an axis through its origin, within the radius R. With the distances
/// y and z from the origin along the other two axes, v_y decreases by C z / (rho R^2) exp(-(y^2 + z^2) / (2 R^2)), and
/// v_z increases by the same expression with y in place of z. (T. Poinsot, S. K. Lele, J. Comput. Phys. 101, 1992)
struct Vortex {
  int axis = 0;
  Vec3 origin = Vec3::Zero();       ///< origin [m]
  double strength = 0, radius = 0;  ///< C; radius [m]
  Location where = {};              ///< in the scene
};

struct VortexList {
  std::vector<Vortex> list;
};

/// The tag `<gaussianTemperature>`: T = 300 K + A exp(-(x - x0)^2 / (2 s_x^2) - (y - y0)^2 / (2 s_y^2)), everywhere.
struct GaussianTemperature {
  double amplitude = 0;             ///< amplitude [K]
  Vec3 origin = Vec3::Zero();       ///< origin [m]
  double spreadX = 0, spreadY = 0;  ///< spread x and spread y [m]
};

/// The tag `<counterflow>`: v_x = -a (x - m_x), v_y = a (y - m_y), where m_x and m_y are half the lengths of the grid.
/// Source: C. S. Yoo, Y. Wang, A. Trouvé & H. G. Im, Combust. Theory Model. 9 (2005) 617.
struct Counterflow {
  double strainRate = 0;  ///< strain rate a [1/s]
};

/// The tag `<manufacturedSolution>`. mms_1 is a row of vortices of amplitude A in a wind of 1 m/s along x and y; its
/// pressure is p_0 - A²/4 (cos 2x + cos 2y), with p_0 = 101325 Pa. mms_3 is the initial state of the Taylor-Green
/// vortex with an angle (M. E. Brachet & al., J. Fluid Mech. 130 (1983) 411).
struct Manufactured {
  std::string type;
  double amplitude = 1;  ///< amplitude A [m/s]
  double angle = 0;
};

/// The properties of the gas and of the grid on which initial states depend.
struct StartPlace {
  double density = 0;          ///< density [kg/m³]
  euler::Gas gas = {};         ///< its law
  Vec3 middle = Vec3::Zero();  ///< half the lengths of the grid [m]
};

/// The tag `<customInitialization>`.
struct CustomStart {
  std::optional<VortexList> vortices;
  std::optional<GaussianTemperature> temperature;
  std::optional<Counterflow> counterflow;
  std::optional<Manufactured> manufactured;

  /// The reason why this initial state is not available for `gases` gases, the first of which is `gas`; empty if it is
  /// available.
  std::string problem(std::size_t gases, const euler::Gas& gas = {}) const;
  /// Changes the velocity [m/s] and the temperature [K] at a point [m].
  void apply(const Vec3& point, const StartPlace& place, Vec3& velocity, double& temperatureThere) const;
};

const input::Schema<CustomStart>& customStartSchema();

}  // namespace tushar::ice
