#include "components/ice/burn_model.hpp"

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

}  // namespace

const Schema<SimpleBurnSection>& simpleBurnSchema() {
  static const Schema<SimpleBurnSection> schema = [] {
    Schema<SimpleBurnSection> tags("Simple_Burn",
                                   "The surface of a body burns at a rate that depends on the pressure.");
    addMaterials(tags);
    tags.value("Active", &SimpleBurnSection::isActive, true, "1", "whether the body burns")
        .required("ThresholdTemp", &SimpleBurnSection::thresholdTemperature, "K",
                  "a surface burns where the gas or a body at it is hotter than this", input::nonNegative())
        .required("ThresholdPressure", &SimpleBurnSection::thresholdPressure, "Pa",
                  "and where the pressure of the gas is higher than this", input::nonNegative())
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
    using Read = SteadyBurnSection;
    const auto of = [](double SteadyBurn::*number) -> double Read::* { return number; };
    Schema<Read> tags("Steady_Burn",
                      "The surface of a body burns as a steady deflagration (Ward, Son & Brewster 1998).");
    addMaterials(tags);
    tags.required("IdealGasConst", of(&SteadyBurn::gasConstant), "J/(mol K)", "R", input::positive())
        .required("PreExpCondPh", of(&SteadyBurn::solidFactor), "1/s", "factor of the reaction in the solid",
                  input::positive())
        .required("ActEnergyCondPh", of(&SteadyBurn::activationEnergy), "J/mol", "its activation energy",
                  input::positive())
        .required("PreExpGasPh", of(&SteadyBurn::gasFactor), "m^3/(kg s K^2)", "factor of the reaction in the gas",
                  input::positive())
        .required("CondPhaseHeat", of(&SteadyBurn::solidHeat), "J/kg", "heat of the reaction in the solid",
                  input::nonNegative())
        .required("GasPhaseHeat", of(&SteadyBurn::gasHeat), "J/kg", "heat of the reaction in the gas",
                  input::nonNegative())
        .required("HeatConductGasPh", of(&SteadyBurn::gasConductivity), "W/(m K)", "thermal conductivity of the gas",
                  input::positive())
        .required("HeatConductCondPh", of(&SteadyBurn::solidConductivity), "W/(m K)",
                  "thermal conductivity of the solid", input::positive())
        .required("SpecificHeatBoth", of(&SteadyBurn::specificHeat), "J/(kg K)",
                  "specific heat of solid and gas, for the rate", input::positive())
        .required("MoleWeightGasPh", of(&SteadyBurn::molarMass), "kg/mol", "molar mass of the gas", input::positive())
        .required("ThresholdPressure", &Read::thresholdPressure, "Pa",
                  "a surface burns where the pressure of the gas is higher than this", input::nonNegative())
        .required("IgnitionTemp", &Read::ignitionTemperature, "K",
                  "and where the gas or a body at it is hotter than this", input::nonNegative())
        .ignored("BoundaryParticles", "surfaces are where the gas has walls");
    return tags;
  }();
  return schema;
}

}  // namespace tushar::ice
