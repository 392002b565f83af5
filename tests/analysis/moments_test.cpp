#include "components/analysis/moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tushar::analysis {
namespace {

constexpr int count = 1000;

/// Samples with a variance of about 1e-6 beside a great mean, in three components.
std::vector<Vec3> samplesAround(double mean) {
  std::vector<Vec3> samples;
  for (int k = 0; k < count; ++k)
    samples.push_back(Vec3::Constant(mean) +
                      1e-3 * Vec3(std::sin(k), std::cos(1.7 * k * k), std::exp(std::sin(3 * k))));
  return samples;
}

/// The sums of powers of deviations from the mean, in long double: in two passes over the samples.
Moments<3, 4> inTwoPasses(const std::vector<Vec3>& samples) {
  Moments<3, 4> result;
  for (int d = 0; d < 3; ++d) {
    long double mean = 0, powers[3] = {};
    for (const Vec3& sample : samples) mean += static_cast<long double>(sample[d]) / samples.size();
    for (const Vec3& sample : samples) {
      const long double deviation = sample[d] - mean;
      for (int k = 0; k < 3; ++k) powers[k] += std::pow(deviation, 2 + k);
    }
    result.row(d) << static_cast<double>(mean), static_cast<double>(powers[0]), static_cast<double>(powers[1]),
        static_cast<double>(powers[2]);
  }
  return result;
}

Moments<3, 4> oneAfterTheOther(const std::vector<Vec3>& samples) {
  Moments<3, 4> sums = Moments<3, 4>::Zero();
  double n = 0;
  for (const Vec3& sample : samples) sums = withSample<3, 4>(sums, sample, ++n);
  return sums;
}

TEST(Moments, AreThoseOfTwoPasses) {
  const auto samples = samplesAround(0);
  const Moments<3, 4> found = oneAfterTheOther(samples), exact = inTwoPasses(samples);
  for (int d = 0; d < 3; ++d) {
    const double width = std::sqrt(exact(d, 1) / count);
    for (int k = 1; k < 4; ++k)  // round-off of 1000 sums of terms of this size
      EXPECT_NEAR(found(d, k), exact(d, k), 1e-13 * count * std::pow(width, k + 1)) << d << ' ' << k;
    EXPECT_NEAR(found(d, 0), exact(d, 0), 1e-15 * count * width);
  }
}

/// The difference of the mean square and the square of the mean would have lost all digits: 1e-6 beside 1e10.
TEST(Moments, ASmallVarianceBesideAGreatMeanKeepsItsDigits) {
  const auto samples = samplesAround(1e5);
  const Moments<3, 4> found = oneAfterTheOther(samples), exact = inTwoPasses(samples);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(found(d, 1) / exact(d, 1), 1, 1e-7) << d;  // samples have 1e5 * 1e-16
}

TEST(Moments, OfTwoOrdersAreTheFirstOnesOfFour) {
  Moments<3, 2> sums = Moments<3, 2>::Zero();
  double n = 0;
  const auto samples = samplesAround(10);
  for (const Vec3& sample : samples) sums = withSample<3, 2>(sums, sample, ++n);
  EXPECT_EQ(sums, (oneAfterTheOther(samples).leftCols<2>()));
}

TEST(Moments, ProductsAreThoseOfTwoPasses) {
  const auto samples = samplesAround(1e3);
  const Moments<3, 4> all = inTwoPasses(samples);
  Moments<3, 2> sums = Moments<3, 2>::Zero();
  Vec3 mixed = Vec3::Zero(), ofNumber = Vec3::Zero(), exactMixed = Vec3::Zero(), exactOfNumber = Vec3::Zero();
  double n = 0;
  for (const Vec3& sample : samples) {
    const Vec3 delta = sample - sums.col(0), exact = sample - all.col(0);
    mixed = withProducts(mixed, delta, delta, n + 1);
    ofNumber = withProducts(ofNumber, delta[1], delta, n + 1);
    sums = withSample<3, 2>(sums, sample, ++n);
    exactMixed += Vec3(exact[0] * exact[1], exact[1] * exact[2], exact[2] * exact[0]);
    exactOfNumber += exact[1] * exact;
  }
  EXPECT_LT((mixed - exactMixed).norm(), 1e-12 * count);  // samples have 1e3 * 1e-16, deviations are 1e-3
  EXPECT_LT((ofNumber - exactOfNumber).norm(), 1e-12 * count);
  EXPECT_GT(exactOfNumber[1], 1e-7 * count);
}

}  // namespace
}  // namespace tushar::analysis
