#pragma once

#include "components/mpm/gas/conserving/scheme.hpp"
#include "components/mpm/gas/material.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::gas::conserving {

/// The section `conserving_gas_dynamics` of `MPM`, as given in the scene. Defaults of missing tags depend on the
/// transfer and the dimension.
struct Section {
  Transfer transfer = Transfer::apic;
  double cfl = 0.5, advectiveCfl = 0.8;
  std::optional<double> longestParticle;
  std::optional<Viscosity> viscosity;
  double heatConduction = 0;
  std::optional<Remap> remap;
};
const input::Schema<Section>& sectionSchema();

/// Constructs the method; set by the module mpm_gas_conserving when it is loaded.
extern std::unique_ptr<Component> (*makeConservingMpm)(const Level& level, const ConservingGasDynamics& method,
                                                       const std::vector<Gas>& gases);

/// The method's settings on a grid of this dimension, with defaults filled in.
ConservingGasDynamics settle(const Section& read, int dimension);

}  // namespace tushar::mpm::gas::conserving
