#include "components/ice/equation_of_state.hpp"

#include <algorithm>
#include <utility>

namespace tushar::ice {

using input::Diagnostics;
using input::Element;
using input::Schema;
using Kind = EquationOfState::Kind;

namespace {

const Schema<EquationOfState>& idealSchema() {
  static const Schema<EquationOfState> schema = [] {
    Schema<EquationOfState> tags("EOS", "p = (gamma - 1) c_v rho T.");
    tags.foreignAttribute("type", "ideal_gas");
    for (const char* tag : {"A", "B", "C", "R1", "R2", "om", "rho0"})
      tags.ignored(tag, "belongs to the types JWL and JWLC");
    tags.ignored("gas_constant", "it is (gamma - 1) c_v");
    return tags;
  }();
  return schema;
}

const Schema<EquationOfState>& stiffenedSchema() {
  static const Schema<EquationOfState> schema =
      Schema<EquationOfState>("EOS", "p = (gamma - 1) c_v rho T - p_infinity.")
          .foreignAttribute("type", "stiffened_gas")
          .required("p_infinity", &EquationOfState::pInfinity, "Pa", "stiffness: about 6e8 for water",
                    input::nonNegative())
          .ours();
  return schema;
}

/// The tags that JWL and JWLC share.
Schema<euler::ColdCurve> jwlTags(const char* type, const char* sentence) {
  Schema<euler::ColdCurve> tags("EOS", sentence);
  tags.foreignAttribute("type", type)
      .required("A", &euler::ColdCurve::a, "Pa", "factor of exp(-R1 rho0 / rho)", input::nonNegative())
      .required("B", &euler::ColdCurve::b, "Pa", "factor of exp(-R2 rho0 / rho)", input::nonNegative())
      .required("R1", &euler::ColdCurve::r1, "1", "factor in the first exponent", input::positive())
      .required("R2", &euler::ColdCurve::r2, "1", "factor in the second exponent", input::positive())
      .required("om", &euler::ColdCurve::omega, "1", "omega, the Grüneisen parameter", input::positive())
      .required("rho0", &euler::ColdCurve::density, "kg/m^3", "density of the explosive", input::positive());
  return tags;
}
const Schema<euler::ColdCurve>& jwlSchema() {
  static const Schema<euler::ColdCurve> schema =
      std::move(jwlTags("JWL", "p = A exp(-R1 rho0 / rho) + B exp(-R2 rho0 / rho) + om rho c_v T.")
                    .ignored("C", "belongs to JWLC"));
  return schema;
}
const Schema<euler::ColdCurve>& jwlcSchema() {
  static const Schema<euler::ColdCurve> schema = std::move(
      jwlTags("JWLC", "p = A exp(-R1 rho0 / rho) + B exp(-R2 rho0 / rho) + C (rho / rho0)^(1 + om), at any T.")
          .required("C", &euler::ColdCurve::c, "Pa", "factor of the power of rho", input::nonNegative()));
  return schema;
}
const Schema<euler::ColdCurve>& murnaghanSchema() {
  static const Schema<euler::ColdCurve> schema =
      Schema<euler::ColdCurve>(
          "EOS", "p = P0 + ((rho / rho0)^n - 1) / (n K); for rho < rho0, p = P0 (rho / rho0)^(1 / (K P0)).")
          .foreignAttribute("type", "Murnaghan")
          .required("n", &euler::ColdCurve::exponent, "1", "slope of the bulk modulus", input::positive())
          .required("K", &euler::ColdCurve::compressibility, "1/Pa", "compressibility at rho0", input::positive())
          .required("rho0", &euler::ColdCurve::density, "kg/m^3", "density at P0", input::positive())
          .required("P0", &euler::ColdCurve::pressureThere, "Pa", "pressure at rho0", input::positive());
  return schema;
}
/// The tags of Gruneisen.
struct GruneisenTags {
  double a = 0, b = 0, density = 0, pressure = 0, temperature = 0;
};
const Schema<GruneisenTags>& gruneisenSchema() {
  static const Schema<GruneisenTags> schema =
      Schema<GruneisenTags>("EOS", "p = P0 + A (rho / rho0 - 1) + B (T - T0).")
          .foreignAttribute("type", "Gruneisen")
          .required("A", &GruneisenTags::a, "Pa", "A, the slope of the pressure with rho / rho0", input::positive())
          .required("B", &GruneisenTags::b, "Pa/K", "B, the slope of the pressure with temperature", input::positive())
          .required("rho0", &GruneisenTags::density, "kg/m^3", "density at P0 and T0", input::positive())
          .required("P0", &GruneisenTags::pressure, "Pa", "pressure at rho0 and T0")
          .required("T0", &GruneisenTags::temperature, "K", "temperature at rho0 and P0", input::positive());
  return schema;
}
const Schema<euler::Water::Numbers>& waterSchema() {
  using Numbers = euler::Water::Numbers;
  static const Schema<Numbers> schema =
      Schema<Numbers>("EOS", "1 / rho = vo (1 - ko p + L (a p + T - To)^2), c_p = co + b (To - T) at p = 0.")
          .foreignAttribute("type", "Thomsen_Hartka_water")
          .required("a", &Numbers::a, "K/Pa", "rate at which To falls with pressure", input::positive())
          .required("b", &Numbers::b, "J/(kg K^2)", "rate at which c_p falls with temperature", input::nonNegative())
          .required("co", &Numbers::heat, "J/(kg K)", "c_p at To and p = 0", input::positive())
          .required("ko", &Numbers::stiffness, "1/Pa", "compressibility at To and p = 0", input::positive())
          .required("To", &Numbers::temperature, "K", "temperature at which water is densest at p = 0",
                    input::positive())
          .required("L", &Numbers::bend, "1/K^2", "curvature of the volume around To", input::positive())
          .required("vo", &Numbers::volume, "m^3/kg", "volume per mass at To and p = 0", input::positive());
  return schema;
}

/// The tags of TST.
struct TstTags {
  double a = 0, b = 0, u = 0, w = 0, gamma = 0;
};
const Schema<TstTags>& tstSchema() {
  static const Schema<TstTags> schema =
      Schema<TstTags>("EOS", "p = (Gamma - 1) c_v T / (v - b) - a / ((v + u b) (v + w b)), v = 1 / rho.")
          .foreignAttribute("type", "TST")
          .required("a", &TstTags::a, "Pa m^6/kg^2", "attraction of molecules; below 0 they repel each other")
          .required("b", &TstTags::b, "m^3/kg", "volume of the molecules", input::nonNegative())
          .required("u", &TstTags::u, "1", "u, more than -1", input::greaterThan(-1))
          .required("w", &TstTags::w, "1", "w, more than -1", input::greaterThan(-1))
          .required("Gamma", &TstTags::gamma, "1", "ratio of the specific heats of the dilute gas",
                    input::greaterThan(1));
  return schema;
}

struct SphereTags {
  double b = 0;
};
const Schema<SphereTags>& sphereSchema() {
  static const Schema<SphereTags> schema =
      Schema<SphereTags>("EOS", "p = (gamma - 1) c_v T / (1 / rho - b): molecules are hard spheres.")
          .foreignAttribute("type", "hard_sphere_gas")
          .required("b", &SphereTags::b, "m^3/kg", "volume of the molecules", input::nonNegative());
  return schema;
}

const std::vector<std::pair<std::string, Kind>>& kinds() {
  static const std::vector<std::pair<std::string, Kind>> list{{"ideal_gas", Kind::ideal},
                                                              {"stiffened_gas", Kind::stiffened},
                                                              {"JWL", Kind::jwl},
                                                              {"JWLC", Kind::jwlc},
                                                              {"Murnaghan", Kind::murnaghan},
                                                              {"Gruneisen", Kind::gruneisen},
                                                              {"Thomsen_Hartka_water", Kind::water},
                                                              {"TST", Kind::tst},
                                                              {"hard_sphere_gas", Kind::hardSpheres}};
  return list;
}

}  // namespace

std::shared_ptr<const euler::Gas::Law> EquationOfState::law(double specificHeat, double gamma) const {
  const auto curved = [&](double gruneisen) {
    return std::make_shared<const euler::Gas::Law>(euler::CurvedGas(cold, gruneisen, specificHeat));
  };
  if (kind == Kind::jwl) return curved(cold.omega);
  if (kind == Kind::gruneisen) return curved(perKelvin / (cold.density * specificHeat));
  if (kind == Kind::jwlc || kind == Kind::murnaghan) return curved(0);
  if (kind == Kind::tst || kind == Kind::hardSpheres) {
    euler::RealGas::Numbers numbers = real;
    numbers.specificHeat = specificHeat;
    numbers.gasConstant = ((kind == Kind::tst ? gammaOfThinGas : gamma) - 1) * specificHeat;
    return std::make_shared<const euler::Gas::Law>(euler::RealGas(numbers));
  }
  if (kind == Kind::water) return std::make_shared<const euler::Gas::Law>(euler::Water(water));
  return nullptr;
}

const std::vector<std::string>& equationsOfState() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, kind] : kinds()) all.push_back(name);
    return all;
  }();
  return names;
}

