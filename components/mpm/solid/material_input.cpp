#include "components/mpm/solid/material_input.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include <map>
#include <set>

#include "components/mpm/solid/constitutive/make_model.hpp"
#include "components/mpm/solid/contact/contact_input.hpp"
#include "components/mpm/solid/damage/damage_input.hpp"
#include "components/mpm/solid/grains/grain_input.hpp"
#include "core/input/geometry/smooth_cylinder.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

/// Calls `visit` with one model of each type.
template <class Visit>
void forEachModel(Visit&& visit) {
  std::apply([&](const auto&... model) { (visit(model), ...); }, AllModels{});
}

/// The tags of a model, and the attribute that selects the model.
template <class M>
const Schema<M>& modelSchema() {
  static const Schema<M> schema =
      Schema<M>(M::schema()).foreignAttribute("type", "selects the model: " + std::string(M::name));
  return schema;
}

std::vector<std::string> modelNames() {
  std::vector<std::string> names;
  forEachModel([&]<class M>(const M&) { names.emplace_back(M::name); });
  return names;
}

/// Uintah's older names for models that are available.
const std::map<std::string, std::string> otherWords{
    {"arenisca", "Arenisca"}, {"cnh_damage", "UCNH"}, {"cnhp_damage", "comp_neo_hook_plastic"}};

/// Models of Uintah that are not available, each with the most similar one.
const std::vector<std::pair<std::string, std::string>> lackingModels{
    {"membrane", "comp_neo_hook, with bodies as thick as a cell"},
    {"three_factor_mooney", "comp_mooney_rivlin"},
    {"SVK", "comp_neo_hook"},
    {"murnaghanMPM", "water, which has the same pressure law"},
    {"rf_elastic_plastic", "elastic_plastic_hp"},
    {"TransIsoHypoFrictional", "hypo_elastic, without fibres"},
    {"hypo_elastic_fortran", "hypo_elastic"},
    {"kayenta", "MohrCoulomb"},
    {"ArenaSoil", "Arenisca4"},
    {"camclay", "MohrCoulomb"},
    {"HypoplasticB", "MohrCoulomb"},
    {"soil_foam", "MohrCoulomb"},
};

void refuseModel(const Element& tag, const std::string& type, Diagnostics& diagnostics) {
  for (const auto& [name, instead] : lackingModels)
    if (type == name)
      return diagnostics.error(
          tag, fmt::format("the model '{}' of Uintah is not available; the most similar one is {}", name, instead));
  diagnostics.error(tag, "attribute 'type': " + input::choiceProblem(type, modelNames()));
}

/// Whether a tag that names Arenisca3 has the tags of Arenisca, as in some scenes of Uintah.
bool hasOlderTags(const Element& tag) { return tag.child("p4_fluid_effect") && !tag.child("STREN"); }

/// The type of the model in a tag, as Tushar's name.
std::string typeOf(const Element& tag) {
  const std::string type = tag.attribute("type").value_or("");
  const auto yields = tag.child("usePlasticity");
  if (type == CompNeoHook::name && yields && yields->text() == "true") return std::string(Ucnh::name);
  const auto surface = tag.child("yield_condition");
  if (type == ElasticPlasticModel::name && surface && surface->attribute("type") == GursonYield::name)
    return std::string(ElasticPlasticHp::name);
  if (type == Arenisca3::name && hasOlderTags(tag)) return std::string(Arenisca2::name);
  const auto other = otherWords.find(type);
  return other == otherWords.end() ? type : other->second;
}

