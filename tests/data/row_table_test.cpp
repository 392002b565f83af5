#include "core/data/row_table.hpp"

#include <gtest/gtest.h>

namespace tushar::data {

TEST(RowTable, HasOneValueWhereNoRowIsOpen) {
  RowTable<int> table(-1);
  table.reset(3, 4);

  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_FALSE(table.isOpen(row));
    for (int k = 0; k < 4; ++k) EXPECT_EQ(table[row][k], -1);
  }
  EXPECT_FALSE(table.hasOpenRows());
}

TEST(RowTable, AnOpenRowIsAloneInItsValues) {
  RowTable<int> table;
  table.reset(100, 2);
  for (const std::size_t row : {70u, 3u}) table.open(row)[1] = static_cast<int>(row);
  table.open(70)[0] = 5;

  EXPECT_EQ(table[70][0], 5);
  EXPECT_EQ(table[70][1], 70);
  EXPECT_EQ(table[3][0], 0);
  EXPECT_EQ(table[3][1], 3);
  EXPECT_EQ(table[4][1], 0);
  EXPECT_TRUE(table.isOpen(3) && table.isOpen(70) && !table.isOpen(4));
}

TEST(RowTable, ForgetsItsRows) {
  RowTable<int> table;
  table.reset(2, 2);
  table.open(1)[0] = 8;
  table.reset(2, 2);

  EXPECT_FALSE(table.hasOpenRows());
  EXPECT_EQ(table[1][0], 0);
  EXPECT_EQ(table.open(1)[0], 0) << "nor does a row that is opened again remember";
}

TEST(RowTable, FillsRowsThatBecomeLonger) {
  RowTable<int> table(-1);
  table.reset(2, 2);
  table.open(1)[0] = 7;
  table.open(1)[1] = 8;
  table.reset(2, 5);

  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(table[0][k], -1);
    EXPECT_EQ(table.open(1)[k], -1);
  }
}

TEST(RowTable, KnowsItsSize) {
  RowTable<int> table;
  EXPECT_FALSE(table.isOf(2, 3));
  table.reset(2, 3);
  EXPECT_TRUE(table.isOf(2, 3));
  EXPECT_FALSE(table.isOf(3, 2));
}

}  // namespace tushar::data
