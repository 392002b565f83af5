#include "components/ice/gas_schemas.hpp"

#include <fmt/format.h>

#include "components/euler/tasks/advance_mixture.hpp"
#include "core/input/geometry.hpp"
#include "core/input/refuse.hpp"
#include "core/solvers/input.hpp"

namespace tushar::ice {

using input::Diagnostics, input::Element, input::Schema;

namespace {

const Schema<AdvectionSection>& advectionSchema() {
  static const Schema<AdvectionSection> schema =
      Schema<AdvectionSection>("advection", "How the flow at the faces of cells is reconstructed.")
          .requiredChoiceAttribute(
              "type", &AdvectionSection::reconstruction,
              {{"FirstOrder", euler::Reconstruction::firstOrder}, {"SecondOrder", euler::Reconstruction::musclHancock}},
              "constant values in cells, or van Leer's slopes with a half step")
          .ignoredAttribute("useCompatibleFluxes", "all quantities of a cell are transported with its mass")
          .ignoredAttribute("compatibleFluxes", "all quantities of a cell are transported with its mass");
  return schema;
}

const Schema<StepSection>& stepSchema() {
  static const Schema<StepSection> schema =
      Schema<StepSection>("TimeStepControl", "What limits the steps.")
          .value(
              "knob_for_speedSound", &StepSection::soundSpeedKnob, StepSection().soundSpeedKnob, "1",
              "with an <ImplicitSolver>, the fraction of the speed of sound that limits the steps, in addition to the "
              "velocity and the acceleration of the gas",
              input::between(0, 1))
          .ignored("knob_for_diffusion", "viscosity and conduction are explicit, and always limit the steps")
          .choice("Scheme_for_delT_calc", &StepSection::limitsSum, {{"aggressive", false}, {"conservative", true}},
                  false,
                  "aggressive: <cfl> limits dt (|v| + c) / h along each axis, and the sum over axes is at most .8 or "
                  "<cfl>, or .5 "
                  "with bodies or an <ImplicitSolver>; conservative: <cfl> limits the sum");
  return schema;
}

const Schema<HypreSection>& hypreSchema() {
  static const Schema<HypreSection> schema = [] {
    Schema<HypreSection> tags("Parameters", "The settings of the pressure solve, in hypre's terms.");
    const std::string cg = "cg", multigrid = "multigrid";
    tags.foreignAttribute("variable", "implicitPressure")
        .choice("solver", &HypreSection::solver,
                {{"cg", cg},
                 {"pcg", cg},
                 {"conjugategradient", cg},
                 {"gmres", "gmres"},
                 {"amg", cg},
                 {"smg", cg},
                 {"pfmg", cg},
                 {"sparsemsg", cg},
                 {"hybrid", cg},
                 {"jacobi", cg}},
                cg, "conjugate gradients or GMRES; any other name means conjugate gradients")
        .choice("preconditioner", &HypreSection::preconditioner,
                {{"none", "none"},
                 {"jacobi", "jacobi"},
                 {"diagonal", "jacobi"},
                 {"pfmg", multigrid},
                 {"smg", multigrid},
                 {"sparsemsg", multigrid},
                 {"amg", multigrid}},
                multigrid, "multigrid for any multigrid method of hypre, the diagonal, or none")
        .value("tolerance", &HypreSection::tolerance, 1e-10, "1",
               "largest residual, relative to the right-hand side; at least 1e-12", input::positive())
        .value("maxiterations", &HypreSection::maxIterations, 1000, "1",
               "largest number of iterations; the solve fails if it needs more", input::atLeast(1));
    for (const char* tag : {"npre", "npost", "skip", "jump", "logging", "norm", "criteria", "relax_type",
                            "initial_tolerance", "setupFrequency", "updateCoefFrequency", "solveFrequency"})
      tags.ignored(tag, "belongs to hypre's own solvers");
    return tags;
  }();
  return schema;
}

const Schema<ImplicitSection>& implicitSchema() {
  static const Schema<ImplicitSection> schema = [] {
    Schema<ImplicitSection> tags("ImplicitSolver",
                                 "Steps that the speed of sound does not limit, since the pressure is implicit.");
    tags.location(&ImplicitSection::where)
        .section("Parameters", &ImplicitSection::hypre, hypreSchema(),
                 "the settings of the solve, as in Uintah's scenes")
        .section("Solver", &ImplicitSection::solver, solvers::linearSchema(),
                 "the settings of the solve, in PETSc's terms")
        .ours();
    for (const char* tag : {"max_outer_iterations", "outer_iteration_tolerance", "iters_before_timestep_restart",
                            "iters_before_timestep_recompute"})
      tags.ignored(tag, "a step has one solve: mass, momentum and energy are conserved for any pressure");
    return tags;
  }();
  return schema;
}

const Schema<PushSection>& pushSchema() {
  static const Schema<PushSection> schema =
      Schema<PushSection>("fixedPressureGradient",
                          "A uniform force per volume, given as the pressure drop per length along each axis.")
          .value("x_dir", &PushSection::x, 0, "N/m^3", "along x")
          .value("y_dir", &PushSection::y, 0, "N/m^3", "along y")
          .value("z_dir", &PushSection::z, 0, "N/m^3", "along z");
  return schema;
}

const Schema<EddiesSection>& eddiesSchema() {
  static const Schema<EddiesSection> schema =
      Schema<EddiesSection>("turbulence", "Viscosity of eddies smaller than cells.")
          .location(&EddiesSection::where)
          .requiredChoiceAttribute("model", &EddiesSection::model, {{"Smagorinsky", "Smagorinsky"}},
                                   "adds rho (C d)^2 sqrt(2 S:S) to mu, where d is the cube root of a cell's volume "
                                   "and S the symmetric part of the velocity gradient")
          .required("model_constant", &EddiesSection::constant, "1", "C, .1 to .2", input::nonNegative())
          .ignored("filter_width", "it is the cube root of a cell's volume, as in Uintah")
          .ignored("turb_Pr", "eddies do not mix heat, as in Uintah");
  return schema;
}

const Schema<HeatingSection>& heatingSchema() {
  static const Schema<HeatingSection> schema =
      Schema<HeatingSection>("ADD_HEAT", "Heat that is added to gases everywhere, for some time.")
          .location(&HeatingSection::where)
          .required("add_heat_matls", &HeatingSection::materials, "1", "indices of the materials; bodies come first")
          .required("add_heat_coeff", &HeatingSection::perMass, "W/kg",
                    "heat per mass and time for each of these materials")
          .required("add_heat_t_start", &HeatingSection::start, "s", "time at which the heating begins")
          .required("add_heat_t_final", &HeatingSection::end, "s", "time at which the heating ends");
  return schema;
}

const Schema<IceSection>& iceSchema() {
  static const Schema<IceSection> schema = [] {
    Schema<IceSection> tags("ICE", "The method.");
    tags.requiredSection("advection", &IceSection::advection, advectionSchema())
        .value("explicit", &IceSection::isExplicit, false, "1",
               "steps are explicit, even if there is an <ImplicitSolver>")
        .ours()
        .optional("thin_walls", &IceSection::thinWalls, "1",
                  "true: bodies block the gas even if thinner than a cell, but oblique walls are rougher; false: "
                  "bodies thinner than 1.25 cells leak")
        .ours()
        .section("ImplicitSolver", &IceSection::implicit, implicitSchema(),
                 "the pressure is implicit, so that the speed of sound does not limit the steps; <explicit> switches "
                 "this off")
        .section("TimeStepControl", &IceSection::steps, stepSchema(), "the steps of an <ImplicitSolver>");
    input::noteTag(tags, "max_iteration_equilibration", "the pressure follows from density and energy");
    input::noteTag(tags, "ClampSpecificVolume", "the specific volume follows from the density");
    tags.section("customInitialization", &IceSection::start, customStartSchema(),
                 "the initial state, given by formulas");
    tags.section("fixedPressureGradient", &IceSection::push, pushSchema(), "a force that drives a flow")
        .section("turbulence", &IceSection::eddies, eddiesSchema(), "viscosity of eddies smaller than cells")
        .section("ADD_HEAT", &IceSection::heating, heatingSchema(), "heat from outside");
    input::refuseTag(tags, "wallShearStress", "the gas does not slip along a wall with a Velocity");
    tags.optional(
        "applyHydrostaticPressure", &IceSection::isHydrostatic, "1",
        "whether, with gravity g, the Pressure of sides is that at the centre x0 of the first cell, and rises "
        "by rho g (x - x0), where rho is the initial density of the gas with <isSurroundingMatl>; by default, "
        "if there is one");
    return tags;
  }();
  return schema;
}

void readState(GasMaterial& material, const Element& element, Diagnostics& diagnostics) {
  material.state = readEquationOfState(element, diagnostics);
}

const Schema<GasBody>& bodySchema() {
  static const Schema<GasBody> schema = [] {
    Schema<GasBody> tags("geom_object",
                         "The gas of a region at the start; where regions overlap, the last one applies.");
    input::addShape(tags, &GasBody::where, &GasBody::shape,
                    "the region: cells whose centre is inside; several shapes form their union")
        .required("density", &GasBody::density, "kg/m^3", "density at the start", input::positive(),
                  input::WithoutTime())
        .required("temperature", &GasBody::temperature, "K", "temperature at the start", input::positive(),
                  input::WithoutTime())
        .value("velocity", &GasBody::velocity, input::VectorExpression(), "m/s", "velocity at the start",
               input::WithoutTime())
        .optional("volumeFraction", &GasBody::share, "1",
                  "volume fraction of the gas, if several gases share the region; a single gas fills it",
                  input::between(0, 1), input::WithoutTime())
        .optional("pressure", &GasBody::pressure, "Pa", "has no effect: it follows from density and temperature")
        .value(
            "res", &GasBody::points, Index3::filled(1), "1",
            "with several gases, the number of points of a cell along each axis at which regions are found: a cell "
            "that a surface cuts has a share of each gas; the most of all regions counts. A single gas is that at the "
            "centre",
            input::atLeast(1))
        .ignoredAttribute("name", "a note for readers");
    return tags;
  }();
  return schema;
}

const Schema<AirSection>& airSchema() {
  static const Schema<AirSection> schema =
      Schema<AirSection>("SpecificHeatModel", "A c_v that depends on the temperature.")
          .location(&AirSection::where)
          .requiredChoiceAttribute("type", &AirSection::type, {{"airNasa", "airNasa"}},
                                   "that of 1 mol of O2 with 3.76 mol of N2 by the NASA polynomials, 200 to 3500 K")
          .optional("gas_constant", &AirSection::gasConstant, "J/(kg K)", "R; by default (gamma - 1) specific_heat",
                    input::positive());
  return schema;
}

void checkMaterial(const GasMaterial& read, const Element& element, Diagnostics& diagnostics) {
  if (read.air && read.state.kind != EquationOfState::Kind::ideal)
    diagnostics.error(*element.child("SpecificHeatModel"), "belongs to a gas of type ideal_gas");
}

const Schema<GasMaterial>& materialSchema() {
  static const Schema<GasMaterial> schema = [] {
    Schema<GasMaterial> tags("material", "A gas, and where it is at the start.");
    tags.attributeValue("name", &GasMaterial::name, "", "1", "its name")
        .ignoredAttribute("index", "gases are numbered in the order of the scene")
        .custom("EOS", readState, {"EOS"},
                "the equation of state, by its type: ideal_gas p = (gamma - 1) c_v rho T; stiffened_gas; "
                "hard_sphere_gas; for explosives, liquids and dense gases JWL, JWLC, Murnaghan, Gruneisen, "
                "Thomsen_Hartka_water and TST, for which <gamma> has no effect")
        .forms({{.tags = {"EOS"}, .demands = {{"type", equationsOfState()}}, .atLeast = 1, .repeats = false}})
        .required("gamma", &GasMaterial::gamma, "1", "ratio of specific heats, more than 1", input::atLeast(1))
        .required("specific_heat", &GasMaterial::specificHeat, "J/(kg K)", "c_v", input::positive())
        .value("dynamic_viscosity", &GasMaterial::viscosity, 0, "Pa s", "shear viscosity; there is no bulk viscosity",
               input::nonNegative())
        .value("thermal_conductivity", &GasMaterial::conductivity, 0, "W/(m K)", "thermal conductivity",
               input::nonNegative())
        .list("geom_object", &GasMaterial::bodies, bodySchema(),
              "the gas of a region at the start; where regions overlap, the last one applies; regions must cover the "
              "grid",
              1)
        .value("isSurroundingMatl", &GasMaterial::isAround, false, "1",
               "whether it is the gas around the others; see <applyHydrostaticPressure>")
        .ignored("tiny_rho", "it has no effect");
    input::refuseSwitch(tags, "includeFlowWork", "the total energy is conserved, including all work");
    tags.section("SpecificHeatModel", &GasMaterial::air, airSchema(), "a c_v that depends on the temperature");
    tags.custom(
            "dynamicViscosityModels",
            [](GasMaterial& material, const Element& element, Diagnostics& diagnostics) {
              readViscosityModels(material.varying, element, diagnostics);
            },
            {"dynamicViscosityModels"},
            "viscosities instead of <dynamic_viscosity>; if several apply, the last one is used",
            describeViscosityModels)
        .forms({{.tags = {"dynamicViscosityModels"}, .repeats = false}});
    return tags.check(checkMaterial);
  }();
  return schema;
}

const Schema<Exchange>& coefficientsSchema() {
  static const Schema<Exchange> schema =
      Schema<Exchange>("exchange_coefficients", "One number per pair of materials: 0 and 1, 0 and 2, …, 1 and 2, …")
          .location(&Exchange::where)
          .value("momentum", &Exchange::momentum, {}, "kg/(m^3 s)", "exchange of momentum", input::nonNegative())
          .value("heat", &Exchange::heat, {}, "W/(m^3 K)", "exchange of heat", input::nonNegative())
          .ignoredAttribute("type", "coefficients are constant");
  return schema;
}

const Schema<CoefficientSection>& coefficientModelSchema() {
  static const Schema<CoefficientSection> schema = [] {
    Schema<CoefficientSection> tags("CoefficientModel", "Exchange coefficients that vary.");
    tags.choice("heat", &CoefficientSection::heat, {{"constant", "constant"}, {"linearVariation", "linearVariation"}},
                "constant",
                "the numbers of <exchange_coefficients>, or the larger of r^2 and 1/r^2, where r is the ratio of the "
                "two masses in the cell; the result is limited to 1e5 to 1e12");
    input::refuseTag(tags, "momentum", "bodies are walls to the gas, and gases share one velocity");
    return tags;
  }();
  return schema;
}

const Schema<ExchangeModelSection>& exchangeModelSchema() {
  static const Schema<ExchangeModelSection> schema = [] {
    Schema<ExchangeModelSection> tags("Model", "How bodies and gases exchange momentum and heat.");
    tags.requiredChoiceAttribute("type", &ExchangeModelSection::type, {{"scalar", "scalar"}, {"slip", "slip"}},
                                 "by <exchange_coefficients>; slip: the same, since <useSlipCoeffs> can only be false")
        .value("useSlipCoeffs", &ExchangeModelSection::slips, true, "1",
               "for slip: false; coefficients from the mean free path of a gas are not available");
    for (const char* tag :
         {"fluidMatlIndex", "solidMatlIndex", "momentum_accommodation_coeff", "thermal_accommodation_coeff"})
      tags.ignored(tag, "belongs to useSlipCoeffs");
    return tags.check([](const ExchangeModelSection& read, const Element& model, Diagnostics& diagnostics) {
      if (read.type == "slip" && read.slips)
        diagnostics.error(model.child("useSlipCoeffs").value_or(model),
                          "slip by the mean free path is not available: viscous gas sticks to walls; set "
                          "<useSlipCoeffs> to false, or remove the model");
    });
  }();
  return schema;
}

const Schema<ExchangeSection>& exchangeSchema() {
  static const Schema<ExchangeSection> schema = [] {
    Schema<ExchangeSection> tags("exchange_properties", "The exchange between materials.");
    tags.requiredSection("exchange_coefficients", &ExchangeSection::coefficients, coefficientsSchema());
    tags.value("do_convective_heat_transfer", &ExchangeSection::convects, false, "1",
               "whether the surface of a body also exchanges heat with the fluid in front of it")
        .optional("convective_fluid", &ExchangeSection::fluid, "1", "the number of this fluid", input::nonNegative())
        .optional("convective_solid", &ExchangeSection::solid, "1", "the number of this body", input::nonNegative());
    tags.section("CoefficientModel", &ExchangeSection::model, coefficientModelSchema(),
                 "what the coefficients depend on");
    tags.section("Model", &ExchangeSection::exchangeModel, exchangeModelSchema(), "how materials exchange momentum");
    return tags.check([](const ExchangeSection& read, const Element& element, Diagnostics& diagnostics) {
      for (const auto& [name, number] :
           {std::pair("convective_fluid", read.fluid), std::pair("convective_solid", read.solid)})
        if (read.convects && !number)
          diagnostics.error(element, fmt::format("missing tag <{}>: do_convective_heat_transfer is true", name));
        else if (!read.convects && number)
          diagnostics.note(*element.child(name), "does nothing: do_convective_heat_transfer is false");
    });
  }();
  return schema;
}

}  // namespace

const Schema<CfdSection>& cfdSchema() {
  static const Schema<CfdSection> schema =
      Schema<CfdSection>("CFD", "The flow of the gas.")
          .required("cfl", &CfdSection::cfl, "1",
                    "dt times the largest (|v| + c) / h along an axis (TimeStepControl/Scheme_for_delT_calc)",
                    input::positive(), input::atMost(1))
          .requiredSection("ICE", &CfdSection::ice, iceSchema());
  return schema;
}

const Schema<PropertiesSection>& propertiesSchema() {
  static const Schema<GasMaterials> list =
      Schema<GasMaterials>("ICE", "The gas.")
          .list("material", &GasMaterials::materials, materialSchema(), "a gas; several share the grid", 1)
          .check([](const GasMaterials& read, const Element& element, Diagnostics& diagnostics) {
            if (read.materials.size() > euler::kMostGases)
              diagnostics.error(element.children("material")[euler::kMostGases],
                                fmt::format("more than {} gases are not available", euler::kMostGases));
          });
  static const Schema<PropertiesSection> schema =
      Schema<PropertiesSection>("MaterialProperties", "The materials of the scene.")
          .requiredSection("ICE", &PropertiesSection::ice, list)
          .section("exchange_properties", &PropertiesSection::exchange, exchangeSchema())
          .ignored("MPM", "the solids, if there are any");
  return schema;
}

const Schema<ConstantsSection>& constantsSchema() {
  static const Schema<ConstantsSection> schema =
      Schema<ConstantsSection>("PhysicalConstants", "Physical constants.")
          .value("gravity", &ConstantsSection::gravity, Vec3::Zero(), "m/s^2", "acceleration of gravity")
          .value("reference_pressure", &ConstantsSection::referencePressure, 0, "Pa",
                 "the pressure on solids where there is no gas; a gas alone does not depend on it",
                 input::nonNegative());
  return schema;
}

}  // namespace tushar::ice
