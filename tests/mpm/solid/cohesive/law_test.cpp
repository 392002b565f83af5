#include "components/mpm/solid/cohesive/law.hpp"

#include <gtest/gtest.h>

namespace tushar::mpm::solid {

namespace {

const CohesiveLaw law{.normalStrength = 240,
                      .tangentialStrength = 130,
                      .normalLength = 4e-5,
                      .tangentialLength = 9e-5,
                      .normalFailureLength = 1,
                      .tangentialFailureLength = 1};

/// The work per area along a straight path of jumps, by Simpson's rule.
double workAlong(double normal, double tangential) {
  constexpr int parts = 2000;
  double work = 0;
  for (int k = 0; k <= parts; ++k) {
    const double s = static_cast<double>(k) / parts, weight = k == 0 || k == parts ? 1 : k % 2 == 1 ? 4 : 2;
    const CohesiveLaw::Traction traction = law.at(s * normal, s * tangential);
    work +=
        weight / (3 * parts) * (traction.normal * normal + traction.perTangentialJump * s * tangential * tangential);
  }
  return work;
}

}  // namespace

TEST(CohesiveLaw, reachesItsStrengthsAtTheirJumps) {
  EXPECT_DOUBLE_EQ(law.at(law.normalLength, 0).normal, 240);
  const double slid = law.tangentialLength / std::numbers::sqrt2;
  EXPECT_NEAR(law.at(0, slid).perTangentialJump * slid, 130, 1e-11);
  for (const double factor : {.5, .9, 1.1, 2.0}) {
    EXPECT_LT(law.at(factor * law.normalLength, 0).normal, 240);
    EXPECT_LT(law.at(0, factor * slid).perTangentialJump * factor * slid, 130);
  }
}

TEST(CohesiveLaw, takesTheEnergiesOfBothModes) {
  // Beyond 40 lengths, less than 1e-15 of the energy is left; Simpson's rule is exact to 1e-7 here.
  EXPECT_NEAR(workAlong(40 * law.normalLength, 0) / (std::numbers::e * 240 * 4e-5), 1, 1e-6);
  EXPECT_NEAR(workAlong(0, 40 * law.tangentialLength) / (std::sqrt(std::numbers::e / 2) * 130 * 9e-5), 1, 1e-6);
}

TEST(CohesiveLaw, isTheGradientOfItsEnergyInMixedModes) {
  for (const auto& [x, y] : {std::pair{.3, .2}, {1.5, .8}, {-.4, 1.1}, {2.0, 2.0}}) {
    const double normal = x * law.normalLength, tangential = y * law.tangentialLength;
    EXPECT_NEAR(workAlong(normal, tangential) / law.energy(normal, tangential), 1, 1e-8);
  }
}

TEST(CohesiveLaw, pushesBodiesApartThatPenetrate) {
  EXPECT_LT(law.at(-.5 * law.normalLength, 0).normal, 0);
  EXPECT_LT(law.at(-2 * law.normalLength, 0).normal, 10 * law.at(-.5 * law.normalLength, 0).normal);
}

}  // namespace tushar::mpm::solid
