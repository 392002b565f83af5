#include "core/collect/stored_state.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "core/collect/gather.hpp"
#include "core/core.hpp"
#include "tests/support/run.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::collect {

namespace {

struct Dust {
  std::string name;
};

const std::vector<Dust> dusts{{"fine"}, {"coarse"}};
const ParticleLabel<Vec<2>> position{"p.x", "m", "position"};
const ParticleLabel<int> mark{"p.mark", "1", "a mark"};
const NodeLabel<Vec<2>> wind{"g.wind", "m/s", "wind"};
const CellLabel<double> heat{"c.heat", "K", "temperature"};
const ReductionLabel<Sum> total{"Total", "K", "sum of heat"};

/// Creates three particles in every second cell, with ids that decrease along the grid, so that they need sorting.
void scatter(const Patch& patch, const Dust& dust, ParticleMaker& maker, std::vector<Vec<2>>& x,
             std::vector<int>& marks) {
  forEach<2>(patch.cells(), [&](const Index<2>& cell) {
    if ((cell[0] + cell[1]) % 2 == 1 || dust.name == "coarse") return;
    const std::uint64_t number = patch.level().cellNumber<2>(cell);
    for (const std::uint64_t k : {2, 0, 1}) {
      maker.add(cell, 1000 - 3 * number + k);
      x.push_back(patch.level().cellCentre<2>(cell) * (1 + 0.1 * static_cast<double>(k)));
      marks.push_back(static_cast<int>(number) - 20);
    }
  });
}

void blow(const Patch& patch, const Dust&, NodeView<Vec<2>> velocity, CellView<double> temperature, Sum& sum) {
  forEach<2>(patch.nodes(), [&](const Index<2>& node) { velocity[node] = Vec<2>(node[0] + 0.1, -node[1] / 3.0); });
  forEach<2>(patch.cells(), [&](const Index<2>& cell) {
    temperature[cell] = 1.0 / (1 + cell[0] + 10 * cell[1]);
    sum.add(temperature[cell]);
  });
}

void look(const Patch&, const Dust&, NodeView<const Vec<2>>, CellView<const double>, ParticleView<const Vec<2>>,
          ParticleView<const int>, double seen, Sum& again) {
  again.add(seen);
}

const ReductionLabel<Sum> copy{"Copy", "K", "what a task saw of the sum"};

/// A runner with an initial task list and a task that reads every variable, with ghost cells.
class Weather : public test::Runner {
 public:
  explicit Weather(const Index3& patches, const Index3& cells = {{7, 5, 1}}) : Runner(test::domain(cells, patches)) {
    TaskList starts, looks;
    starts.newParticles("scatter", scatter, dusts, creates(position), creates(mark));
    starts.perMaterial("blow", blow, dusts, computes(wind), computes(heat), computes(total));
    looks.perMaterial("look", look, dusts, requiresOld(wind, 1), requiresOld(heat, 2), requiresOld(position, 1),
                      requiresOld(mark), requiresOld(total), computes(copy));
    start = compile(starts, {names.labels.begin(), names.labels.end()});
    later = compile(looks, {"Copy"}, true);
    warehouse.grow(2);
  }

  std::string print() { return fingerprint(warehouse, {"c.heat", "g.wind", "p.mark", "p.particleID", "p.x"}, 2); }

  StateNames names{{"Total", "c.heat", "g.wind", "p.mark", "p.particleID", "p.x"}, {"fine", "coarse"}};
  tasks::TaskGraph start, later;
};

std::string fileOf(Weather& weather) {
  const std::string path = test::temporaryFolder() + "state.h5";
  const StoredState state(weather.warehouse, weather.names);
  output::writeTogether(
      {}, path, {}, [](output::Hdf5File&) {}, state.datasets());
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void readBack(Weather& weather, const std::vector<std::string>& required = {}) {
  output::CheckedParts none(test::temporaryFolder(), {}, mpi::Communicator::alone());
  readState(output::Hdf5Input(test::temporaryFolder() + "state.h5"), weather.warehouse, weather.names, required, none);
}

std::string refusalOf(Weather& weather, const std::vector<std::string>& required) {
  try {
    readBack(weather, required);
  } catch (const InputError& error) {
    return error.problems().front().sentence;
  }
  return "";
}

}  // namespace

TEST(StoredState, IsTheSameFileForAnyPatches) {
  Weather whole(Index3{{1, 1, 1}}), pieces(Index3{{3, 2, 1}});
  whole.step(whole.start);
  pieces.step(pieces.start);

  EXPECT_TRUE(fileOf(whole) == fileOf(pieces));
}

TEST(StoredState, IsReadToTheBitOnAnyPatches) {
  Weather written(Index3{{2, 1, 1}});
  written.step(written.start);
  const std::string file = fileOf(written);
  for (const Index3& patches : {Index3{{1, 1, 1}}, Index3{{7, 5, 1}}, Index3{{3, 2, 1}}}) {
    Weather read(patches);

    EXPECT_EQ(refusalOf(read, read.names.labels), "");

    EXPECT_EQ(read.print(), written.print());
    EXPECT_TRUE(fileOf(read) == file);
    read.step(read.later);
    EXPECT_NE(read.warehouse.reduction<Sum>(read.table.find("Copy", -1)).value, 0);
  }
}

TEST(StoredState, RestoresAReductionWithTheErrorThatItCarries) {
  Weather written(Index3{{2, 1, 1}}), read(Index3{{1, 1, 1}});
  written.step(written.start);
  fileOf(written);

  refusalOf(read, {});

  const Sum& expected = written.warehouse.reduction<Sum>(written.table.find("Total", -1));
  const Sum& found = read.warehouse.reduction<Sum>(read.table.find("Total", -1));
  EXPECT_EQ(found.value, expected.value);
  EXPECT_EQ(found.error, expected.error);
  EXPECT_NE(found.error, 0);
}

TEST(StoredState, RefusesWhatDoesNotFitTheScene) {
  Weather written(Index3{{2, 1, 1}}), larger(Index3{{1, 1, 1}}, Index3{{8, 5, 1}}), same(Index3{{1, 1, 1}});
  written.step(written.start);
  written.names.labels = {"c.heat", "p.particleID", "p.x"};
  fileOf(written);

  EXPECT_EQ(refusalOf(larger, {}),
            "the checkpoint has 35 values of /cells/fine/c.heat, but the scene needs 40; undo the changes made to "
            "the scene since then");
  EXPECT_EQ(refusalOf(same, {"p.mark"}),
            "the checkpoint has no /particles/fine/p.mark, which the scene needs; undo the changes made to the scene "
            "since then");
  EXPECT_EQ(refusalOf(same, {"p.x"}), "");
}

}  // namespace tushar::collect
