#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/tasks/particle_maker.hpp"
#include "tests/support/run.hpp"

namespace tushar::tasks {

namespace {

using data::Generation;
using data::ParticleLabel;
using data::ParticleView;
using grid::forEach;
using grid::Patch;

constexpr ParticleLabel<Vec<2>> x{"p.x", "m", "position"};
constexpr ParticleLabel<double> mark{"p.mark", "1", "a value that belongs to the id"};
constexpr ParticleLabel<Vec<3>> more{"p.more", "1", "further values that belong to the id"};

struct Material {
  std::string name;
};
const std::vector<Material> gas{{"gas"}};

double markOf(ParticleId id) { return 0.5 + static_cast<double>(id % 1000003); }
Vec<3> moreOf(ParticleId id) { return {markOf(id), -markOf(id), 2 * markOf(id)}; }
/// A pseudo-random number that depends only on the argument.
std::uint64_t scrambled(std::uint64_t seed) {
  seed = (seed ^ (seed >> 31)) * 0x7fb5d329728ea185ULL;
  seed = (seed ^ (seed >> 27)) * 0x81dadef4bc2dd44dULL;
  return seed ^ (seed >> 33);
}

struct Values {
  std::vector<Vec<2>>& x;
  std::vector<double>& marks;
  std::vector<Vec<3>>& more;

  void add(ParticleMaker& maker, const Index<2>& cell, ParticleId id, const Vec<2>& at) const {
    maker.add(cell, id);
    x.push_back(at);
    marks.push_back(markOf(id));
    more.push_back(moreOf(id));
  }
};

/// Two particles in each cell but those of the third column and of the fifth row.
void create(const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<2>>& at,
            std::vector<double>& marks, std::vector<Vec<3>>& others) {
  forEach<2>(patch.cells(), [&](const Index<2>& cell) {
    if (cell[0] == 2 || cell[1] == 4) return;
    for (ParticleId k = 0; k < 2; ++k)
      Values{at, marks, others}.add(maker, cell, 2 * patch.level().cellNumber(cell) + k,
                                    patch.level().cellCentre<2>(cell));
  });
}

void stay(const Patch&, const Material&, ParticleView<const Vec<2>> from, ParticleView<Vec<2>> to) {
  for (int p = 0; p < from.owned(); ++p) to[p] = from[p];
}

enum class How { keeping, addingAll };

/// Removes about `removed` of 1000 particles; of each, new ones are made in neighbouring cells, whose patches make
/// them: one, or two in the first steps, so that patches need more memory.
void change(const Patch& patch, const Material&, ParticleMaker& maker, int removed, How how, const int* step,
            ParticleView<const Vec<2>> from, ParticleView<const ParticleId> ids, ParticleView<const double>,
            ParticleView<const Vec<3>>, std::vector<Vec<2>>& at, std::vector<double>& marks,
            std::vector<Vec<3>>& others) {
  const Values values{at, marks, others};
  int next = 0;
  bool changes = false;
  forEach<2>(from.cells(), [&](const Index<2>& cell) {
    const bool isOwn = patch.cells().contains(cell);
    for (const int p : from.in(cell)) {
      const std::uint64_t chance = scrambled(ids[p] * 1000 + static_cast<std::uint64_t>(*step));
      if (chance % 1000 >= static_cast<std::uint64_t>(removed)) {
        if (isOwn && how == How::addingAll) values.add(maker, cell, ids[p], from[p]);
        continue;
      }
      changes = true;
      if (isOwn && how == How::keeping) maker.keep(next, p);
      if (isOwn) next = p + 1;
      for (std::uint64_t k = 0; k < (*step < 8 ? 2 : 1); ++k) {
        const std::uint64_t way = scrambled(chance + k);
        const Index<2> to = cell + Index<2>{{static_cast<int>(way % 3) - 1, static_cast<int>(way / 3 % 3) - 1}};
        if (patch.cells().contains(to))
          values.add(maker, to, scrambled(ids[p] + (k << 62)), patch.level().cellCentre<2>(to));
      }
    }
  });
  if (how == How::keeping) changes ? maker.keep(next, from.owned()) : maker.keepAll();
}

struct Found {
  std::map<ParticleId, Vec<2>> at;
  std::vector<ParticleId> order;  ///< ids in the order of patches and sets
  int wrong = 0;                  ///< particles with wrong values or in a wrong cell

