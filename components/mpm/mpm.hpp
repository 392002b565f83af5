#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm {

/// The methods of this component, each in a separate module.
enum class Method { gas, solid, implicitSolid };

/// The method that the <MPM> section of a scene selects.
Method methodOf(const input::Element& root);

/// The description of a method: its part of the ComponentKind, whose fields have the same names.
struct MethodKind {
  std::function<simulation::MakeComponent(const input::Element& root, input::Diagnostics&)> read;
  std::function<void(std::ostream&)> describe;
  std::function<std::vector<std::vector<simulation::SectionForm>>()> forms;
  std::function<int(const input::Element& root)> nodesBeyond = {};
};

/// Must be called by the module of a method when it is loaded.
void define(Method method, MethodKind kind);

/// All methods as one component.
simulation::ComponentKind kind();

}  // namespace tushar::mpm
