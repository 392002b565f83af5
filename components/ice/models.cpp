#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "components/ice/decay_input.hpp"
#include "components/ice/gas_schemas.hpp"
#include "components/ice/tracers/input.hpp"
#include "core/input/refuse.hpp"

// The section Models: scalars that are transported with the gas.

namespace tushar::ice {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

/// The values of the attribute `type` of a <Model>.
const std::vector<std::string> modelTypes{"PassiveScalar",    "Test",           "Simple_Burn", "Steady_Burn",
                                          "Unsteady_Burn",    "DDT1",           "JWLpp",       "LightTime",
                                          "BinaryProperties", "TracerParticles"};

const Schema<ScalarRegion>& startSchema() {
  static const Schema<ScalarRegion> schema = [] {
    Schema<ScalarRegion> tags("geom_object", "A region at the start; where regions overlap, the last one applies.");
    input::addShape(tags, &ScalarRegion::where, &ScalarRegion::shape,
                    "the region: cells whose centre is inside; several shapes form their union")
        .required("scalar", &ScalarRegion::value, "1", "value of the scalar in the region", input::WithoutTime())
        .value("sinusoidalInitialize", &ScalarRegion::isSine, false, "1",
               "instead of <scalar>, the sum over axes of sin(2 pi freq d), where d goes from 0 to 1 across the region")
        .value("freq", &ScalarRegion::waves, Vec3::Zero(), "1", "number of waves along each axis")
        .value("linearInitialize", &ScalarRegion::isLinear, false, "1", "adds slope · d, with the same d")
        .value("slope", &ScalarRegion::slope, Vec3::Zero(), "1", "increase across the region along each axis")
        .ignored("coeff", "belongs to profiles that a formula can describe")
        .ignoredAttribute("name", "a note for readers");
    for (const char* tag : {"triangularInitialize", "quadraticInitialize", "cubicInitialize",
                            "exponentialInitialize_1D", "exponentialInitialize_2D"})
      input::refuseSwitch(tags, tag, "give <scalar> a formula");
    return tags;
  }();
  return schema;
}

const Schema<ScalarRegion>& interiorSchema() {
  static const Schema<ScalarRegion> schema = [] {
    Schema<ScalarRegion> tags("geom_object", "A region in which a scalar increases in each step.");
    input::addShape(tags, &ScalarRegion::where, &ScalarRegion::shape, "the region: cells whose centre is inside")
        .required("scalar", &ScalarRegion::value, "1", "increase in each step", input::WithoutTime())
        .value("maxScalar", &ScalarRegion::most, std::numeric_limits<double>::max(), "1",
               "largest value after the increase");
    return tags;
  }();
  return schema;
}

struct RegionList {
  std::vector<ScalarRegion> list;
};
struct ScalarConstants {
  double diffusivity = 0, constantRate = 0, linearRate = 0;
};
struct ScalarSection {
  Location where;
  std::string name;
  ScalarConstants constants;
  std::optional<DecaySection> decay;
  RegionList start;
  std::optional<RegionList> interior;
};
struct PassiveScalarSection {
  ScalarSection scalar;
};

const Schema<ScalarSection>& scalarSchema() {
  static const Schema<ScalarConstants> constants = [] {
    Schema<ScalarConstants> tags("constants", "Constants of a scalar.");
    tags.value("diffusivity", &ScalarConstants::diffusivity, 0, "m^2/s", "diffusion coefficient", input::nonNegative())
        .ignored("AMR_Refinement_Criteria",
                 "a <Variable> in <Refinement_Criteria_Thresholds> determines where cells are finer")
        .ignored("initialize_diffusion_knob", "there is no diffusion before the first step");
    tags.value("rateOfChange0", &ScalarConstants::constantRate, 0, "1/s", "how fast the scalar falls, until it is 0")
        .value("rateOfChange1", &ScalarConstants::linearRate, 0, "1/s",
               "how fast the scalar falls, per value of the scalar");
    return tags;
  }();
  static const Schema<RegionList> start =
      Schema<RegionList>("initialization", "The scalar at the start.")
          .list("geom_object", &RegionList::list, startSchema(),
                "a region; where regions overlap, the last one applies; regions must cover the grid", 1);
  static const Schema<RegionList> interior =
      Schema<RegionList>("interiorSources", "Regions in which the scalar increases.")
          .list("geom_object", &RegionList::list, interiorSchema(), "a region", 1);
  static const Schema<ScalarSection> schema = [] {
    Schema<ScalarSection> tags("scalar", "A quantity per mass that is transported with the gas.");
    tags.location(&ScalarSection::where)
        .requiredAttribute("name", &ScalarSection::name, "1", "it is saved as scalar-NAME and totalSum_scalar-NAME")
        .section("constants", &ScalarSection::constants, constants)
        .requiredSection("initialization", &ScalarSection::start, start)
        .section("interiorSources", &ScalarSection::interior, interior)
        .section("exponentialDecay", &ScalarSection::decay, decaySchema())
        .ignored("test_conservation", "totalSum_scalar-NAME is computed if it is saved");
    input::refuseSwitch(tags, "reinitializeDomain", "a run starts with <initialization>");
    return tags;
  }();
  return schema;
}

const Schema<PassiveScalarSection>& passiveScalarSchema() {
  static const Schema<PassiveScalarSection> schema =
      Schema<PassiveScalarSection>("PassiveScalar", "A quantity per mass that is transported with the gas.")
          .requiredSection("scalar", &PassiveScalarSection::scalar, scalarSchema())
          .ignored("material", "there is only one gas");
  return schema;
}

const Schema<MassExchange>& massExchangeSchema() {
  static const Schema<MassExchange> schema =
      Schema<MassExchange>("Test", "One material is converted into another one.")
          .location(&MassExchange::where)
          .foreignAttribute("type", "Test")
          .required("fromMaterial", &MassExchange::from, "1", "the gas or the body that is converted")
          .required("toMaterial", &MassExchange::to, "1", "the gas into which it is converted")
          .required("rate", &MassExchange::rate, "1/s", "fraction that is converted per unit time",
                    input::nonNegative())
          .value("startTime", &MassExchange::startTime, 0, "s", "time at which the conversion begins");
  return schema;
}

/// Reads a mass exchange. Older scenes give the numbers without a <Test> around them.
void readExchange(const Element& model, ModelsSection& models, Diagnostics& diagnostics) {
  const auto given = model.child("Test");
  if (!given && !model.child("fromMaterial")) return diagnostics.error(model, "missing tag <Test> in <Model>");
  models.massExchanges.push_back(massExchangeSchema().read(given.value_or(model), diagnostics));
}

/// Reads the burn model of a body from the tag that has the name of the model.
template <class Section>
void readBurning(const Element& model, const Schema<Section>& schema, ModelsSection& models, Diagnostics& diagnostics) {
  const auto given = model.child(schema.name());
  if (!given) return diagnostics.error(model, fmt::format("missing tag <{}> in <Model>", schema.name()));
  const Section read = schema.read(*given, diagnostics);
  if constexpr (requires { read.isActive; })
    if (!read.isActive) return;
  models.burns.push_back(read.model());
}

void readProgram(const Element& model, ModelsSection& models, Diagnostics& diagnostics) {
  const auto given = model.child("LightTime");
  if (!given) return diagnostics.error(model, "missing tag <LightTime> in <Model>");
  models.programs.push_back(programmedBurnSchema().read(*given, diagnostics));
}

void readReaction(const Element& model, ModelsSection& models, Diagnostics& diagnostics) {
  const auto given = model.child("JWLpp");
  if (!given) return diagnostics.error(model, "missing tag <JWLpp> in <Model>");
  models.reactions.push_back(pressureBurnSchema().read(*given, diagnostics));
}

void readBinary(const Element& model, ModelsSection& models, Diagnostics& diagnostics) {
  const auto given = model.child("BinaryProperties");
  if (!given) return diagnostics.error(model, "missing tag <BinaryProperties> in <Model>");
  if (models.binary) return diagnostics.error(model, "a second <Model type=\"BinaryProperties\"> is not available");
  const std::size_t before = diagnostics.size();
  BinaryProperties read = readBinaryProperties(*given, diagnostics);
  if (diagnostics.size() == before) models.binary = std::move(read);
}

void readTracers(const Element& model, ModelsSection& models, Diagnostics& diagnostics) {
  const auto given = model.child(tracersSchema().name());
  if (!given) return diagnostics.error(model, "missing tag <TracerParticles> in <Model>");
  if (models.tracers)
    return diagnostics.error(model,
                             "a second <Model type=\"TracerParticles\"> is not available; give the first one more "
                             "regions and scalars");
  const std::size_t before = diagnostics.size();
  TracerSettings read = settingsOfTracers(tracersSchema().read(*given, diagnostics), diagnostics);
  if (diagnostics.size() == before) models.tracers = std::move(read);
}

/// Refuses tags in a <Model> other than one that has the name of its type. Older scenes have the numbers of a mass
/// exchange without this tag.
void refuseOtherTags(const Element& model, const std::string& type, Diagnostics& diagnostics) {
  if (type == "Test" && !model.child("Test")) return;
  bool isGiven = false;
  for (const Element& tag : model.children()) {
    if (tag.name() != type)
      diagnostics.error(tag, fmt::format("unknown tag <{}> in <Model>{}; allowed here: {}", tag.name(),
                                         didYouMean(tag.name(), {type}), type));
    else if (isGiven)
      diagnostics.error(tag, fmt::format("<{}> is given twice in <Model>; add another <Model> for another one", type));
    isGiven = isGiven || tag.name() == type;
  }
}

void readModel(const Element& model, ModelsSection& models, Diagnostics& diagnostics) {
  const std::string type = model.attribute("type").value_or("");
  if (std::find(modelTypes.begin(), modelTypes.end(), type) != modelTypes.end())
    refuseOtherTags(model, type, diagnostics);
  if (type == "Test") return readExchange(model, models, diagnostics);
  if (type == "JWLpp") return readReaction(model, models, diagnostics);
  if (type == "LightTime") return readProgram(model, models, diagnostics);
  if (type == "BinaryProperties") return readBinary(model, models, diagnostics);
  if (type == tracersSchema().name()) return readTracers(model, models, diagnostics);
  if (type == simpleBurnSchema().name()) return readBurning(model, simpleBurnSchema(), models, diagnostics);
  if (type == steadyBurnSchema().name()) return readBurning(model, steadyBurnSchema(), models, diagnostics);
  if (type == unsteadyBurnSchema().name()) return readBurning(model, unsteadyBurnSchema(), models, diagnostics);
  if (type == ddtSchema().name()) return readBurning(model, ddtSchema(), models, diagnostics);
  if (type != "PassiveScalar")
    return diagnostics.error(model, fmt::format("the type '{}' is not available; remove the model, or use one of {}",
                                                type, input::listed(modelTypes)));
  const auto given = model.child("PassiveScalar");
  if (!given) return diagnostics.error(model, "missing tag <PassiveScalar> in <Model>");
  const std::size_t before = diagnostics.size();
  ScalarSection read = passiveScalarSchema().read(*given, diagnostics).scalar;
  if (diagnostics.size() > before) return;
  const ScalarDecay decay =
      decayOf(read.constants.constantRate, read.constants.linearRate, read.decay, "PassiveScalar", diagnostics);
  if (diagnostics.size() > before) return;
  const auto isIt = [&](const ScalarSettings& other) { return other.name == read.name; };
  if (std::any_of(models.scalars.begin(), models.scalars.end(), isIt))
    return diagnostics.error(*given, fmt::format("the name '{}' is given twice", read.name));
  models.scalars.push_back({.where = read.where,
                            .name = read.name,
                            .decay = decay,
                            .diffusivity = read.constants.diffusivity,
                            .start = std::move(read.start.list),
                            .interior = read.interior.value_or(RegionList()).list});
}

}  // namespace

