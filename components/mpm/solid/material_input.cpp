#include "components/mpm/solid/material_input.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "components/mpm/solid/constitutive/all.hpp"
#include "components/mpm/solid/contact/contact_input.hpp"
#include "components/mpm/solid/damage/damage_input.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

/// Calls `visit` with a model of each type.
template <class Visit>
void forEachModel(Visit&& visit) {
  std::apply([&](const auto&... model) { (visit(model), ...); }, AllModels{});
}

/// A model's own tags, and the attribute that picks it.
template <class M>
const Schema<M>& modelSchema() {
  static const Schema<M> schema =
      Schema<M>(M::schema()).foreignAttribute("type", "picks the model: " + std::string(M::name));
  return schema;
}

std::vector<std::string> modelNames() {
  std::vector<std::string> names;
  forEachModel([&]<class M>(const M&) { names.emplace_back(M::name); });
  return names;
}

/// Older words of Uintah's for models that are here.
const std::map<std::string, std::string> otherWords{{"cnh_damage", "UCNH"}, {"cnhp_damage", "comp_neo_hook_plastic"}};

/// Models of Uintah's that are missing here, and what there is instead.
const std::vector<std::pair<std::string, std::string>> lackingModels{
    {"visco_scram", "hypo_elastic, without viscosity, with a <damage_model>"},
    {"mw_visco_elastic", "hypo_elastic, without viscosity"},
    {"membrane", "comp_neo_hook for bodies as thick as a cell"},
    {"three_factor_mooney", "comp_mooney_rivlin"},
    {"SVK", "comp_neo_hook"},
    {"ArrudaBoyce8", "comp_mooney_rivlin"},
    {"murnaghanMPM", "water, whose pressure obeys the same law"},
    {"TH_water", "water"},
    {"jwlpp_mpm", "ideal_gas for gases"},
    {"program_burn", "ideal_gas for gases"},
    {"p_alpha", "elastic_plastic_hp with a mie_gruneisen equation of state"},
    {"rf_elastic_plastic", "elastic_plastic_hp"},
    {"visco_plastic", "elastic_plastic_hp with johnson_cook flow"},
    {"visco_trans_iso_hyper", "trans_iso_hyper, without viscosity"},
    {"TransIsoHypoFrictional", "hypo_elastic, without fibres"},
    {"hypo_elastic_fortran", "hypo_elastic"},
    {"kayenta", "MohrCoulomb"},
    {"Arenisca", "MohrCoulomb"},
    {"Arenisca3", "MohrCoulomb"},
    {"Arenisca4", "MohrCoulomb"},
    {"ArenaSoil", "MohrCoulomb"},
    {"camclay", "MohrCoulomb"},
    {"nonlocal_drucker_prager", "MohrCoulomb"},
    {"HypoplasticB", "MohrCoulomb"},
    {"soil_foam", "MohrCoulomb"},
};

void refuseModel(const Element& tag, const std::string& type, Diagnostics& diagnostics) {
  for (const auto& [name, instead] : lackingModels)
    if (type == name)
      return diagnostics.error(tag,
                               fmt::format("the model '{}' of Uintah is not available; nearest is {}", name, instead));
  diagnostics.error(tag, "attribute 'type': " + input::choiceProblem(type, modelNames()));
}

void readModel(Material& material, const Element& parent, Diagnostics& diagnostics) {
  const auto tag = parent.child("constitutive_model");
  if (!tag) return diagnostics.error(parent, "missing tag <constitutive_model> in <material>");
  std::string type = tag->attribute("type").value_or("");
  if (const auto other = otherWords.find(type); other != otherWords.end()) type = other->second;
  forEachModel([&]<class M>(const M&) {
    if (type != M::name) return;
    M model = modelSchema<M>().read(*tag, diagnostics);
    if constexpr (providesCapability<M, capability::ConstantsOfMaterial>) model.material = material.constants();
    material.model = std::make_shared<ModelOf<M>>(model);
  });
  if (!material.model) refuseModel(*tag, type, diagnostics);
}

void describeModels(std::ostream& out, int indent) {
  forEachModel([&]<class M>(const M&) {
    out << std::string(indent, ' ') << "type=\"" << M::name << "\": " << M::schema().sentence() << '\n';
    M::schema().describeContents(out, indent + 2);
  });
}

Schema<Body> bodyTags() {
  return Schema<Body>("geom_object", "A body of material at the start.")
      .custom(
          "shape",
          [](Body& body, const Element& element, Diagnostics& diagnostics) {
            body.where = element.where();
            body.shape = input::readGeometry(element, diagnostics);
          },
          input::geometryNames(), "the body's shape; several are united", input::describeGeometry)
      .required("res", &Body::particlesPerCell, "1", "particles per cell along x, y, z", input::between(1, 32))
      .value("velocity", &Body::velocity, input::VectorExpression(), "m/s", "velocity at the start")
      .value("temperature", &Body::temperature, input::Expression(293.0), "K", "temperature at the start",
             input::nonNegative())
      .value("color", &Body::color, 0, "1", "a number that its particles keep, p.color")
      .ignored("concentration", "belongs to do_scalar_diffusion")
      .ignored("comment", "for readers")
      .ignored("density", "the material's is taken, as in Uintah")
      .ignored("pressure", "bodies start without stress")
      .ignored("level", "there is one level")
      .ignoredAttribute("name", "for readers");
}