  bool operator==(const Found&) const = default;
};

Found found(test::Runner& run) {
  Found all;
  const auto values = [&](const char* name, int patch) {
    return run.warehouse.variable(Generation::old, run.table.find(name, 0), patch).values;
  };
  for (const Patch& patch : run.warehouse.grid().patches()) {
    const auto* ids = reinterpret_cast<const ParticleId*>(values("p.particleID", patch.id()));
    const auto* at = reinterpret_cast<const Vec<2>*>(values("p.x", patch.id()));
    const auto* marks = reinterpret_cast<const double*>(values("p.mark", patch.id()));
    const auto* others = reinterpret_cast<const Vec<3>*>(values("p.more", patch.id()));
    forEach<2>(patch.cells(), [&](const Index<2>& cell) {
      for (const int p : run.warehouse.particles(Generation::old, 0, patch.id()).in(cell)) {
        all.wrong +=
            marks[p] != markOf(ids[p]) || others[p] != moreOf(ids[p]) || patch.level().cellOf<2>(at[p]) != cell;
        all.order.push_back(ids[p]);
        all.at[ids[p]] = at[p];
      }
    });
  }
  return all;
}

Found changed(int removed, How how, const Index3& patches) {
  test::Runner run(test::domain({{13, 11, 1}}, patches));
  int step = 0;
  TaskList start, advance;
  start.newParticles("create", create, gas, creates(x), creates(mark), creates(more));
  advance.perMaterial("stay", stay, gas, requiresOld(x), computes(x));
  advance.relocate(x, gas);
  advance.newParticles("change", change, gas, with(removed), with(how), with(&step), requiresNew(x, 1),
                       requiresNew(data::particleId, 1), requiresNew(mark), requiresNew(more), creates(x),
                       creates(mark), creates(more));
  TaskGraph begin = run.compile(start, {"p.x", "p.mark", "p.more", "p.particleID"});
  TaskGraph next = run.compile(advance, {"p.x", "p.mark", "p.more"}, true);
  run.step(begin);
  for (; step < 30; ++step) run.step(next);
  return found(run);
}

/// The greatest index of a particle or ghost on a periodic grid in three steps in which all particles are kept by a
/// task that reads `reach` layers of ghosts.
double furthestWith(int reach) {
  grid::Domain domain = test::domain({{6, 5, 1}});
  domain.periodic = {true, true, false};
  test::Runner run(domain);
  constexpr data::ReductionLabel<data::Maximum> furthest{"furthest", "1", "greatest index"};
  TaskList start, advance;
  start.newParticles(
      "create",
      [](const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<2>>& at) {
        forEach<2>(patch.cells(), [&](const Index<2>& cell) {
          maker.add(cell, patch.level().cellNumber(cell));
          at.push_back(patch.level().cellCentre<2>(cell));
        });
      },
      gas, creates(x));
  advance.perMaterial("stay", stay, gas, requiresOld(x), computes(x));
  advance.relocate(x, gas);
  advance.newParticles(
      "keep",
      [](const Patch&, const Material&, ParticleMaker& maker, ParticleView<const Vec<2>>, std::vector<Vec<2>>&) {
        maker.keepAll();
      },
      gas, requiresNew(x, reach), creates(x));
  advance.perMaterial(
      "look",
      [](const Patch&, const Material&, ParticleView<const Vec<2>> at, data::Maximum& last) {
        forEach<2>(at.cells(), [&](const Index<2>& cell) {
          for (const int p : at.in(cell)) last.add(p);
        });
      },
      gas, requiresNew(x, 1), computes(furthest));
  TaskGraph begin = run.compile(start, {"p.x", "p.particleID"});
  TaskGraph next = run.compile(advance, {"p.x", "furthest"}, true);
  run.step(begin);
  double last = 0;
  for (int k = 0; k < 3; ++k) {
    run.step(next);
    last = std::max(last, run.warehouse.reductionValues(run.table.find("furthest", -1)).at(0));
  }
  return last;
}

}  // namespace

/// A task that keeps particles leaves the same set, with the same values, as one that makes all of them again.
TEST(KeptParticles, AreAsIfMadeAgain) {
  for (const int removed : {1, 30, 400, 1000})
    for (const Index3 patches : {Index3{{1, 1, 1}}, Index3{{3, 2, 1}}, Index3{{13, 4, 1}}}) {
      const Found kept = changed(removed, How::keeping, patches), made = changed(removed, How::addingAll, patches);
      EXPECT_EQ(kept.wrong, 0);
      EXPECT_FALSE(kept.at.empty());
      EXPECT_TRUE(kept == made) << removed << ' ' << patches[0];
    }
}

TEST(KeptParticles, DoNotDependOnPatches) {
  const Found one = changed(30, How::keeping, {{1, 1, 1}}), many = changed(30, How::keeping, {{5, 3, 1}});
  EXPECT_GT(one.at.size(), 100);
  EXPECT_TRUE(one.at == many.at);
}

/// Ghosts that were read before take no space besides those that are read afterwards.
TEST(KeptParticles, DoNotGatherGhosts) {
  EXPECT_GT(furthestWith(0), 40);
  EXPECT_EQ(furthestWith(1), furthestWith(0));
}

}  // namespace tushar::tasks
