#include "core/base/lanes.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tushar
