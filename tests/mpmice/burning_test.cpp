#include "components/mpmice/burn/burn_bodies.hpp"
#include "components/mpmice/burn/burn_modes.hpp"
#include "components/mpmice/burn/unsteady_surface.hpp"
#include "components/mpmice/tasks/measure_bodies.hpp"
#include "tests/mpmice/fields.hpp"

namespace tushar::mpmice {

namespace {

template <class T>
class BurningAlongAxes : public testing::Test {};
TYPED_TEST_SUITE(BurningAlongAxes, AllAxes);

/// Gas next to a body that fills a half space with boxes, four per cell along each axis.
template <int D, int Size = 8>
struct HalfSpace {
  static constexpr int size = Size, perCell = 4;

  /// Creates the boxes whose centres lie beyond the plane through `corner` + `shift` cells with normal `into`.
  HalfSpace(const Vec<D>& into, double shift) : fields(level.cells()) {
    TakenShares<D> shares{{fields.free.cells(), fields.coverage.cells()}};
    forEach<D>(cube<D>(size * perCell), [&](const Index<D>& at) {
      Index<D> cell;
      ParticleBox<D> box;
      double along = 0;
      for (int d = 0; d < D; ++d) {
        cell[d] = at[d] / perCell;
        box.middle[d] = (at[d] % perCell + 0.5) / perCell;
        box.edges[d] = 1.0 / perCell;
        along += into[d] * (cell[d] + box.middle[d] - 0.5 * size);
      }
      if (!(along > 0)) return;
      box.middle[0] += shift;
      shares.take(cell, box);
    });
    shares.settle();
  }
  /// Returns the surface area in the cells of a box, in units of a cell face.
  double areaIn(const Box& cells) const {
    const SurfaceAtFaces<D> surface(level, settings, fields.gas());
    double sum = 0;
    forEach<D>(cells, [&](const Index<D>& cell) {
      for (int d = 0; d < D; ++d)
        if (cell[d] > 0) sum += std::abs(surface.step(cell, d)) * surface.normalAlong(cell, d);
    });
    return sum;
  }

  Level level{euler::closedBox(D, size)};
  Settings settings;
  GasFields<D> fields;
};

/// Four cells on a line, first gas, then a body; the burn rate is wanted at each face.
struct Line {
  Level level{euler::closedBox(1, 4)};
  Field<Vec<1>> rate{level.cells(), Vec<1>::Zero()};
  Field<double> within{level.cells(), 0}, mass{within};

