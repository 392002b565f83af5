#include "components/mpm/gas/material_input.hpp"

#include <fmt/format.h>

#include "core/input/geometry.hpp"

namespace tushar::mpm::gas {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

const Schema<GasObjectSection>& objectSchema() {
  static const Schema<GasObjectSection> schema = [] {
    Schema<GasObjectSection> tags("geom_object", "A body of material at the start.");
    input::addShape(tags, &GasObjectSection::where, &GasObjectSection::shape,
                    "shape of the body; several shapes form their union")
        .required("res", &GasObjectSection::res, "1", "particles per cell along x, y, z", input::between(1, 64))
        .value("velocity", &GasObjectSection::velocity, input::VectorExpression(), "m/s", "velocity at the start",
               input::WithoutTime())
        .optional("temperature", &GasObjectSection::temperature, "K",
                  "temperature at the start, instead of <pressure>: p = (gamma - 1) rho c_v T", input::positive(),
                  input::WithoutTime())
        .optional("density", &GasObjectSection::density, "kg/m^3", "density at the start, if not that of the material",
                  input::positive(), input::WithoutTime())
        .ours()
        .optional("pressure", &GasObjectSection::pressure, "Pa", "pressure at the start", input::positive(),
                  input::WithoutTime())
        .ours()
        .choice("placement", &GasObjectSection::placement,
                {{"midpoint", Placement::midpoint}, {"jittered", Placement::jittered}, {"random", Placement::random}},
                Placement::midpoint,
                "particles start at the centres of equal parts of a cell, at random points in these parts, or at "
                "random points in the cell")
        .ours()
        .value("seed", &GasObjectSection::seed, 0, "1", "seed of the random points", input::nonNegative())
        .ours()
        .check([](const GasObjectSection& object, const Element& element, Diagnostics& diagnostics) {
          if (object.pressure.has_value() == object.temperature.has_value())
            diagnostics.error(element, object.pressure ? "gives both <pressure> and <temperature>; keep one"
                                                       : "gives neither <pressure> nor <temperature>");
        });
    return tags;
  }();
  return schema;
}

const Schema<GasModelSection>& modelSchema() {
  static const Schema<GasModelSection> schema =
      Schema<GasModelSection>("constitutive_model", "The response of the material to deformation.")
          .location(&GasModelSection::where)
          .requiredChoiceAttribute("type", &GasModelSection::type,
                                   {{"ideal_gas", GasType::ideal}, {"stiffened_gas", GasType::stiffened}},
                                   "p = (gamma - 1) rho e, or (gamma - 1) rho e - gamma p_infinity")
          .value("gamma", &GasModelSection::gamma, 1.4, "1", "ratio of specific heats", input::greaterThan(1))
          .value("specific_heat", &GasModelSection::specificHeat, 717.5, "J/(kg K)",
                 "c_v, used by bodies with a <temperature>", input::positive())
          .value("p_infinity", &GasModelSection::pInfinity, 0, "Pa", "stiffness: 0 for air, about 6e8 for water",
                 input::nonNegative())
          .ours()
          .check([](const GasModelSection& model, const Element& element, Diagnostics& diagnostics) {
            if (model.type == GasType::ideal && model.pInfinity > 0)
              diagnostics.error(element, "an ideal_gas has no p_infinity; use type=\"stiffened_gas\"");
          });
  return schema;
}

const Schema<Relaxation>& relaxationSchema() {
  static const Schema<Relaxation> schema =
      Schema<Relaxation>("relaxation", "A source of heat, de/dt = -rate (e - internal_energy), integrated exactly.")
          .required("rate", &Relaxation::rate, "1/s", "rate", input::nonNegative())
          .ours()
          .required("internal_energy", &Relaxation::internalEnergy, "J/kg",
                    "internal energy towards which the gas relaxes", input::positive())
          .ours();
  return schema;
}

const Schema<GasSection>& materialSchema() {
  static const Schema<GasSection> schema =
      Schema<GasSection>("material", "A material and the bodies made of it.")
          .attributeValue("name", &GasSection::name, "gas", "1", "its name")
          .optional("density", &GasSection::density, "kg/m^3", "density at the start", input::positive())
          .requiredSection("constitutive_model", &GasSection::model, modelSchema())
          .section("relaxation", &GasSection::relaxation, relaxationSchema())
          .ours()
          .value("thermal_conductivity", &GasSection::thermalConductivity, 0, "W/(m K)",
                 "the gas method conducts no heat", input::between(0, 0))
          .value("specific_heat", &GasSection::specificHeat, 0, "J/(kg K)",
                 "accepted for compatibility with Uintah: the constitutive model has its own", input::nonNegative())
          .list("geom_object", &GasSection::objects, objectSchema(), "a body of material at the start", 1)
          .check([](const GasSection& material, const Element& element, Diagnostics& diagnostics) {
            const auto bodies = element.children("geom_object");
            for (std::size_t k = 0; k < material.objects.size(); ++k)
              if (!material.density && !material.objects[k].density)
                diagnostics.error(bodies[k], "has no <density>, and neither has its material");
          });
  return schema;
}

/// The initial pressure of a body: as given, or (gamma - 1) rho c_v T - p_inf if its temperature is given.
input::Expression pressureOf(const GasObjectSection& object, const input::Expression& density,
                             const GasModelSection& model) {
  if (object.pressure) return *object.pressure;
  const std::string text = fmt::format("({})*({})*({})-({})", (model.gamma - 1) * model.specificHeat, density.text(),
                                       object.temperature->text(), model.pInfinity);
  input::Expression pressure = *input::Expression::parse(text);
  pressure.readAt(object.temperature->where());
  return pressure;
}

}  // namespace

const Schema<GasProperties>& gasProperties() {
  static const Schema<GasList> list = Schema<GasList>("MPM", "The materials of the Material Point Method.")
                                          .list("material", &GasList::materials, materialSchema(), "a material", 1);
  static const Schema<GasProperties> schema = Schema<GasProperties>("MaterialProperties", "The materials of the scene.")
                                                  .requiredSection("MPM", &GasProperties::mpm, list);
  return schema;
}

Gas makeGas(const GasSection& material, bool isAlone) {
  Gas gas;
  gas.name = material.name;
  gas.gamma = material.model.gamma;
  gas.pInfinity = material.model.pInfinity;
  gas.carried = isAlone ? 0 : gas.pInfinity;
  gas.where = material.model.where;
  gas.relaxation = material.relaxation;
  for (const GasObjectSection& object : material.objects) {
    const input::Expression density = object.density ? *object.density : input::Expression(*material.density);
    gas.objects.push_back({object.where, object.shape, object.res, density, pressureOf(object, density, material.model),
                           object.velocity, object.placement, object.seed});
  }
  return gas;
}

}  // namespace tushar::mpm::gas
