#include "components/euler/blend.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tushar::euler {

namespace {

/// The limits of the pressure [Pa]. A liquid that does not fill its cell has the least one.
constexpr double leastPressure = 1e-100, greatestPressure = 1e16;
/// The relative change of volume that counts as round-off.
constexpr double roundOff = 4e-15;
/// The relative change from which on the next step of Newton's method would change less than round-off.
constexpr double nearlyDone = 1e-8;
/// The relative difference of volume and energy up to which a state is an equilibrium.
constexpr double tolerance = 1e-8;
/// How far the sum of volume fractions may be from 1 that Newton's method begins with.
constexpr double farFromOne = 0.1;
/// The volume fraction up to which the law of water may be outside the range where it is valid: a trace in hot gas.
constexpr double leastShareOfWater = 1e-6;

/// The density at which p = P0 + ((rho / rho_0)^n - 1) / (n K), or p = P0 (rho / rho_0)^(1 / (K P0)) below P0.
double densityOfMurnaghan(const ColdCurve& cold, double pressure) {
  const double k = cold.compressibility, least = cold.pressureThere;
  if (pressure < least) return cold.density * std::pow(pressure / least, k * least);
  return cold.density * std::pow(1 + cold.exponent * k * (pressure - least), 1 / cold.exponent);
}

/// The slope dp/drho of a cold curve, given its pressure there; with Murnaghan's law, it vanishes far below rho_0.
double slopeOf(const ColdCurve& cold, double rho, double pressure) {
  if (cold.kind == ColdCurve::Kind::murnaghan && pressure < cold.pressureThere)
    return pressure / (cold.compressibility * cold.pressureThere * rho);
  return cold.slope(rho);
}

}  // namespace

MixedGas Blend::law(double energy) const {
  if (!isPossible) return {std::nan(""), std::nan("")};
  const double softness = (pressure + energy) / modulus;
  return {softness, energy - pressure * softness};
}

BlendLaws::BlendLaws(const std::vector<Gas>& gases) : gases_(gases) {
  for (const Gas& gas : gases_) {
    const CurvedGas* law = gas.law ? std::get_if<CurvedGas>(gas.law.get()) : nullptr;
    const RealGas* spheres = gas.law ? std::get_if<RealGas>(gas.law.get()) : nullptr;
    const Water* water = gas.law ? std::get_if<Water>(gas.law.get()) : nullptr;
    const double ofHeat = law ? law->gruneisen() : spheres ? spheres->gasConstant() / gas.specificHeat : gas.gamma - 1;
    substances_.push_back({gas.specificHeat, ofHeat, gas.pInfinity, spheres ? spheres->covolume() : 0, law, water});
  }
}

double BlendLaws::Substance::densityAt(double pressure, double temperature, double guess) const {
  const double heat = gruneisen * specificHeat * temperature;
  if (!law) return (pressure + pInfinity) / (heat + covolume * pressure);
  const ColdCurve& cold = law->cold();
  if (isLinear()) return cold.density * (1 + (pressure - cold.pressureThere - heat * cold.density) / cold.a);
  if (cold.kind == ColdCurve::Kind::murnaghan && gruneisen == 0) return densityOfMurnaghan(cold, pressure);
  // In logarithms, pressure and density are nearly proportional to each other.
  double rho = guess, low = 0, high = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 200; ++k) {
    const double there = cold.pressure(rho) + heat * rho, slope = cold.slope(rho) + heat;
    (there < pressure ? low : high) = rho;
    const double step = std::log(pressure / there) * there / (slope * rho);
    double next = rho * std::exp(std::clamp(step, -5.0, 5.0));
    const bool isDone = std::abs(step) <= nearlyDone;
    if (!isDone && !(next > low && next < high)) next = std::isinf(high) ? 2 * rho : 0.5 * (low + high);
    rho = next;
    if (isDone) break;
  }
  return rho;
}

double BlendLaws::Substance::pressureAt(double rho, double temperature) const {
  const double heat = gruneisen * specificHeat * temperature;
  if (!law) return (heat * rho - pInfinity) / (1 - covolume * rho);
  return law->cold().pressure(rho) + heat * (isLinear() ? law->cold().density : rho);
}

double BlendLaws::Substance::stiffnessAt(double rho, double cold, double temperature) const {
  const double slope = law ? slopeOf(law->cold(), rho, cold) : 0, room = 1 - covolume * rho;
  return slope + (isLinear() ? 0 : gruneisen * specificHeat * temperature / (room * room));
}

/// Sums over the gases at a pressure and a temperature, and their derivatives.
struct BlendLaws::Sums {
  double volume = 0, energy = 0;                  ///< sum of m / rho, sum of m e
  double volumeOfPressure = 0, volumeOfHeat = 0;  ///< derivatives with respect to p and T
  double energyOfPressure = 0, energyOfHeat = 0;  ///< the same for the energy
  double capacity = 0;                            ///< sum of m c_p [J/(m³ K)]