  std::vector<double> shares(double dt) const {
    const BurntMass<1> burnt(level, rate.seen(), within.seen(), mass.seen(), dt);
    std::vector<double> all;
    for (int k = 0; k < 4; ++k) all.push_back(burnt.shareOf({k}));
    return all;
  }
};

}  // namespace

TYPED_TEST(BurningAlongAxes, HaveTheAreaOfAPlaneWhereverItCutsCells) {
  constexpr int D = TypeParam::value;
  Vec<D> into = Vec<D>::Zero();
  into[0] = 1;
  for (int k = 0; k <= 20; ++k) {
    const HalfSpace<D> half(into, 0.05 * k);
    EXPECT_NEAR(half.areaIn(half.level.cells()) / std::pow(8, D - 1), 1, 1e-12) << k;
  }
}

TEST(SurfaceAtFaces, HaveTheAreaOfAnObliquePlane) {
  for (const double slope : {0.1, 0.25, 0.3, 0.5, 0.7, 0.9, 1.0})
    for (const double shift : {0.0, 0.3, 0.6}) {
      const HalfSpace<2, 24> half({1, slope}, shift);
      Box rows = half.level.cells();  // away from the sides, where the normal is not that of the plane
      rows.lower[1] = 6;
      rows.upper[1] = 18;
      // Boxes form steps, so their normal differs slightly from that of the plane, except at 45 degrees.
      EXPECT_NEAR(half.areaIn(rows) / (12 * std::sqrt(1 + slope * slope)), 1, slope < 1 ? 0.03 : 1e-14)
          << slope << ' ' << shift;
    }
}

TEST(SurfaceAtFaces, HaveBothSidesOfASlotOfOneCell) {
  const Level level(euler::closedBox(1, 5));
  GasFields<1> fields(level.cells());
  for (const int full : {1, 3}) fields.free.values[full] = fields.density.values[full] = 0;
  const SurfaceAtFaces<1> surface(level, {}, fields.gas());
  for (int k = 1; k < 5; ++k) {
    EXPECT_EQ(std::abs(surface.step({k}, 0)), 1);
    EXPECT_EQ(surface.normalAlong({k}, 0), 1);
  }
}

TEST(BurntMass, ComesFromTheCellOfTheGasFirst) {
  Line line;
  line.mass.values = {0, 3, 8, 8};
  line.rate.values[2][0] = 10;  // by the gas of cell 1
  EXPECT_EQ(line.shares(0.1), (std::vector<double>{0, 1.0 / 3, 0, 0}));
  EXPECT_EQ(line.shares(0.5), (std::vector<double>{0, 1, 2.0 / 8, 0}));
  EXPECT_EQ(line.shares(2), (std::vector<double>{0, 1, 1, 0}));
}

TEST(BurntMass, IsWhatIsWantedFromBothSides) {
  Line line;
  line.mass.values = {0, 0, 8, 0};
  line.rate.values[2][0] = 2;   // by the gas of cell 1
  line.rate.values[3][0] = -6;  // by that of cell 3
  const std::vector<double> shares = line.shares(0.5);
  EXPECT_DOUBLE_EQ(shares[2] * 8, 4);
  EXPECT_EQ(shares[1] + shares[3], 0);
}

TEST(BurntMass, IsAlsoThatOfRests) {
  Line line;
  line.mass.values = {0, 3, 0, 0};
  line.within.values[1] = 2;
  EXPECT_DOUBLE_EQ(line.shares(0.5)[1], 1.0 / 3);
}

TEST(SimpleBurn, FollowsThePressure) {
  const ice::SimpleBurn law{75.3, 101325};
  EXPECT_DOUBLE_EQ(law.rate({.pressure = 101325}), 75.3);
  EXPECT_NEAR(law.rate({.pressure = 10 * 101325.0}) / 75.3, 5.99791, 1e-5);  // 10^.778
}

/// The explosive PBX 9501 of Uintah's scenes.
const ice::SteadyBurn explosive{8.314, 1.637e15, 1.76e5, 1.6e-3, 4e5, 3.018e6, 0.07, 0.2, 1.4e3, 0.0342};

TEST(SteadyBurn, SatisfiesTheEquationsOfItsSource) {
  for (const double pressure : {1e5, 1e6, 1e7, 1e8})
    for (const double cold : {250.0, 298.0, 400.0}) {
      const ice::AtSurface at{pressure, cold, 1832};
      const double c = explosive.specificHeat, kg = explosive.gasConductivity, r = explosive.gasConstant;
      const double m = explosive.rate(at), ts = explosive.surfaceTemperature(at);
      const double wp = explosive.molarMass * pressure / r;
      const double x = 2 * kg / (c * (std::sqrt(m * m + 4 * kg * explosive.gasFactor * wp * wp / c) - m));
      const double back = cold + explosive.solidHeat / c + explosive.gasHeat / c / (1 + x * m * c / kg);
      EXPECT_NEAR(back / ts, 1, 1e-9);
      const double heating = ts - cold - 0.5 * explosive.solidHeat / c;
      const double square = explosive.solidFactor * r * explosive.solidConductivity * at.bodyDensity * ts * ts *
                            std::exp(-explosive.activationEnergy / (r * ts)) /
                            (explosive.activationEnergy * c * heating);
      EXPECT_NEAR(m * m / square, 1, 1e-9);
    }
}

TEST(SteadyBurn, IsFasterUnderPressureAndWhereTheBodyIsWarm) {
  double last = 0;
  for (const double pressure : {1e5, 1e6, 1e7, 1e8}) {
    const double rate = explosive.rate({pressure, 298, 1832});
    EXPECT_GT(rate, last);
    EXPECT_GT(explosive.rate({pressure, 350, 1832}), rate);
    last = rate;
  }
}

/// The explosive with delays of a steady state; its rate is not scaled.
const ice::UnsteadyBurn slowExplosive{explosive, 0.2, 0.25, 1};

TEST(UnsteadyBurn, IsSteadyAtFirstAndAtLast) {
  const ice::AtSurface at{1e6, 298, 1832}, later{1.1e6, 298, 1832};
  const ice::SurfaceHeat first = slowExplosive.after({}, 1e-6, at);
  EXPECT_NEAR(slowExplosive.rateIn(first, at).value() / explosive.rate(at), 1, 1e-12);
  const ice::SurfaceHeat last = slowExplosive.after(first, 1e6, later);
  EXPECT_NEAR(slowExplosive.rateIn(last, later).value() / explosive.rate(later), 1, 1e-12);
}

TEST(UnsteadyBurn, RelaxesAsItsEquationsSay) {
  const ice::AtSurface before{1e6, 298, 1832}, at{1.02e6, 298, 1832};
  const ice::SurfaceHeat from = slowExplosive.steady(before), to = slowExplosive.steady(at);
  const double m = explosive.rate(at), delay = 0.2 * explosive.solidConductivity * 1832 / (1400 * m * m);
  EXPECT_NEAR(to.gradient / (m * 1400 * (to.temperature - 298) / explosive.solidConductivity), 1, 1e-12);
  ice::SurfaceHeat state = from;
  for (int k = 1; k <= 8; ++k) {
    state = slowExplosive.after(state, 0.25 * delay, at);
    EXPECT_NEAR((state.gradient - to.gradient) / (from.gradient - to.gradient), std::exp(-0.25 * k), 1e-9);
    EXPECT_NEAR((state.temperature - to.temperature) / (from.temperature - to.temperature), std::exp(-k), 1e-9);
    const double rate = slowExplosive.rateIn(state, at).value(), ts = state.temperature, r = explosive.gasConstant;
    const double reaction = explosive.solidFactor * r * explosive.solidConductivity * 1832 * ts * ts *
                            std::exp(-explosive.activationEnergy / (r * ts)) / explosive.activationEnergy;
    const double flow = explosive.solidConductivity * state.gradient * rate;
    EXPECT_NEAR((0.5 * explosive.solidHeat * rate * rate + reaction) / flow, 1, 1e-12);
    EXPECT_GT(rate, m) << "the temperature rises before the gradient";
  }
}

TEST(UnsteadyBurn, HasNoRateWhereTheGradientIsTooSmall) {
  const ice::AtSurface at{1e6, 298, 1832};
  ice::SurfaceHeat state = slowExplosive.steady(at);
  state.gradient *= 0.1;
  EXPECT_FALSE(slowExplosive.rateIn(state, at));
}

TEST(UnsteadyBurn, ScalesItsDeviationFromTheSteadyRate) {
  const ice::AtSurface at{1e6, 298, 1832};
  ice::SurfaceHeat state = slowExplosive.steady(at);
  state.gradient *= 1.1;
  ice::UnsteadyBurn scaled = slowExplosive;
  scaled.exponent = 2;
  const double m = explosive.rate(at), ratio = slowExplosive.rateIn(state, at).value() / m;
  EXPECT_NE(ratio, 1);
  EXPECT_NEAR(scaled.rateIn(state, at).value() / (m * ratio * ratio), 1, 1e-12);
}

TEST(Induction, IsShorterIntoTheBodyThanAlongItsSurface) {
  const ice::Induction law{0.01, 1e5, 0.0026, 0.5};
  EXPECT_NEAR(law.part(1), 0.01, 1e-15);
  EXPECT_DOUBLE_EQ(law.part(0), 1);
  EXPECT_NEAR(law.part(std::sqrt(0.5)), 0.505, 1e-15);
  EXPECT_DOUBLE_EQ(law.time(1e-3, 4e5), 1e-3 / (2 * 0.0026));
}

TEST(Cracks, LetGasInThatHasThePressure) {
  const double radius = std::sqrt(8e8 / std::pow(1e7, 2.84));
  EXPECT_TRUE(ice::Ddt::enterCracks(1e7, 1.001 * radius));
  EXPECT_FALSE(ice::Ddt::enterCracks(1e7, 0.999 * radius));
  EXPECT_FALSE(ice::Ddt::enterCracks(-1e7, 1.001 * radius));
}

/// Six cells on a line: two cells of gas at 1 Pa and 2.5 K, then an explosive at 1 K without pressure.
struct Explosive {
  Level level{euler::closedBox(1, 6)};
  GasFields<1> fields{level.cells()};
  Field<double> mass{level.cells(), 0}, volume{mass}, temperature{mass}, others{mass}, hottest{mass}, pressure{mass},
      radius{mass}, mode{mass}, waited{mass}, induction{mass};
  Settings settings;
  ice::Ddt law;

