#include "core/tasks/between_materials.hpp"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "core/data/views.hpp"
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
constexpr ParticleLabel<int> next{"p.next", "1", "the next material"};
constexpr data::ReductionLabel<data::Sum> wrong{"wrong", "1", "particles that are not where they should be"};

struct Material {
  std::string name;
  int index;
};
const std::vector<Material> materials{{"a", 0}, {"b", 1}, {"c", 2}, {"d", 3}};

double markOf(ParticleId id) { return 0.5 + static_cast<double>(id); }

/// Makes three particles in each cell, all of the first material.
void create(const Patch& patch, const Material& material, ParticleMaker& maker, std::vector<Vec<2>>& position,
            std::vector<double>& marks) {
  if (material.index > 0) return;
  forEach<2>(patch.cells(), [&](const Index<2>& cell) {
    for (ParticleId k = 3; k-- > 0;) {
      const ParticleId id = 3 * patch.level().cellNumber(cell) + k;
      maker.add(cell, id);
      position.emplace_back(patch.level().nodePosition(0, cell[0]) + 0.2 * static_cast<double>(k + 1) * 0.1,
                            patch.level().nodePosition(1, cell[1]) + 0.05);
      marks.push_back(markOf(id));
    }
  });
}

/// Moves all particles to the right by 0.7 cells, or back from the last cell to the first.
void drift(const Patch&, const Material&, ParticleView<const Vec<2>> from, ParticleView<Vec<2>> to) {
  for (int p = 0; p < from.owned(); ++p)
    to[p] = from[p][0] > 0.92 ? Vec<2>(from[p][0] - 0.9, from[p][1]) : Vec<2>(from[p][0] + 0.07, from[p][1]);
}

/// Chooses materials by id and by the present material; never the third one.
void choose(const Patch&, const Material& material, ParticleView<const ParticleId> id, ParticleView<int> to) {
  for (int p = 0; p < id.owned(); ++p) {
    const int k = static_cast<int>((id[p] * 7 + static_cast<ParticleId>(material.index)) % 5);
    to[p] = k < 3 ? material.index : (k == 3 ? 1 : 3);
  }
}

/// Counts particles in a wrong cell, unsorted, or with a wrong mark; ghosts included.
void inspect(const Patch& patch, const Material&, ParticleView<const Vec<2>> position,
             ParticleView<const ParticleId> ids, ParticleView<const double> marks, data::Sum& errors) {
  position.forEachOccupied<2>(position.cells(), [&](const Index<2>& cell, const data::ParticleRange& range) {
    for (const int p : range) {
      errors.add(patch.level().cellOf<2>(position[p]) != cell);
      errors.add(marks[p] != markOf(ids[p]));
      errors.add(p > range.first && ids[p] <= ids[p - 1]);
    }
  });
}

struct Ended {
  std::map<ParticleId, std::tuple<int, double, double>> particles;  ///< by id: material and position
  long moved = 0;
  double errors = 0;
};

Ended runOn(const Index3& patches, bool skips) {
  test::Runner run(test::domain({{10, 10, 1}}, patches));
  TaskList start, advance, choosing, looking;
  start.newParticles("create", create, materials, creates(x), creates(mark));
  advance.perMaterial("drift", drift, materials, requiresOld(x), computes(x));
  advance.relocate(x, materials);
  choosing.perMaterial("choose", choose, materials, requiresOld(data::particleId), computes(next));
  looking.perMaterial("inspect", inspect, materials, requiresOld(x, 1), requiresOld(data::particleId, 1),
                      requiresOld(mark, 1), computes(wrong));
  TaskGraph begin = run.compile(start, {"p.x", "p.mark", "p.particleID"});
  TaskGraph step = run.compile(advance, {"p.x", "p.mark"}, true);
  TaskGraph chosen = run.compile(choosing, {"p.next"});
  TaskGraph after = run.compile(looking, {"wrong"});
  if (skips) run.scheduler.skipAbsentMaterials();
  run.step(begin);
  Ended ended;
  for (int k = 0; k < 12; ++k) {
    run.step(step);
    run.scheduler.run(chosen, {k, 0});
    ended.moved += moveBetweenMaterials(run.warehouse, 4, "p.next", {"p.x", "p.mark", "p.particleID"});
    run.step(after);
    ended.errors += run.warehouse.reductionValues(run.table.find("wrong", -1)).at(0);
  }
  for (int patch = 0; patch < run.warehouse.patches(); ++patch)
    for (int m = 0; m < 4; ++m) {
      const auto valuesOf = [&](std::string_view name) {
        return run.warehouse.variable(Generation::old, run.table.find(name, m), patch).values;
      };
      const int owned = run.warehouse.particles(Generation::old, m, patch).owned();
      for (int p = 0; p < owned; ++p) {
        const Vec<2>& at = reinterpret_cast<const Vec<2>*>(valuesOf("p.x"))[p];
        ended.particles[reinterpret_cast<const ParticleId*>(valuesOf("p.particleID"))[p]] = {m, at[0], at[1]};
      }
    }
  return ended;
}

TEST(BetweenMaterials, particlesMoveWithTheirValuesOnAnyPatches) {
  const Ended reference = runOn({{1, 1, 1}}, true);
  EXPECT_EQ(reference.errors, 0);
  EXPECT_EQ(reference.particles.size(), 300U);
  EXPECT_GT(reference.moved, 150);
  for (const auto& [id, particle] : reference.particles) EXPECT_NE(std::get<0>(particle), 2);
  for (const Index3& patches : {Index3{{2, 1, 1}}, Index3{{3, 2, 1}}, Index3{{1, 1, 1}}})
    for (const bool skips : {false, true}) {
      const Ended other = runOn(patches, skips);
      EXPECT_EQ(other.errors, 0);
      EXPECT_EQ(other.moved, reference.moved);
      EXPECT_TRUE(other.particles == reference.particles) << patches[0] << ' ' << patches[1] << ' ' << skips;
    }
}

TEST(BetweenMaterials, aMaterialThatDoesNotExistIsRefused) {
  test::Runner run(test::domain({{4, 4, 1}}, {{1, 1, 1}}));
  TaskList start, choosing;
  start.newParticles("create", create, materials, creates(x), creates(mark));
  choosing.perMaterial(
      "choose",
      [](const Patch&, const Material&, ParticleView<const ParticleId> id, ParticleView<int> to) {
        for (int p = 0; p < id.owned(); ++p) to[p] = 4;
      },
      materials, requiresOld(data::particleId), computes(next));
  TaskGraph begin = run.compile(start, {"p.x", "p.mark", "p.particleID"});
  TaskGraph chosen = run.compile(choosing, {"p.next"});
  run.step(begin);
  run.scheduler.run(chosen, {0, 0});
  EXPECT_THROW(moveBetweenMaterials(run.warehouse, 4, "p.next", {"p.x"}), data::AccessError);
}

}  // namespace

}  // namespace tushar::tasks
