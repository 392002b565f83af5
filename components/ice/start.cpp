#include "components/ice/start.hpp"

#include <cmath>
#include <numbers>

#include "core/input/refuse.hpp"

namespace tushar::ice {

using input::Schema;

namespace {

constexpr double surroundings = 300;  ///< temperature of the surroundings [K], as in Uintah

const Schema<VortexList>& vorticesSchema() {
  static const Schema<Vortex> vortex =
      Schema<Vortex>("vortex", "A vortex.")
          .location(&Vortex::where)
          .requiredChoice("axis", &Vortex::axis, {{"X", 0}, {"Y", 1}, {"Z", 2}, {"x", 0}, {"y", 1}, {"z", 2}},
                          "axis of rotation")
          .required("origin", &Vortex::origin, "m", "a point on the axis")
          .required("strength", &Vortex::strength, "kg/(m s)", "C in v = C r / (rho R^2) exp(-r^2 / (2 R^2))")
          .required("radius", &Vortex::radius, "m", "R; beyond it there is no rotation", input::positive());
  static const Schema<VortexList> schema =
      Schema<VortexList>("vortices", "Vortices, added to the velocity at the start.")
          .list("vortex", &VortexList::list, vortex, "a vortex", 1);
  return schema;
}

const Schema<GaussianTemperature>& temperatureSchema() {
  static const Schema<GaussianTemperature> schema =
      Schema<GaussianTemperature>("gaussianTemperature", "The temperature at the start: 300 K plus a Gaussian bell.")
          .required("amplitude", &GaussianTemperature::amplitude, "K", "height of the bell", input::greaterThan(-300))
          .required("origin", &GaussianTemperature::origin, "m", "its centre")
          .required("spread_x", &GaussianTemperature::spreadX, "m", "standard deviation along x", input::positive())
          .required("spread_y", &GaussianTemperature::spreadY, "m", "standard deviation along y", input::positive());
  return schema;
}

constexpr const char *windOfVortices = "mms_1", *taylorGreen = "mms_3";

const Schema<Counterflow>& counterflowSchema() {
  static const Schema<Counterflow> schema =
      Schema<Counterflow>("counterflow", "Gas flows in along x and out along y.")
          .required("strainRate", &Counterflow::strainRate, "1/s",
                    "strain rate a in v_x = -a (x - m), where m is half the length of the grid")
          .ignored("referenceCell", "the pressure follows from density and temperature");
  return schema;
}

const Schema<Manufactured>& manufacturedSchema() {
  static const Schema<Manufactured> schema =
      Schema<Manufactured>("manufacturedSolution", "Incompressible flows with known solutions.")
          .requiredChoiceAttribute("type", &Manufactured::type,
                                   {{windOfVortices, windOfVortices}, {taylorGreen, taylorGreen}},
                                   "vortices in a uniform flow, or the Taylor-Green vortex")
          .value("A", &Manufactured::amplitude, 1, "m/s", "for mms_1: amplitude of the vortices")
          .value("angle", &Manufactured::angle, 0, "1", "for mms_3: how the velocity is divided among the axes");
  return schema;
}

void addVortex(const Vortex& vortex, const Vec3& point, double rho, Vec3& velocity) {
  const int j = vortex.axis == 0 ? 1 : 0, k = vortex.axis == 2 ? 1 : 2;
  const double y = point[j] - vortex.origin[j], z = point[k] - vortex.origin[k];
  const double squared = y * y + z * z, radius = vortex.radius;
  if (squared > radius * radius) return;
  const double turn = vortex.strength / (rho * radius * radius) * std::exp(-squared / (2 * radius * radius));
  velocity[j] -= turn * z;
  velocity[k] += turn * y;
}

void setWindOfVortices(double amplitude, const Vec3& x, Vec3& velocity) {
  velocity[0] = 1 - amplitude * std::cos(x[0]) * std::sin(x[1]);
  velocity[1] = 1 + amplitude * std::sin(x[0]) * std::cos(x[1]);
}
/// Pressure [Pa] of the flow mms_1 for a density of 1 kg/m³, as in Uintah.
double pressureOfWind(double amplitude, const Vec3& x) {
  return 101325 - amplitude * amplitude / 4 * (std::cos(2 * x[0]) + std::cos(2 * x[1]));
}

void setTaylorGreen(double angle, const Vec3& x, Vec3& velocity) {
  const double size = 2 / std::sqrt(3.0), third = 2 * std::numbers::pi / 3;
  velocity[0] = size * std::sin(angle + third) * std::sin(x[0]) * std::cos(x[1]) * std::cos(x[2]);
  velocity[1] = size * std::sin(angle - third) * std::cos(x[0]) * std::sin(x[1]) * std::cos(x[2]);
  velocity[2] = size * std::sin(angle) * std::cos(x[0]) * std::cos(x[1]) * std::sin(x[2]);
}

/// The temperature [K] at which a gas has a pressure [Pa].
double temperatureAt(const StartPlace& place, double pressure) {
  const euler::Gas& gas = place.gas;
  if (!gas.law) return (pressure + gas.pInfinity) / (place.density * gas.gasConstant());
  return gas.temperature(place.density, gas.energyOf(place.density, pressure));
}

}  // namespace

std::string CustomStart::problem(std::size_t gases, const euler::Gas& gas) const {
  const int flows = (vortices ? 1 : 0) + (counterflow ? 1 : 0) + (manufactured ? 1 : 0);
  if (flows > 1)
    return "give only one of vortices, counterflow and manufacturedSolution, since each defines the velocity";
  if (gases > 1 && manufactured && manufactured->type == windOfVortices)
    return "manufacturedSolution mms_1 is not available with several gases: its temperature is that of one gas";
  if (gas.isBarotropic() && manufactured && manufactured->type == windOfVortices)
    return "manufacturedSolution mms_1 is not available with JWLC or Murnaghan, whose pressure does not depend on the "
           "temperature";
  return "";
}

void CustomStart::apply(const Vec3& point, const StartPlace& place, Vec3& velocity, double& temperatureThere) const {
  if (vortices)
    for (const Vortex& vortex : vortices->list) addVortex(vortex, point, place.density, velocity);
  if (counterflow) {
    velocity[0] = -counterflow->strainRate * (point[0] - place.middle[0]);
    velocity[1] = counterflow->strainRate * (point[1] - place.middle[1]);
  }
  if (manufactured && manufactured->type == windOfVortices) {
    setWindOfVortices(manufactured->amplitude, point, velocity);
    temperatureThere = temperatureAt(place, pressureOfWind(manufactured->amplitude, point));
  } else if (manufactured) {
    setTaylorGreen(manufactured->angle, point, velocity);
  }
  if (!temperature) return;
  const double x = (point[0] - temperature->origin[0]) / temperature->spreadX;
  const double y = (point[1] - temperature->origin[1]) / temperature->spreadY;
  temperatureThere = surroundings + temperature->amplitude * std::exp(-(x * x + y * y) / 2);
}

const Schema<CustomStart>& customStartSchema() {
  static const Schema<CustomStart> schema = [] {
    Schema<CustomStart> tags("customInitialization",
                             "The state at the start, by formulas; the pressure follows from density and temperature.");
    tags.section("vortices", &CustomStart::vortices, vorticesSchema(), "vortices, added to the velocity")
        .section("gaussianTemperature", &CustomStart::temperature, temperatureSchema(),
                 "the temperature, instead of that of the regions")
        .section("counterflow", &CustomStart::counterflow, counterflowSchema(), "two streams that meet")
        .section("manufacturedSolution", &CustomStart::manufactured, manufacturedSchema(),
                 "incompressible flows with known solutions");
    for (const char* tag : {"vortexPairs", "logLawProfile", "powerLawProfile", "powerLawProfile2", "DNS_Moser"})
      input::refuseTag(tags, tag, "give <velocity> or <temperature> a formula in x, y, z");
    return tags;
  }();
  return schema;
}

}  // namespace tushar::ice
