#pragma once

#include "components/mpm/solid/material.hpp"
#include "core/input/variant.hpp"

namespace tushar::mpm::solid {

/// Reads the tags `damage_model` and `erosion` of a material whose constitutive model has been read. Reports problems
/// to `diagnostics`.
void readDamage(Material& material, const input::Element& parent, input::Diagnostics& diagnostics);
void describeDamage(std::ostream& out, int indent);
/// The allowed content of `damage_model` and `erosion`, for the schemas of editors.
std::vector<input::TagForm> damageForms();

}  // namespace tushar::mpm::solid
