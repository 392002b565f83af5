#include <gtest/gtest.h>

#include <numbers>

#include "components/euler/tasks/add_diffusion.hpp"
#include "components/euler/tasks/add_gravity.hpp"
#include "components/euler/tasks/add_varying_diffusion.hpp"
#include "tests/euler/gas_box.hpp"

// Changes due to viscosity, conduction and gravity in a step, computed by calls of task bodies.

namespace tushar::euler {

namespace {

constexpr double pi = std::numbers::pi;

/// A gas with c_v = 2.5 and gamma = 1.4: R = 1, T = p / rho.
Gas air() {
  Gas gas;
  gas.specificHeat = 2.5;
  return gas;
}

/// A gas that only diffusion changes.
template <int D>
class StillBox : public GasBox<D> {
 public:
  using GasBox<D>::density, GasBox<D>::momentum, GasBox<D>::energy, GasBox<D>::grid, GasBox<D>::level;

  StillBox(const grid::Domain& domain, const typename GasBox<D>::Profile& profile, Diffusion how)
      : GasBox<D>(domain, profile, {}, air()), diffusion(how) {}

  void diffuse(double dt) {
    const auto oldMomentum = momentum;
    const auto oldEnergy = energy;
    for (const Patch& patch : grid.patches())
      addDiffusion<D>(patch, this->gas, diffusion,
                      {{view<const double>(density, patch, 1), view<const Vec<D>>(oldMomentum, patch, 1),
                        view<const double>(oldEnergy, patch, 1)}},
                      0, dt, view<Vec<D>>(momentum, patch, 0), view<double>(energy, patch, 0), {});
  }
  /// Adds the diffusion of a step of dt [s], with the task for viscosities that vary in space.
  void diffuse(const VaryingDiffusion& varying, double dt) {
    const auto oldMomentum = momentum;
    const auto oldEnergy = energy;
    for (const Patch& patch : grid.patches())
      addVaryingDiffusion<D>(patch, this->gas, varying,
                             {{view<const double>(density, patch, 1), view<const Vec<D>>(oldMomentum, patch, 1),
                               view<const double>(oldEnergy, patch, 1)}},
                             0, dt, view<Vec<D>>(momentum, patch, 0), view<double>(energy, patch, 0), {});
  }
  double stableDiffusion(const VaryingDiffusion& varying, double cfl) {
    Minimum dt;
    for (const Patch& patch : grid.patches())
      limitVaryingDiffusion<D>(patch, this->gas, varying, cfl,
                               {{view<const double>(density, patch, 1), view<const Vec<D>>(momentum, patch, 1),
                                 view<const double>(energy, patch, 1)}},
                               0, dt);
    return dt.value;
  }
  double stableDiffusion(double cfl) {
    Minimum dt;
    for (const Patch& patch : grid.patches())
      limitDiffusion<D>(patch, this->gas, diffusion, cfl, view<const double>(density, patch, 0),
                        view<const Vec<D>>(momentum, patch, 0), view<const double>(energy, patch, 0), dt);
    return dt.value;
  }
  double temperature(std::size_t i) const {
    return (energy[i] - 0.5 * momentum[i].squaredNorm() / density[i]) / (density[i] * this->gas.specificHeat);
  }

  Diffusion diffusion;

