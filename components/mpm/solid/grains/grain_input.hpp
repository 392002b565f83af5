#pragma once

#include "components/mpm/solid/problem.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// Declares the tags of a material that describe how its grains separate.
void addGrainTags(input::Schema<Material>& material);
/// Whether the grains of a scene move separately, and whether the scene also has a gas.
struct GrainSwitches {
  bool isGranular = false, besideGas = false;
};
/// Checks the materials of a scene: only those of a scene whose grains move separately may have no bodies. For such a
/// scene, checks the tags of grains, and makes the ids of particles that may share a material distinct; for others,
/// notes that these tags have no effect. Called after all other settings have been read.
void settleGrains(Problem& problem, const GrainSwitches& switches, const input::Element& root,
                  input::Diagnostics& diagnostics);

}  // namespace tushar::mpm::solid
