#include <gtest/gtest.h>

#include "tests/euler/gas_box.hpp"

namespace tushar::euler {

namespace {

template <int D>
class Dimension : public std::integral_constant<int, D> {};
template <class T>
class AdvanceInEachDimension : public testing::Test {};
using Dimensions = testing::Types<Dimension<1>, Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(AdvanceInEachDimension, Dimensions);

/// Number of cells along an axis: more than one block along the first axis in 1-D and 2-D.
template <int D>
constexpr int cellsAlong = D == 1   ? 300
                           : D == 2 ? 30
                                    : 12;

template <int D>
void expectSame(const GasBox<D>& a, const GasBox<D>& b) {
  EXPECT_EQ(a.density, b.density);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.momentum, b.momentum);
}

grid::BoundaryCondition inflow(const grid::BoundaryVariable& variable, const Vec3& value) {
  return {variable, BoundaryKind::dirichlet, value};
}

}  // namespace

TYPED_TEST(AdvanceInEachDimension, KeepsMassAndEnergyOfAClosedBox) {
  constexpr int D = TypeParam::value;
  for (const Method& method : allMethods()) {
    GasBox<D> box(closedBox(D, cellsAlong<D>), roughGas<D>, method);
    const double mass = box.mass(), energy = box.totalEnergy();
    for (int step = 0; step < 20; ++step) box.step(box.stableStep(0.8));
    // Each step rounds each cell once or twice: 20 steps, 1e-16 each.
    EXPECT_NEAR(box.mass() / mass, 1, 1e-14);
    EXPECT_NEAR(box.totalEnergy() / energy, 1, 1e-14);
  }
}

TYPED_TEST(AdvanceInEachDimension, LimitsTheSumOfRatesOrTheRateAlongEachAxis) {
  constexpr int D = TypeParam::value;
  State<D> w{};
  w[kDensity] = 1.4;
  w[kPressure<D>] = 4;  // so that c = 2
  for (int d = 0; d < D; ++d) w[kVelocity(d)] = d == 0 ? -3 : 1;
  GasBox<D> box(closedBox(D, cellsAlong<D>), [&](const Vec<D>&) { return w; });
  const double perWidth = box.level.inverseSpacing(0), axis = 5 * perWidth, sum = (5 + 3 * (D - 1)) * perWidth;
  EXPECT_NEAR(box.stableStep(0.3), 0.3 / sum, 1e-15);
  EXPECT_NEAR(box.stableStep(Courant{0.3, 0.8}), std::min(0.3 / axis, 0.8 / sum), 1e-15);
  EXPECT_NEAR(box.stableStep(Courant{0.7, 0.8}), D == 1 ? 0.7 / axis : 0.8 / sum, 1e-15) << "the sum must be stable";
  if (D == 1) {
    EXPECT_EQ(box.stableStep(Courant{0.3, 0.8}), box.stableStep(0.3));
  }
}

TYPED_TEST(AdvanceInEachDimension, KeepsAContactAtRestExactly) {
  constexpr int D = TypeParam::value;
  const auto contact = [](const Vec<D>& x) {
    State<D> w{};
    w[kDensity] = x[D - 1] < 0.5 ? 1 : 0.125 + 0.1 * x[D - 1];
    w[kPressure<D>] = 0.7;
    return w;
  };
  for (const Method& method : allMethods()) {
    GasBox<D> box(closedBox(D, cellsAlong<D>), contact, method);
    const GasBox<D> before(closedBox(D, cellsAlong<D>), contact, method);
    for (int step = 0; step < 5; ++step) box.step(box.stableStep(0.8));
    expectSame<D>(box, before);
  }
}

TYPED_TEST(AdvanceInEachDimension, LetsAUniformGasFlowOutUnchanged) {
  constexpr int D = TypeParam::value;
  const auto uniform = [](const Vec<D>&) {
    State<D> w;
    w.fill(0.7);
    return w;
  };
  GasBox<D> box(openBox(D, cellsAlong<D>), uniform);
  const GasBox<D> before(openBox(D, cellsAlong<D>), uniform);
  for (int step = 0; step < 5; ++step) box.step(box.stableStep(0.8));
  expectSame<D>(box, before);
}

TYPED_TEST(AdvanceInEachDimension, GivesTheSameBitsOnAnyPatches) {
  constexpr int D = TypeParam::value;
  for (const Method& method : allMethods()) {
    GasBox<D> whole(closedBox(D, cellsAlong<D>), roughGas<D>, method);
    const double dt = whole.stableStep(0.8);
    whole.step(dt);
    for (const int parts : {2, 7, 64}) {
      grid::Domain domain = closedBox(D, cellsAlong<D>);
      domain.patches = {{parts, D > 1 ? 3 : 1, D > 2 ? 5 : 1}};
      GasBox<D> split(domain, roughGas<D>, method);
      EXPECT_EQ(split.stableStep(0.8), dt);
      split.step(dt);
      expectSame<D>(split, whole);
    }
  }
}