 private:
  template <class T, class Values>
  CellView<T> view(Values& values, const Patch& patch, int ghost) const {
    return {values.data(), level.cells(), patch.cellsWithin(ghost)};
  }
};

/// A box between walls at rest, normal to x, at two temperatures.
grid::Domain heatedBox(int cells, double lower, double upper) {
  grid::Domain domain = closedBox(1, cells);
  for (int side = 0; side < 2; ++side) {
    auto& face = domain.boundaries.face(0, side);
    face.clear();
    face.push_back({boundary::velocity, BoundaryKind::dirichlet, Vec3::Zero()});
    face.push_back({boundary::temperature, BoundaryKind::dirichlet, Vec3(side == 0 ? lower : upper, 0, 0)});
  }
  return domain;
}

/// Gas between two walls normal to y; the upper wall moves at 1 m/s along x.
grid::Domain shearedBox() {
  grid::Domain domain = closedBox(2, 16);
  domain.resolution[0] = 2;
  for (int side = 0; side < 2; ++side) {
    domain.boundaries.face(0, side).clear();
    auto& face = domain.boundaries.face(1, side);
    face.clear();
    face.push_back({boundary::velocity, BoundaryKind::dirichlet, Vec3(side, 0, 0)});
  }
  return domain;
}

}  // namespace

TEST(Diffusion, DampsAWaveOfTemperatureAtConstantVolume) {
  // dT/dt = k / (rho c_v) T'' between adiabatic walls: cos(pi x) exp(-kappa pi² t), second order in h.
  const double kappa = 0.1, until = 0.5;
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    const int cells = k == 0 ? 16 : 32;
    StillBox<1> box(closedBox(1, cells),
                    [](const Vec<1>& x) { return gasAt(2, 0, 2 * (1 + 0.3 * std::cos(pi * x[0]))); },
                    {0, kappa * 2 * 2.5});
    const double dt = 0.25 / (kappa * cells * cells);
    const int steps = static_cast<int>(std::lround(until / dt));
    for (int n = 0; n < steps; ++n) box.diffuse(dt);
    errors[k] = 0;
    for (int i = 0; i < cells; ++i) {
      const double x = (i + 0.5) / cells;
      const double exact = 1 + 0.3 * std::cos(pi * x) * std::exp(-kappa * pi * pi * steps * dt);
      errors[k] = std::max(errors[k], std::abs(box.temperature(i) - exact));
    }
  }
  EXPECT_LT(errors[0], 5e-4);
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.2);
}

TEST(Diffusion, LeadsHeatSteadilyBetweenTwoWalls) {
  StillBox<1> box(heatedBox(8, 1, 3), [](const Vec<1>&) { return gasAt(1, 0, 1); }, {0, 1});
  for (int n = 0; n < 4000; ++n) box.diffuse(0.4 * 2.5 / 64 / 2);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(box.temperature(i), 1 + 2 * (i + 0.5) / 8, 1e-12);
}

TEST(Diffusion, ShearsGasBetweenMovingWallsLinearly) {
  // Couette's flow; heat of friction leaves through both walls: T = 1 + mu U² / (2 k) y (1 - y), to second order.
  grid::Domain domain = shearedBox();
  for (int side = 0; side < 2; ++side)
    domain.boundaries.face(1, side).push_back({boundary::temperature, BoundaryKind::dirichlet, Vec3(1, 0, 0)});
  const auto rest = [](const Vec<2>&) {
    State<2> w{};
    w[kDensity] = w[kPressure<2>] = 1;
    return w;
  };
  StillBox<2> box(domain, rest, {1, 2});
  for (int n = 0; n < 4000; ++n) box.diffuse(1e-3);
  for (int i = 0; i < 16; ++i) {
    const double y = (i + 0.5) / 16;
    const std::size_t cell = box.level.cellNumber<2>(Index<2>{{0, i}});
    EXPECT_NEAR(box.momentum[cell][0], y, 1e-12);
    EXPECT_NEAR(box.temperature(cell), 1 + 0.25 * y * (1 - y), 1.0 / 256);
  }
}

TEST(Diffusion, KeepsTheEnergyOfAClosedBox) {
  StillBox<3> box(closedBox(3, 6), roughGas<3>, {0.1, 0.3});
  const double energy = box.totalEnergy();
  for (int n = 0; n < 5; ++n) box.diffuse(1e-3);
  EXPECT_NEAR(box.totalEnergy(), energy, 1e-14 * energy);
}

