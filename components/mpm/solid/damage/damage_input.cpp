#include "components/mpm/solid/damage/damage_input.hpp"

#include <fmt/format.h>

#include "components/mpm/solid/by_color.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

const Schema<NoDamage>& NoDamage::schema() {
  static const Schema<NoDamage> schema("damage_model", "No damage.");
  return schema;
}

/// Declares the tags for the initial damage.
template <class Self>
void declareStart(Schema<Self>& tags) {
  tags.value("initial_mean_scalar_damage", &Self::initialDamage, 0, "1", "damage at the start", input::between(0, 1))
      .value("initial_std_scalar_damage", &Self::initialDeviation, 0, "1", "for gauss: standard deviation",
             input::nonNegative())
      .choice("initial_scalar_damage_distrib", &Self::startsSpread, {{"constant", false}, {"gauss", true}}, false,
              "distribution of the initial damage among the particles; the random numbers differ from Uintah's");
}

const Schema<JohnsonCookDamage>& JohnsonCookDamage::schema() {
  using Self = JohnsonCookDamage;
  static const Schema<Self> schema = [] {
    Schema<Self> tags("damage_model",
                      "Johnson-Cook damage; a particle fails when p.damage reaches 1 (in Uintah no particle fails).");
    tags.required("D1", &Self::d1, "1", "fracture strain without stress")
        .required("D2", &Self::d2, "1", "factor of exp(D3 s*)")
        .required("D3", &Self::d3, "1", "factor of the triaxiality")
        .required("D4", &Self::d4, "1", "factor of the logarithm of the rate")
        .required("D5", &Self::d5, "1", "factor of the temperature")
        .value("critical_scalar_damage", &Self::leastDamage, 1e-10, "1", "damage below this value is treated as 0",
               input::nonNegative())
        .ignored("D0", "Uintah does not use it either")
        .ignored("Dc", "Uintah does not use it either");
    declareStart(tags);
    return tags;
  }();
  return schema;
}

const Schema<HancockMackenzieDamage>& HancockMackenzieDamage::schema() {
  using Self = HancockMackenzieDamage;
  static const Schema<Self> schema = [] {
    Schema<Self> tags("damage_model",
                      "Hancock-Mackenzie damage, p.damage; as in Uintah, it does not make particles fail.");
    tags.ignored("critical_scalar_damage", "as in Uintah, this damage does not make particles fail");
    declareStart(tags);
    return tags;
  }();
  return schema;
}

const Schema<BrittleDamage>& BrittleDamage::schema() {
  using Self = BrittleDamage;
  static const Schema<Self> schema = [] {
    Schema<Self> tags("damage_model", "Damage of brittle materials: the stress falls once a threshold is passed.");
    tags.value("brittle_damage_initial_threshold", &Self::threshold, 57, "Pa^(1/2)", "r_0", input::positive())
        .value("brittle_damage_fracture_energy", &Self::fractureEnergy, 11.2, "J/m^2", "G_f", input::positive())
        .value("brittle_damage_constant_D", &Self::shape, 0.1, "1", "shape of the softening", input::positive())
        .value("brittle_damage_max_damage_increment", &Self::greatestStep, 0.1, "1",
               "largest growth of damage in one step", input::positive())
        .ignored("brittle_damage_recoveryCoeff", "damage does not heal")
        .ignored("brittle_damage_printDamage", "save p.damage");
    refuseSwitch(tags, "brittle_damage_allowRecovery", "damage does not heal");
    return tags;
  }();
  return schema;
}

/// Converts a pointer to a member of ThresholdDamage into a pointer to a member of Self, which extends it.
template <class Self, class T>
T Self::*of(T ThresholdDamage::*member) {
  return member;
}

/// Declares the tags of the criterion, and of the distribution of the threshold among particles.
template <class Self>
void declareThreshold(Schema<Self>& tags) {
  using Base = ThresholdDamage;
  using Criterion = Base::Criterion;
  using Distribution = Base::Distribution;
  tags.requiredChoice("failure_criteria", of<Self>(&Base::criterion),
                      {{"MaximumPrincipalStress", Criterion::principalStress},
                       {"MaximumPrincipalStrain", Criterion::principalStrain},
                       {"MohrCoulomb", Criterion::mohrCoulomb},
                       {"MohrColoumb", Criterion::mohrCoulomb}},
                      "quantity that is compared with the threshold")
      .choice("failure_distrib", of<Self>(&Base::distribution),
              {{"constant", Distribution::constant},
               {"gauss", Distribution::gauss},
               {"weibull", Distribution::weibull},
               {"uniform", Distribution::uniform}},
              Distribution::constant, "distribution of the threshold among the particles")
      .value("failure_seed", of<Self>(&Base::seed), 0, "1", "seed of the random thresholds, which differ from Uintah's")
      .choice("scaling", of<Self>(&Base::scalesWithVolume), {{"none", false}, {"kayenta", true}}, false,
              "whether small particles are stronger: (reference_volume / volume)^(1/exponent)")
      .optional("reference_volume", of<Self>(&Base::referenceVolume), "m^3",
                "volume of particles whose threshold is not scaled", input::positive())
      .optional("exponent", of<Self>(&Base::exponent), "1", "exponent of the scaling; the Weibull modulus by default",
                input::positive())
      .value("friction_angle", of<Self>(&Base::frictionAngle), 0, "degrees", "for MohrCoulomb", input::between(0, 89))
      .value("tensile_cutoff_fraction_of_cohesion", of<Self>(&Base::tensileCutoff), 0, "1", "for MohrCoulomb",
             input::nonNegative())
      .value("LocalizeParticles", of<Self>(&Base::localizes), true, "1", "whether particles can fail");
}

