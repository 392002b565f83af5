#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm {

/// The methods of this component, each in a module of its own.
enum class Method { gas, solid, implicitSolid };

/// The method that the <MPM> section of a scene asks for.
Method methodOf(const input::Element& root);

/// What a method reads, describes and makes; its module calls this when it is loaded.
void define(Method method, simulation::ComponentKind kind);

/// All methods as one component.
simulation::ComponentKind kind();

}  // namespace tushar::mpm
