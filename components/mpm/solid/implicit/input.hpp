#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid::implicit {

/// Whether the <MPM> section of a scene has implicit time steps.
bool isImplicit(const input::Element& root);
/// Reads a scene of solids with implicit time steps; every problem goes to the diagnostics.
simulation::MakeComponent readScene(const input::Element& root, input::Diagnostics& diagnostics);

/// The sections of such a scene, for the schemas of editors.
std::vector<simulation::SectionForm> forms();

/// The component of solids with implicit time steps, for sus.
simulation::ComponentKind implicitKind();

}  // namespace tushar::mpm::solid::implicit