/// Checks the scaling of a threshold.
void checkScaling(const ThresholdDamage& read, const Element& element, Diagnostics& diagnostics) {
  if (!read.scalesWithVolume) return;
  if (read.distribution == ThresholdDamage::Distribution::constant)
    diagnostics.error(element, "scaling needs a <failure_distrib> that is not constant");
  if (!read.referenceVolume) diagnostics.error(element, "scaling needs <reference_volume>");
  if (!read.exponent && read.distribution != ThresholdDamage::Distribution::weibull)
    diagnostics.error(element, "scaling needs <exponent>");
}

const Schema<ThresholdDamage>& ThresholdDamage::schema() {
  using Self = ThresholdDamage;
  static const Schema<Self> schema = [] {
    Schema<Self> tags("damage_model", "A particle fails at once if a stress or strain exceeds a threshold.");
    declareThreshold(tags);
    tags.required("failure_mean", &Self::mean, "Pa or 1", "mean of the threshold; for MohrCoulomb, of the cohesion",
                  input::positive())
        .value("failure_std", &Self::deviation, 0, "Pa or 1",
               "standard deviation (gauss), half width (uniform), or Weibull modulus", input::nonNegative())
        .check([](const Self& read, const Element& element, Diagnostics& diagnostics) {
          if (read.distribution == Distribution::weibull && read.deviation <= 0)
            diagnostics.error(element, "failure_distrib weibull needs <failure_std>, its modulus");
          checkScaling(read, element, diagnostics);
        });
    return tags;
  }();
  return schema;
}

const Schema<ThresholdVarDamage>& ThresholdVarDamage::schema() {
  using Self = ThresholdVarDamage;
  static const Schema<Entry> entry =
      Schema<Entry>("entry", "The threshold of particles of one color.")
          .required("color", &Entry::color, "1", "p.color of the particles")
          .required("mean", &Entry::mean, "Pa or 1", "mean of the threshold; for MohrCoulomb, of the cohesion",
                    input::positive())
          .required("std", &Entry::deviation, "Pa or 1",
                    "standard deviation (gauss), half width (uniform), or Weibull modulus", input::nonNegative());
  static const Schema<Table> byColor =
      Schema<Table>("variable_properties", "Thresholds as a function of p.color, linear between the entries.")
          .list("entry", &Table::entries, entry, "the threshold for one color, in order of increasing color", 1);
  static const Schema<Self> schema = [] {
    Schema<Self> tags(
        "damage_model",
        "A particle fails at once if a stress or strain exceeds a threshold that depends on the particle's color.");
    declareThreshold(tags);
    tags.requiredSection("variable_properties", &Self::table, byColor)
        .check([](const Self& read, const Element& element, Diagnostics& diagnostics) {
          if (!growsInColor(read.table.entries))
            diagnostics.error(element, "variable_properties: <color> does not increase from each entry to the next");
          for (const Entry& one : read.table.entries)
            if (read.distribution == Distribution::weibull && one.deviation <= 0)
              diagnostics.error(element, "failure_distrib weibull needs a <std>, its modulus, in every entry");
          checkScaling(read, element, diagnostics);
        });
    return tags;
  }();
  return schema;
}

