#pragma once

#include "components/ice/gas_input.hpp"
#include "components/mpmice/settings.hpp"
#include "core/input/diagnostics.hpp"

namespace tushar::mpmice {

/// Reads what bodies and gases exchange by the coefficients of a scene, which must have some: drag, heat and
/// convection. `solids` is the number of bodies. Reports every problem to the diagnostics.
void readExchange(const ice::GasScene& scene, int solids, const input::Element& root, Settings& settings,
                  input::Diagnostics& diagnostics);

}  // namespace tushar::mpmice
