#pragma once

#include <optional>

#include "components/mpm/gas/paper/tasks/redistribute.hpp"
#include "components/mpm/gas/viscosity.hpp"

namespace tushar::mpm::gas::paper {

/// The volume, and hence the mass, that a particle represents.
enum class VolumeModel {
  /// An equal share of the cell, V_c / N_c, (5) of the paper, in each step: neither mass nor energy is conserved.
  cellShare,
  tracked,  ///< its own volume: mass is constant, volume is mass over density; mass and total energy are conserved
};

/// The section `gas_dynamics`: the settings of the gas method.
struct GasDynamics {
  double cfl = 0.2125;
  Viscosity viscosity;
  bool densityFilter = true;
  VolumeModel volumeModel = VolumeModel::cellShare;
  std::optional<Redistribution> redistribute;
};

}  // namespace tushar::mpm::gas::paper