namespace {

const Schema<Erosion>& erosionSchema() {
  using Algorithm = Erosion::Algorithm;
  static const Schema<Erosion> schema =
      Schema<Erosion>("erosion", "The treatment of particles that fail.")
          .requiredChoiceAttribute(
              "algorithm", &Erosion::algorithm,
              {{"none", Algorithm::none},
               {"AllowNoTension", Algorithm::allowNoTension},
               {"ZeroStress", Algorithm::zeroStress},
               {"AllowNoShear", Algorithm::allowNoShear},
               {"PreserveStress", Algorithm::preserveStress}},
              "what a failed particle bears: only pressure (AllowNoTension), no stress (ZeroStress), only mean stress "
              "(AllowNoShear), or all stress (PreserveStress, and none, with which only a <damage_model> makes "
              "particles fail)")
          .value("char_time", &Erosion::relaxationTime, 1e-99, "s", "time in which the lost stress decays to 1/e",
                 input::positive());
  return schema;
}

/// Checks that a damage model fits the constitutive model, and copies the elastic constants of the constitutive model
/// into the damage model.
void connect(Material& material, const Element& parent, const Element& tag, Diagnostics& diagnostics) {
  const bool isJohnsonCook = std::holds_alternative<JohnsonCookDamage>(material.damage);
  const bool needsRate = isJohnsonCook || std::holds_alternative<HancockMackenzieDamage>(material.damage);
  if (isJohnsonCook && material.meltTemperature <= material.roomTemperature)
    diagnostics.error(tag, "johnson_cook: <melt_temp> of the material is not greater than its <room_temp>");
  if (needsRate && material.model && offsetOf(*material.model, "p.plasticStrainRate") < 0)
    diagnostics.error(tag, tag.attribute("type").value_or("") +
                               " needs the plastic strain of a constitutive model elastic_plastic_hp, found " +
                               std::string(material.model->name()));
  BrittleDamage* brittle = std::get_if<BrittleDamage>(&material.damage);
  if (!brittle) return;
  const auto model = parent.child("constitutive_model");
  const auto number = [&](const char* name) -> std::optional<double> {
    const auto given = model ? model->child(name) : std::nullopt;
    return given ? input::parse<double>(given->text()).value : std::nullopt;
  };
  const auto bulk = number("bulk_modulus"), shear = number("shear_modulus");
  if (!bulk || !shear)
    return diagnostics.error(tag, "Brittle needs a constitutive model with bulk_modulus and shear_modulus");
  brittle->young = 9 * *bulk * *shear / (3 * *bulk + *shear);
}

/// Refuses erosion together with a stability check of porous metals; in Uintah, particles fail by this check.
void refuseStabilityChecks(const Element& parent, const Element& erosion, Diagnostics& diagnostics) {
  const auto model = parent.child("constitutive_model");
  const auto check = model ? model->child("stability_check") : std::nullopt;
  const auto yield = model ? model->child("yield_condition") : std::nullopt;
  if (check && check->attribute("type") != "none" && yield && yield->attribute("type") == "gurson")
    diagnostics.error(*check,
                      fmt::format("<erosion> on line {} acts after a loss of stability, which is not detected with "
                                  "yield_condition gurson; set the type of the stability_check to none, and give the "
                                  "material a <damage_model>",
                                  erosion.where().line));
}

/// Adds a note that porosity makes no particle fail; in Uintah, it makes particles of metals fail by default.
void noteWhatDoesNotFail(const Material& material, const Element& parent, const Element& erosion,
                         Diagnostics& diagnostics) {
  const auto model = parent.child("constitutive_model");
  const auto isOff = [&](const char* tag) {
    return model && model->child(tag) && model->child(tag)->text() == "false";
  };
  if (material.model && offsetOf(*material.model, "p.plasticStrainRate") >= 0 && !isOff("evolve_porosity") &&
      !isOff("check_TEPLA_failure_criterion"))
    diagnostics.note(erosion,
                     "particles fail because of the <damage_model> or melting, not because of porosity as in Uintah");
}

}  // namespace

void readDamage(Material& material, const Element& parent, Diagnostics& diagnostics) {
  if (const auto tag = parent.child("damage_model")) {
    material.damage = input::TypedTag<Damage>::read(*tag, diagnostics);
    connect(material, parent, *tag, diagnostics);
  }
  if (const auto tag = parent.child("erosion")) {
    material.erosion = erosionSchema().read(*tag, diagnostics);
    if (material.erosion.acts()) refuseStabilityChecks(parent, *tag, diagnostics);
    if (material.erosion.acts()) noteWhatDoesNotFail(material, parent, *tag, diagnostics);
  }
}

std::vector<input::TagForm> damageForms() {
  return {input::onceForm("damage_model", input::TypedTag<Damage>::alternatives), input::onceForm("erosion", [] {
            return std::vector<input::Alternative>{{&erosionSchema(), {}}};
          })};
}

void describeDamage(std::ostream& out, int indent) {
  input::TypedTag<Damage>::describe(out, indent);
  out << std::string(indent, ' ') << "<erosion>: " << erosionSchema().sentence() << '\n';
  erosionSchema().describeContents(out, indent + 2);
}

}  // namespace tushar::mpm::solid
