#include "components/reference/gas_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tushar::reference {
namespace {

/// Density x^3 y^2 + z, with a pressure jump at x = .3 and an undeclared kink of the energy.
class Polynomial : public GasReference {
 public:
  GasState at(const Vec3& x, double) const override {
    GasState gas;
    gas.density = x[0] * x[0] * x[0] * x[1] * x[1] + x[2];
    gas.velocity = x;
    gas.pressure = x[0] < 0.3 ? 1 : 5;
    gas.energy = std::abs(x[0] - 0.7);
    return gas;
  }
  std::vector<double> breaks(int axis, double) const override {
    return axis == 0 ? std::vector<double>{-1, 0.3, 9} : std::vector<double>{};
  }
};

TEST(GasReference, AveragesAPolynomialExactlyOverABox) {
  const GasState mean = Polynomial().average(Vec3(0, 0, 0), Vec3(1, 1, 1), 0);
  EXPECT_NEAR(mean.density, 1.0 / 12 + 0.5, 1e-14);
  EXPECT_NEAR((mean.velocity - Vec3(0.5, 0.5, 0.5)).norm(), 0, 1e-14);
}

TEST(GasReference, SplitsAtDeclaredBreaks) {
  EXPECT_NEAR(Polynomial().average(Vec3(0, 0, 0), Vec3(1, 0, 0), 0).pressure, 0.3 + 0.7 * 5, 1e-14);
}

TEST(GasReference, FindsKinksThatAreNotDeclared) {
  EXPECT_NEAR(Polynomial().average(Vec3(0, 0, 0), Vec3(1, 0, 0), 0).energy, (0.49 + 0.09) / 2, 1e-12);
}

TEST(GasReference, HasNoFiniteMeanOfValuesBeyondAllNumbers) {
  class Huge : public GasReference {
   public:
    GasState at(const Vec3& x, double) const override {
      GasState gas;
      gas.pressure = x[0] < 0.3 ? std::numeric_limits<double>::infinity() : 1;
      return gas;
    }
  };

  EXPECT_FALSE(std::isfinite(Huge().average(Vec3(0, 0, 0), Vec3(1, 1, 1), 0).pressure)) << "and says so at once";
}

TEST(GasReference, TakesAnAxisWithoutExtentAsAPoint) {
  const GasState mean = Polynomial().average(Vec3(0, 0.5, 0.25), Vec3(1, 0.5, 0.25), 0);
  EXPECT_NEAR(mean.density, 0.25 * 0.25 + 0.25, 1e-15);
  const GasState point = Polynomial().average(Vec3(0.5, 0.5, 0.25), Vec3(0.5, 0.5, 0.25), 0);
  EXPECT_DOUBLE_EQ(point.density, 0.125 * 0.25 + 0.25);
}

}  // namespace
}  // namespace tushar::reference
