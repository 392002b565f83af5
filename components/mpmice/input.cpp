#include "components/mpmice/input.hpp"

#include <fmt/format.h>

#include "components/ice/gas_input.hpp"
#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/constitutive/visco_scram.hpp"
#include "components/mpm/solid/explicit/input.hpp"
#include "components/mpm/solid/scene_input.hpp"
#include "components/mpmice/exchange_input.hpp"
#include "components/mpmice/mpmice.hpp"
#include "components/mpmice/open_sides.hpp"
#include "components/mpmice/wave_speeds.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::mpmice {

using input::Diagnostics;
using input::Element;

namespace {

/// The extent of a grid, and the widths of its cells [m].
struct GridWidths {
  Vec3 lower, upper, widths;
};
/// The grid of a scene; none if the scene does not give it as numbers, or if the grid has several levels.
std::optional<GridWidths> gridOf(const Element& root) {
  const auto grid = root.child("Grid");
  const auto levels = grid ? grid->children("Level") : std::vector<Element>();
  if (levels.size() != 1 || root.child("AMR")) return {};
  const std::optional<Element> level = levels.front();
  const auto box = level->child("Box");
  const auto vectorOf = [](const std::optional<Element>& of, const char* name) -> std::optional<Vec3> {
    const auto tag = of ? of->child(name) : std::nullopt;
    return tag ? input::parse<Vec3>(tag->text()).value : std::nullopt;
  };
  const auto lower = vectorOf(box, "lower"), upper = vectorOf(box, "upper"), cells = vectorOf(box, "resolution");
  if (!lower || !upper) return {};
  if (const auto spacing = vectorOf(level, "spacing")) return GridWidths{*lower, *upper, *spacing};
  if (!cells) return {};
  return GridWidths{*lower, *upper, (*upper - *lower).cwiseQuotient(*cells)};
}

/// Notes bodies of a single shape that are so thin along an axis that gas leaks through them.
void noteThinBodies(const std::vector<mpm::solid::Material>& materials, const Element& root, Diagnostics& diagnostics) {
  constexpr double leastCells = 1.25;
  const auto grid = gridOf(root);
  if (!grid) return;
  for (const mpm::solid::Material& material : materials) {
    if (material.bodies.size() != 1) continue;
    const mpm::solid::Body& body = material.bodies.front();
    if (body.list) continue;  // the widths of its particles are not known yet
    const auto bounds = body.shape->bounds();
    for (int axis = 0; axis < 3; ++axis) {
      if (bounds.min[axis] <= grid->lower[axis] && bounds.max[axis] >= grid->upper[axis]) continue;
      const double cells = (bounds.max[axis] - bounds.min[axis]) / grid->widths[axis];
      if (!(cells > 0 && cells < leastCells * (1 - 1e-9))) continue;
      diagnostics.note(body.where, "MaterialProperties/MPM/material/geom_object",
                       fmt::format("is only {:.2g} times as thick as a cell along {}: gas leaks through bodies thinner "
                                   "than {:g} cells; to prevent this, set <thin_walls> of <ICE> to true, or refine the "
                                   "grid",
                                   cells, "xyz"[axis], leastCells));
    }
  }
}

/// Tells of contacts in which bodies stay together under compression: in a gas, they may part.
void noteContacts(const Element& root, Diagnostics& diagnostics) {
  for (const Element& contact : root.child("MaterialProperties")->child("MPM")->children("contact")) {
    const auto type = contact.child("type");
    const std::string kind = type ? std::string(type->text()) : "";
    if (kind == "friction" || kind == "friction_bard" || kind == "friction_conserving")
      diagnostics.note(*type, fmt::format("'{}' lets bodies part under compression, like 'approach': in a gas, its "
                                          "pressure compresses surfaces that do not touch",
                                          kind));
  }
}

/// Refuses settings that would give a burning surface a wrong area or pressure.
void checkBurning(const ice::GasScene& scene, const Element& root, Diagnostics& diagnostics) {
  if (scene.burns.size() > 1)
    diagnostics.error(scene.burns[1].where, "Models/Model",
                      "only one body of a scene can burn; remove the other burn models");
  const Element gas = *root.child("CFD")->child("ICE");
  if (scene.thinWalls.value_or(false))
    diagnostics.error(*gas.child("thin_walls"), "is not available with a burning body: remove it");
}

/// The index of a material among those of its kind. Reports a name that does not exist there.
std::size_t placeOf(const std::string& name, const std::vector<std::string>& names,
                    const std::vector<std::string>& others, const char* kind, const char* otherKind,
                    const std::function<void(const std::string&)>& refuse) {
  const auto is = [&](const std::string& one) { return one == name; };
  if (std::none_of(names.begin(), names.end(), is))
    refuse(std::any_of(others.begin(), others.end(), is)
               ? fmt::format("found '{}', which is a {}, expected a {}", name, otherKind, kind)
           : std::any_of(names.begin(), names.end(), [](const std::string& one) { return !one.empty(); })
               ? input::choiceProblem(name, names)
               : fmt::format("found '{}', but no {} has a name", name, kind));
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Checks a body that burns by DDT1, at its surface or also in its cracks.
void checkDdt(const Element& body, bool areRigid, const ice::BurnModel& model, Diagnostics& diagnostics) {
  const auto given = body.child("constitutive_model");
  const std::string name = given ? given->attribute("type").value_or("") : "";
  if (model.ddt()->burnsCracks && name != mpm::solid::ViscoScram::name)
    diagnostics.error(given.value_or(body),
                      fmt::format("found '{}', but useCrackModel needs a body of visco_scram, which has cracks", name));
  if (areRigid)
    diagnostics.error(model.where, "Models/Model/DDT1",
                      "is not available with rmpmice, whose bodies have no stress; use mpmice");
}

/// The burning body, if there is one.
std::optional<Burning> burningOf(const ice::GasScene& scene, bool areRigid, const Element& root,
                                 Diagnostics& diagnostics) {
  if (scene.burns.empty()) return {};
  checkBurning(scene, root, diagnostics);
  const ice::BurnModel& model = scene.burns.front();
  Burning burning{model};
  const auto refuse = [&](const char* tag) {
    return [&diagnostics, &model, tag](const std::string& sentence) {
      diagnostics.error(model.where, fmt::format("Models/Model/{}", tag), sentence);
    };
  };
  std::vector<std::string> bodies, gases;
  const std::vector<Element> materials = root.child("MaterialProperties")->child("MPM")->children("material");
  for (const Element& material : materials) bodies.push_back(material.attribute("name").value_or(""));
  for (const euler::Settings& gas : scene.mixture) gases.push_back(gas.name);
  if (gases.empty()) gases.push_back(scene.gas.name);
  burning.body = placeOf(model.from, bodies, gases, "body", "gas", refuse("fromMaterial"));
  burning.gas = placeOf(model.to, gases, bodies, "gas", "body", refuse("toMaterial"));
  if (burning.body < materials.size() && !materials[burning.body].child("specific_heat"))
    diagnostics.error(materials[burning.body],
                      "missing tag <specific_heat>: the body burns, and its heat is added to the gas");
  if (burning.body < materials.size() && model.ddt()) checkDdt(materials[burning.body], areRigid, model, diagnostics);
  return burning;
}

int countSolids(const Element& root) {
  const auto properties = root.child("MaterialProperties");
  const auto solids = properties ? properties->child("MPM") : std::nullopt;
  return solids ? static_cast<int>(solids->children("material").size()) : 0;
}

/// Refuses settings that are not available for a gas with bodies.
void checkGas(const ice::GasScene& scene, const Element& root, Diagnostics& diagnostics) {
  const auto mpm = root.child("MPM");
  if (const auto radial = mpm ? mpm->child("axisymmetric") : std::nullopt; radial && radial->text() == "true")
    diagnostics.error(*radial, "is not available with a gas, whose grid is Cartesian");
  if (scene.gas.courant.number > greatestCfl)
    diagnostics.error(*root.child("CFD")->child("cfl"),
                      fmt::format("found {:g}, expected at most {:g} with bodies, since they may half fill a cell",
                                  scene.gas.courant.number, greatestCfl));
}

/// Notes that conditions on a part of a side apply only to the gas, and that those of the whole side apply to bodies.
void noteConditionsOfBodies(const Element& root, int solids, Diagnostics& diagnostics) {
  const auto grid = root.child("Grid");
  const auto group = grid ? grid->child("BoundaryConditions") : std::nullopt;
  for (const Element& face : group ? group->children("Face") : std::vector<Element>{}) {
    if (face.attribute("side")) continue;
    for (const Element& condition : face.children("BCType")) {
      const std::string label = condition.attribute("label").value_or("");
      const bool isOfGas = label == euler::boundary::density.name || label == euler::boundary::pressure.name;
      const int material = input::parse<int>(condition.attribute("id").value_or("all")).value.value_or(-1);
      if (isOfGas || material >= solids || condition.attribute("var") == nameOf(BoundaryKind::neumann)) continue;
      diagnostics.note(condition, "applies only to the gas: bodies have the conditions of the whole side");
    }
  }
}

/// Refuses velocities of bodies that oscillate at a side.
void refuseOscillatingBodies(const Element& root, int solids, Diagnostics& diagnostics) {
  for (const Element& condition : simulation::boundaryConditions(root)) {
    const int material = input::parse<int>(condition.attribute("id").value_or("all")).value.value_or(-1);
    if (condition.attribute("var") != "Sine" || condition.attribute("label") != euler::boundary::velocity.name)
      continue;
    if (material < solids)
      diagnostics.error(condition, fmt::format("var Sine is not available for the Velocity of bodies; give the gas "
                                               "alone a Velocity, with id {}",
                                               solids));
  }
}

/// Refuses scalars of tracers that have the name of a variable of bodies: both would be one variable.
void refuseNamesOfBodies(const ice::GasScene& scene, Diagnostics& diagnostics) {
  if (!scene.tracers) return;
  namespace body = mpm::solid::p;
  const std::vector<std::string_view> taken{body::mass.name,
                                            body::volume.name,
                                            body::temperature.name,
                                            body::temperatureChange.name,
                                            body::damage.name,
                                            body::failureThreshold.name,
                                            body::localized.name,
                                            body::failureTime.name,
                                            body::color.name,
                                            body::surface.name,
                                            body::viscosity.name,
                                            body::strainEnergy.name,
                                            body::stress.name,
                                            body::deformationMeasure.name,
                                            body::velocityGradient.name,
                                            body::size<3>.name,
                                            body::externalForce<3>.name,
                                            p::boxEdges<3>.name,
                                            p::unburned.name};
  for (const ice::TracerScalarSettings& one : scene.tracers->scalars)
    for (const std::string_view name : taken)
      if (ice::particleName(one.name) == name)
        diagnostics.error(one.where, "Models/Model",
                          fmt::format("the name '{}' is given twice: bodies have a variable {}", one.name, name));
}

template <int D>
std::unique_ptr<Component> makeWithGas(const Level& level, Settings settings,
                                       const mpm::solid::MakeSurrounded& makeSolids) {
  lookAtSides<D>(level, settings);
  auto gas = std::make_shared<const GasAround<D>>(settings);
  std::unique_ptr<mpm::solid::Solids> solids = makeSolids(level, settings.areRigid, gas);
  return std::make_unique<MpmIce<D>>(std::move(gas), std::move(solids));
}

/// Whether steps are explicit although the scene has an <ImplicitSolver>, because waves in bodies limit them to much
/// less than sound in the gas does. If so, adds a note. Implicit steps are kept if <ImplicitSolver> has a <Solver>, a
/// tag of Tushar.
bool needsNoImplicitSteps(const ice::GasScene& scene, const std::vector<mpm::solid::Material>& materials,
                          const Element& root, Diagnostics& diagnostics) {
  const Element section = *root.child("CFD")->child("ICE")->child("ImplicitSolver");
  if (section.child("Solver") || !areBodiesMuchFaster(materials, scene.gas)) return false;
  diagnostics.note(section, fmt::format("does nothing: steps are explicit, since waves in bodies, at {:.3g} m/s, limit "
                                        "them more than sound in the gas does; add a <Solver> for implicit steps",
                                        fastestInBodies(materials)));
  return true;
}

simulation::MakeComponent readScene(const Element& root, bool areRigid, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const int solids = countSolids(root);
  const ice::GasScene scene = ice::readGas(root, solids, diagnostics);
  for (const ice::ScalarSettings& one : scene.scalars)
    if (one.diffusivity > 0)
      diagnostics.error(one.where, "Models/Model",
                        fmt::format("{:g} m^2/s is not available with bodies: next to them, scalars are transported, "
                                    "but do not diffuse; set it to 0",
                                    one.diffusivity));
  if (!scene.massExchanges.empty())
    diagnostics.error(scene.massExchanges.front().where, "Models/Model",
                      "is not available with bodies; remove it, or keep only the gas");
  const mpm::solid::SurroundedSolids bodies = mpm::solid::readSurrounded(root, diagnostics);
  if (diagnostics.size() > before || !bodies.make) return {};
  Settings settings{scene.gas, scene.referencePressure, scene.gravity, {}, scene.thinWalls.value_or(false), areRigid};
  settings.diffusion = {scene.varying, scene.diffusions};
  settings.heating = scene.heating;
  settings.scalars = scene.scalars;
  settings.tracers = scene.tracers;
  settings.gases = scene.mixture;
  settings.reactions = ice::reactionsOf(scene);
  if (scene.implicit && (areRigid || !needsNoImplicitSteps(scene, bodies.materials, root, diagnostics)))
    settings.implicit = {.diffusion = scene.varying.varies() ? euler::Diffusion() : scene.varying.uniform,
                         .gravity = scene.gravity,
                         .soundSpeedKnob = scene.implicit->soundSpeedKnob,
                         .solver = scene.implicit->solver};
  if (!settings.implicit) ice::letPressureRise(scene, settings.gas, settings.gases);
  if (scene.exchange) readExchange(scene, solids, root, settings, diagnostics);
  settings.burning = burningOf(scene, areRigid, root, diagnostics);
  checkGas(scene, root, diagnostics);
  noteConditionsOfBodies(root, solids, diagnostics);
  refuseOscillatingBodies(root, solids, diagnostics);
  refuseNamesOfBodies(scene, diagnostics);
  noteContacts(root, diagnostics);
  if (!settings.thinWalls) noteThinBodies(bodies.materials, root, diagnostics);
  if (diagnostics.size() > before) return {};
  return [settings, make = bodies.make,
          check = ice::checkOfAxes(root, scene)](const Level& level) -> std::unique_ptr<Component> {
    check(level);
    if (level.dimension() == 1) return makeWithGas<1>(level, settings, make);
    if (level.dimension() == 2) return makeWithGas<2>(level, settings, make);
    return makeWithGas<3>(level, settings, make);
  };
}

}  // namespace

simulation::ComponentKind kind(bool areRigid) {
  simulation::ComponentKind kind;
  kind.name = areRigid ? "rmpmice" : "mpmice";
  kind.sentence = areRigid ? "a compressible gas around bodies of particles that keep their velocities"
                           : "a compressible gas that interacts with bodies of particles";
  kind.sections = ice::gasSections();
  kind.sections.insert(kind.sections.end(), {"MPM", "PhysicalBC"});
  kind.takesLevels = true;
  kind.refinesByItself = true;  // the finest level follows bodies
  kind.amrSections = {"ICE", "MPM", "MPMICE"};
  kind.readFirst = {"MaterialProperties/MPM"};  // as in Uintah
  kind.boundaryLabels = {grid::symmetric, euler::boundary::density, euler::boundary::pressure,
                         mpm::boundary::velocity.evenOnPlanes(), mpm::boundary::temperature.evenOnPlanes()};
  for (const char* name : ice::scalarsAtSides) kind.boundaryLabels.push_back(BoundaryLabel<double>(name));
  kind.conditionWords = ice::gasConditionWords();
  kind.takesPartsOfSides = true;
  kind.describe = [](std::ostream& out) {
    ice::describeGas(out);
    out << "For bodies, instead:\n";
    mpm::solid::describe(out);
  };
  kind.nodesBeyond = mpm::solid::nodesBeyond;
  kind.cellsOfBlocks = [](const input::Element&) { return 6; };
  kind.read = [areRigid](const Element& root, Diagnostics& diagnostics) {
    return readScene(root, areRigid, diagnostics);
  };
  return kind;
}

}  // namespace tushar::mpmice
