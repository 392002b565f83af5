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
  Vec3 gravity = Vec3::Zero();    ///< gravity [m/s^2]
  double damping = 0;             ///< artificial_damping_coeff [1/s]
  std::optional<ArtificialViscosity> viscosity;
  double minimumMassForAcceleration = 1e-199;     ///< mass up to which nodes feel only gravity [kg]
  std::optional<double> maximumParticleVelocity;  ///< maximum particle velocity [m/s]
  /// Whether particles that a step turns inside out or throws through a symmetry plane are removed; otherwise, those
  /// that are turned inside out end the run.
  bool removesLost = true;
  /// Smallest number of substeps for F; -n: F follows from the series of exp(L dt) up to the power n instead.
  int minimumSubcyclesForF = 1;
  /// Whether particles are lost if a step deforms them too much; a prescribed deformation may have any size.
  bool limitsDeformation = true;
  Vec3 commonSize = Vec3::Ones();  ///< initial size of all particles in cells, unless each particle stores its own size
  std::array<bool, 3> isThin{};    ///< which of the axes x, y, z the grid does not use
  bool keepsSizes = false;         ///< whether each particle stores its size
  /// Whether each particle stores its size as edges of any direction, for shape functions that follow them.
  bool keepsDomains = false;
  /// cpdi_lcrit: largest distance of the corners of convected particle domains from the centre, in cells; 0: no limit
  double longestDiagonal = 0;
  double meanWidth = 0;         ///< mean cell width over x, y, z [m]: the length in the artificial viscosity
  bool viscosityHeats = false;  ///< whether artificial viscosity heats particles (artificial_viscosity_heating)
  /// Number of cells that the largest radius of capability::Nonlocal spans; 0 if no model averages.
  int nonlocalLayers = 0;
  /// keepPressBCNormalToSurface: whether pressures rotate with the bodies on which they act
  bool turnsPressures = false;
  /// DoPressureStabilization: whether the particles of a cell share one change of volume
  bool sharesVolume = false;
  bool isGranular = false;  ///< DoGranularMPM: whether grains that do not touch move separately
  bool conductsHeat = true;
  bool givesTemperatures = false;  ///< whether sides of the grid have given temperatures
  bool loadsAtCorners = false;     ///< use_CBDI_boundary_condition: whether pressures act on faces of particles
  bool contactHeats = false;       ///< do_contact_friction_heating: whether friction in contacts heats bodies
  bool thermalContact = false;     ///< whether materials that share nodes share a temperature
};

}  // namespace tushar::mpm::solid