TEST(Diffusion, LeavesNothingThroughASlippingWallOrAnOpenSide) {
  // Gas that moves along x past walls normal to y, which are planes of symmetry.
  for (const bool open : {false, true}) {
    grid::Domain domain = open ? openBox(2, 6) : closedBox(2, 6);
    for (int side = 0; side < 2; ++side) domain.boundaries.face(0, side).clear();
    const auto moving = [](const Vec<2>&) { return State<2>{1, 0.5, 0, 1}; };
    StillBox<2> box(domain, moving, {0.1, 0.3});
    const auto before = box.momentum;
    const auto energy = box.energy;
    box.diffuse(1e-2);
    EXPECT_EQ(box.momentum, before);
    EXPECT_EQ(box.energy, energy);
  }
}

TEST(Diffusion, LimitsTheStep) {
  // h = 1/8, sound speed 1, v = .5, greatest diffusivity k / (rho c_v) = .4: 1 / dt = (1.5 / h + 2 .4 / h²) / cfl.
  StillBox<1> box(closedBox(1, 8), [](const Vec<1>&) { return gasAt(1, 0.5, 1 / 1.4); }, {0.1, 1});
  EXPECT_NEAR(box.stableDiffusion(0.5), 0.5 / (1.5 * 8 + 2 * 0.4 * 64), 1e-15);
}

TEST(VaryingDiffusion, IsDiffusionWhereNothingVaries) {
  StillBox<3> box(closedBox(3, 6), roughGas<3>, {0.1, 0.3}), varying(closedBox(3, 6), roughGas<3>, {});
  box.diffuse(1e-3);
  varying.diffuse(VaryingDiffusion{.uniform = {0.1, 0.3}}, 1e-3);
  for (std::size_t i = 0; i < box.energy.size(); ++i) {
    EXPECT_NEAR((varying.momentum[i] - box.momentum[i]).norm(), 0, 1e-15);
    EXPECT_NEAR(varying.energy[i], box.energy[i], 1e-14);
  }
  StillBox<1> line(closedBox(1, 8), [](const Vec<1>&) { return gasAt(1, 0.5, 1 / 1.4); }, {0.1, 1});
  EXPECT_NEAR(line.stableDiffusion(VaryingDiffusion{.uniform = {0.1, 1}}, 0.5), line.stableDiffusion(0.5), 1e-15);
}

TEST(VaryingDiffusion, HasTheViscosityOfAirBySutherland) {
  // Tables of air: 1.716e-5 Pa s at 273.15 K, 2.286e-5 at 400 K.
  const VaryingDiffusion air{.sutherland = Sutherland{1.458e-6, 110.4}};
  EXPECT_NEAR(air.at(Vec3::Zero(), 273.15).viscosity, 1.716e-5, 2e-8);
  EXPECT_NEAR(air.at(Vec3::Zero(), 400).viscosity, 2.286e-5, 2e-8);
}

TEST(VaryingDiffusion, TakesTheLastSpongeLayer) {
  VaryingDiffusion how{.uniform = {1, 2}, .sutherland = Sutherland{}};
  how.sponges = {{Vec3(0, 0, 0), Vec3(0.5, 1, 1), 7}, {Vec3(0.25, 0, 0), Vec3(0.5, 1, 1), 9}};
  EXPECT_EQ(how.at(Vec3(0.1, 0, 0), 1).viscosity, 7);
  EXPECT_EQ(how.at(Vec3(0.3, 0, 0), 1).viscosity, 9);
  EXPECT_EQ(how.at(Vec3(0.6, 0, 0), 1).viscosity, 0);
  EXPECT_EQ(how.at(Vec3(0.6, 0, 0), 1).conductivity, 2);
}

