#include "components/mpm/solid/scene_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/body_notes.hpp"
#include "components/mpm/solid/loads/load_input.hpp"
#include "components/mpm/solid/material_input.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

const Schema<PhysicalConstants>& constantsSchema(bool besideGas) {
  static const auto make = [] {
    Schema<PhysicalConstants> tags("PhysicalConstants", "Physical constants.");
    tags.value("gravity", &PhysicalConstants::gravity, Vec3::Zero(), "m/s^2", "acceleration of gravity");
    for (const char* tag : {"reference_point", "viscosity", "ideal_gas_constant", "pressure"})
      tags.ignored(tag, "belongs to flow components");
    return tags;
  };
  static const Schema<PhysicalConstants> alone = make().ignored("reference_pressure", "it has no effect on solids");
  static const Schema<PhysicalConstants> beside = make().custom(
      "reference_pressure", [](PhysicalConstants&, const Element&, Diagnostics&) {}, {"reference_pressure"},
      "the ambient pressure, which exerts no force on bodies");
  return besideGas ? beside : alone;
}

std::vector<simulation::SectionForm> sectionForms(const input::SchemaBase& mpm) {
  return {{"MPM", &mpm},
          {"PhysicalConstants", &constantsSchema(), false},
          {"MaterialProperties", &propertiesSchema()},
          {"PhysicalBC", &loadsForm(), false}};
}

namespace {

/// Uses one size for the particles of all bodies, if all have the same size.
void settleSizes(Problem& problem) {
  Index3 first{{1, 1, 1}};
  for (auto material = problem.materials.rbegin(); material != problem.materials.rend(); ++material)
    if (!material->bodies.empty()) first = material->bodies.front().particlesPerCell;
  for (int axis = 0; axis < 3; ++axis) problem.method.commonSize[axis] = 1.0 / first[axis];
  problem.method.keepsSizes = problem.start.solution != nullptr;
  for (const Material& material : problem.materials)
    for (const Body& body : material.bodies) {
      problem.method.keepsSizes = problem.method.keepsSizes || body.seeds || !(body.particlesPerCell == first);
      problem.method.keepsDomains = problem.method.keepsDomains || body.seeds;
    }
}

/// Refuses particles wider than a cell, in which gimp does not find all nodes that they overlap.
template <int D>
void refuseWide(const Level& level, const Body& body) {
  constexpr double widest = 1 + 1e-9;
  for (const auto& [cell, seeds] : *body.seeds)
    for (const Seed& seed : seeds) {
      const Vec<D> extent = extentOf<D>(level, seed);
      for (int d = 0; d < D; ++d)
        if (extent[d] > widest)
          throw InputError({{body.where, "geom_object",
                             fmt::format("the particle at ({:g}, {:g}, {:g}) m is {:.3g} cells wide along {}, but with "
                                         "<interpolator> gimp at most one cell is possible; cpdi has no such limit",
                                         seed.at[0], seed.at[1], seed.at[2], extent[d], "xyz"[level.axis(d)])}});
    }
}

void refuseWideParticles(const Level& level, const std::vector<Material>& materials) {
  for (const Material& material : materials)
    for (const Body& body : material.bodies) {
      if (!body.seeds) continue;
      if (level.dimension() == 1) refuseWide<1>(level, body);
      if (level.dimension() == 2) refuseWide<2>(level, body);
      if (level.dimension() == 3) refuseWide<3>(level, body);
    }
}

/// Refuses listed sizes around an axis: a particle there is a ring, whose volume per radian depends on its radius.
void refuseSizesAroundAxis(const Problem& problem) {
  for (const Material& material : problem.materials)
    for (const Body& body : material.bodies)
      if (body.list && !(body.list->volume.empty() && body.list->edges.empty()))
        throw InputError(
            {{body.where, "geom_object",
              "p.volume, p.rvec1, p.rvec2 and p.rvec3 are not available with axisymmetric; <res> gives the "
              "size of the particles"}});
}

}  // namespace