TYPED_TEST(AdvanceInEachDimension, MirrorsToTheLastBit) {
  constexpr int D = TypeParam::value;
  constexpr int n = cellsAlong<D>;
  for (int axis = 0; axis < D; ++axis) {
    GasBox<D> box(closedBox(D, n), roughGas<D>), mirror(closedBox(D, n), roughGas<D>);
    const auto reflect = [&](const Index<D>& cell) {
      Index<D> other = cell;
      other[axis] = n - 1 - cell[axis];
      return other;
    };
    forEach<D>(box.level.cells(), [&](const Index<D>& cell) {
      const std::size_t to = mirror.level.template cellNumber<D>(cell);
      const std::size_t from = box.level.template cellNumber<D>(reflect(cell));
      mirror.density[to] = box.density[from];
      mirror.energy[to] = box.energy[from];
      mirror.momentum[to] = box.momentum[from];
      mirror.momentum[to][axis] *= -1;
    });
    for (int step = 0; step < 3; ++step) {
      const double dt = box.stableStep(0.8);
      box.step(dt);
      mirror.step(dt);
    }
    forEach<D>(box.level.cells(), [&](const Index<D>& cell) {
      State<D> expected = box.at(reflect(cell));
      expected[kVelocity(axis)] *= -1;
      ASSERT_EQ(mirror.at(cell), expected);
    });
  }
}

TEST(Advance, OfAPlaneWaveInTwoDimensionsIsThatInOneToTheLastBit) {
  for (const Method& method : allMethods())
    for (int axis = 0; axis < 2; ++axis) {
      GasBox<1> line(closedBox(1, 40), sodGas, method);
      grid::Domain domain = closedBox(2, 3);
      domain.resolution[axis] = 40;
      GasBox<2> plane(
          domain,
          [&](const Vec<2>& x) {
            const State<1> w = sodGas(Vec<1>(x[axis]));
            State<2> wide{w[0], 0, 0, w[2]};
            return wide;
          },
          method);
      for (int step = 0; step < 10; ++step) {
        const double dt = line.stableStep(0.5);
        line.step(dt);
        plane.step(dt);
      }
      forEach<2>(plane.level.cells(), [&](const Index<2>& cell) {
        const State<2> wide = plane.at(cell);
        const State<1> w = line.at(Index<1>{{cell[axis]}});
        ASSERT_EQ(wide[kDensity], w[kDensity]);
        ASSERT_EQ(wide[kVelocity(axis)], w[kVelocity(0)]);
        ASSERT_EQ(wide[kVelocity(1 - axis)], 0);
        ASSERT_EQ(wide[3], w[2]);
      });
    }
}

TEST(Advance, TakesInWhatFlowsThroughAFace) {
  grid::Domain domain = openBox(1, 50);
  domain.boundaries.face(0, 0) = {inflow(boundary::density, {2, 0, 0}), inflow(boundary::velocity, {3, 0, 0}),
                                  inflow(boundary::pressure, {1, 0, 0})};
  GasBox<1> box(domain, [](const Vec<1>&) { return gasAt(1, 3, 1); });  // supersonic: the inflow alone decides
  const double before = box.mass(), dt = box.stableStep(0.5);
  box.step(dt);
  EXPECT_NEAR(box.mass() - before, dt * (2 * 3 - 1 * 3), 1e-14);
  box.run(1, 0.8);
  for (const double rho : box.density) EXPECT_NEAR(rho, 2, 1e-3);
}

TEST(Advance, ContinuesWhatAFaceDoesNotPrescribe) {
  grid::Domain domain = openBox(1, 50);
  domain.boundaries.face(0, 0) = {inflow(boundary::velocity, {0.5, 0, 0})};
  GasBox<1> box(domain, [](const Vec<1>&) { return gasAt(1.3, 0.5, 2); });
  const GasBox<1> before(domain, [](const Vec<1>&) { return gasAt(1.3, 0.5, 2); });
  box.step(box.stableStep(0.8));
  expectSame<1>(box, before);
}