  Explosive() {
    settings.gas.gas.specificHeat = 1;
    settings.burning = Burning();
    settings.burning->model.ignitionTemperature = 2;
    settings.burning->model.leastPressure = 0.5;
    law.detonationPressure = 10;
    for (std::size_t k = 2; k < 6; ++k) {
      fields.free.values[k] = fields.density.values[k] = fields.energy.values[k] = 0;
      mass.values[k] = 5;
      volume.values[k] = temperature.values[k] = hottest.values[k] = 1;
    }
  }
  BurnModes<1>::Found at(int cell, double dt = 0.1) {
    settings.burning->model.law = law;
    const Reactant reactant{{mass.seen(), volume.seen(), temperature.seen(), others.seen(), hottest.seen()}};
    const Load load{pressure.seen(), radius.seen()};
    Waited before;
    if (law.induction) before = {mode.seen(), waited.seen(), induction.seen()};
    return BurnModes<1>(level, settings, fields.gas(), reactant, load).find({cell}, before, dt);
  }
};

/// The same line with an explosive whose surface remembers how it burned.
struct Remembering : Explosive {
  Field<double> temperatureBefore{mass}, gradientBefore{mass};

  Remembering() {
    temperatureBefore.values.assign(6, 0);
    gradientBefore.values.assign(6, 0);
    settings.burning->model.law = ice::UnsteadyBurn{{1, 0.03, 5, 0.08, 0.2, 1.8, 0.01, 0.01, 1, 1}, 0.01, 0.25, 1};
  }
  UnsteadySurface<1>::Found at(int cell, double dt = 0.1) {
    const Reactant reactant{{mass.seen(), volume.seen(), temperature.seen(), others.seen(), hottest.seen()}};
    const SurfaceBefore before{temperatureBefore.seen(), gradientBefore.seen()};
    return UnsteadySurface<1>(level, settings, fields.gas(), reactant, before).find({cell}, dt);
  }
  ice::SurfaceHeat steadyState() const { return settings.burning->model.unsteady()->steady({1, 1, 5}); }
};

TEST(UnsteadySurface, IsWhereABodyMeetsAHotGas) {
  Remembering line;
  const ice::SurfaceHeat steady = line.steadyState();
  EXPECT_EQ(line.at(1).rate, 0) << "no explosive";
  EXPECT_EQ(line.at(3).rate, 0) << "inside";
  EXPECT_DOUBLE_EQ(line.at(2).state.temperature, steady.temperature);
  EXPECT_DOUBLE_EQ(line.at(2).rate, line.settings.burning->model.rate({1, 1, 5}));
  line.settings.burning->model.ignitionTemperature = 3;
  EXPECT_EQ(line.at(2).rate, 0);
  EXPECT_FALSE(line.at(2).state.burns());
}

TEST(UnsteadySurface, ContinuesWithItsStateOrThatOfItsNeighbours) {
  Remembering line;
  const ice::SurfaceHeat steady = line.steadyState();
  line.temperatureBefore.values[3] = steady.temperature;
  line.gradientBefore.values[3] = 1.1 * steady.gradient;
  EXPECT_NEAR(line.at(2, 1e-9).state.gradient, 1.1 * steady.gradient, 1e-7 * steady.gradient);
  line.temperatureBefore.values[2] = steady.temperature;
  line.gradientBefore.values[2] = 0.95 * steady.gradient;
  EXPECT_NEAR(line.at(2, 1e-9).state.gradient, 0.95 * steady.gradient, 1e-7 * steady.gradient);
}

TEST(BurnModes, OfASurfaceNeedAHotGasWithPressure) {
  Explosive line;
  EXPECT_EQ(line.at(1).mode, BurnMode::none) << "no explosive";
  EXPECT_EQ(line.at(2).mode, BurnMode::surface);
  EXPECT_EQ(line.at(3).mode, BurnMode::none) << "inside";
  line.settings.burning->model.ignitionTemperature = 3;
  EXPECT_EQ(line.at(2).mode, BurnMode::none);
  line.settings.burning->model.ignitionTemperature = 2;
  line.settings.burning->model.leastPressure = 1.1;
  EXPECT_EQ(line.at(2).mode, BurnMode::none);
}

TEST(BurnModes, OfADetonationEndTheRun) {
  Explosive line;
  line.pressure.values[3] = 11;
  EXPECT_EQ(line.at(2).mode, BurnMode::surface);
  EXPECT_THROW(line.at(3), NumericalError);
}

TEST(BurnModes, InCracksNeedThemWide) {
  Explosive line;
  line.law.burnsCracks = true;
  line.hottest.values[4] = 5;
  line.pressure.values[3] = 2;
  line.radius.values[3] = 1.01 * std::sqrt(8e8 / std::pow(2, 2.84));
  EXPECT_EQ(line.at(3).mode, BurnMode::cracks);
  EXPECT_EQ(line.at(3).pressure, 2);
  line.radius.values[3] *= 0.98;
  EXPECT_EQ(line.at(3).mode, BurnMode::none);
}

TEST(BurnModes, WaitForTheirFlame) {
  Explosive line;
  line.law.induction = ice::Induction{0.5, 1, 2, 0};  // a cell of 1/6 m in 1/12 s, into the body in half of it
  const auto first = line.at(2, 0.02);
  EXPECT_EQ(first.mode, BurnMode::waiting);
  EXPECT_DOUBLE_EQ(first.waited, 0.02);
  EXPECT_NEAR(first.induction, 0.5 * line.level.spacing(0) / 2, 1e-15);
  line.mode.values[2] = double(first.mode);
  line.waited.values[2] = first.waited;
  line.induction.values[2] = first.induction;
  const auto second = line.at(2, first.induction);
  EXPECT_EQ(second.mode, BurnMode::surface);
  line.mode.values[2] = double(second.mode);
  line.waited.values[2] = second.waited;
  EXPECT_EQ(line.at(2, 1e-9).mode, BurnMode::surface) << "from then on it burns";
}

TEST(BurnModes, GoOnThroughCracks) {
  Explosive line;
  line.law.burnsCracks = true;
  line.law.induction = ice::Induction{0.5, 1, 2, 0};
  line.hottest.values[2] = 5;
  line.radius.values[3] = line.radius.values[4] = 1e6;
  line.pressure.values[3] = line.pressure.values[4] = 1;
  EXPECT_EQ(line.at(3, 1).mode, BurnMode::none) << "nothing beside it burns";
  line.mode.values[2] = double(BurnMode::surface);
  EXPECT_EQ(line.at(3, 1).mode, BurnMode::cracks);
  EXPECT_EQ(line.at(3, 1e-3).mode, BurnMode::waiting);
  EXPECT_EQ(line.at(4, 1).mode, BurnMode::none) << "two cells away";
}

}  // namespace tushar::mpmice
