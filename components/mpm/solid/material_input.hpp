#pragma once

#include <optional>
#include <vector>

#include "components/mpm/solid/cohesive/zone_input.hpp"
#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The `MaterialProperties` section.
struct MaterialProperties {
  /// A tag without content; its presence has an effect.
  struct ThermalContact {};
  struct List {
    std::vector<Material> materials;
    std::vector<Contact> contacts;
    std::vector<ZonesTag> zones;
    std::optional<ThermalContact> thermalContact;
  } mpm;
};

/// The schema of `MaterialProperties`; `besideGas`: whether the section also describes a gas, which another schema
/// reads.
const input::Schema<MaterialProperties>& propertiesSchema(bool besideGas = false);

}  // namespace tushar::mpm::solid