void settleParticles(const Level& level, Problem& problem, bool isGimp) {
  if (problem.start.axisymmetric) refuseSizesAroundAxis(problem);
  for (Material& material : problem.materials) {
    for (Body& body : material.bodies) body.fillsDepth = problem.surroundings != nullptr;
    placeParticles(level, material.bodies);
  }
  if (isGimp) refuseWideParticles(level, problem.materials);
  countParticles(level, problem.materials, problem.start.loads.surfaces);
  settleSizes(problem);
  problem.notes = notesOnBodies(level, problem);
  double widths = 0, axes = 0;
  for (int axis = 0; axis < 3; ++axis) {
    widths += level.cellWidth(axis);
    axes += level.cellWidth(axis) > 0;
  }
  problem.method.meanWidth = widths / axes;
  for (const Material& material : problem.materials)
    for (int d = 0; d < level.dimension(); ++d)
      problem.method.nonlocalLayers =
          std::max(problem.method.nonlocalLayers,
                   static_cast<int>(std::ceil(material.model->nonlocalLength() / level.spacing(d))));
  for (int material = 0; material < static_cast<int>(problem.materials.size()); ++material)
    for (int d = 0; d < level.dimension(); ++d)
      for (const int side : {0, 1}) {
        const auto given = level.boundary(d, side, boundary::temperature, material);
        problem.method.givesTemperatures |= given && given->isDirichlet();
      }
  problem.method.isThin = {true, true, true};
  for (int d = 0; d < level.dimension(); ++d) problem.method.isThin[level.axis(d)] = false;
}

void nameMaterials(std::vector<Material>& materials) {
  std::set<std::string> names;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    materials[m].index = static_cast<int>(m);
    if (materials[m].name.empty()) materials[m].name = "material" + std::to_string(m);
    if (!names.insert(materials[m].name).second) names.insert(materials[m].name += "." + std::to_string(m));
  }
}

namespace {

/// Whether a side of the grid has a given temperature for a material.
bool hasGivenTemperature(const Element& root, std::size_t material) {
  const auto conditions = simulation::boundaryConditions(root);
  return std::any_of(conditions.begin(), conditions.end(), [&](const Element& condition) {
    const std::string id = condition.attribute("id").value_or("all");
    return condition.attribute("label") == boundary::temperature.name &&
           condition.attribute("var") == nameOf(grid::BoundaryKind::dirichlet) &&
           (id == "all" || id == std::to_string(material));
  });
}

}  // namespace

void checkHeat(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  const bool sharesHeat = problem.method.conductsHeat && problem.method.thermalContact;
  const auto tags = root.child("MaterialProperties")->child("MPM")->children("material");
  for (std::size_t m = 0; m < tags.size(); ++m) {
    const Material& material = problem.materials[m];
    if (material.specificHeat > 0) continue;
    if (problem.method.conductsHeat && hasGivenTemperature(root, m))
      diagnostics.error(tags[m], "missing tag <specific_heat>: a side of the grid has a given Temperature");
    if (material.model->changesTemperature())
      diagnostics.error(tags[m], "missing tag <specific_heat>: " + std::string(material.model->name()) +
                                     " is heated by plastic work");
    else if (material.thermalConductivity > 0 || sharesHeat)
      diagnostics.error(tags[m], "missing tag <specific_heat>: it conducts heat");
  }
}

void refuseHeatFlows(const Problem& problem, const Element& root, Diagnostics& diagnostics) {
  for (const Element& condition : simulation::boundaryConditions(root)) {
    if (condition.attribute("label") != boundary::temperature.name ||
        condition.attribute("var") != nameOf(grid::BoundaryKind::neumann))
      continue;
    const std::string id = condition.attribute("id").value_or("all");
    const auto value = condition.child("value");
    if (id != "all" && input::parse<int>(id).value >= static_cast<int>(problem.materials.size())) continue;  // a gas
    if (value && input::parse<double>(value->text()).value != 0.0)
      diagnostics.error(condition, "value: found '" + std::string(value->text()) +
                                       "'; solids take Neumann for Temperature only with 0, which insulates the side; "
                                       "<heat_flux> in <PhysicalBC> supplies heat");
  }
}

void refuseCellsAround(const Level& level, const Location& where) {
  if (level.dimension() == 3)
    throw InputError(
        {{where, "MPM/axisymmetric", "x is the radius and y the axis: give z one cell between symmetry planes"}});
}

int nodesBeyond(const Element& root) {
  const auto mpm = root.child("MPM");
  const auto interpolator = mpm ? mpm->child("interpolator") : std::nullopt;
  return interpolator && interpolator->text() != "linear" ? 1 : 0;
}

}  // namespace tushar::mpm::solid
