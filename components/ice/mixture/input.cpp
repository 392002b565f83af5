#include "components/ice/mixture/input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "components/euler/labels.hpp"

namespace tushar::ice {

using input::Diagnostics;
using input::Element;

namespace {

/// Uintah's exchange coefficients of at least this value are taken to mean that the gases share one velocity or one
/// temperature.
constexpr double oneForAll = 1e9;

/// Uintah's names of the mass fraction in BinaryProperties.
constexpr std::array<std::string_view, 2> fractionLabels{"scalar-f", "scalar-f_CC"};

void checkSubstance(const GasMaterial& material, const Element& element, Diagnostics& diagnostics) {
  const auto kind = material.state.kind;
  if (kind == EquationOfState::Kind::tst)
    diagnostics.error(*element.child("EOS"),
                      "is not available with a second gas: several gases must be of type ideal_gas, stiffened_gas, "
                      "JWL, JWLC, Murnaghan, Gruneisen, Thomsen_Hartka_water or hard_sphere_gas");
  if (material.air)
    diagnostics.error(*element.child("SpecificHeatModel"),
                      "is not available with a second gas: remove it, or keep one gas");
  if (material.varying.varies())
    diagnostics.error(*element.child("dynamicViscosityModels"),
                      "is not available with a second gas: give <dynamic_viscosity>, or keep one gas");
}

/// Checks that there is a coefficient for each pair of materials, and that each pair of gases has one velocity.
void checkExchange(const GasScene& scene, const Element& root, int solids, Diagnostics& diagnostics) {
  if (!scene.exchange) return;
  const Element tag = *root.child("MaterialProperties")->child("exchange_properties")->child("exchange_coefficients");
  const std::size_t gases = scene.mixture.size(), count = gases + solids, pairs = count * (count - 1) / 2;
  for (const auto& [name, given] :
       {std::pair("momentum", &scene.exchange->momentum), std::pair("heat", &scene.exchange->heat)})
    if (!given->empty() && given->size() != pairs && !(given == &scene.exchange->heat && scene.exchange->heatByMasses))
      diagnostics.error(tag.child(name).value_or(tag),
                        fmt::format("found {} numbers, expected {}: one for each pair of {} {}", given->size(), pairs,
                                    count, solids > 0 ? "materials" : "gases"));
  const std::vector<double>& momentum = scene.exchange->momentum;
  if (momentum.size() != pairs) return;
  const std::size_t ofGases = pairs - gases * (gases - 1) / 2;  // the first: pairs come row by row, bodies first
  for (std::size_t pair = ofGases; pair < momentum.size(); ++pair)
    if (momentum[pair] < oneForAll)
      return diagnostics.error(tag.child("momentum").value_or(tag),
                               fmt::format("{:g} between gases is not available: gases share one velocity, so the "
                                           "value is expected to be 1e9 or more",
                                           momentum[pair]));
}

/// Checks what is not available if a gas has its own equation of state. The gases of a cell then have one temperature,
/// so the exchange of heat between them must be fast.
void checkBlend(const GasScene& scene, int solids, Diagnostics& diagnostics) {
  if (scene.implicit)
    diagnostics.error(scene.implicit->where, "CFD/ICE/ImplicitSolver",
                      "is not available if one of several gases is neither ideal nor stiffened: remove it, or run with "
                      "--set CFD/ICE/explicit=true");
  if (!scene.exchange || scene.exchange->heatByMasses) return;
  const std::size_t gases = scene.mixture.size(), count = gases + solids, pairs = count * (count - 1) / 2;
  const std::vector<double>& heat = scene.exchange->heat;
  if (heat.size() != pairs) return;
  for (std::size_t pair = pairs - gases * (gases - 1) / 2; pair < pairs; ++pair)
    if (heat[pair] < oneForAll)
      return diagnostics.error(
          scene.exchange->where, "MaterialProperties/exchange_properties/exchange_coefficients/heat",
          fmt::format("{:g} between gases is not available if one of them is neither ideal nor stiffened: the gases of "
                      "a cell then have one temperature, so the value is expected to be 1e9 or more",
                      heat[pair]));
}

/// The Dirichlet value of a variable at a face, if it has one.
std::optional<std::string> givenAt(const Element& face, const grid::BoundaryVariable& label) {
  for (const Element& condition : face.children("BCType"))
    if (condition.attribute("label") == label.name && condition.attribute("var") == nameOf(BoundaryKind::dirichlet))
      if (const auto value = condition.child("value")) return value->text();
  return {};
}

/// Whether a face is a wall: only a velocity parallel to the face is given.
bool isWall(const Element& face) {
  const auto given = givenAt(face, euler::boundary::velocity);
  if (!given || givenAt(face, euler::boundary::pressure) || givenAt(face, euler::boundary::density)) return false;
  const auto velocity = input::parse<Vec3>(*given).value;
  for (const char* shape : {"side", "circle", "annulus", "ellipse", "rectangle", "rectangulus"})
    if (const auto side = face.attribute(shape); side && velocity)
      return (*velocity)[std::string("xyz").find(side->front())] == 0;
  return false;
}

/// Reports a condition that does not apply to all gases; as in Uintah, the pressure may be given for the first
/// material.
void checkMaterial(const Element& condition, int solids, Diagnostics& diagnostics) {
  const std::string id = condition.attribute("id").value_or("all");
  const bool isPressure = condition.attribute("label") == euler::boundary::pressure.name;
  if (id == "all" || (isPressure && (id == "0" || id == fmt::format("{}", solids)))) return;
  diagnostics.error(condition.whereOf("id"), condition.path(),
                    fmt::format("found '{}', expected all: several gases have one velocity and one pressure", id));
}

void checkSide(const Element& face, const Element& condition, int solids, bool isBinary, Diagnostics& diagnostics) {
  const std::string label = condition.attribute("label").value_or(""), var = condition.attribute("var").value_or("");
  const bool isGiven = var == nameOf(BoundaryKind::dirichlet);
  const bool saysWhat = label == euler::boundary::density.name ||
                        (isBinary && (label == fractionLabels[0] || label == fractionLabels[1])) ||
                        (label == euler::boundary::temperature.name && !isWall(face));
  if (isGiven && saysWhat)
    diagnostics.error(condition,
                      "Dirichlet is not available with several gases: the gas that flows in has the composition of the "
                      "adjacent cells; give a Velocity or a Pressure, or Neumann");
  else if (var != nameOf(BoundaryKind::neumann) && var != euler::boundary::waves.name && !isBinary)
    checkMaterial(condition, solids, diagnostics);
}

/// Checks that the conditions of sides apply to all gases together: they may give velocity, pressure and the
/// temperature of walls, but no composition.
void checkSides(const Element& root, int solids, bool isBinary, Diagnostics& diagnostics) {
  const auto group = root.child("Grid") ? root.child("Grid")->child("BoundaryConditions") : std::nullopt;
  for (const Element& face : group ? group->children("Face") : std::vector<Element>())
    for (const Element& condition : face.children("BCType")) {
      const int material = input::parse<int>(condition.attribute("id").value_or("all")).value.value_or(-1);
      if (material < 0 || material >= solids) checkSide(face, condition, solids, isBinary, diagnostics);
    }
}

/// Checks that each exchange of mass names two different gases of the scene.
void checkExchangesOfMass(const GasScene& scene, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const euler::Settings& gas : scene.mixture) names.push_back(gas.name);
  const auto check = [&](const Location& where, const std::string& path, const std::string& from,
                         const std::string& to) {
    for (const std::string& name : {from, to})
      if (const std::string problem = input::choiceProblem(name, names); !problem.empty())
        diagnostics.error(where, path, problem);
    if (from == to) diagnostics.error(where, path, "a gas cannot become itself");
  };
  for (const MassExchange& one : scene.massExchanges) check(one.where, "Models/Model/Test", one.from, one.to);
  for (const PressureBurn& one : scene.reactions) check(one.where, "Models/Model/JWLpp", one.from, one.to);
  for (const ProgrammedBurn& one : scene.programs) check(one.where, "Models/Model/LightTime", one.from, one.to);
}

}  // namespace

void checkMixture(const std::vector<GasMaterial>& materials, const Element& root, const GasScene& scene, int solids,
                  Diagnostics& diagnostics) {
  const auto elements = root.child("MaterialProperties")->child("ICE")->children("material");
  std::set<std::string> names;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    checkSubstance(materials[k], elements[k], diagnostics);
    if (!scene.binary && !names.insert(scene.mixture[k].name).second)
      diagnostics.error(elements[k], fmt::format("the name '{}' is given twice", scene.mixture[k].name));
  }
  if (!scene.scalars.empty())
    diagnostics.error(scene.scalars.front().where, "Models/Model",
                      "is not available with several gases; remove it, or keep one gas");
  if (!scene.binary) checkExchange(scene, root, solids, diagnostics);
  if (scene.mixture.front().blend) checkBlend(scene, solids, diagnostics);
  checkExchangesOfMass(scene, diagnostics);
  checkSides(root, solids, scene.binary.has_value(), diagnostics);
}

}  // namespace tushar::ice