TEST(VaryingDiffusion, HasOneStressAcrossLayersOfTwoViscosities) {
  // Between walls at 0 and 1 m/s the stress is U / (sum of thickness / mu): mu 1 below y = 1/2 and 3 above it, and the
  // mean, 2, at the face between them, which counts for the width of a cell.
  const auto rest = [](const Vec<2>&) { return State<2>{1, 0, 0, 1}; };
  StillBox<2> box(shearedBox(), rest, {});
  const VaryingDiffusion how{.uniform = {1, 0}, .sponges = {{Vec3(-1, 0.5, -1), Vec3(2, 2, 2), 3}}};
  for (int n = 0; n < 8000; ++n) box.diffuse(how, 5e-4);
  const auto u = [&](int i) { return box.momentum[box.level.cellNumber<2>(Index<2>{{0, i}})][0]; };
  const double h = 1.0 / 16, stress = (u(3) - u(2)) / h;
  EXPECT_NEAR(3 * (u(12) - u(11)) / h, stress, 1e-10);
  EXPECT_NEAR(2 * (u(8) - u(7)) / h, stress, 1e-10);
  EXPECT_NEAR(1 / stress, 7.5 * h + h / 2 + 7.5 * h / 3, 1e-10);
}

TEST(VaryingDiffusion, OfEddiesInAShear) {
  // v_x = s y: sqrt(2 S : S) = s, so that mu + rho (C Delta)² s, Delta the cubic root of a cell's volume.
  grid::Domain domain = openBox(3, 4);
  const auto shear = [](const Vec<3>& x) { return State<3>{2, 3 * x[1], 0, 0, 1}; };
  StillBox<3> box(domain, shear, {});
  const Patch& patch = box.grid.patches().front();
  const GhostRules<3> rules = diffusionRules<3>(box.level, box.gas, 0);
  const double constant = 0.2, delta = 0.25;
  Diffuser<3> diffuser(box.level, patch.cells(), rules, constant);
  diffuser.hold(patch.cells(), [&](const Index<3>& cell) {
    DiffusingCell<3> one;
    one.w[kTemperature] = 1;
    one.w[kVelocity(0)] = 3 * box.level.cellCentre<3>(cell)[1];
    one.how = {0.1, 0};
    one.density = 2;
    return one;
  });
  const double exact = 0.1 + 2 * constant * constant * delta * delta * 3;
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(diffuser.atFace(Index<3>{{2, 2, 2}}, axis).viscosity, exact, 1e-14) << axis;
}

TEST(Force, PushesAllGasAlike) {
  StillBox<2> box(closedBox(2, 4), roughGas<2>, {});
  const auto before = box.momentum;
  const double temperature = box.temperature(5);
  const Patch& patch = box.grid.patches().front();
  addForce<2>(patch, {3, 0, 0}, {box.density.data(), box.level.cells(), patch.cells()}, 0.1,
              {box.momentum.data(), box.level.cells(), patch.cells()},
              {box.energy.data(), box.level.cells(), patch.cells()});
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(box.momentum[i][0], before[i][0] + 0.3, 1e-15);
  EXPECT_NEAR(box.temperature(5), temperature, 1e-13);
}

TEST(Gravity, ChangesTheKineticEnergyAlone) {
  StillBox<2> box(closedBox(2, 4), roughGas<2>, {});
  std::vector<double> temperature;
  for (std::size_t i = 0; i < box.density.size(); ++i) temperature.push_back(box.temperature(i));
  const auto before = box.momentum;
  const Patch& patch = box.grid.patches().front();
  addGravity<2>(patch, {1, -2, 7}, {box.density.data(), box.level.cells(), patch.cells()}, 0.1,
                {box.momentum.data(), box.level.cells(), patch.cells()},
                {box.energy.data(), box.level.cells(), patch.cells()});
  for (std::size_t i = 0; i < box.density.size(); ++i) {
    EXPECT_NEAR(box.momentum[i][0], before[i][0] + 0.1 * box.density[i], 1e-14);
    EXPECT_NEAR(box.momentum[i][1], before[i][1] - 0.2 * box.density[i], 1e-14);
    EXPECT_NEAR(box.temperature(i), temperature[i], 1e-13);
  }
}

}  // namespace tushar::euler
