#pragma once

#include "components/mpm/gas/conserving/scheme.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::gas::conserving {

/// The `conserving_gas_dynamics` section of `MPM` as it is written. Defaults of what is missing depend on the transfer
/// and the dimension.
struct Section {
  Transfer transfer = Transfer::apic;
  double cfl = 0.5, advectiveCfl = 0.8;
  std::optional<double> longestParticle;
  std::optional<Viscosity> viscosity;
  double heatConduction = 0;
  std::optional<Remap> remap;
};
const input::Schema<Section>& sectionSchema();

/// The method on a grid of that dimension, defaults filled in.
ConservingGasDynamics settle(const Section& read, int dimension);

}  // namespace tushar::mpm::gas::conserving
