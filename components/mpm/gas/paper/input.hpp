#pragma once

#include "components/mpm/gas/paper/method.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::gas::paper {

/// The schema of the section `gas_dynamics` of `MPM`.
const input::Schema<GasDynamics>& methodSchema();

/// Throws InputError if a reseeded cell would have more than max_particles: it would be reseeded in every step.
void checkSeeds(const Redistribution& how, int dimension);

}  // namespace tushar::mpm::gas::paper
