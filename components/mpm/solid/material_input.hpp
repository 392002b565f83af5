#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "components/mpm/solid/material.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The `MaterialProperties` section.
struct MaterialProperties {
  struct List {
    std::vector<Material> materials;
    std::vector<Contact> contacts;
    bool thermalContact = false;
  } mpm;
};

const input::Schema<MaterialProperties>& propertiesSchema();

}  // namespace tushar::mpm::solid
