#pragma once

#include <optional>
#include <vector>

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The `MaterialProperties` section.
struct MaterialProperties {
  /// A tag that acts by standing there.
  struct ThermalContact {};
  struct List {
    std::vector<Material> materials;
    std::vector<Contact> contacts;
    std::optional<ThermalContact> thermalContact;
  } mpm;
};

const input::Schema<MaterialProperties>& propertiesSchema();

}  // namespace tushar::mpm::solid