double ScalarRegion::at(const Vec3& point) const {
  if (!isSine && !isLinear) return value(point);
  const input::Box3 bounds = shape->bounds();
  const Vec3 through = (point - bounds.min).cwiseQuotient(bounds.max - bounds.min);
  if (isLinear) return value(point) + slope.dot(through);
  double sum = 0;
  for (int d = 0; d < 3; ++d) sum += std::sin(2 * std::numbers::pi * waves[d] * through[d]);
  return sum;
}

const Schema<ModelsSection>& modelsSchema() {
  static const Schema<ModelsSection> schema =
      Schema<ModelsSection>("Models",
                            "Scalars that are transported with the gas, and conversions of one material into another.")
          .custom(
              "Model",
              [](ModelsSection& models, const Element& section, Diagnostics& diagnostics) {
                for (const Element& model : section.children("Model")) readModel(model, models, diagnostics);
              },
              {"Model"},
              "type=\"PassiveScalar\": a quantity per mass that is transported with the gas; type=\"Test\": one "
              "material is converted into another one; type=\"Simple_Burn\", type=\"Steady_Burn\", "
              "type=\"Unsteady_Burn\", type=\"DDT1\": a body burns; type=\"JWLpp\": a gas burns at a rate that depends "
              "on the pressure; type=\"LightTime\": a "
              "gas detonates at given times; type=\"BinaryProperties\": the gas consists of two gases at one "
              "temperature; type=\"TracerParticles\": particles without mass move with the gas",
              [](std::ostream& out, int indent) {
                passiveScalarSchema().describe(out, indent);
                massExchangeSchema().describe(out, indent);
                simpleBurnSchema().describe(out, indent);
                steadyBurnSchema().describe(out, indent);
                unsteadyBurnSchema().describe(out, indent);
                ddtSchema().describe(out, indent);
                pressureBurnSchema().describe(out, indent);
                programmedBurnSchema().describe(out, indent);
                describeBinaryProperties(out, indent);
                tracersSchema().describe(out, indent);
              })
          .forms({{.tags = {"Model"}, .demands = {{"type", modelTypes}}}});
  return schema;
}

}  // namespace tushar::ice
