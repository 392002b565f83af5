#include "components/ice/mixture/binary_properties.hpp"

#include "core/input/geometry.hpp"
#include "core/input/geometry/combined.hpp"
#include "core/input/refuse.hpp"

namespace tushar::ice {

using input::Schema;

namespace {

/// The tag `<constants>`, as written in the scene.
struct TwoConstants {
  double rhoA = 0, rhoB = 0, cvA = 0, cvB = 0, rA = 0, rB = 0;
  double viscosityA = 0, viscosityB = 0, conductivityA = 0, conductivityB = 0;
};

/// The tag `<scalar>`: the mass fraction of the second gas.
struct FractionSection {
  TwoConstants constants;
  std::vector<FractionRegion> regions;
};

/// The tag that has the name of the model.
struct BinarySection {
  Location where;
  std::string material;
  FractionSection scalar;
};

const Schema<TwoConstants>& constantsOfTwo() {
  using Read = TwoConstants;
  static const Schema<Read> schema = [] {
    Schema<Read> tags("constants", "The properties of the gases A and B.");
    tags.required("rho_A", &Read::rhoA, "kg/m^3", "density of A at the start", input::positive())
        .required("rho_B", &Read::rhoB, "kg/m^3", "density of B at the start", input::positive())
        .required("cv_A", &Read::cvA, "J/(kg K)", "c_v of A", input::positive())
        .required("cv_B", &Read::cvB, "J/(kg K)", "c_v of B", input::positive())
        .required("R_A", &Read::rA, "J/(kg K)", "gas constant of A", input::positive())
        .required("R_B", &Read::rB, "J/(kg K)", "gas constant of B", input::positive())
        .value("dynamic_viscosity_A", &Read::viscosityA, 0, "Pa s", "viscosity of A", input::nonNegative())
        .value("dynamic_viscosity_B", &Read::viscosityB, 0, "Pa s", "viscosity of B", input::nonNegative())
        .value("thermalCond_A", &Read::conductivityA, 0, "W/(m K)", "conductivity of A", input::nonNegative())
        .value("thermalCond_B", &Read::conductivityB, 0, "W/(m K)", "conductivity of B", input::nonNegative())
        .ignored("AMR_Refinement_Criteria",
                 "a <Variable> in <Refinement_Criteria_Thresholds> determines where cells are finer");
    const std::vector<std::string> none{"0", "0.0", "0.", "0.0e0"};
    input::refuseOtherValues(tags, "diffusivity", none, "the gases do not diffuse into each other");
    input::refuseOtherValues(tags, "initialize_diffusion_knob", none, "give more regions, each with its <scalar>");
    return tags;
  }();
  return schema;
}

const Schema<FractionSection>& fractionSchema() {
  static const Schema<FractionRegion> region = [] {
    Schema<FractionRegion> tags("geom_object", "A region at the start; where regions overlap, the last one counts.");
    input::addShape(tags, &FractionRegion::where, &FractionRegion::shape, "the region: cells whose centre is inside")
        .required("scalar", &FractionRegion::fraction, "1", "mass fraction of B in the region", input::nonNegative(),
                  input::atMost(1));
    return tags;
  }();
  static const Schema<FractionSection> schema =
      Schema<FractionSection>("scalar", "The mass fraction of B.")
          .requiredSection("constants", &FractionSection::constants, constantsOfTwo())
          .list("geom_object", &FractionSection::regions, region, "a region; outside the regions there is only A", 1)
          .ignoredAttribute("name", "the mass fraction is saved as scalar-f")
          .ignored("test_conservation", "TotalMass-B is computed if it is saved");
  return schema;
}

const Schema<BinarySection>& binarySchema() {
  static const Schema<BinarySection> schema =
      Schema<BinarySection>("BinaryProperties", "Two ideal gases at one temperature, as properties of one gas.")
          .location(&BinarySection::where)
          .value("material", &BinarySection::material, "", "1", "the gas that has these properties")
          .requiredSection("scalar", &BinarySection::scalar, fractionSchema());
  return schema;
}

/// One of the two gases in the part of `region` that belongs to an object of the scene; `part` is its mass fraction.
euler::GasObject objectOf(const euler::GasObject& common, const FractionRegion& region, const BinaryProperties& of,
                          const BinaryGas& gas, double part) {
  const double f = region.fraction;
  const double density = 1 / ((1 - f) / of.a.density + f / of.b.density);
  const double gasConstant = (1 - f) * of.a.gasConstant + f * of.b.gasConstant;
  const auto number = [](double value) { return input::Expression(value); };
  euler::GasObject object = common;
  object.where = region.where;
  object.shape = std::make_shared<const input::Intersection>(std::vector<input::PiecePtr>{common.shape, region.shape});
  // Both gases have the same temperature and pressure: m R T = z p, rho_k R_k = rho R.
  object.density = number(density * gasConstant / gas.gasConstant);
  object.share = number(part * gas.gasConstant / gasConstant);
  object.points = Index3::filled(1);  // it is one gas, whose mass fraction is that at the centre
  return object;
}

}  // namespace

std::vector<euler::Settings> BinaryProperties::gases(const euler::Settings& common) const {
  std::vector<euler::Settings> both(2, common);
  for (std::size_t k = 0; k < 2; ++k) {
    const BinaryGas& gas = k == 0 ? a : b;
    both[k].name = k == 0 ? "A" : "B";
    both[k].gas.gamma = 1 + gas.gasConstant / gas.specificHeat;
    both[k].gas.specificHeat = gas.specificHeat;
    both[k].objects.clear();
    both[k].objectsMayBeEmpty = true;
    const auto add = [&](const euler::GasObject& one, const FractionRegion& region) {
      const double part = k == 0 ? 1 - region.fraction : region.fraction;
      both[k].objects.push_back(objectOf(one, region, *this, gas, part));
    };
    for (const euler::GasObject& one : common.objects) add(one, {one.where, one.shape, 0});
    for (const FractionRegion& region : regions)
      for (const euler::GasObject& one : common.objects) add(one, region);
  }
  return both;
}

BinaryProperties readBinaryProperties(const input::Element& tag, input::Diagnostics& diagnostics) {
  const BinarySection read = binarySchema().read(tag, diagnostics);
  const TwoConstants& of = read.scalar.constants;
  return {.where = read.where,
          .material = read.material,
          .a = {of.rhoA, of.cvA, of.rA, of.viscosityA, of.conductivityA},
          .b = {of.rhoB, of.cvB, of.rB, of.viscosityB, of.conductivityB},
          .regions = read.scalar.regions};
}

void describeBinaryProperties(std::ostream& out, int indent) { binarySchema().describe(out, indent); }

}  // namespace tushar::ice
