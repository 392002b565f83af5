#include <gtest/gtest.h>

#include "tests/euler/gas_box.hpp"

// Sides that let waves out.

namespace tushar::euler {

namespace {

constexpr double far = 1 / 1.4;  // pressure at which the speed of sound is 1 where the density is

/// A tube with a non-reflecting side at 1 and either a wall or another such side at 0.
grid::Domain tube(int cells, double sigma, bool hasWall) {
  grid::Domain domain = closedBox(1, cells);
  for (int side = hasWall ? 1 : 0; side < 2; ++side) {
    auto& face = domain.boundaries.face(0, side);
    face.clear();
    face.push_back({boundary::waves, BoundaryKind::dirichlet, Vec3(far, sigma, 0)});
  }
  return domain;
}

/// Returns the mean and the largest value of p - p_far.
std::pair<double, double> excess(const GasBox<1>& box) {
  double mean = 0, most = 0;
  for (std::size_t i = 0; i < box.density.size(); ++i) {
    const double kinetic = 0.5 * box.momentum[i].squaredNorm() / box.density[i];
    const double p = box.gas.pressure(box.density[i], box.energy[i] - kinetic);
    mean += (p - far) / static_cast<double>(box.density.size());
    most = std::max(most, std::abs(p - far));
  }
  return {mean, most};
}

/// A sound pulse of small amplitude that travels towards x+.
State<1> pulse(const Vec<1>& x) {
  const double rise = 1e-4 * std::exp(-200 * (x[0] - 0.5) * (x[0] - 0.5));
  return gasAt(1 + rise, rise, far + rise);
}

}  // namespace

TEST(Waves, LeaveTheTube) {
  for (const double sigma : {0.0, 0.27}) {
    GasBox<1> box(tube(100, sigma, false), pulse, {.reconstruction = Reconstruction::musclHancock});
    box.run(1, 0.4);
    EXPECT_LT(excess(box).second, sigma > 0 ? 3e-6 : 5e-7) << sigma;
  }
}

TEST(Waves, RelaxToThePressureFarAway) {
  // Sound travels to the wall and back in 2 L / c. So the wave w(t) that enters at the side and its echo obey w' = -K
  // (w(t) + w(t - 2 L / c)) / 2. For w = exp(-s t): s L / c = sigma (1 + exp(2 s L / c)) / 2 = .05278. With slopes, the
  // limiter leaves nine tenths of this, because the side sees part of the slope in the last cell.
  for (const Reconstruction how : {Reconstruction::firstOrder, Reconstruction::musclHancock}) {
    GasBox<1> box(tube(50, 0.05, true), [](const Vec<1>&) { return gasAt(1, 0, far * (1 + 1e-4)); },
                  {.reconstruction = how});
    box.run(10, 0.4);
    const double first = excess(box).first;
    box.run(10, 0.4);
    const bool hasSlopes = how == Reconstruction::musclHancock;
    EXPECT_NEAR(std::log(first / excess(box).first) / 10 / 0.05278, hasSlopes ? 0.89 : 1, 0.02);
  }
}

TEST(Waves, RelaxAGasWhosePressureDependsOnItsDensity) {
  // Murnaghan's law with c = 1 at the density 1. The last component is rho c_v T, which is much greater than p here.
  const ColdCurve cold{
      .kind = ColdCurve::Kind::murnaghan, .density = 1, .exponent = 2, .compressibility = 1, .pressureThere = far};
  const Gas gas{.specificHeat = 1, .law = std::make_shared<const Gas::Law>(CurvedGas(cold, 0, 1))};
  const auto compressed = [](const Vec<1>&) { return gasAt(1 + far * 1e-4, 0, 300 * (1 + far * 1e-4)); };
  GasBox<1> box(tube(50, 0.05, true), compressed, {.reconstruction = Reconstruction::firstOrder}, gas);
  EXPECT_NEAR(excess(box).first / (far * 1e-4), 1, 1e-3);
  box.run(10, 0.4);
  const double first = excess(box).first;
  box.run(10, 0.4);
  EXPECT_NEAR(std::log(first / excess(box).first) / 10 / 0.05278, 1, 0.02);
  for (std::size_t i = 0; i < box.density.size(); ++i)
    EXPECT_NEAR(gas.temperature(box.density[i], box.energy[i]), 300, 0.01);
}

TEST(Waves, OfASideAtThatPressureDoNothing) {
  const auto rest = [](const Vec<1>&) { return gasAt(1, 0.2, far); };
  GasBox<1> box(tube(20, 0.27, false), rest, {.reconstruction = Reconstruction::musclHancock});
  box.run(0.5, 0.4);
  EXPECT_LT(excess(box).second, 1e-14);
}

}  // namespace tushar::euler
