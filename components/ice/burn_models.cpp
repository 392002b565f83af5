#include "components/ice/burn_model.hpp"

// The models of bodies that burn, as they are written.

namespace tushar::ice {

using input::Schema;

namespace {

template <class Section>
void addMaterials(Schema<Section>& tags) {
  tags.location(&Section::where)
      .required("fromMaterial", &Section::from, "1", "name of the body that burns")
      .required("toMaterial", &Section::to, "1", "name of the gas that it becomes");
}

}  // namespace

const Schema<SimpleBurnSection>& simpleBurnSchema() {
  static const Schema<SimpleBurnSection> schema = [] {
    Schema<SimpleBurnSection> tags("Simple_Burn", "The surface of a body burns at a rate that its pressure gives.");
    addMaterials(tags);
    tags.value("Active", &SimpleBurnSection::isActive, true, "1", "whether it burns at all")
        .required("ThresholdTemp", &SimpleBurnSection::thresholdTemperature, "K",
                  "a surface burns where something beside it is hotter", input::nonNegative())
        .required("ThresholdPressure", &SimpleBurnSection::thresholdPressure, "Pa",
                  "and where the gas has more pressure", input::nonNegative())
        .required("Enthalpy", &SimpleBurnSection::enthalpy, "J/kg", "heat of the reaction")
        .required("BurnCoeff", &SimpleBurnSection::coefficient, "kg/(m^2 s)", "rate at <refPressure>",
                  input::nonNegative())
        .required("refPressure", &SimpleBurnSection::reference, "Pa", "rate = BurnCoeff (p / refPressure)^0.778",
                  input::positive());
    return tags;
  }();
  return schema;
}

}  // namespace tushar::ice