EquationOfState readEquationOfState(const Element& material, Diagnostics& diagnostics) {
  EquationOfState read;
  const auto given = material.child("EOS");
  if (!given) {
    diagnostics.error(material, "missing tag <EOS> in <material>");
    return read;
  }
  const std::string type = given->attribute("type").value_or("");
  const std::string problem = input::choiceProblem(type, equationsOfState());
  if (!problem.empty()) {
    diagnostics.error(given->whereOf("type"), given->path(), "attribute 'type': " + problem);
    return read;
  }
  const Kind kind =
      std::find_if(kinds().begin(), kinds().end(), [&](const auto& one) { return one.first == type; })->second;
  if (kind == Kind::ideal) read = idealSchema().read(*given, diagnostics);
  if (kind == Kind::stiffened) read = stiffenedSchema().read(*given, diagnostics);
  if (kind == Kind::jwl) read.cold = jwlSchema().read(*given, diagnostics);
  if (kind == Kind::jwlc) read.cold = jwlcSchema().read(*given, diagnostics);
  if (kind == Kind::murnaghan) {
    read.cold = murnaghanSchema().read(*given, diagnostics);
    read.cold.kind = euler::ColdCurve::Kind::murnaghan;
  }
  if (kind == Kind::gruneisen) {
    const GruneisenTags tags = gruneisenSchema().read(*given, diagnostics);
    read.cold = {.kind = euler::ColdCurve::Kind::linear,
                 .density = tags.density,
                 .a = tags.a,
                 .pressureThere = tags.pressure - tags.b * tags.temperature};
    read.perKelvin = tags.b;
  }
  if (kind == Kind::tst) {
    const TstTags tags = tstSchema().read(*given, diagnostics);
    read.real = {.attraction = tags.a, .covolume = tags.b, .u = tags.u, .w = tags.w};
    read.gammaOfThinGas = tags.gamma;
  }
  if (kind == Kind::hardSpheres) read.real.covolume = sphereSchema().read(*given, diagnostics).b;
  if (kind == Kind::water) read.water = waterSchema().read(*given, diagnostics);
  read.kind = kind;
  return read;
}

}  // namespace tushar::ice
