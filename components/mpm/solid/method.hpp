#pragma once

#include <optional>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The velocity from which stresses are computed; Bardenhagen, J. Comput. Phys. 180 (2002) 383.
enum class StressUpdate {
  last,          ///< v* at the end of the step, as in Uintah
  modifiedLast,  ///< the particles' new velocity, interpolated to the grid again
  first,         ///< v at the start of the step
};

/// The `MPM` section: the settings of the method.
struct Method {
  StressUpdate stressUpdate = StressUpdate::last;
  double picFraction = 0;         ///< fraction of PIC in the velocity update; the rest is FLIP
  bool xpic = false;              ///< whether velocities are updated by XPIC of order 2
  bool affine = false;            ///< whether velocities are transferred to the grid by APIC
  bool projectsGradient = false;  ///< whether velocities are transferred to the grid with their gradients
  Vec3 gravity = Vec3::Zero();    ///< m/s^2
  double damping = 0;             ///< artificial_damping_coeff, 1/s
  std::optional<ArtificialViscosity> viscosity;
  double minimumMassForAcceleration = 1e-199;     ///< kg
  std::optional<double> maximumParticleVelocity;  ///< m/s
  bool removesLost = true;                        ///< those turned inside out or thrown out; false: the run ends
  int minimumSubcyclesForF = 1;    ///< -n: F follows from the series of exp(L dt) up to the power n instead
  Vec3 commonSize = Vec3::Ones();  ///< size of all particles at the start, in cells, unless each keeps its own
  std::array<bool, 3> isThin{};    ///< axes x, y, z that the grid does not use
  bool keepsSizes = false;         ///< each particle keeps its size
  bool keepsDomains = false;       ///< as edges in any direction, where shape functions follow them
  double meanWidth = 0;            ///< of a cell over x, y, z, m: the length of the artificial viscosity
  bool viscosityHeats = false;     ///< artificial_viscosity_heating
  int nonlocalLayers = 0;          ///< cells within the greatest length of capability::Nonlocal; 0 if there is none
  bool turnsPressures = false;     ///< keepPressBCNormalToSurface: pressures rotate with the bodies that they act on
  bool sharesVolume = false;       ///< DoPressureStabilization: the particles of a cell share one change of volume
  bool conductsHeat = true;
  bool loadsAtCorners = false;  ///< use_CBDI_boundary_condition: pressures act on faces of particles
  bool contactHeats = false;    ///< do_contact_friction_heating
  bool thermalContact = false;  ///< materials that share nodes share a temperature
};

}  // namespace tushar::mpm::solid