void readModel(Material& material, const Element& parent, Diagnostics& diagnostics) {
  const auto tag = parent.child("constitutive_model");
  if (!tag) return diagnostics.error(parent, "missing tag <constitutive_model> in <material>");
  const std::string type = typeOf(*tag);
  if (tag->attribute("type") == Arenisca3::name && type == Arenisca2::name)
    diagnostics.note(*tag, "has the tags of 'Arenisca', not of 'Arenisca3', so it is treated as 'Arenisca'");
  forEachModel([&]<class M>(const M&) {
    if (type != M::name) return;
    M model = modelSchema<M>().read(*tag, diagnostics);
    if constexpr (providesCapability<M, capability::ConstantsOfMaterial>) model.material = material.constants();
    material.model = makeModel(model, material);
    if (material.thermalExpansion > 0 && !expands<M>)
      diagnostics.note(parent.child("linear_thermal_expansion_coef").value(),
                       "does nothing: as in Uintah, only comp_neo_hook, UCNH and comp_neo_hook_plastic expand");
  });
  if (!material.model) refuseModel(*tag, type, diagnostics);
}

/// The schemas of the tag, one for each model.
std::vector<input::Alternative> modelAlternatives() {
  std::vector<input::Alternative> alternatives;
  forEachModel([&]<class M>(const M&) {
    std::vector<std::string> words{std::string(M::name)};
    for (const auto& [word, model] : otherWords)
      if (model == M::name) words.push_back(word);
    if (M::name == Ucnh::name) words.emplace_back(CompNeoHook::name);
    alternatives.push_back({&modelSchema<M>(), {{"type", words}}});
  });
  return alternatives;
}

void describeModels(std::ostream& out, int indent) {
  forEachModel([&]<class M>(const M&) {
    out << std::string(indent, ' ') << "type=\"" << M::name << "\": " << M::schema().sentence() << '\n';
    M::schema().describeContents(out, indent + 2);
  });
}

void checkAffine(const Body& body, const Element& element, Diagnostics& diagnostics) {
  if (!(body.affineMatrix().determinant() > 0))
    diagnostics.error(element, "affineTransformation_A0, …_A1 and …_A2: the determinant of A is not positive");
  const bool isTransformed = body.affineMatrix() != Matrix3::Identity() || !body.affineShift.isZero(0);
  if (isTransformed && dynamic_cast<const input::SmoothCylinder*>(body.shape.get()))
    diagnostics.error(element, "affineTransformation_…: a smoothcyl has the places of its rings; remove it");
}

/// Reads the shape of a body, or the file that lists its particles.
void readShape(Body& body, const Element& element, Diagnostics& diagnostics) {
  const auto list = element.child("file");
  if (!list) {
    body.shape = input::readGeometry(element, diagnostics);
    return;
  }
  body.list = readListedParticles(*list, diagnostics);
  body.shape = body.list;
  std::vector<std::string> others = input::geometryNames();
  for (const char* tag : {"numLevelsParticleFilling", "affineTransformation_A0", "affineTransformation_A1",
                          "affineTransformation_A2", "affineTransformation_b"})
    others.emplace_back(tag);
  for (const std::string& name : others)
    if (const auto other = element.child(name))
      diagnostics.error(*other,
                        "<file> lists all particles of this body; remove this tag, or put it into a "
                        "<geom_object> of its own");
  if (element.children("file").size() > 1)
    diagnostics.error(element.children("file")[1], "put a second <file> into a <geom_object> of its own");
}

std::vector<std::string> shapeNames() {
  std::vector<std::string> names = input::geometryNames();
  names.emplace_back("file");
  return names;
}

void describeShapes(std::ostream& out, int indent) {
  input::describeGeometry(out, indent);
  listedParticlesSchema().describe(out, indent);
}

std::vector<input::TagForm> shapeForms() {
  std::vector<input::TagForm> forms = input::geometryForms();
  forms.push_back(input::sectionForm({"file"}, [] {
    return std::vector<input::Alternative>{{&listedParticlesSchema(), {}}};
  }));
  return forms;
}

