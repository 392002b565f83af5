#include "components/ice/burn_model.hpp"

#include "core/input/refuse.hpp"

// The models of bodies that burn, as they are written.

namespace tushar::ice {

using input::Schema;

namespace {

template <class Section>
void addMaterials(Schema<Section>& tags) {
  tags.location(&Section::where)
      .required("fromMaterial", &Section::from, "1", "name of the body that burns")
      .required("toMaterial", &Section::to, "1", "name of the gas into which it is converted");
}

/// Declares the parameters of a steady deflagration; `pressure` is the name of the tag for the threshold pressure.
template <class Section>
void addSteadyBurn(Schema<Section>& tags, const char* pressure) {
  const auto of = [](double SteadyBurn::*number) -> double Section::* { return number; };
  tags.required("IdealGasConst", of(&SteadyBurn::gasConstant), "J/(mol K)", "R", input::positive())
      .required("PreExpCondPh", of(&SteadyBurn::solidFactor), "1/s", "factor of the reaction in the solid",
                input::positive())
      .required("ActEnergyCondPh", of(&SteadyBurn::activationEnergy), "J/mol",
                "activation energy of the reaction in the solid", input::positive())
      .required("PreExpGasPh", of(&SteadyBurn::gasFactor), "m^3/(kg s K^2)", "factor of the reaction in the gas",
                input::positive())
      .required("CondPhaseHeat", of(&SteadyBurn::solidHeat), "J/kg", "heat of the reaction in the solid",
                input::nonNegative())
      .required("GasPhaseHeat", of(&SteadyBurn::gasHeat), "J/kg", "heat of the reaction in the gas",
                input::nonNegative())
      .required("HeatConductGasPh", of(&SteadyBurn::gasConductivity), "W/(m K)", "thermal conductivity of the gas",
                input::positive())
      .required("HeatConductCondPh", of(&SteadyBurn::solidConductivity), "W/(m K)", "thermal conductivity of the solid",
                input::positive())
      .required("SpecificHeatBoth", of(&SteadyBurn::specificHeat), "J/(kg K)",
                "specific heat of solid and gas, used in the rate", input::positive())
      .required("MoleWeightGasPh", of(&SteadyBurn::molarMass), "kg/mol", "molar mass of the gas", input::positive())
      .required(pressure, &Section::thresholdPressure, "Pa", "pressure of the gas above which a surface burns",
                input::nonNegative())
      .required("IgnitionTemp", &Section::ignitionTemperature, "K",
                "temperature of the gas, or of a body at the surface, above which the surface burns",
                input::nonNegative())
      .ignored("BoundaryParticles", "surfaces are where the gas has walls");
}

}  // namespace

const Schema<SimpleBurnSection>& simpleBurnSchema() {
  static const Schema<SimpleBurnSection> schema = [] {
    Schema<SimpleBurnSection> tags("Simple_Burn",
                                   "The surface of a body burns at a rate that depends on the pressure.");
    addMaterials(tags);
    tags.value("Active", &SimpleBurnSection::isActive, true, "1", "whether the body burns")
        .required("ThresholdTemp", &SimpleBurnSection::thresholdTemperature, "K",
                  "temperature of the gas, or of a body at the surface, above which the surface burns",
                  input::nonNegative())
        .required("ThresholdPressure", &SimpleBurnSection::thresholdPressure, "Pa",
                  "pressure of the gas above which a surface burns", input::nonNegative())
        .required("Enthalpy", &SimpleBurnSection::enthalpy, "J/kg", "heat of the reaction")
        .required("BurnCoeff", &SimpleBurnSection::coefficient, "kg/(m^2 s)", "rate at <refPressure>",
                  input::nonNegative())
        .required("refPressure", &SimpleBurnSection::reference, "Pa", "rate = BurnCoeff (p / refPressure)^0.778",
                  input::positive());
    return tags;
  }();
  return schema;
}

const Schema<SteadyBurnSection>& steadyBurnSchema() {
  static const Schema<SteadyBurnSection> schema = [] {
    Schema<SteadyBurnSection> tags("Steady_Burn",
                                   "The surface of a body burns as a steady deflagration (Ward, Son & Brewster 1998).");
    addMaterials(tags);
    addSteadyBurn(tags, "ThresholdPressure");
    return tags;
  }();
  return schema;
}

const Schema<UnsteadyBurnSection>& unsteadyBurnSchema() {
  static const Schema<UnsteadyBurnSection> schema = [] {
    const auto of = [](double UnsteadyBurn::*number) -> double UnsteadyBurnSection::* { return number; };
    Schema<UnsteadyBurnSection> tags(
        "Unsteady_Burn", "The surface of a body burns; its temperature follows that of Steady_Burn with a delay.");
    addMaterials(tags);
    addSteadyBurn(tags, "ThresholdPressure");
    tags.required("CondUnsteadyCoef", of(&UnsteadyBurn::solidDelay), "1",
                  "N_c in tau = N_c k_c rho / (c m^2), the delay of the temperature gradient below the surface",
                  input::nonNegative())
        .required("GasUnsteadyCoef", of(&UnsteadyBurn::gasDelay), "1",
                  "N_g: the temperature of the surface has the delay N_g tau", input::nonNegative())
        .required("BurnrateModCoef", of(&UnsteadyBurn::exponent), "1",
                  "B: the rate is m (rate / m)^B, with the steady rate m", input::nonNegative());
    return tags;
  }();
  return schema;
}

namespace {

void addInduction(Schema<DdtSection>& tags) {
  const auto of = [](double Induction::*number) -> double DdtSection::* { return number; };
  tags.value("useInductionTime", &DdtSection::waits, false, "1",
             "a cell burns only after the time that a flame takes to cross it")
      .value("IgnitionConst", of(&Induction::inwards), 1, "1",
             "time that a flame takes to cross a cell into the body, divided by its time along a surface",
             input::nonNegative())
      .value("PressureShift", of(&Induction::pressure), 1, "Pa", "p_0 in F_b (p / p_0)^F_c, the speed along a surface",
             input::positive())
      .value("PreexpoConst", of(&Induction::speed), 1, "m/s", "F_b", input::positive())
      .value("ExponentialConst", of(&Induction::exponent), 0, "1", "F_c");
}

void checkDdt(const DdtSection& read, const input::Element& section, input::Diagnostics& diagnostics) {
  if (!read.burnt.empty() && read.burnt != read.to)
    diagnostics.error(*section.child("burnMaterial"), "is not available; the burned body becomes <toMaterial>");
  if (read.waits)
    for (const char* tag : {"IgnitionConst", "PressureShift", "PreexpoConst", "ExponentialConst"})
      if (!section.child(tag)) diagnostics.error(section, std::string("missing tag <") + tag + "> in <DDT1>");
}

}  // namespace

const Schema<DdtSection>& ddtSchema() {
  static const Schema<DdtSection> schema = [] {
    Schema<DdtSection> tags("DDT1", "A body deflagrates at its surface and in cracks; a detonation ends the run.");
    addMaterials(tags);
    tags.value("burnMaterial", &DdtSection::burnt, "", "1", "may only repeat <toMaterial>");
    addSteadyBurn(tags, "ThresholdPressureSB");
    tags.required("ThresholdPressureJWL", &DdtSection::detonationPressure, "Pa",
                  "above this pressure the body would detonate, which ends the run", input::positive());
    for (const char* tag : {"G", "b", "E0"}) tags.ignored(tag, "belongs to the detonation, which ends the run");
    addInduction(tags);
    tags.value("useCrackModel", &DdtSection::burnsCracks, false, "1",
               "whether the body also burns in cracks that the gas can enter: p^2.84 p.crackRad^2 > 8e8");
    for (const char* tag : {"Gcrack", "nCrack", "CrackVolThreshold", "rho0"})
      tags.ignored(tag, "Uintah does not use it either");
    input::noteTag(tags, "adjust_IO_intervals", "outputs and checkpoints keep their intervals");
    return tags.check(checkDdt);
  }();
  return schema;
}

}  // namespace tushar::ice
