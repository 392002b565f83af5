#include "components/reference/piecewise_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace tushar::reference {
namespace {

/// Density 1 within a surface and 0 outside; pressure x² y z inside.
template <class Inside>
class Body : public GasReference {
 public:
  explicit Body(Inside inside) : inside_(inside) {}
  GasState at(const Vec3& x, double) const override {
    GasState gas;
    gas.density = inside_(x) ? 1 : 0;
    gas.pressure = inside_(x) ? x[0] * x[0] * x[1] * x[2] : 0;
    return gas;
  }

 private:
  Inside inside_;
};

double partInside(const Sphere& sphere, const Vec3& lower, const Vec3& upper) {
  const Body ball([&](const Vec3& x) { return (x - sphere.centre).cwiseProduct(sphere.round).norm() < sphere.radius; });
  return piecewiseMean(ball, std::vector{sphere}, lower, upper, 0).density;
}

TEST(PiecewiseMean, FindsTheVolumeOfABall) {
  const Sphere ball{Vec3(0.1, 0.2, 0.3), 0.5, Vec3::Ones()};
  const double volume = 4.0 / 3 * M_PI * 0.125;
  EXPECT_NEAR(8 * partInside(ball, Vec3(-1, -1, -1), Vec3(1, 1, 1)), volume, 2e-8);
  EXPECT_NEAR(partInside(ball, ball.centre, ball.centre + Vec3(0.6, 0.6, 0.6)) * 0.216, volume / 8, 1e-8);
}

TEST(PiecewiseMean, FindsTheVolumeOfABallCellByCell) {
  const Sphere ball{Vec3(0.1, 0.2, 0.3), 0.5, Vec3::Ones()};
  const int n = 7;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Vec3 lower = Vec3(-0.5, -0.5, -0.5) + 1.4 / n * Vec3(i, j, k);
        sum += partInside(ball, lower, lower + Vec3::Constant(1.4 / n));
      }
  EXPECT_NEAR(sum * std::pow(1.4 / n, 3), 4.0 / 3 * M_PI * 0.125, 1e-8);  // as the header says
}

TEST(PiecewiseMean, FindsTheAreaOfADisc) {
  const Sphere disc{Vec3(0.1, 0.2, 9), 0.5, Vec3(1, 1, 0)};
  EXPECT_NEAR(4 * partInside(disc, Vec3(-1, -1, 0), Vec3(1, 1, 0)), M_PI / 4, 1e-9);
  EXPECT_NEAR(4 * partInside(disc, Vec3(-1, -1, 0), Vec3(1, 1, 1)), M_PI / 4, 1e-9);  // drawn out along z
}

TEST(PiecewiseMean, FindsTheLengthBetweenTwoPoints) {
  EXPECT_NEAR(partInside({Vec3(0.1, 5, 5), 0.5, Vec3(1, 0, 0)}, Vec3(-1, 0, 0), Vec3(1, 0, 0)), 0.5, 1e-14);
}

TEST(PiecewiseMean, IsExactForAPolynomialInACornerCutOff) {
  // Over the tetrahedron x + y + z < 1 the integral of x² y z is 2! 1! 1! / 7!.
  const Body corner([](const Vec3& x) { return x.sum() < 1; });
  const GasState mean = piecewiseMean(corner, std::vector{Plane{Vec3(2, 2, 2), 2}}, Vec3::Zero(), Vec3(2, 2, 2), 0);
  EXPECT_NEAR(8 * mean.density, 1.0 / 6, 1e-14);
  EXPECT_NEAR(8 * mean.pressure, 2.0 / 5040, 1e-15);
}

TEST(PiecewiseMean, TakesSeveralPlanes) {
  const Body slab([](const Vec3& x) { return x[0] + x[1] > 0.3 && x[0] + x[1] < 1.1; });
  const std::vector<Plane> planes{{Vec3(1, 1, 0), 1.1}, {Vec3(1, 1, 0), 0.3}, {Vec3(1, 1, 0), 7}};
  const double area = 1 - 0.3 * 0.3 / 2 - 0.9 * 0.9 / 2;
  EXPECT_NEAR(piecewiseMean(slab, planes, Vec3::Zero(), Vec3(1, 1, 0), 0).density, area, 1e-14);
}

TEST(PiecewiseMean, KnowsWhatASurfaceCuts) {
  const Sphere circle{Vec3::Zero(), 1, Vec3(1, 1, 0)};
  EXPECT_TRUE(circle.cuts(Vec3(0.5, 0.5, 0), Vec3(1, 1, 0)));
  EXPECT_FALSE(circle.cuts(Vec3(0.8, 0.8, 0), Vec3(1, 1, 0)));
  EXPECT_FALSE(circle.cuts(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 3)));
  const Plane plane{Vec3(1, -1, 0), 0};
  EXPECT_TRUE(plane.cuts(Vec3(0, 0, 0), Vec3(1, 1, 0)));
  EXPECT_FALSE(plane.cuts(Vec3(1, 0, 0), Vec3(2, 1, 0)));
}

TEST(PiecewiseMean, RefusesABoxUpsideDown) {
  const Body all([](const Vec3&) { return true; });
  EXPECT_THROW(piecewiseMean(all, std::vector<Plane>{}, Vec3(1, 0, 0), Vec3::Zero(), 0), std::invalid_argument);
}

}  // namespace
}  // namespace tushar::reference