  void add(double mass, double rho, const Substance& of, double temperature) {
    const double linear = of.isLinear() ? of.law->cold().density : rho, heat = of.gruneisen * of.specificHeat;
    const double cold = of.coldPressure(rho), stiffness = of.stiffnessAt(rho, cold, temperature);
    const double perKelvin = heat * linear / (1 - of.covolume * rho);  // dp/dT at constant rho
    const double square = rho * rho, yield = mass / (square * stiffness);
    volume += mass / rho;
    energy += mass * (of.coldEnergy(rho) + of.specificHeat * temperature);
    volumeOfPressure -= yield;
    volumeOfHeat += yield * perKelvin;
    energyOfPressure += yield * cold;
    energyOfHeat += mass * of.specificHeat - yield * perKelvin * cold;
    capacity += mass * of.specificHeat + yield * perKelvin * perKelvin * temperature;
  }
  void add(double mass, const Water::Point& of, double pressure, double temperature) {
    volume += mass * of.volume;
    energy += mass * of.energy;
    volumeOfPressure += mass * of.ofPressure;
    volumeOfHeat += mass * of.ofTemperature;
    energyOfPressure -= mass * (temperature * of.ofTemperature + pressure * of.ofPressure);
    energyOfHeat += mass * (of.heatOfPressure - pressure * of.ofTemperature);
    capacity += mass * of.heatOfPressure;
  }
  /// rho c² [Pa] of gases that fill the volume 1.
  double modulus(double temperature) const {
    return 1 / (-volumeOfPressure - temperature * volumeOfHeat * volumeOfHeat / capacity);
  }
};

BlendLaws::Sums BlendLaws::sumsAt(const double* masses, double pressure, double temperature,
                                  std::array<double, kMostGases>& rho) const {
  Sums sums;
  for (std::size_t k = 0; k < substances_.size(); ++k) {
    if (!(masses[k] > 0)) continue;
    if (const Water* water = substances_[k].water) {
      const Water::Point at = water->at(pressure, temperature);
      rho[k] = 1 / at.volume;
      sums.add(masses[k], at, pressure, temperature);
      continue;
    }
    rho[k] = substances_[k].densityAt(pressure, temperature, rho[k]);
    sums.add(masses[k], rho[k], substances_[k], temperature);
  }
  return sums;
}

double BlendLaws::temperatureAt(const double* masses, double energy, double pressure,
                                std::array<double, kMostGases>& rho) const {
  double least = 0, most = std::numeric_limits<double>::infinity(), at = 300;
  for (int k = 0; k < 200; ++k) {
    const Sums sums = sumsAt(masses, pressure, at, rho);
    (sums.energy < energy ? least : most) = at;
    const double step = (energy - sums.energy) / sums.energyOfHeat;
    const bool isDone = std::abs(step) <= nearlyDone * at;
    double next = at + step;
    if (!isDone && !(next > least && next < most)) next = std::isinf(most) ? 2 * at : 0.5 * (least + most);
    at = next;
    if (isDone) break;
  }
  return at;
}

void BlendLaws::bisect(const double* masses, double energy, double& pressure, double& temperature,
                       std::array<double, kMostGases>& rho) const {
  double least = std::log(leastPressure), most = std::log(greatestPressure);
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (least + most);
    if (middle <= least || middle >= most) break;
    pressure = std::exp(middle);
    temperature = temperatureAt(masses, energy, pressure, rho);
    (sumsAt(masses, pressure, temperature, rho).volume > 1 ? least : most) = middle;
  }
}

namespace {

/// The pressure after a step of Newton's method that changes ln p by `change`, where `softness` is -d ln V / d ln p.
/// The volume of stiff gases is nearly linear in p, that of others in ln p.
double steppedPressure(double pressure, double change, double softness) {
  double next = pressure;
  if (change < -0.9)
    next *= std::exp(std::max(change, -50.0));
  else if (change > 1)
    next = std::min(pressure * std::exp(std::min(change, 50.0)), std::max(10 * pressure, 1e9));
  else
    next *= softness < 0.2 ? 1 + change : std::exp(change);
  return std::clamp(next, leastPressure, greatestPressure);
}

}  // namespace