const Schema<Body>& bodySchema() {
  static const Schema<Body> schema = [] {
    Schema<Body> tags = bodyTags();
    refuseOtherValues(tags, "volumeFraction", {"1"}, "a body fills its shape");
    return tags;
  }();
  return schema;
}

/// Tags of Uintah's in a material that change nothing here, and those that are missing.
void acceptUintahsTags(Schema<Material>& tags) {
  tags.ignored("possible_alpha_material", "belongs to the contact friction_LR");
  for (const char* tag : {"water_density", "porosity", "permeability", "initial_pore_pressure"})
    tags.ignored(tag, "belongs to coupled_flow_analysis");
  tags.ignored("heat_transfer_coefficient", "with <thermal_contact> materials share one temperature at a node");
  tags.ignored("C_p", "the <specific_heat> is taken").ignored("do_conc_reduction", "belongs to do_scalar_diffusion");
  refuseSwitch(tags, "linear_thermal_expansion_coef", "temperature does not make bodies longer");
  requireSwitch(tags, "is_active", "every material is there from the start");
  refuseSwitch(tags, "activation_time", "every material is there from the start");
}

const Schema<Material>& materialSchema() {
  static const Schema<Material> schema = [] {
    Schema<Material> material("material", "A material and the bodies made of it.");
    material.attributeValue("name", &Material::name, "", "1", "its name; material0, material1, … where none is given")
        .required("density", &Material::density, "kg/m^3", "density at the start", input::positive())
        .value("specific_heat", &Material::specificHeat, 0, "J/(kg K)", "c_v", input::nonNegative())
        .value("thermal_conductivity", &Material::thermalConductivity, 0, "W/(m K)", "conductivity",
               input::nonNegative())
        .value("melt_temp", &Material::meltTemperature, 295e10, "K",
               "temperature at which it melts; it never does where none is given, as in Uintah", input::positive())
        .value("room_temp", &Material::roomTemperature, 294, "K", "temperature of the constants of damage",
               input::nonNegative())
        .value("is_rigid", &Material::isRigid, false, "1",
               "explicit steps: its stress exerts no force, and its velocities go by FLIP also with XPIC2; in implicit "
               "steps "
               "bodies are rigid that a <contact> of type rigid or specified makes its master")
        .value(
            "is_force_transmitting_material", &Material::transmitsForce, false, "1",
            "explicit steps: it moves as a rigid whole, by the sum of the loads on it and of what <contact> of type "
            "rigid or "
            "specified, whose master it is, takes from others; gravity, damping and sides of the grid do not act on it")
        .custom("constitutive_model", readModel, {"constitutive_model"}, "how it answers to being deformed",
                describeModels)
        .custom("damage_model", readDamage, {"damage_model", "erosion"}, "how it fails, and what it bears then",
                describeDamage)
        .list("geom_object", &Material::bodies, bodySchema(), "a body of material at the start", 1);
    acceptUintahsTags(material);
    return material;
  }();
  return schema;
}

void noteCommonNames(const MaterialProperties::List& list, const Element& element, Diagnostics& diagnostics) {
  std::set<std::string> names;
  const auto tags = element.children("material");
  for (std::size_t m = 0; m < list.materials.size(); ++m)
    if (const std::string& name = list.materials[m].name; !name.empty() && !names.insert(name).second)
      diagnostics.note(tags[m],
                       fmt::format("a second material is called '{0}': this one is saved as '{0}.{1}'", name, m));
}

/// Contacts name materials that there are; numbers too many in <materials> mean nothing, as in Uintah.
void checkContacts(const MaterialProperties::List& list, const Element& element, Diagnostics& diagnostics) {
  const int count = static_cast<int>(list.materials.size());
  for (const Element& tag : element.children("contact"))
    for (const char* name : {"master_material", "ExcludeMaterial"}) {
      const auto given = tag.child(name);
      const int number = given ? input::parse<int>(given->text()).value.value_or(0) : 0;
      if (number < 0 || number >= count)
        diagnostics.error(*given,
                          fmt::format("there is no material {}: they are counted from 0 to {}", number, count - 1));
    }
}

}  // namespace

const Schema<MaterialProperties>& propertiesSchema() {
  static const Schema<MaterialProperties::ThermalContact> thermalContact(
      "thermal_contact", "Materials that share nodes share a temperature there.");
  static const Schema<MaterialProperties::List> list =
      Schema<MaterialProperties::List>("MPM", "The materials of the Material Point Method, and how they touch.")
          .list("material", &MaterialProperties::List::materials, materialSchema(), "a material", 1)
          .custom(
              "contact",
              [](MaterialProperties::List& read, const Element& element, Diagnostics& diagnostics) {
                read.contacts = readContacts(element, diagnostics);
              },
              {"contact"}, "how materials act on each other; several are applied one after the other", describeContacts)
          .section("thermal_contact", &MaterialProperties::List::thermalContact, thermalContact)
          .check(noteCommonNames)
          .check(checkContacts);
  static const Schema<MaterialProperties> schema = Schema<MaterialProperties>("MaterialProperties", "What there is.")
                                                       .requiredSection("MPM", &MaterialProperties::mpm, list);
  return schema;
}

}  // namespace tushar::mpm::solid
