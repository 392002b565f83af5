#include <gtest/gtest.h>

#include "tests/euler/curved_riemann.hpp"
#include "tests/euler/gas_box.hpp"

// Gases with various equations of state.

namespace tushar::euler {

namespace {

// The explosive LX-10's products, ANFO's and ANFO itself, with the numbers of scenes of Uintah.
ColdCurve jwlCurve() { return {.density = 1835, .a = 1.6689e12, .b = 5.969e10, .r1 = 5.9, .r2 = 2.1, .omega = 0.45}; }
ColdCurve jwlcCurve() {
  return {.density = 1160, .a = 2.9867e11, .b = 4.11706e9, .c = 7.206147e8, .r1 = 4.95, .r2 = 1.15, .omega = 0.35};
}
ColdCurve murnaghanCurve() {
  return {.kind = ColdCurve::Kind::murnaghan,
          .density = 1160,
          .exponent = 7.4,
          .compressibility = 3.9e-11,
          .pressureThere = 5e9};
}
/// The explosive of Uintah's riemann_grun.ups: A = 1.3338e9 Pa, B = 7.027e5 Pa/K.
ColdCurve linearCurve() {
  return {.kind = ColdCurve::Kind::linear, .density = 1823.3, .a = 1.3338e9, .pressureThere = 101325 - 7.027e5 * 317.4};
}
template <class Law>
Gas gasOf(const Law& law) {
  return {.gamma = 1.4, .specificHeat = 716, .law = std::make_shared<const Gas::Law>(law)};
}
Gas jwl() { return gasOf(CurvedGas(jwlCurve(), 0.45, 716)); }
Gas jwlc() { return gasOf(CurvedGas(jwlcCurve(), 0, 716)); }
Gas murnaghan() { return gasOf(CurvedGas(murnaghanCurve(), 0, 716)); }
Gas gruneisen() { return gasOf(CurvedGas(linearCurve(), 7.027e5 / (1823.3 * 716), 716)); }
Water::Numbers waterNumbers() { return {.volume = 1.00008e-3}; }
Gas water() { return gasOf(Water(waterNumbers())); }
/// Air of Uintah's BwSmall.ups.
Gas air() {
  const double gasConstant = 288.186;
  return gasOf(RealGas({.gasConstant = gasConstant, .specificHeat = 722, .isAir = true}));
}
/// The products of Uintah's SteadyBurn_2dRT.ups, and a gas whose molecules attract each other.
Gas tst() {
  return gasOf(RealGas({.gasConstant = 0.63 * 514.96,
                        .specificHeat = 514.96,
                        .attraction = -260.1385968,
                        .covolume = 7.955153678e-4,
                        .u = -0.5,
                        .w = 3}));
}
Gas attracted() {
  return gasOf(RealGas(
      {.gasConstant = 300, .specificHeat = 750, .attraction = 100, .covolume = 1e-3, .u = 2.414214, .w = -0.414214}));
}
/// The products of Uintah's IS/hollow_AMR.ups, whose molecules are hard spheres.
Gas spheres() { return gasOf(RealGas({.gasConstant = 0.4 * 716, .specificHeat = 716, .covolume = 1.4e-3})); }
/// The JWL law without its exponentials, which is an ideal gas.
Gas idealByLaw() { return gasOf(CurvedGas({.density = 1}, 0.4, 716)); }

struct Case {
  const char* name;
  Gas gas;
  std::vector<double> densities;
};
std::vector<Case> allLaws() {
  return {{"JWL", jwl(), {1, 300, 1835, 2500}},
          {"JWLC", jwlc(), {0.3, 500, 1160, 1900}},
          {"Murnaghan", murnaghan(), {1000, 1159, 1161, 1800}},
          {"Gruneisen", gruneisen(), {1700, 1823, 2000}},
          {"water", water(), {990, 1000, 1010}},
          {"air", air(), {1e-3, 1, 40}},
          {"TST", tst(), {1e-3, 1, 300, 900}},
          {"hard spheres", spheres(), {1e-3, 1, 300}},
          {"attracted", attracted(), {1e-3, 1, 100, 200}},
          {"ideal", idealByLaw(), {1e-3, 1, 10}}};
}

double energyAt(const Gas& gas, double rho, double temperature) {
  return gas.energyOf(rho, gas.lastAt(rho, temperature));
}

TubeState stateAt(const Gas& gas, double rho, double temperature) { return {rho, 0, gas.lastAt(rho, temperature)}; }

/// Mean density error of a shock tube, relative to the mean change, when the fastest wave has travelled .4.
double tubeError(const Gas& gas, const TubeState& left, const TubeState& right, int cells, double cfl = 0.5) {
  const CurvedRiemann exact(gas, left, right);
  const double fastest = std::sqrt(std::max(gas.soundSpeedSquared(left.density, left.last),
                                            gas.soundSpeedSquared(exact.densityRight, exact.at(exact.velocity).last)));
  const double until = 0.3 / (fastest + std::abs(exact.velocity));
  GasBox<1> box(
      openBox(1, cells),
      [&](const Vec<1>& x) {
        const TubeState& of = x[0] < 0.5 ? left : right;
        return gasAt(of.density, of.velocity, of.last);
      },
      {}, gas);
  box.run(until, cfl);
  double sum = 0;
  forEach<1>(box.level.cells(), [&](const Index<1>& cell) {
    const double x = box.level.cellCentre<1>(cell)[0];
    sum += std::abs(box.at(cell)[kDensity] - exact.at((x - 0.5) / until).density) / cells;
  });
  return sum / std::abs(left.density - right.density);
}

}  // namespace

TEST(ColdCurve, StoresTheWorkOfItsPressure) {
  for (const ColdCurve& curve : {jwlCurve(), jwlcCurve(), murnaghanCurve(), linearCurve()})
    for (const double rho : {0.3 * curve.density, 0.99 * curve.density, 1.01 * curve.density, 1.7 * curve.density}) {
      const double step = 1e-4 * rho;
      const auto slope = [&](auto&& of) { return (of(rho + step) - of(rho - step)) / (2 * step); };
      const double energy = slope([&](double at) { return curve.energy(at); });
      const double expected = (curve.energy(rho) + curve.pressure(rho)) / rho;
      EXPECT_NEAR(energy / expected, 1, 1e-6) << rho;
      EXPECT_NEAR(slope([&](double at) { return curve.pressure(at); }) / curve.slope(rho), 1, 1e-6) << rho;
    }
}

TEST(ColdCurve, HasTheSameBitsTogetherAndAlone) {
  for (const ColdCurve& curve : {jwlCurve(), jwlcCurve(), murnaghanCurve(), linearCurve()})
    for (double rho = 1e-4 * curve.density; rho < 2 * curve.density; rho *= 1.01) {
      EXPECT_EQ(curve.pressureAndEnergy(rho), std::pair(curve.pressure(rho), curve.energy(rho))) << rho;
      EXPECT_EQ(curve.pressureAndSlope(rho), std::pair(curve.pressure(rho), curve.slope(rho))) << rho;
      if (curve.kind != ColdCurve::Kind::jwl) continue;
      const double v = curve.density / rho, tail = curve.c == 0 ? 0 : curve.c * std::pow(v, -1 - curve.omega);
      EXPECT_EQ(curve.pressure(rho), curve.a * std::exp(-curve.r1 * v) + curve.b * std::exp(-curve.r2 * v) + tail);
    }
}

TEST(GasLaws, HaveThePressuresOfUintahsScenes) {
  EXPECT_NEAR(jwlc().pressure(1.62605283294106, 0), 101325, 1e-6);
  EXPECT_NEAR(jwlc().pressure(0.295388723220783, 0), 10132.5, 1e-7);
  ColdCurve anfo = murnaghanCurve();
  anfo.compressibility = 3.9e-10;
  anfo.pressureThere = 101325;
  EXPECT_DOUBLE_EQ(anfo.pressure(1160), 101325);
  EXPECT_NEAR(anfo.pressure(1300) / ((std::pow(1300.0 / 1160, 7.4) - 1) / (7.4 * 3.9e-10)), 1, 1e-3);
  EXPECT_NEAR(gruneisen().lastAt(1823.3, 317.4), 101325, 1e-6);
  EXPECT_NEAR(gruneisen().lastAt(1823.17534017, 317.4), 10132.5, 1);
  const Gas cold = water();
  EXPECT_NEAR(cold.lastAt(995.749014615, 300), 101325, 0.5);  // 1e-10 of the density are .2 Pa
  EXPECT_NEAR(cold.densityAt(101325, 300), 995.749014615, 1e-6);
}

TEST(GasLaws, OfAStateAgree) {
  for (const auto& [name, gas, densities] : allLaws())
    for (const double rho : densities)
      for (const double temperature : {290.0, 300.0, 320.0}) {
        const double last = gas.lastAt(rho, temperature), energy = gas.energyOf(rho, last);
        EXPECT_GT(gas.heat(rho, last), 0) << name;
        EXPECT_NEAR(gas.temperature(rho, energy) / temperature, 1, 1e-10) << name << rho;
        EXPECT_NEAR(gas.pressure(rho, energy) / gas.pressureOf(rho, last), 1, 1e-9) << name << rho;
        EXPECT_NEAR(gas.energyOf(rho, gas.last(rho, energy)) / energy, 1, 1e-9) << name << rho;
        if (gas.isBarotropic()) continue;
        EXPECT_NEAR(gas.densityAt(last, temperature) / rho, 1, 1e-10) << name << rho;
      }
}

TEST(GasLaws, HaveTheSoundSpeedAndTheEntropyThatFollow) {
  for (const auto& [name, gas, densities] : allLaws())
    for (const double rho : densities) {
      // c² = dp/drho at constant entropy, where de = p / rho² drho.
      const double energy = energyAt(gas, rho, 310) / rho, step = 1e-5 * rho;
      const double push = gas.pressure(rho, rho * energy) / (rho * rho);
      const auto along = [&](auto&& of) {
        return (of(rho + step, (rho + step) * (energy + step * push)) -
                of(rho - step, (rho - step) * (energy - step * push))) /
               (2 * step);
      };
      const double c2 = gas.soundSpeedSquared(rho, gas.last(rho, rho * energy));
      EXPECT_NEAR(along([&](double at, double of) { return gas.pressure(at, of); }) / c2, 1, 1e-4) << name << rho;
      const auto entropy = [&](double at, double of) {
        return std::visit([&](const auto& law) { return law.entropy(at, of); }, *gas.law);
      };
      EXPECT_NEAR(rho * along(entropy), 0, 1e-6) << name << rho;
    }
}

TEST(CurvedRiemann, OfAnIdealGasIsToros) {
  const Gas gas = idealByLaw();
  const CurvedRiemann exact(gas, {1, 0, 1}, {0.125, 0, 0.1});
  EXPECT_NEAR(exact.pressure, 0.30313, 5e-6);
  EXPECT_NEAR(exact.velocity, 0.92745, 5e-6);
  EXPECT_NEAR(exact.densityLeft, 0.42632, 5e-6);
  EXPECT_NEAR(exact.densityRight, 0.26557, 5e-6);
}

TEST(GasLaws, WithoutACurveAreIdealGases) {
  GasBox<1> byLaw(closedBox(1, 100), sodGas, {}, idealByLaw());
  GasBox<1> ideal(closedBox(1, 100), sodGas, {}, Gas{1.4, 0});
  byLaw.run(0.2, 0.8);
  ideal.run(0.2, 0.8);
  for (std::size_t i = 0; i < ideal.density.size(); ++i) EXPECT_NEAR(byLaw.density[i], ideal.density[i], 1e-12);
}

template <int D>
void expectIdealGasByLaw(int cells) {
  GasBox<D> byLaw(closedBox(D, cells), roughGas<D>, {}, idealByLaw());
  GasBox<D> ideal(closedBox(D, cells), roughGas<D>, {}, Gas{1.4, 0});
  for (int step = 0; step < 4; ++step) {
    const double dt = ideal.stableStep(0.5);
    EXPECT_NEAR(byLaw.stableStep(0.5) / dt, 1, 1e-12);
    byLaw.step(dt);
    ideal.step(dt);
  }
  for (std::size_t i = 0; i < ideal.density.size(); ++i) {
    EXPECT_NEAR(byLaw.density[i], ideal.density[i], 1e-12);
    EXPECT_NEAR(byLaw.energy[i], ideal.energy[i], 1e-12);
    EXPECT_LT((byLaw.momentum[i] - ideal.momentum[i]).norm(), 1e-12);
  }
}

TEST(GasLaws, WithoutACurveAreIdealGasesInEachDimension) {
  expectIdealGasByLaw<1>(60);
  expectIdealGasByLaw<2>(20);
  expectIdealGasByLaw<3>(12);
}

TEST(GasLaws, ConvergeToExactShockTubes) {
  struct Tube {
    const char* name;
    Gas gas;
    double left, hot, right, cold;
  };
  // Products at the pressure of a detonation against thin ones, and condensed ones against one another.
  for (const auto& [name, gas, left, hot, right, cold] :
       {Tube{"JWL", jwl(), 1835, 3000, 200, 300}, Tube{"JWLC", jwlc(), 1400, 300, 100, 300},
        Tube{"Murnaghan", murnaghan(), 1400, 300, 1170, 300}, Tube{"Gruneisen", gruneisen(), 2100, 500, 1800, 300},
        Tube{"water", water(), 1010, 300, 1000, 310}, Tube{"air", air(), 1, 1500, 0.1, 300},
        Tube{"TST", tst(), 400, 1000, 100, 300}}) {
    const TubeState high = stateAt(gas, left, hot), low = stateAt(gas, right, cold);
    const double coarse = tubeError(gas, high, low, 100), fine = tubeError(gas, high, low, 400);
    EXPECT_LT(fine, 0.006) << name;
    EXPECT_LT(fine, 0.4 * coarse) << name;  // a shock alone would give a quarter, a contact .4
  }
}

TEST(HeatOfAir, IsThatOfTables) {
  // c_p/R of N2 and O2 at 298.15 K and 1000 K: 3.503, 3.533 and 3.933, 4.194 (M. W. Chase, NIST-JANAF tables, 1998).
  // The polynomials fit the tables to .3 % of c_v.
  EXPECT_NEAR(HeatOfAir::specificHeat(298.15), (3.533 + 3.76 * 3.503) / 4.76 - 1, 8e-3);
  EXPECT_NEAR(HeatOfAir::specificHeat(1000), (4.194 + 3.76 * 3.933) / 4.76 - 1, 8e-3);
  EXPECT_EQ(HeatOfAir::specificHeat(150), HeatOfAir::specificHeat(200));
  EXPECT_EQ(HeatOfAir::specificHeat(5000), HeatOfAir::specificHeat(3500));
}

TEST(HeatOfAir, HasTheEnergyAndTheEntropyThatFollow) {
  for (const double t : {1.0, 199.9, 200.0, 300.0, 999.9, 1000.0, 1000.1, 2500.0, 3500.0, 6000.0}) {
    const double step = 1e-3 * t, heat = HeatOfAir::specificHeat(t);
    EXPECT_NEAR((HeatOfAir::energy(t + step) - HeatOfAir::energy(t - step)) / (2 * step) / heat, 1, 1e-4) << t;
    EXPECT_NEAR((HeatOfAir::entropy(t + step) - HeatOfAir::entropy(t - step)) / (2 * step) * t / heat, 1, 1e-4) << t;
    EXPECT_NEAR(HeatOfAir::temperature(HeatOfAir::energy(t)) / t, 1, 1e-14) << t;
  }
}

TEST(GasLaws, OfRealGasesHaveThePressuresOfUintahsScenes) {
  EXPECT_NEAR(air().lastAt(0.11719839492715756, 300) / 10132.5, 1, 1e-5);
  EXPECT_NEAR(tst().lastAt(1.037341706242494, 300) / 101325, 1, 1e-5);
  EXPECT_FALSE(std::get<RealGas>(*tst().law).canBe(1300, 1e12)) << "there is no room for so many molecules";
}

TEST(GasLaws, OfHardSpheresHaveTheirPressure) {
  EXPECT_NEAR(spheres().lastAt(300, 400) / (0.4 * 300 * 716 * 400 / (1 - 1.4e-3 * 300)), 1, 1e-14);
}

TEST(GasLaws, ConserveAndStayPositive) {
  for (const auto& [name, gas, densities] : allLaws()) {
    const auto rough = [&gas = gas, least = densities.front(), most = densities.back()](const Vec<2>& x) {
      const State<2> from = roughGas<2>(x);
      State<2> w = from;
      w[kDensity] = least + (most - least) * (from[kDensity] - 0.1);
      const double speed = std::sqrt(gas.soundSpeedSquared(w[kDensity], gas.lastAt(w[kDensity], 320)));
      for (int d = 0; d < 2; ++d) w[kVelocity(d)] = 0.02 * speed * from[kVelocity(d)];
      w[kPressure<2>] = gas.lastAt(w[kDensity], 290 + 20 * from[kPressure<2>]);
      return w;
    };
    GasBox<2> box(closedBox(2, 24), rough, {}, gas);
    const double mass = box.mass(), energy = box.totalEnergy();
    for (int step = 0; step < 20; ++step) ASSERT_NO_THROW(box.step(box.stableStep(0.4))) << name;
    EXPECT_NEAR(box.mass() / mass, 1, 1e-14) << name;
    EXPECT_NEAR(box.totalEnergy() / energy, 1, 1e-13) << name;
  }
}

TEST(GasLaws, OfRestKeepThePressureAtContacts) {
  // A contact at rest stays exactly as it is.
  const Gas gas = jwl();
  const double pressure = 1e9;
  const auto contact = [&](const Vec<1>& x) {
    return gasAt(gas.densityAt(pressure, x[0] < 0.5 ? 2000 : 600), 0, pressure);
  };
  GasBox<1> box(closedBox(1, 50), contact, {}, gas);
  for (int step = 0; step < 10; ++step) box.step(box.stableStep(0.5));
  forEach<1>(box.level.cells(), [&](const Index<1>& cell) {
    const State<1> u = box.at(cell);
    EXPECT_NEAR(gas.pressure(u[kDensity], u[kPressure<1>]) / pressure, 1, 1e-12);
  });
}

}  // namespace tushar::euler