std::optional<BlendLaws::Guess> BlendLaws::guessFrom(const double* masses, double energy, const double* shares) const {
  Guess guess{};
  double cold = 0, capacity = 0, softest = 0, all = 0;
  for (std::size_t k = 0; k < substances_.size(); ++k) all += shares[k];
  if (!(std::abs(all - 1) < farFromOne)) return {};  // not volume fractions
  for (std::size_t k = 0; k < substances_.size(); ++k) {
    if (!(masses[k] > 0)) continue;
    if (substances_[k].water || !(shares[k] > 0)) return {};
    guess.rho[k] = masses[k] / shares[k];
    cold += masses[k] * substances_[k].coldEnergy(guess.rho[k]);
    capacity += masses[k] * substances_[k].specificHeat;
  }
  guess.temperature = (energy - cold) / capacity;
  if (!(guess.temperature > 0)) return {};
  for (std::size_t k = 0; k < substances_.size(); ++k) {
    if (!(masses[k] > 0)) continue;
    const double rho = guess.rho[k];
    const double stiffness = substances_[k].stiffnessAt(rho, substances_[k].coldPressure(rho), guess.temperature);
    if (!(shares[k] > softest * rho * stiffness)) continue;
    softest = shares[k] / (rho * stiffness);
    guess.pressure = substances_[k].pressureAt(rho, guess.temperature);
  }
  if (!(guess.pressure > leastPressure && guess.pressure < greatestPressure)) return {};
  return guess;
}

Blend BlendLaws::at(const double* masses, double energy, const double* shares) const {
  Blend blend;
  double capacity = 0, whole = energy;  // the energy above 0 K
  for (std::size_t k = 0; k < substances_.size(); ++k) {
    if (std::isnan(masses[k])) return blend;
    capacity += std::max(masses[k], 0.0) * substances_[k].specificHeat;
    whole += std::max(masses[k], 0.0) * substances_[k].heatBelow();
  }
  if (!(whole > 0 && whole <= std::numeric_limits<double>::max()) || !(capacity > 0)) return blend;
  std::optional<Guess> found;
  if (shares) found = guessFrom(masses, energy, shares);
  if (!found) {
    found = Guess{0.1 * whole, whole / capacity, {}};
    for (std::size_t k = 0; k < substances_.size(); ++k)
      found->rho[k] = substances_[k].law ? substances_[k].law->cold().density : 1;
  }
  auto& [pressure, temperature, rho] = *found;
  bool isDone = false;
  for (int k = 0; k < 100 && !isDone; ++k) {
    const Sums s = sumsAt(masses, pressure, temperature, rho);
    const double excess = s.volume - 1, missing = energy - s.energy;
    const double byPressure = s.volumeOfPressure - s.volumeOfHeat * s.energyOfPressure / s.energyOfHeat;
    const double change = -(std::log1p(excess) * s.volume + s.volumeOfHeat * missing / s.energyOfHeat) / byPressure;
    const double softness = -byPressure * pressure / s.volume;
    const double next = steppedPressure(pressure, change / pressure, softness);
    const double warms = (missing - s.energyOfPressure * (next - pressure)) / s.energyOfHeat;
    const double after = temperature + std::clamp(warms, -0.7 * temperature, 2 * temperature);
    const double risen = std::abs(std::log(next / pressure));
    const bool falls = excess < -tolerance && next > leastPressure;  // a liquid that does not fill the cell
    isDone = std::abs(after - temperature) <= nearlyDone * temperature && !falls &&
             (risen <= nearlyDone || softness * risen <= roundOff);  // also at the limits of the pressure
    pressure = next;
    temperature = after;
    if (!(pressure > 0) || !(temperature > 0)) break;
  }
  if (!isDone) bisect(masses, energy, pressure, temperature, rho);
  const Sums sums = sumsAt(masses, pressure, temperature, rho);
  for (std::size_t k = 0; k < substances_.size(); ++k)
    blend.shares[k] = masses[k] > 0 ? masses[k] / (rho[k] * sums.volume) : 0;
  blend.pressure = pressure;
  blend.temperature = temperature;
  // A small stiffness remains in a liquid that does not fill its cell, so that the speeds of waves stay distinct.
  blend.modulus = std::max(sums.modulus(temperature), 1e-12 * whole);
  blend.isPossible = temperature > 0 && pressure < greatestPressure && blend.modulus > 0 &&
                     std::isfinite(blend.modulus) && std::abs(sums.energy - energy) <= tolerance * whole &&
                     (sums.volume < 1 + tolerance) && (pressure <= 2 * leastPressure || sums.volume > 1 - tolerance);
  for (std::size_t k = 0; k < substances_.size(); ++k)
    if (const Water* water = substances_[k].water; water && blend.shares[k] > leastShareOfWater)
      blend.isPossible &= water->isValid(pressure, temperature);
  return blend;
}

std::string BlendLaws::limits() const {
  for (const Substance& one : substances_) {
    if (!one.water) continue;
    const auto [coldest, hottest] = one.water->temperatureLimits();
    return fmt::format("; the law of the water is valid between {:.4g} and {:.4g} K (at p = 0)", coldest, hottest);
  }
  return "";
}

}  // namespace tushar::euler
