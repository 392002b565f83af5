#include "components/reference/tabulated.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/base/error.hpp"
#include "core/output/archive_hdf5.hpp"
#include "tests/reference/gas_equations.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::reference {
namespace {

/// A table of 4 x 2 cells of .5 x 1 m from (1, -1, 0): density 10 j + i, pressure 2 (10 j + i), u = (i, j, 0).
GasTable plane() {
  GasTable table{Vec3(1, -1, 0), Vec3(3, 1, 1), {{4, 2, 1}}, 0.3, {}};
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 4; ++i) {
      const double density = 10 * j + i;
      table.means.push_back({density, Vec3(i, j, 0), 2 * density, 5});
    }
  return table;
}

TEST(Tabulated, IsLinearBetweenTheMiddlesOfCells) {
  const Tabulated gas(plane());
  EXPECT_DOUBLE_EQ(gas.at(Vec3(1.75, -0.5, 9), 0.3).density, 1);
  EXPECT_DOUBLE_EQ(gas.at(Vec3(2, 0, 0), 0.3).density, 6.5);
  EXPECT_DOUBLE_EQ(gas.at(Vec3(2, 0, 0), 0.3).pressure, 13);
  EXPECT_EQ(gas.at(Vec3(2, 0.25, 0), 0.3).velocity, Vec3(1.5, 0.75, 0));
  EXPECT_DOUBLE_EQ(gas.at(Vec3(1, -1, 0), 0.3).density, 0);  // as in the cell at the rim
}

TEST(Tabulated, AveragesEachCellByWhatOfItIsInTheBox) {
  const Tabulated gas(plane());
  EXPECT_DOUBLE_EQ(gas.average(Vec3(1.5, -1, 0), Vec3(2, 0, 1), 0.3).density, 1);
  EXPECT_DOUBLE_EQ(gas.average(Vec3(1, -1, 0), Vec3(3, 1, 0), 0.3).density, 6.5);
  EXPECT_DOUBLE_EQ(gas.average(Vec3(1.25, -0.5, 0), Vec3(1.75, 0.5, 0), 0.3).density, 5.5);
  EXPECT_DOUBLE_EQ(gas.average(Vec3(1.25, -0.5, 0), Vec3(2.25, -0.4, 0), 0.3).density, 0.25 * 0 + 0.5 * 1 + 0.25 * 2);
  EXPECT_DOUBLE_EQ(gas.average(Vec3(0, -1, 0), Vec3(1.5, 0, 1), 0.3).density, 0);  // what is inside
  EXPECT_THROW(gas.average(Vec3(4, -1, 0), Vec3(5, 0, 1), 0.3), std::invalid_argument);
  EXPECT_THROW(gas.average(Vec3(2, -1, 0), Vec3(1, 0, 1), 0.3), std::invalid_argument);
}

TEST(Tabulated, HoldsAtItsTimeAndInItsBox) {
  const Tabulated gas(plane());
  EXPECT_TRUE(gas.holdsAt(0.3));
  EXPECT_FALSE(gas.holdsAt(0.31));
  EXPECT_TRUE(gas.covers(Vec3(2, 0.5, 7), 0.3));
  EXPECT_FALSE(gas.covers(Vec3(2, 0.5, 7), 0.2));
  EXPECT_FALSE(gas.covers(Vec3(3.1, 0.5, 0), 0.3));
  EXPECT_THROW(gas.at(Vec3(2, 0, 0), 0.2), std::domain_error);
  EXPECT_THROW(gas.average(Vec3(2, 0, 0), Vec3(3, 1, 0), 0.2), std::domain_error);
}

TEST(Tabulated, RefusesATableThatDoesNotFit) {
  GasTable table = plane();
  table.means.pop_back();
  EXPECT_THROW(Tabulated{table}, std::invalid_argument);
  table = plane();
  table.upper[1] = -1;
  EXPECT_THROW(Tabulated{table}, std::invalid_argument);
}

/// Writes an output with the gas of plane() below `group`, with the given number of cells along x.
std::filesystem::path writeOutput(const std::filesystem::path& path, const std::string& group, int cells = 4) {
  output::Hdf5File file(path, true, 0);
  const GasTable table = plane();
  output::Array density{"c.density", "", "", 1, std::vector<double>()}, pressure = density, velocity = density;
  velocity.components = 3;
  for (const GasState& mean : table.means) {
    std::get<0>(density.values).push_back(mean.density);
    std::get<0>(pressure.values).push_back(mean.pressure);
    for (int d = 0; d < 3; ++d) std::get<0>(velocity.values).push_back(mean.velocity[d]);
  }
  file.attribute("/", "time", 0.3);
  file.group("grid");
  file.attribute("grid", "cells", Index3{{cells, 2, 1}});
  file.attribute("grid", "lower", table.lower);
  file.attribute("grid", "spacing", Vec3(0.5, 1, 1));
  file.dataset(group + "c.density", density, {1, 2, 4});
  file.dataset(group + "c.pressure", pressure, {1, 2, 4});
  file.dataset(group + "c.velocity", velocity, {1, 2, 4});
  return path;
}

TEST(GasTable, IsReadFromAnOutputOfCellsOrOfAMaterial) {
  for (const std::string group : {"cells/", "cells/gas/"}) {
    const GasTable table = readGasTable(writeOutput(test::temporaryFolder() + "t00001.h5", group), 1.4),
                   expected = plane();
    EXPECT_EQ(table.time, 0.3);
    EXPECT_EQ(table.cells, expected.cells);
    EXPECT_EQ(table.lower, expected.lower);
    EXPECT_EQ(table.upper, expected.upper);
    ASSERT_EQ(table.means.size(), 8u);
    for (std::size_t k = 1; k < 8; ++k) {
      EXPECT_EQ(table.means[k].density, expected.means[k].density);
      EXPECT_EQ(table.means[k].velocity, expected.means[k].velocity);
      EXPECT_DOUBLE_EQ(table.means[k].energy, 5);
    }
  }
}

TEST(GasTable, SaysWhatAFileLacks) {
  const auto problem = [](const std::filesystem::path& path) -> std::string {
    try {
      readGasTable(path, 1.4);
    } catch (const FileError& error) {
      return error.what();
    }
    return "nothing";
  };
  const std::string path = test::temporaryFolder() + "t.h5";
  EXPECT_EQ(problem(writeOutput(path, "nodes/")), "'" + path + "' holds no c.density");
  EXPECT_EQ(problem(writeOutput(path, "cells/", 5)),
            "'" + path + "': cells/c.density does not have the 10 values that the grid needs");
  EXPECT_NE(problem(test::temporaryFolder() + "none.h5").find("cannot read the file"), std::string::npos);
}

}  // namespace
}  // namespace tushar::reference
