#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm {

/// The methods of this component, each in a separate module.
enum class Method { gas, solid, implicitSolid };

/// The method selected by the <MPM> section of a scene.
Method methodOf(const input::Element& root);

/// The part of a ComponentKind that depends on the method. Its fields have the same names as those of ComponentKind.
struct MethodKind {
  std::function<simulation::MakeComponent(const input::Element& root, input::Diagnostics&)> read;
  std::function<void(std::ostream&)> describe;
  std::function<std::vector<std::vector<simulation::SectionForm>>()> forms;
  std::function<int(const input::Element& root)> nodesBeyond = {};
};

/// Registers a method. The module of the method calls this function when it is loaded.
void define(Method method, MethodKind kind);

/// Describes all methods as one component.
simulation::ComponentKind kind();

}  // namespace tushar::mpm