Schema<Body> bodyTags() {
  Schema<Body> tags("geom_object", "A body of material at the start.");
  tags.location(&Body::where)
      .custom("shape", readShape, shapeNames(),
              "shape of the body; several shapes form their union. Or a file that lists its particles", describeShapes)
      .forms(shapeForms(), 1)
      .required("res", &Body::particlesPerCell, "1", "particles per cell along x, y, z", input::between(1, 32))
      .value("velocity", &Body::velocity, input::VectorExpression(), "m/s", "velocity at the start")
      .value("temperature", &Body::temperature, input::Expression(293.0), "K", "temperature at the start",
             input::nonNegative())
      .value("color", &Body::color, 0, "1", "a number that the particles of the body store as p.color")
      .value("numLevelsParticleFilling", &Body::levels, 1, "1",
             "number of particle sizes, each half the previous one, that fill the shape up to its surface; negative: "
             "only the smallest particles extend beyond the surface",
             input::between(-8, 8))
      .value("affineTransformation_A0", &Body::affineRow0, Vec3::UnitX(), "1",
             "first row of A: for each point X inside the shape, a particle starts at A X + b instead of X, and A "
             "transforms its edges")
      .value("affineTransformation_A1", &Body::affineRow1, Vec3::UnitY(), "1", "second row of A")
      .value("affineTransformation_A2", &Body::affineRow2, Vec3::UnitZ(), "1", "third row of A")
      .value("affineTransformation_b", &Body::affineShift, Vec3::Zero(), "m", "b")
      .check(checkAffine)
      .ignored("concentration", "belongs to do_scalar_diffusion")
      .ignored("comment", "a note for readers")
      .ignored("density", "the density of the material is used, as in Uintah")
      .ignored("pressure", "bodies start without stress")
      .ignored("level", "there is only one level")
      .ignoredAttribute("name", "a note for readers");
  return tags;
}

const Schema<Body>& bodySchema() {
  static const Schema<Body> schema = [] {
    Schema<Body> tags = bodyTags();
    refuseOtherValues(tags, "volumeFraction", {"1"}, "a body always fills its shape");
    return tags;
  }();
  return schema;
}

/// Accepts Uintah's tags in a material that have no effect in Tushar, and refuses those that are not available.
void acceptUintahsTags(Schema<Material>& tags) {
  for (const char* tag : {"water_density", "porosity", "permeability", "initial_pore_pressure"})
    tags.ignored(tag, "belongs to coupled_flow_analysis");
  tags.ignored("heat_transfer_coefficient", "with <thermal_contact> materials share one temperature at a node");
  tags.ignored("gamma", "belongs to a gas; Uintah does not read it for a body either");
  tags.ignored("C_p", "the <specific_heat> is used").ignored("do_conc_reduction", "belongs to do_scalar_diffusion");
  for (const char* tag : {"D1", "D2", "D3", "D4", "D5"})
    tags.ignored(tag, "it has an effect only in <damage_model type=\"johnson_cook\">, as in Uintah");
  for (const char* tag : {"ThresholdTemp", "ThresholdPressure", "Enthalpy", "BurnCoeff", "refPressure"})
    noteTag(tags, tag, "a <Model> in <Models> specifies how the material burns, as in Uintah");
  requireSwitch(tags, "is_active", "all materials exist from the start");
  refuseSwitch(tags, "activation_time", "all materials exist from the start");
}

