#include "core/base/lanes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace tushar {
namespace {

TEST(Lanes, TransposeMovesLaneKOfRowRToLaneROfRowK) {
  LanesSquare rows;
  for (int r = 0; r < Lanes::count; ++r) rows[r] = Lanes::of([&](int k) { return 100.0 * r + k; });
  transpose(rows);
  for (int r = 0; r < Lanes::count; ++r)
    for (int k = 0; k < Lanes::count; ++k) EXPECT_EQ(rows[r][k], 100.0 * k + r);
}

template <int numbers>
void expectColumnsThereAndBack() {
  std::vector<double> from(numbers * Lanes::count);
  std::iota(from.begin(), from.end(), 1.0);
  const auto columns = columnsOf<numbers>([&](int k) { return from.data() + numbers * k; });
  for (int c = 0; c < numbers; ++c)
    for (int k = 0; k < Lanes::count; ++k) EXPECT_EQ(columns[c][k], from[numbers * k + c]);
  for (int count = 1; count <= Lanes::count; ++count) {
    std::vector<double> to(from.size(), 0.0);
    storeColumns(columns, count, [&](int k) { return to.data() + numbers * k; });
    for (std::size_t at = 0; at < to.size(); ++at)
      EXPECT_EQ(to[at], static_cast<int>(at) < numbers * count ? from[at] : 0.0) << "nothing beyond " << count;
  }
}

TEST(Lanes, ColumnsOfRecordsComeBackWhereTheyWere) {
  expectColumnsThereAndBack<1>();
  expectColumnsThereAndBack<3>();
  expectColumnsThereAndBack<8>();
  expectColumnsThereAndBack<9>();
  // The last square overlaps the one before, with registers of 8 numbers, or of 4.
  expectColumnsThereAndBack<21>();
  expectColumnsThereAndBack<7>();
}

template <int numbers>
void expectPackedAsColumns() {
  std::vector<double> from(numbers * Lanes::count), to(from.size());
  std::iota(from.begin(), from.end(), 1.0);
  const auto columns = unpack<numbers>(from.data());
  for (int c = 0; c < numbers; ++c)
    for (int k = 0; k < Lanes::count; ++k) EXPECT_EQ(columns[c][k], from[numbers * k + c]);
  pack(columns, to.data());
  EXPECT_EQ(to, from);
}

TEST(Lanes, UnpackGivesTheColumnsOfRecordsInARow) {
  expectPackedAsColumns<1>();
  expectPackedAsColumns<2>();
  expectPackedAsColumns<3>();
}

TEST(Lanes, KnowWhichOfThemAreNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Lanes::Mask mask = isNaN(Lanes::of([&](int lane) { return lane == 1 ? nan : 1.0; }));
  for (int lane = 0; lane < Lanes::count; ++lane) EXPECT_EQ(mask[lane] != 0, lane == 1);
}

TEST(Lanes, RoundAndTakeRootsAsSingleNumbersDo) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), large = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, -0.0, 0.5, 1.5, 2.5, -0.5, -2.5, 0.49999999999999994, 3.7, -1e300, 1e15 + 0.5, large})
    for (int lane = 0; lane < Lanes::count; ++lane) {
      const Lanes all = Lanes::of([&](int k) { return k == lane ? x : 0.25 * k; });
      EXPECT_EQ(nearbyint(all)[lane], std::nearbyint(x));
      EXPECT_EQ(std::signbit(nearbyint(all)[lane]), std::signbit(std::nearbyint(x)));
      EXPECT_EQ(abs(all)[lane], std::abs(x));
      EXPECT_FALSE(std::signbit(abs(all)[lane]));
      EXPECT_EQ(sqrt(abs(all))[lane], std::sqrt(std::abs(x)));
    }
  EXPECT_TRUE(std::isnan(nearbyint(Lanes(nan))[0]) && std::isnan(abs(Lanes(nan))[0]));
  LaneIntegers whole;
  for (int lane = 0; lane < Lanes::count; ++lane) whole[lane] = 3 - lane;
  for (int lane = 0; lane < Lanes::count; ++lane) EXPECT_EQ(widen(whole)[lane], 3 - lane);
}

TEST(Lanes, FindTheGreatestTheTotalAndWhetherAnySatisfiesACondition) {
  for (int lane = 0; lane < Lanes::count; ++lane) {
    const Lanes all = Lanes::of([&](int k) { return k == lane ? 7.0 : -1.0 - k; });
    double sum = 0;
    for (int k = 0; k < Lanes::count; ++k) sum += all[k];
    EXPECT_EQ(greatest(all), 7);
    EXPECT_EQ(total(all), sum);
    EXPECT_TRUE(any(all > 6));
    EXPECT_FALSE(any(all > 7));
  }
}

}  // namespace
}  // namespace tushar
