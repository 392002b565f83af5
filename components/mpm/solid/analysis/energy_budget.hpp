#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// `energyBudget`: reports the sources and sinks of the energy of solids since the start: kinetic energy, work of
/// loads, of the grid's faces and of contact; strain, plastic flow, viscosity and damping; and the unaccounted
/// remainder, which is the dissipation of the method itself (see tasks/measure_work.hpp).
simulation::AnalysisKind energyBudgetKind();

}  // namespace tushar::mpm::solid