const Schema<Material>& materialSchema() {
  static const Schema<Material> schema = [] {
    Schema<Material> material("material", "A material and the bodies made of it.");
    material.attributeValue("name", &Material::name, "", "1", "name; material0, material1, … by default")
        .required("density", &Material::density, "kg/m^3", "density at the start", input::positive())
        .value("specific_heat", &Material::specificHeat, 0, "J/(kg K)", "c_v", input::nonNegative())
        .value("thermal_conductivity", &Material::thermalConductivity, 0, "W/(m K)", "thermal conductivity",
               input::nonNegative())
        .value("melt_temp", &Material::meltTemperature, 295e10, "K",
               "melting temperature; by default the material never melts, as in Uintah", input::positive())
        .value("room_temp", &Material::roomTemperature, 294, "K", "reference temperature of the damage constants",
               input::nonNegative())
        .value("linear_thermal_expansion_coef", &Material::thermalExpansion, 0, "1/K",
               "thermal expansion coefficient (of lengths) relative to <room_temp>, for neo-Hookean models in explicit "
               "steps",
               input::nonNegative())
        .value("is_rigid", &Material::isRigid, false, "1",
               "in explicit steps, its stress exerts no force, and its velocities are updated by FLIP even with XPIC2; "
               "both also apply to the master of a contact. In implicit steps, it must be the master of a <contact> of "
               "type rigid or specified")
        .value("is_force_transmitting_material", &Material::transmitsForce, false, "1",
               "in explicit steps, it moves as one rigid body under its loads and the forces of the <contact> of type "
               "rigid or specified of which it is the master; gravity, damping and the sides of the grid do not act on "
               "it. All of it is accelerated alike, so it moves as one only if its initial velocity is the same "
               "everywhere")
        .value("possible_alpha_material", &Material::mayLeadContact, true, "1",
               "for contacts of type friction_LR, friction_LRVar and specified_friction: true: normals may point out "
               "of this material; false: it slides only at nodes where two other materials meet")
        .custom("constitutive_model", readModel, {"constitutive_model"}, "stress as a function of deformation",
                describeModels)
        .forms({input::onceForm("constitutive_model", modelAlternatives, 1)})
        .custom("damage_model", readDamage, {"damage_model", "erosion"},
                "when particles fail, and what strength they then have", describeDamage)
        .forms(damageForms())
        .list("geom_object", &Material::bodies, bodySchema(), "a body of material at the start");
    addGrainTags(material);
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
                       fmt::format("another material is also called '{0}': this one is saved as '{0}.{1}'", name, m));
}

/// Checks that the masters of contacts, and the materials that they exclude, exist.
void checkContacts(const MaterialProperties::List& list, const Element& element, Diagnostics& diagnostics) {
  const int count = static_cast<int>(list.materials.size());
  for (const Element& tag : element.children("contact"))
    for (const char* name : {"master_material", "ExcludeMaterial"}) {
      const auto given = tag.child(name);
      const int number = given ? input::parse<int>(given->text()).value.value_or(0) : 0;
      if (number < 0 || number >= count)
        diagnostics.error(
            *given, fmt::format("there is no material {}; materials are numbered from 0 to {}", number, count - 1));
    }
}

}  // namespace

const Schema<MaterialProperties>& propertiesSchema(bool besideGas) {
  static const Schema<MaterialProperties::ThermalContact> thermalContact(
      "thermal_contact", "With this tag, materials that share a node have the same temperature at the node.");
  static const Schema<MaterialProperties::List> list =
      Schema<MaterialProperties::List>("MPM", "The materials of the Material Point Method, and their contact.")
          .list("material", &MaterialProperties::List::materials, materialSchema(), "a material", 1)
          .custom(
              "contact",
              [](MaterialProperties::List& read, const Element& element, Diagnostics& diagnostics) {
                read.contacts = readContacts(element, diagnostics);
              },
              {"contact"}, "how materials interact; several contacts are applied one after the other", describeContacts)
          .forms({contactForm()})
          .list("cohesive_zone", &MaterialProperties::List::zones, zonesSchema(), "cohesive zones between bodies")
          .section("thermal_contact", &MaterialProperties::List::thermalContact, thermalContact)
          .check(noteCommonNames)
          .check(checkContacts);
  static const auto make = [] {
    return Schema<MaterialProperties>("MaterialProperties", "The materials of the scene.")
        .requiredSection("MPM", &MaterialProperties::mpm, list);
  };
  static const Schema<MaterialProperties> alone = make();
  static const Schema<MaterialProperties> beside = make().custom(
      "ICE", [](MaterialProperties&, const Element&, Diagnostics&) {}, {"ICE", "exchange_properties"},
      "the gas, and its exchange with bodies");
  return besideGas ? beside : alone;
}

}  // namespace tushar::mpm::solid
