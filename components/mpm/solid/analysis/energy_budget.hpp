#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// `energyBudget`: where the energy of solids came from and where it went since the start, in the report: kinetic
/// energy, work of loads, of the grid's faces and of contact; strain, plastic flow, viscosity and damping; and what is
/// not accounted for, which the method has taken itself (see tasks/measure_work.hpp).
simulation::AnalysisKind energyBudgetKind();

}  // namespace tushar::mpm::solid
