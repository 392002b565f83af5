#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// `energyBudget`: reports the sources and sinks of the energy of solids since the start. Sources are the initial
/// kinetic energy and the work of loads, of the grid's faces and of contact. Sinks are the current kinetic energy,
/// strain, plastic flow, viscosity and damping. The remainder is the dissipation of the method itself (see
/// tasks/measure_work.hpp).
simulation::AnalysisKind energyBudgetKind();

}  // namespace tushar::mpm::solid
