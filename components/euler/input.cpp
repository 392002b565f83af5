#include "components/euler/input.hpp"

#include <fmt/format.h>

#include "components/euler/euler.hpp"
#include "components/euler/flat_axes.hpp"
#include "core/simulation/by_dimension.hpp"

namespace tushar::euler {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

const Schema<GasObject>& objectSchema() {
  static const Schema<GasObject> schema = [] {
    Schema<GasObject> tags("geom_object",
                           "The gas of a region at the start; where regions overlap, the last one applies.");
    tags.allOurs();
    input::addShape(tags, &GasObject::where, &GasObject::shape,
                    "the region: cells whose centre is inside; several shapes form their union")
        .required("density", &GasObject::density, "kg/m^3", "density at the start", input::positive(),
                  input::WithoutTime())
        .value("velocity", &GasObject::velocity, input::VectorExpression(), "m/s", "velocity at the start",
               input::WithoutTime())
        .required("pressure", &GasObject::pressure, "Pa", "pressure at the start; above -p_infinity",
                  input::WithoutTime());
    return tags;
  }();
  return schema;
}

enum class GasType { ideal, stiffened };
struct GasSection {
  GasType type = GasType::ideal;
  double gamma = 1.4, pInfinity = 0;
};
const Schema<GasSection>& gasSchema() {
  static const Schema<GasSection> schema =
      Schema<GasSection>("gas", "p = (gamma - 1) rho epsilon - gamma p_infinity.")
          .allOurs()
          .choiceAttribute("type", &GasSection::type,
                           {{"ideal_gas", GasType::ideal}, {"stiffened_gas", GasType::stiffened}}, GasType::ideal,
                           "an ideal gas has p_infinity = 0")
          .value("gamma", &GasSection::gamma, 1.4, "1", "ratio of specific heats", input::greaterThan(1))
          .value("p_infinity", &GasSection::pInfinity, 0, "Pa", "stiffness: 0 for air, about 6e8 for water",
                 input::nonNegative())
          .check([](const GasSection& gas, const Element& element, Diagnostics& diagnostics) {
            if (gas.type == GasType::ideal && gas.pInfinity > 0)
              diagnostics.error(element, "an ideal_gas has no p_infinity; use type=\"stiffened_gas\"");
          });
  return schema;
}

struct EulerSection {
  FluxKind flux = FluxKind::hllc;
  Reconstruction reconstruction = Reconstruction::musclHancock;
  Limiter limiter = Limiter::vanLeer;
  double cfl = 0.8;
  GasSection gas;
  std::vector<GasObject> objects;
};
const Schema<EulerSection>& schema() {
  static const Schema<EulerSection> schema =
      Schema<EulerSection>("Euler", "Gas dynamics by finite volumes: Godunov's method and MUSCL-Hancock.")
          .allOurs()
          .choice("flux", &EulerSection::flux, {{"hllc", FluxKind::hllc}, {"exact", FluxKind::exact}}, FluxKind::hllc,
                  "the Riemann solver at faces: three waves, or the exact solution (slow)")
          .choice("reconstruction", &EulerSection::reconstruction,
                  {{"first_order", Reconstruction::firstOrder}, {"muscl_hancock", Reconstruction::musclHancock}},
                  Reconstruction::musclHancock,
                  "constant values in cells, or slopes in cells with a half step (second order)")
          .choice("limiter", &EulerSection::limiter,
                  {{"minmod", Limiter::minmod}, {"van_leer", Limiter::vanLeer}, {"mc", Limiter::mc}}, Limiter::vanLeer,
                  "limiter of the slopes, from the most to the least diffusive")
          .value("cfl", &EulerSection::cfl, 0.8, "1", "dt times the largest sum over axes of (|v| + c) / h",
                 input::positive(), input::atMost(1))
          .section("gas", &EulerSection::gas, gasSchema())
          .list("geom_object", &EulerSection::objects, objectSchema(),
                "the gas of a region at the start; where regions overlap, the last one applies; the "
                "regions must cover the grid",
                1);
  return schema;
}

/// Checks the values prescribed at faces: Dirichlet values, with a positive density and p + p_infinity.
void checkBoundaries(const Element& root, double pInfinity, Diagnostics& diagnostics) {
  for (const Element& condition : simulation::boundaryConditions(root)) {
    const std::string label = condition.attribute("label").value_or(""), var = condition.attribute("var").value_or("");
    if (label != grid::symmetric.name && var != nameOf(BoundaryKind::dirichlet))
      diagnostics.error(condition, fmt::format("var: found '{}', expected 'Dirichlet' for {} of inflowing gas; at a "
                                               "face without conditions, gas flows out",
                                               var, label));
    const auto text = condition.child("value");
    const auto value = text ? input::parse<double>(text->text()) : input::parse<double>("1");
    const auto limit = [&](const grid::BoundaryVariable& of, double least, const std::string& unit) {
      if (label == of.name && value && !input::satisfies(*value, input::greaterThan(least)))
        diagnostics.error(condition, "value: " + input::violation(text->text(), input::greaterThan(least), unit));
    };
    limit(boundary::density, 0, "kg/m^3");
    limit(boundary::pressure, 0 - pInfinity, "Pa");
  }
}

}  // namespace

simulation::ComponentKind kind() {
  simulation::ComponentKind kind;
  kind.name = "euler";
  kind.sentence = "finite-volume gas dynamics: Godunov's method and MUSCL-Hancock";
  kind.sections = {"Euler"};
  kind.takesLevels = true;
  kind.takesPartsOfSides = true;
  kind.takesFormulasAtSides = true;
  kind.boundaryLabels = {grid::symmetric, boundary::density, boundary::velocity, boundary::pressure};
  kind.describe = [](std::ostream& out) { schema().describe(out); };
  kind.forms = [] { return std::vector<std::vector<simulation::SectionForm>>{{{"Euler", &schema()}}}; };
  kind.read = [](const Element& root, Diagnostics& diagnostics) -> simulation::MakeComponent {
    const std::size_t before = diagnostics.size();
    const EulerSection read = simulation::readSection(root, schema(), diagnostics);
    checkBoundaries(root, read.gas.pInfinity, diagnostics);
    simulation::refuseOtherMaterials(root, 1, diagnostics);
    if (diagnostics.size() > before) return {};
    Settings settings;
    settings.where = root.child("Euler")->where();
    settings.method = {read.flux, read.reconstruction, read.limiter};
    settings.courant.number = read.cfl;
    settings.gas = {read.gas.gamma, read.gas.pInfinity};
    settings.objects = read.objects;
    std::vector<GivenVector> velocities = velocitiesAtSides(root);
    for (GivenVector& one : velocitiesAtStart(settings, "Euler/geom_object")) velocities.push_back(std::move(one));
    return [settings, velocities](const Level& level) {
      refuseAlongFlatAxes(level, velocities);
      return simulation::makeByDimension<Euler>(level, settings);
    };
  };
  return kind;
}

}  // namespace tushar::euler
