#pragma once

#include "components/mpm/solid/problem.hpp"
#include "core/input/schema.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// The `PhysicalConstants` section.
struct PhysicalConstants {
  Vec3 gravity = Vec3::Zero();  ///< gravity [m/s^2]
};
/// The schema of `PhysicalConstants`; `besideGas`: whether the scene also has a gas, for which another schema reads the
/// section.
const input::Schema<PhysicalConstants>& constantsSchema(bool besideGas = false);

/// The sections of a scene with solids, for the schemas of editors; `mpm` is the schema of <MPM>.
std::vector<simulation::SectionForm> sectionForms(const input::SchemaBase& mpm);

/// Numbers the materials, and gives a name to those that have none or the name of a previous one.
void nameMaterials(std::vector<Material>& materials);

/// Requires specific heats if work, loads or conduction change temperatures.
void checkHeat(const Problem& problem, const input::Element& root, input::Diagnostics& diagnostics);

/// Refuses heat flows through sides of the grid: solids do not know how much of a side they touch.
void refuseHeatFlows(const Problem& problem, const input::Element& root, input::Diagnostics& diagnostics);

/// Completes the settings that depend on the grid: number of particles at each load, their size, cell widths. Throws
/// InputError if a particle starts outside the grid or, with the shape functions gimp, is wider than a cell.
void settleParticles(const Level& level, Problem& problem, bool isGimp);

/// Throws InputError if an axisymmetric scene, with its <MPM> at `where`, has cells on both sides of its axis.
void refuseCellsAround(const Level& level, const Location& where);

/// Number of layers of nodes beyond the sides of the grid that the scene's interpolator needs.
int nodesBeyond(const input::Element& root);

}  // namespace tushar::mpm::solid
