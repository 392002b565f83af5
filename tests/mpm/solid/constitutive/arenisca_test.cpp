#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "components/mpm/solid/constitutive/arenisca.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

// Arenisca: the return to the yield surface, and stresses and strains in closed form.

namespace tushar::mpm::solid {
namespace {

using arenisca::Invariants;
using arenisca::YieldSurface;
using testing::MaterialPoint;
using testing::rotation;

/// A cone with its vertex at 600 Pa and a cap; bulk and shear moduli of 10 and 15 kPa.
Arenisca4 sandstone(int lodeType = 0) {
  Arenisca4 model;
  model.peakI1 = 600;
  model.vertexSlope = 0.1;
  model.b0 = 10000;
  model.g0 = 15000;
  model.p0 = -1800;
  model.p1 = 6.7e-4;
  model.p3 = 0.5;
  model.capRatio = 0.5;
  model.lodeType = lodeType;
  model.lodeRatio = lodeType == 0 ? 1 : 0.8;
  return model;
}

/// The cone of sandstone() without a cap.
Arenisca4 cone() {
  Arenisca4 model = sandstone();
  model.p0 = -1e99;
  model.p1 = -1e99;
  return model;
}

/// The exponential of a diagonal tensor.
Matrix3 stretched(double x, double y, double z) {
  return Eigen::Vector3d(std::exp(x), std::exp(y), std::exp(z)).asDiagonal();
}

/// Deforms a point to F, which is diagonal, in steps with D dt = `strain`.
template <class M>
void strain(MaterialPoint<M>& point, const Eigen::Vector3d& strain, int steps) {
  for (int k = 0; k < steps; ++k) {
    const Matrix3 f = stretched(strain[0], strain[1], strain[2]) * point.oldDeformation;
    const Matrix3 rate = (strain / point.timeStep).asDiagonal();
    const Deformation d{f, point.oldDeformation, rate, point.timeStep, 0};
    point.oldStress = point.model.updateStress(d, point.oldStress, point.oldState);
    point.oldDeformation = f;
  }
}

TEST(Arenisca, ReturnsToItsYieldSurfaceForEveryLodeAngle) {
  std::mt19937 engine(7);
  std::normal_distribution<double> any(0, 0.05);
  for (const int lodeType : {0, 1, 3})
    for (int k = 0; k < 40; ++k) {
      MaterialPoint<Arenisca4> point{sandstone(lodeType)};
      Matrix3 f = Matrix3::Identity();
      for (double& component : f.reshaped()) component += any(engine);
      point.advance(f);
      const Invariants stress(point.oldStress);
      const YieldSurface surface(point.model, point.oldState.cap, point.oldState.zeta);
      // Where the last surface of the bisection and that of the plastic strain differ, by 1e-7 of the strain.
      const double tolerance = 1e-5 * 600;
      EXPECT_LE(stress.i1, surface.vertex() + tolerance);
      EXPECT_GE(stress.i1, surface.end() - tolerance);
      EXPECT_LE(stress.rootJ2, surface.lodeFactor(stress.theta) * surface.radius(stress.i1) + tolerance);
    }
}

TEST(Arenisca, ReturnsToTheNearestPoint) {
  for (const int lodeType : {0, 1, 3})
    for (const double theta : {-0.5, -0.2, 0.1, 0.45})
      for (const double i1 : {-2500.0, -1500.0, -300.0, 500.0, 900.0}) {
        const Arenisca4 model = sandstone(lodeType);
        const YieldSurface surface(model, -1800, 0);
        const Invariants trial(i1, 400, theta);
        const Invariants found = arenisca::ClosestPoint(model, {10000, 15000}, surface)(trial);
        const auto distance = [&](const Invariants& point) {
          const double stretch = std::sqrt(3 * 10000 / 15000.0);
          const double r = stretch * point.rootJ2, s = stretch * trial.rootJ2;
          const double z = (point.i1 - trial.i1) / std::numbers::sqrt3;
          return std::sqrt(z * z + r * r + s * s - 2 * r * s * std::cos(point.theta - trial.theta));
        };
        for (double i = -1800; i <= 600; i += 7)
          for (double angle = -std::numbers::pi / 6; angle <= std::numbers::pi / 6; angle += 0.02)
            ASSERT_LE(distance(found), distance({i, surface.lodeFactor(angle) * surface.radius(i), angle}) + 1e-6)
                << lodeType << ' ' << theta << ' ' << i1;
      }
}

/// On the cone in uniaxial strain, dI1 = 3 K (de - 3 a dl) with dl = |de| (2 G / sqrt 3 - 3 K a) / (G + 9 K a^2).
TEST(Arenisca, FollowsItsConeInUniaxialStrain) {
  MaterialPoint<Arenisca4> point{cone()};
  const double bulk = 10000, shear = 15000, slope = 0.1, end = 0.05;
  strain(point, {-end / 100, 0, 0}, 100);
  const double toYield = slope * 600 / (2 * shear / std::numbers::sqrt3 - 3 * bulk * slope);
  const double flow = (2 * shear / std::numbers::sqrt3 - 3 * bulk * slope) / (shear + 9 * bulk * slope * slope);
  const double i1 = -3 * bulk * (toYield + (end - toYield) * (1 + 3 * slope * flow));
  EXPECT_NEAR(point.oldStress.trace(), i1, 1e-8 * std::abs(i1));
  EXPECT_NEAR(Invariants(point.oldStress).rootJ2, slope * (600 - i1), 1e-8 * std::abs(i1));
  EXPECT_NEAR(point.oldState.plasticVolume, 3 * slope * flow * (end - toYield), 1e-10) << "it dilates";
}

/// ln det F = p3 (exp(p1 (I1 - p0)) - 1) + I1 / (3 K) beyond p0.
TEST(Arenisca, FollowsTheCrushCurveUnderPressure) {
  for (const double end : {-0.1, -0.3, -0.45}) {
    MaterialPoint<Arenisca4> point{sandstone()};
    strain(point, Eigen::Vector3d::Constant(end / 300), 100);
    const double i1 = point.oldStress.trace();
    EXPECT_NEAR(0.5 * (std::exp(6.7e-4 * (i1 + 1800)) - 1) + i1 / 30000, end, 1e-6) << i1;
    EXPECT_NEAR(Invariants(point.oldStress).rootJ2, 0, 1e-6);
  }
}

TEST(Arenisca, IsElasticOnceItsPoresHaveCollapsed) {
  MaterialPoint<Arenisca4> point{sandstone()};
  strain(point, Eigen::Vector3d::Constant(-0.01), 100);
  EXPECT_NEAR(point.oldState.plasticVolume, -0.5, 1e-4);
  const double before = point.oldStress.trace();
  strain(point, Eigen::Vector3d::Constant(-0.01), 1);
  EXPECT_NEAR(point.oldStress.trace() - before, -900, 2);
}

TEST(Arenisca, TurnsWithTheMaterial) {
  const Matrix3 turn = rotation(0.7), f = testing::generalDeformation(0.03);
  MaterialPoint<Arenisca4> plain{sandstone(1)}, turned{sandstone(1)};
  plain.advance(f);
  const Deformation d = plain.step(testing::generalDeformation(0.05));
  const Deformation seen{turn * d.deformationGradient, turn * d.oldDeformationGradient,
                         turn * d.velocityGradient * turn.transpose(), d.timeStep, 0};
  turned.oldStress = turn * plain.oldStress * turn.transpose();
  turned.oldState = plain.oldState;
  turned.oldState.quasistatic = tensorOf(turned.oldStress);
  const Matrix3 here = plain.model.updateStress(d, plain.oldStress, plain.oldState);
  const Matrix3 there = turned.model.updateStress(seen, turned.oldStress, turned.oldState);
  EXPECT_LT((turn * here * turn.transpose() - there).norm(), 1e-8 * here.norm());
  EXPECT_NEAR(plain.oldState.cap, turned.oldState.cap, 1e-6);
}

TEST(Arenisca, StoresAndDissipatesEnergy) {
  const auto work = [](double amplitude) {
    MaterialPoint<Arenisca4> point{sandstone()};
    double sum = 0;
    for (int k = 0; k < 400; ++k) {
      const double step = (k < 200 ? amplitude : -amplitude) / 200;
      const Matrix3 before = point.oldStress, old = point.oldDeformation;
      strain(point, {-step, 0, 0}, 1);
      const Matrix3 rate = Eigen::Vector3d(-step / point.timeStep, 0, 0).asDiagonal();
      sum += point.model.strainEnergyDensity({point.oldDeformation, old, rate, point.timeStep, 0}, before,
                                             point.oldStress, point.oldState);
    }
    return sum;
  };
  EXPECT_NEAR(work(0.002), 0, 1e-3 * 0.5 * 30000 * 0.002 * 0.002) << "elastic, but for J in the last digits";
  EXPECT_GT(work(0.05), 0.1 * 0.5 * 30000 * 0.05 * 0.05);
}

/// d sigma = 3 K de with K = b0 + b1 exp(b2 / I1) - b3 exp(b4 / e_p), here without plastic strain.
TEST(Arenisca, StiffensUnderPressure) {
  MaterialPoint<Arenisca4> point{cone()};
  point.model.b1 = 30000;
  point.model.b2 = 100;
  strain(point, Eigen::Vector3d::Constant(-1e-5), 3000);
  double i1 = 0;  // by Runge and Kutta's method, midpoint
  const auto rate = [](double at) { return -9 * (10000 + (at < 0 ? 30000 * std::exp(100 / at) : 0.0)); };
  for (int k = 0; k < 3000; ++k) i1 += 1e-5 * rate(i1 + 0.5e-5 * rate(i1));
  EXPECT_NEAR(point.oldStress.trace(), i1, 1e-3 * std::abs(i1)) << "moduli of the start of each step";
}

/// The wave speed is that of the largest moduli at any pressure, or slightly more.
TEST(Arenisca, HasWavesAsFastAsItsStiffestShearModulus) {
  for (const auto& [atRest, byPressure] : {std::pair{0.2, 0.2}, {0.4, -0.3}, {0.1, 0.39}, {-0.5, 0.8}, {0.2, 0.0}}) {
    Arenisca4 model = cone();
    std::tie(model.b1, model.b2, model.g1, model.g2) = std::tuple(30000, 1500, atRest, byPressure);
    double greatest = model.g0;
    for (double i1 = -10; i1 > -1e8; i1 *= 1.01) greatest = std::max(greatest, arenisca::moduli(model, i1, 0).shear);
    const Matrix3 f = Matrix3::Identity();
    const double speed = model.waveSpeed(2, {f, f, f, 1, 300}, f, model.initialState());
    const double shear = 0.75 * (2 * speed * speed - model.matrixBulk());
    EXPECT_GE(shear, greatest * (1 - 1e-12)) << atRest << ' ' << byPressure;
    EXPECT_NEAR(shear / greatest, 1, 1e-3) << atRest << ' ' << byPressure;
  }
}

/// A cone with a tangent cap, as in Uintah's oldest Arenisca.
Arenisca2 roundedSandstone(double capShape) {
  Arenisca2 model;
  static_cast<arenisca::Constants&>(model) = sandstone();
  model.capShape = capShape;
  model.mostSubsteps = 10;
  return model;
}

/// In z and r, the semi-axes are a and b = CR a, and the cone has slope B. A line touches an ellipse if the square of
/// its distance from the centre is the sum of the squares of the semi-axes times the components of the line's normal.
TEST(Arenisca, HasACapThatTouchesItsCone) {
  for (const double capShape : {0.3, 1.0, 6.0, 14.8}) {
    const Arenisca2 model = roundedSandstone(capShape);
    const YieldSurface surface(model, -1800, 0);
    const double stretch = std::sqrt(3 * 10000 / 15000.0), steepness = 0.1 * stretch * std::numbers::sqrt3;
    const double whole = 2400 / std::numbers::sqrt3;
    double low = 0, high = whole;  // of the half axis a, by bisection
    for (int k = 0; k < 100; ++k) {
      const double a = 0.5 * (low + high);
      (a + std::hypot(a, capShape * a / steepness) < whole ? low : high) = a;
    }
    const double middle = -1800 + low * std::numbers::sqrt3;
    EXPECT_NEAR(surface.radius(middle), capShape * low / stretch, 1e-9) << "the height of the ellipse";
    EXPECT_NEAR(surface.slope(middle), 0, 1e-9);
    EXPECT_NEAR(surface.radius(-1800), 0, 1e-9);
    const double branch = surface.branch();
    EXPECT_NEAR(surface.radius(branch * (1 + 1e-9)), 0.1 * (600 - branch), 1e-3);
    EXPECT_NEAR(surface.slope(branch + 1e-6 * (-1800 - branch)), -0.1, 1e-3) << "without an edge";
    for (double i = -1799; i < 600; i += 7) {
      EXPECT_LE(surface.radius(i), 0.1 * (600 - i) * (1 + 1e-12));
      const double step = 1e-4;
      EXPECT_NEAR(surface.slope(i), (surface.radius(i + step) - surface.radius(i - step)) / 2 / step,
                  1e-4 * (1 + std::abs(surface.slope(i))));
    }
  }
}

TEST(Arenisca, ReturnsToTheNearestPointOfATangentCap) {
  const Arenisca2 model = roundedSandstone(1);
  const YieldSurface surface(model, -1800, 0);
  const double stretch = std::sqrt(3 * 10000 / 15000.0);
  for (const double i1 : {-2500.0, -1700.0, -1500.0, -300.0, 500.0, 900.0}) {
    const Invariants found = arenisca::ClosestPoint(model, {10000, 15000}, surface)({i1, 400, 0.2});
    const auto distance = [&](double i, double rootJ2) {
      return std::hypot((i - i1) / std::numbers::sqrt3, stretch * (rootJ2 - 400));
    };
    for (double i = -1800; i <= 600; i += 0.5)
      ASSERT_LE(distance(found.i1, found.rootJ2), distance(i, surface.radius(i)) + 1e-6) << i1;
  }
}

/// The tangent cap ends where the other cap does, and K is constant.
TEST(Arenisca, FollowsTheCrushCurveWithATangentCap) {
  for (const double end : {-0.1, -0.3, -0.45}) {
    MaterialPoint<Arenisca2> point{roundedSandstone(6)};
    strain(point, Eigen::Vector3d::Constant(end / 300), 100);
    const double i1 = point.oldStress.trace();
    EXPECT_NEAR(0.5 * (std::exp(6.7e-4 * (i1 + 1800)) - 1) + i1 / 30000, end, 1e-6) << i1;
  }
}

/// On the cone the model agrees with the others; see FollowsItsConeInUniaxialStrain.
TEST(Arenisca, FollowsItsConeAlsoWithATangentCap) {
  Arenisca2 model = roundedSandstone(14.8);
  model.p0 = model.p1 = -1e99;
  MaterialPoint<Arenisca2> point{model};
  MaterialPoint<Arenisca4> other{cone()};
  strain(point, {-5e-4, 0, 0}, 100);
  strain(other, {-5e-4, 0, 0}, 100);
  EXPECT_LT((point.oldStress - other.oldStress).norm(), 1e-8 * other.oldStress.norm());
}

TEST(Arenisca, StartsUnderThePressureOfItsFluid) {
  MaterialPoint<Arenisca4> point{sandstone()};
  point.model.b0 = 6000;
  point.model.b1 = 20000;
  point.model.b2 = 1500;
  point.model.fluidBulk = 3000;
  point.model.fluidPressure = 50;
  point.oldState = point.model.initialState();
  point.oldStress = point.model.initialStress();
  EXPECT_EQ(point.oldStress, -50 * Matrix3::Identity());
  EXPECT_DOUBLE_EQ(point.oldState.zeta, -150);
  strain(point, Eigen::Vector3d::Constant(-1e-5), 1);
  EXPECT_LT((point.oldStress.trace() + 150) / (-9e-5), 26000);
  EXPECT_GT((point.oldStress.trace() + 150) / (-9e-5), 6000 + 20000 * std::exp(-1500 / 150.0)) << "stiffer than dry";
  EXPECT_GT(point.oldState.porePressure, 50);
  const double zeta = point.oldState.zeta;
  strain(point, Eigen::Vector3d::Constant(-1e-3), 200);
  EXPECT_LT(point.oldState.plasticVolume, 0);
  EXPECT_LT(point.oldState.zeta, zeta) << "collapsing pores press the fluid";
}

/// At a constant rate the stress exceeds the stress of a cylinder without hardening by 2 G D t1 |D|^-t2.
TEST(Arenisca, BearsMoreAtAHighRate) {
  Arenisca4 model = cone();
  model.peakI1 = model.vertexSlope = 0;
  model.strength = 40;
  MaterialPoint<Arenisca4> slow{model}, fast{model};
  fast.model.t1 = 2e-3;
  fast.model.t2 = 0.5;
  const Eigen::Vector3d shear(1e-3, -1e-3, 0);
  for (MaterialPoint<Arenisca4>* point : {&slow, &fast}) strain(*point, shear, 200);
  EXPECT_NEAR(Invariants(slow.oldStress).rootJ2, 40, 1e-8);
  const double rate = std::sqrt(2.0) * 1e-3 / fast.timeStep;
  const double over = 2 * 15000 * 1e-3 / fast.timeStep * 2e-3 / std::sqrt(rate);
  EXPECT_NEAR(fast.oldStress(0, 0) - slow.oldStress(0, 0), over, 1e-6 * over);
}

}  // namespace
}  // namespace tushar::mpm::solid