TEST(Advance, StopsAtAWall) {
  GasBox<1> box(closedBox(1, 50), [](const Vec<1>&) { return gasAt(1, -0.5, 1); });
  box.run(0.2, 0.8);
  // The gas runs into the left wall: a shock leaves it, with gas at rest behind.
  EXPECT_NEAR(box.momentum[0][0] / box.density[0], 0, 0.01);
  EXPECT_GT(box.density[0], 1.3);
  EXPECT_LT(box.density[49], 0.8);
}

TEST(Advance, IsOfSecondOrderOnASmoothWave) {
  // Without an extremum, where limiters are of first order.
  const auto wave = [](double x) { return 1 + 0.5 * std::tanh((x - 0.4) / 0.05); };
  const auto errorOf = [&](int cells, Method method) {
    GasBox<1> box(
        openBox(1, cells), [&](const Vec<1>& x) { return gasAt(wave(x[0]), 1, 1); }, method);
    box.run(0.2, 0.8);
    double error = 0;
    for (int i = 0; i < cells; ++i) error += std::abs(box.density[i] - wave((i + 0.5) / cells - 0.2));
    return error / cells;
  };
  for (const Limiter limiter : {Limiter::vanLeer, Limiter::mc}) {
    const Method second{FluxKind::hllc, Reconstruction::musclHancock, limiter};
    EXPECT_GT(std::log2(errorOf(200, second) / errorOf(400, second)), 1.9);
  }
  const Method first{FluxKind::hllc, Reconstruction::firstOrder, Limiter::minmod};
  EXPECT_NEAR(std::log2(errorOf(400, first) / errorOf(800, first)), 1, 0.15);
}

TEST(Advance, MovesAStiffenedGasAsAnIdealOneOfHigherPressure) {
  const auto raised = [](double by) {
    return [by](const Vec<1>& x) { return gasAt(sodGas(x)[0], 0, sodGas(x)[2] + by); };
  };
  GasBox<1> ideal(closedBox(1, 100), raised(0.0), {}, Gas{1.4, 0});
  GasBox<1> stiff(closedBox(1, 100), raised(-0.05), {}, Gas{1.4, 0.05});
  ideal.run(0.1, 0.8);
  stiff.run(0.1, 0.8);
  for (std::size_t i = 0; i < ideal.density.size(); ++i) EXPECT_NEAR(stiff.density[i], ideal.density[i], 1e-12);
}

TEST(Advance, StaysPositiveWhereGasFliesApartAndInBlasts) {
  for (const Method& method : allMethods()) {
    GasBox<1> apart(
        openBox(1, 200), [](const Vec<1>& x) { return gasAt(1, x[0] < 0.5 ? -2 : 2, 0.4); }, method);
    GasBox<1> blast(
        openBox(1, 200), [](const Vec<1>& x) { return gasAt(1, 0, x[0] < 0.5 ? 1e6 : 1e-3); }, method);
    EXPECT_NO_THROW(apart.run(0.15, 0.6));
    EXPECT_NO_THROW(blast.run(2e-4, 0.6));
  }
}

TEST(ComputeStableTimeStep, AddsTheSpeedsOfTheAxes) {
  grid::Domain domain = closedBox(2, 10);
  domain.resolution[1] = 20;
  GasBox<2> box(domain, [](const Vec<2>& x) { return State<2>{1.4, x[0] < 0.1 ? -3.0 : 1.0, 0.5, 1}; });
  EXPECT_DOUBLE_EQ(box.stableStep(0.5), 0.5 / ((3 + 1) / 0.1 + (0.5 + 1) / 0.05));
}

TEST(ComputeStableTimeStep, FollowsFromTheFastestCellWhereverItStands) {
  for (int cells = 1; cells < 20; ++cells)
    for (int fastest = 0; fastest < cells; ++fastest) {
      GasBox<1> box(closedBox(1, cells), [&](const Vec<1>& x) {
        return State<1>{1.4, static_cast<int>(x[0] * cells) == fastest ? -3.0 : 1.0, 1};
      });
      EXPECT_DOUBLE_EQ(box.stableStep(0.5), 0.5 / (4.0 * cells)) << cells << " cells, the fastest is " << fastest;
    }
}

TEST(ComputeStableTimeStep, NamesTheCellWhosePressureIsLost) {
  GasBox<1> box(closedBox(1, 300), sodGas);
  box.energy[270] = -1;
  try {
    box.stableStep(0.5);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_STREQ(error.what(),
                 "c.pressure became -0.4 Pa, but must be finite and greater than 0: cell (270) at x = "
                 "0.901667 m, density 0.125 kg/m^3");
    EXPECT_EQ(error.value(), "c.pressure");
    EXPECT_EQ(error.cell(), 270u);
  }
}

}  // namespace tushar::euler
