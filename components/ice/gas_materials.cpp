#include "components/ice/gas_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/euler/blend.hpp"
#include "components/euler/labels.hpp"
#include "components/ice/mixture/input.hpp"
#include "components/ice/uintah_words.hpp"

namespace tushar::ice {

using input::Diagnostics;
using input::Element;

namespace {

/// If a given pressure differs from the one that follows from density and temperature, notes that it is ignored, as in
/// Uintah.
void noteOtherPressure(const GasBody& body, const euler::Gas& gas, const Element& element, Diagnostics& diagnostics) {
  if (!body.pressure) return;
  if (!body.pressure->isConstant() || !body.density.isConstant() || !body.temperature.isConstant()) return;
  const double given = (*body.pressure)(Vec3::Zero());
  const double density = body.density(Vec3::Zero());
  const double pressure = gas.pressureOf(density, gas.lastAt(density, body.temperature(Vec3::Zero())));
  if (std::abs(given - pressure) > 1e-3 * pressure)
    diagnostics.note(
        *element.child("pressure"),
        fmt::format("does nothing: the pressure follows from density and temperature, and is {:g} Pa", pressure));
}

/// The Dirichlet condition of a face that applies to the gas, if there is one; for the pressure, this may be the
/// condition of material 0.
std::optional<Element> dirichletOf(const Element& face, const grid::BoundaryVariable& label, int gas) {
  const bool isShared = label.name == euler::boundary::pressure.name;
  for (const Element& condition : face.children("BCType")) {
    const int material = materialOf(condition);
    if (condition.attribute("label") == label.name && condition.attribute("var") == nameOf(BoundaryKind::dirichlet) &&
        (material < 0 || material == gas || (isShared && material == 0)))
      return condition;
  }
  return {};
}

/// Checks that density, pressure and temperature agree at faces where all three are given, since two determine the
/// third.
void checkInflows(const Element& root, const euler::Gas& gas, Diagnostics& diagnostics) {
  const auto sides = root.child("Grid") ? root.child("Grid")->child("BoundaryConditions") : std::nullopt;
  if (!sides) return;
  const auto valueOf = [](const Element& condition) -> std::optional<double> {
    const auto text = condition.child("value");
    return text ? input::parse<double>(text->text()).value : std::nullopt;
  };
  for (const Element& face : sides->children("Face")) {
    const auto density = dirichletOf(face, euler::boundary::density, gas.material),
               pressure = dirichletOf(face, euler::boundary::pressure, gas.material),
               temperature = dirichletOf(face, euler::boundary::temperature, gas.material);
    if (!density || !pressure || !temperature) continue;
    const auto rho = valueOf(*density), p = valueOf(*pressure), t = valueOf(*temperature);
    if (!rho || !p || !t) {
      diagnostics.error(*temperature,
                        "the temperature already follows from Density and Pressure; keep two of the three");
      continue;
    }
    if (gas.isBarotropic()) continue;  // any temperature fits
    const double fitting = gas.temperature(*rho, gas.energyOf(*rho, *p));
    if (std::abs(*t - fitting) <= 1e-3 * fitting) continue;
    if (std::abs(*t - fitting) <= 1e-2 * fitting)  // rounded, or changed a little in one of them
      diagnostics.note(
          *temperature,
          fmt::format("does nothing: the temperature follows from Density and Pressure, and is {:g} K", fitting));
    else
      diagnostics.error(*temperature,
                        fmt::format("found {:g} K, but the Density, at {}, and the Pressure, at {}, give {:g} K; keep "
                                    "two of the three",
                                    *t, density->where().text(), pressure->where().text(), fitting));
  }
}

/// Whether a volume fraction is a constant with the given value.
bool isShareOf(const GasBody& body, double share) {
  return body.share && body.share->isConstant() && (*body.share)(Vec3::Zero()) == share;
}

/// Reads a gas and its initial state into the settings that it shares with other gases. With `besideBodies`, a region
/// in which the only gas has the volume fraction 0 belongs to a body; if the body does not fill it, the surrounding gas
/// does.
void readMaterial(const GasMaterial& material, const Element& element, bool besideBodies, euler::Settings& settings,
                  Diagnostics& diagnostics) {
  settings.name = material.name;
  if (material.state.hasGamma() && !(material.gamma > 1))
    diagnostics.error(*element.child("gamma"),
                      input::violation(element.child("gamma")->text(), input::greaterThan(1), "1"));
  euler::Gas& gas = settings.gas;
  takeLaw(material, gas);
  const auto tags = element.children("geom_object");
  for (std::size_t k = 0; k < material.bodies.size(); ++k) {
    const GasBody& body = material.bodies[k];
    if (besideBodies && isShareOf(body, 0)) continue;
    settings.objects.push_back({.where = body.where,
                                .shape = body.shape,
                                .density = body.density,
                                .pressure = {},
                                .velocity = body.velocity,
                                .temperature = body.temperature,
                                .share = body.share,
                                .points = body.points});
    if (k < tags.size()) noteOtherPressure(body, gas, tags[k], diagnostics);
  }
}

/// Checks that a single gas fills its regions; beside bodies, it may also leave a region to them.
void checkShares(const GasMaterial& material, bool besideBodies, Diagnostics& diagnostics) {
  for (const GasBody& body : material.bodies)
    if (body.share && !isShareOf(body, 1) && !(besideBodies && isShareOf(body, 0)))
      diagnostics.error(body.share->where(), "MaterialProperties/ICE/material/geom_object/volumeFraction",
                        fmt::format("found '{}', expected 1: a single gas fills the region", body.share->text()));
}

/// The diffusion of a gas, including the eddies of the scene.
euler::VaryingDiffusion varyingOf(const GasMaterial& material, const GasScene& scene) {
  euler::VaryingDiffusion varying = material.varying;
  varying.uniform = {material.viscosity, material.conductivity};
  varying.smagorinsky = scene.varying.smagorinsky;
  return varying;
}

void readOneGas(const GasMaterial& material, const Element& element, GasScene& scene, Diagnostics& diagnostics) {
  scene.specificHeat = material.specificHeat;
  scene.viscosity = material.viscosity;
  scene.conductivity = material.conductivity;
  scene.varying = varyingOf(material, scene);
  const bool besideBodies = scene.gas.gas.material > 0;  // which are numbered before it
  readMaterial(material, element, besideBodies, scene.gas, diagnostics);
  checkShares(material, besideBodies, diagnostics);
  if (scene.implicit && scene.gas.gas.isBarotropic())
    diagnostics.error(scene.implicit->where, "CFD/ICE/ImplicitSolver",
                      "is not available with JWLC or Murnaghan, whose pressure does not depend on the energy: remove "
                      "it, or run with --set CFD/ICE/explicit=true");
}

/// Whether another gas becomes the gas with this name, which then need not be anywhere at the start.
bool isMade(const std::string& name, const GasScene& scene) {
  const auto makesIt = [&](const auto& one) { return one.to == name; };
  return std::any_of(scene.reactions.begin(), scene.reactions.end(), makesIt) ||
         std::any_of(scene.programs.begin(), scene.programs.end(), makesIt);
}

/// Whether one of several gases is neither ideal nor stiffened.
bool haveOwnLaws(const std::vector<GasMaterial>& materials) {
  return std::any_of(materials.begin(), materials.end(), [](const GasMaterial& one) { return one.law() != nullptr; });
}

void readGases(const std::vector<GasMaterial>& materials, const Element& root, GasScene& scene,
               Diagnostics& diagnostics) {
  const auto elements = root.child("MaterialProperties")->child("ICE")->children("material");
  for (std::size_t k = 0; k < materials.size(); ++k) {
    euler::Settings settings = scene.gas;
    settings.where = elements[k].where();
    settings.gas.material += static_cast<int>(k);
    readMaterial(materials[k], elements[k], false, settings, diagnostics);
    if (settings.name.empty()) settings.name = fmt::format("gas{}", k);
    settings.objectsMayBeEmpty = isMade(settings.name, scene);
    scene.mixture.push_back(settings);
    scene.diffusions.push_back({materials[k].viscosity, materials[k].conductivity});
  }
  if (haveOwnLaws(materials)) {
    std::vector<euler::Gas> gases;
    for (const euler::Settings& one : scene.mixture) gases.push_back(one.gas);
    const auto laws = std::make_shared<const euler::BlendLaws>(gases);
    for (euler::Settings& one : scene.mixture) one.blend = laws;
  }
  checkMixture(materials, root, scene, scene.gas.gas.material, diagnostics);
}

/// Notes the properties of a gas that have no effect because it is a mixture of two, except those that agree with the
/// first of the two, which fills the space outside the regions of the other.
void noteOwnProperties(const GasMaterial& material, const Element& element, const BinaryGas& first,
                       Diagnostics& diagnostics) {
  const auto note = [&](const Element& of, const char* tag, double value, double ofFirst) {
    const auto given = of.child(tag);
    if (given && std::abs(value - ofFirst) > 1e-3 * std::abs(ofFirst))
      diagnostics.note(*given, "does nothing: it follows from the <constants> of BinaryProperties");
  };
  note(element, "gamma", material.gamma, 1 + first.gasConstant / first.specificHeat);
  note(element, "specific_heat", material.specificHeat, first.specificHeat);
  note(element, "dynamic_viscosity", material.viscosity, first.viscosity);
  note(element, "thermal_conductivity", material.conductivity, first.conductivity);
  const auto tags = element.children("geom_object");
  for (std::size_t k = 0; k < material.bodies.size() && k < tags.size(); ++k) {
    const input::Expression& density = material.bodies[k].density;
    const double never = std::numeric_limits<double>::infinity();  // a formula agrees with no number
    note(tags[k], "density", density.isConstant() ? density(Vec3::Zero()) : never, first.density);
  }
}

/// A gas with the properties of the first of the two gases of which it is a mixture.
GasMaterial firstOf(GasMaterial material, const BinaryGas& first) {
  material.gamma = 1 + first.gasConstant / first.specificHeat;
  material.specificHeat = first.specificHeat;
  for (GasBody& body : material.bodies) body.density = input::Expression(first.density);
  return material;
}

/// Reads a gas of the scene that is a mixture of two.
void readBinary(const GasMaterial& material, const Element& root, GasScene& scene, Diagnostics& diagnostics) {
  const Element element = *root.child("MaterialProperties")->child("ICE")->child("material");
  const BinaryProperties& binary = *scene.binary;
  if (!binary.material.empty() && binary.material != material.name)
    diagnostics.error(
        binary.where, "Models/Model",
        fmt::format("material: found '{}', expected '{}', the name of the gas", binary.material, material.name));
  if (material.state.kind != EquationOfState::Kind::ideal)
    diagnostics.error(*element.child("EOS"), "with BinaryProperties the gas is of type ideal_gas");
  euler::Settings common = scene.gas;
  common.where = element.where();
  noteOwnProperties(material, element, binary.a, diagnostics);
  readMaterial(firstOf(material, binary.a), element, false, common, diagnostics);
  checkShares(material, false, diagnostics);
  scene.gas.name = material.name;
  scene.mixture = binary.gases(common);
  scene.diffusions = binary.diffusions();
  if (!scene.heating.perMass.empty()) scene.heating.perMass.assign(2, scene.heating.perMass.front());
  if (scene.exchange)
    diagnostics.note(scene.exchange->where, exchangePath,
                     "does nothing: the two gases of BinaryProperties have one velocity and one temperature");
  constexpr double atOnce = 1e30;  // W/(m³ K)
  scene.exchange = Exchange{.where = binary.where, .momentum = {}, .heat = {atOnce}};
  checkMixture({material}, root, scene, scene.gas.gas.material, diagnostics);
}

/// Where a scene converts gases into others.
std::vector<const Location*> conversions(const GasScene& scene) {
  std::vector<const Location*> places;
  for (const MassExchange& one : scene.massExchanges) places.push_back(&one.where);
  for (const ProgrammedBurn& one : scene.programs) places.push_back(&one.where);
  for (const PressureBurn& one : scene.reactions) places.push_back(&one.where);
  return places;
}

}  // namespace

std::shared_ptr<const euler::Gas::Law> GasMaterial::law() const {
  if (!air) return state.law(specificHeat, gamma);
  return std::make_shared<const euler::Gas::Law>(
      euler::RealGas({.gasConstant = air->gasConstant.value_or((gamma - 1) * specificHeat),
                      .specificHeat = specificHeat,
                      .isAir = true}));
}

int materialOf(const Element& condition) {
  return input::parse<int>(condition.attribute("id").value_or("all")).value.value_or(-1);
}

void takeLaw(const GasMaterial& material, euler::Gas& gas) {
  gas.gamma = material.gamma;
  gas.specificHeat = material.specificHeat;
  gas.pInfinity = material.state.pInfinity;
  gas.law = material.law();
}

void readMaterials(const std::vector<GasMaterial>& materials, const Element& root, int solids, GasScene& scene,
                   Diagnostics& diagnostics) {
  if (solids > 0 && !scene.programs.empty())
    diagnostics.error(scene.programs.front().where, "Models/Model",
                      "LightTime is not available with bodies; remove it");
  if (scene.binary && (materials.size() > 1 || solids > 0))
    return diagnostics.error(scene.binary->where, "Models/Model",
                             "BinaryProperties is not available with bodies or a second gas: give each gas a "
                             "<material>");
  if (scene.binary) return readBinary(materials.front(), root, scene, diagnostics);
  if (materials.size() > 1) return readGases(materials, root, scene, diagnostics);
  for (const Location* one : conversions(scene))
    diagnostics.error(*one, "Models/Model", "there is one gas, which cannot become another");
  readOneGas(materials.front(), *root.child("MaterialProperties")->child("ICE")->child("material"), scene, diagnostics);
  checkInflows(root, scene.gas.gas, diagnostics);
}

}  // namespace tushar::ice
