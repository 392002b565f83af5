#include "core/tasks/relocation.hpp"

#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "core/base/error.hpp"
#include "core/data/vanished.hpp"
#include "tests/support/run.hpp"

namespace tushar::tasks {

namespace {

using data::Generation;
using data::ParticleLabel;
using data::ParticleView;
using grid::forEach;
using grid::Patch;

template <int D>
constexpr ParticleLabel<Vec<D>> x{"p.x", "m", "position"};
constexpr ParticleLabel<double> mark{"p.mark", "1", "a value that belongs to the id"};
constexpr data::ReductionLabel<data::Sum> wrong{"wrong", "1", "particles that are not where they should be"};

struct Material {
  std::string name;
};
const std::vector<Material> gas{{"gas"}};

double markOf(ParticleId id) { return 0.5 + static_cast<double>(id % 1000003); }

/// Returns a pseudo-random value from 0 to 1 that depends only on the argument.
double noise(std::uint64_t seed) {
  seed = (seed ^ (seed >> 31)) * 0x7fb5d329728ea185ULL;
  seed = (seed ^ (seed >> 27)) * 0x81dadef4bc2dd44dULL;
  return static_cast<double>((seed ^ (seed >> 33)) >> 11) * 0x1.0p-53;
}

template <int D>
void create(const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<D>>& position,
            std::vector<double>& marks) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    for (ParticleId k = 3; k-- > 0;) {  // in descending order: the framework sorts
      const ParticleId id = 3 * patch.level().cellNumber(cell) + k;
      Vec<D> at;
      for (int d = 0; d < D; ++d)
        at[d] = patch.level().nodePosition(d, cell[d]) +
                noise(7 * id + static_cast<std::uint64_t>(d)) * patch.level().spacing(d);
      maker.add(cell, id);
      position.push_back(at);
      marks.push_back(markOf(id));
    }
  });
}

/// Moves every particle by up to half of `widest` cells, within the grid.
template <int D>
void wander(const Patch& patch, const Material&, double widest, ParticleView<const Vec<D>> from,
            ParticleView<const ParticleId> ids, ParticleView<Vec<D>> to) {
  for (int p = 0; p < from.owned(); ++p)
    for (int d = 0; d < D; ++d) {
      const double jump =
          (noise(ids[p] * 31 + static_cast<std::uint64_t>(d) + static_cast<std::uint64_t>(from[p][d] * 1e9)) - 0.5);
      const double end = patch.level().nodePosition(d, patch.level().cells().upper[d]);
      to[p][d] = std::clamp(from[p][d] + widest * jump * patch.level().spacing(d), 0.0, end);
    }
}

/// Counts particles in a wrong cell, unsorted, or with a wrong mark; ghosts included.
template <int D>
void inspect(const Patch& patch, const Material&, ParticleView<const Vec<D>> position,
             ParticleView<const ParticleId> ids, ParticleView<const double> marks, data::Sum& errors) {
  forEach<D>(position.cells(), [&](const Index<D>& cell) {
    bool first = true;
    ParticleId before = 0;
    for (const int p : position.in(cell)) {
      errors.add(patch.level().template cellOf<D>(position[p]) != cell);
      errors.add(marks[p] != markOf(ids[p]));
      errors.add(!first && ids[p] <= before);
      before = ids[p];
      first = false;
    }
  });
}

/// The time at which particles are examined: within the step or after it.
enum class Look { inStep, afterwards };

/// Returns positions by id after some steps, and the errors that `inspect` found.
template <int D>
std::pair<std::map<ParticleId, Vec<D>>, double> wanderFor(int steps, double widest, const Index3& resolution,
                                                          const Index3& patches, Look look) {
  test::Runner run(test::domain(resolution, patches));
  TaskList start, advance, looking;
  start.newParticles("create", create<D>, gas, creates(x<D>), creates(mark));
  advance.perMaterial("wander", wander<D>, gas, with(widest), requiresOld(x<D>), requiresOld(data::particleId),
                      computes(x<D>));
  advance.relocate(x<D>, gas);
  if (look == Look::inStep)
    advance.perMaterial("inspect", inspect<D>, gas, requiresNew(x<D>, 1), requiresNew(data::particleId, 1),
                        requiresNew(mark, 1), computes(wrong));
  else
    looking.perMaterial("inspect", inspect<D>, gas, requiresOld(x<D>, 1), requiresOld(data::particleId, 1),
                        requiresOld(mark, 1), computes(wrong));
  TaskGraph begin = run.compile(start, {"p.x", "p.mark", "p.particleID"});
  TaskGraph step = run.compile(advance, {"p.x", "p.mark", "wrong"}, true);
  TaskGraph after = run.compile(looking, {"wrong"});
  run.step(begin);
  double errors = 0;
  for (int k = 0; k < steps; ++k) {
    run.step(step);
    run.step(after);
    errors += run.warehouse.reductionValues(run.table.find("wrong", -1)).at(0);
  }
  std::map<ParticleId, Vec<D>> positions;
  for (int patch = 0; patch < run.warehouse.patches(); ++patch) {
    const auto* ids = reinterpret_cast<const ParticleId*>(
        run.warehouse.variable(Generation::old, run.table.find("p.particleID", 0), patch).values);
    const auto* at = reinterpret_cast<const Vec<D>*>(
        run.warehouse.variable(Generation::old, run.table.find("p.x", 0), patch).values);
    for (int p = 0; p < run.warehouse.particles(Generation::old, 0, patch).owned(); ++p) positions[ids[p]] = at[p];
  }
  return {positions, errors};
}

template <int D>
void expectSameOnAll(double widest, const Index3& resolution, const std::vector<Index3>& layouts) {
  const auto reference = wanderFor<D>(25, widest, resolution, {{1, 1, 1}}, Look::inStep);
  EXPECT_EQ(reference.second, 0);
  EXPECT_EQ(reference.first.size(), 3 * grid::Box({{}, resolution}).size());
  for (const Index3& layout : layouts)
    for (const Look look : {Look::inStep, Look::afterwards}) {
      const auto other = wanderFor<D>(25, widest, resolution, layout, look);
      EXPECT_EQ(other.second, 0);
      EXPECT_TRUE(other.first == reference.first) << layout[0] << ' ' << layout[1] << ' ' << layout[2];
    }
}

/// Moves every particle by `shift`.
void shiftAll(TaskList& advance, double shift) {
  advance.perMaterial(
      "shift",
      [shift](const Patch&, const Material&, ParticleView<const Vec<1>> from, ParticleView<Vec<1>> to) {
        for (int p = 0; p < from.owned(); ++p) to[p] = Vec<1>(from[p][0] + shift);
      },
      gas, requiresOld(x<1>), computes(x<1>));
  advance.relocate(x<1>, gas);
}

/// Returns the error of the first step, if any.
std::optional<NumericalError> errorOf(test::Runner& run, const TaskList& start, const TaskList& advance) {
  TaskGraph begin = run.compile(start, {"p.x"}), step = run.compile(advance, {"p.x"}, true);
  run.step(begin);
  try {
    run.step(step);
  } catch (const NumericalError& error) {
    return error;
  }
  return std::nullopt;
}

/// Returns the message of a step in which all particles move by `shift`; the upper x face is open if `open`.
std::string shifted(double shift, bool open, long& dropped) {
  grid::Domain domain = test::domain({{8, 1, 1}}, {{2, 1, 1}});
  if (open) domain.boundaries.face(0, 1).clear();
  test::Runner run(domain);
  TaskList start, advance;
  start.newParticles("create", create<1>, gas, creates(x<1>), creates(mark));
  shiftAll(advance, shift);
  const auto error = errorOf(run, start, advance);
  dropped = run.scheduler.relocation().lost().left;
  return error ? error->what() : "";
}

}  // namespace

TEST(Relocation, KeepsEveryParticleInItsCellInOrderAndWithItsValuesOnAnyPatches) {
  expectSameOnAll<1>(5, {{30, 1, 1}}, {{{2, 1, 1}}, {{7, 1, 1}}, {{30, 1, 1}}});
  expectSameOnAll<2>(5, {{9, 6, 1}}, {{{3, 2, 1}}, {{9, 6, 1}}});
  expectSameOnAll<3>(5, {{5, 4, 3}}, {{{2, 2, 2}}, {{5, 4, 3}}});
}

/// Particles that move little often enter the next cell without a change of their index, because they are the last of
/// one cell and become the first of the next: their values are not moved.
TEST(Relocation, KeepsTheValuesOfParticlesThatChangeTheirCellButNotTheirIndex) {
  for (const double widest : {0.05, 0.2, 0.8}) {
    expectSameOnAll<1>(widest, {{60, 1, 1}}, {{{1, 1, 1}}, {{2, 1, 1}}, {{7, 1, 1}}});
    expectSameOnAll<2>(widest, {{12, 4, 1}}, {{{1, 1, 1}}, {{3, 2, 1}}});
  }
}

TEST(Relocation, ForgetsTheMovesOfAStepThatFailed) {
  test::Runner run(test::domain({{8, 1, 1}}, {{2, 1, 1}}));
  double shift = 0.6;  // the particles of the left half move; some to the other patch, some through the wall
  const auto body = [&shift](const Patch&, const Material&, ParticleView<const Vec<1>> from, ParticleView<Vec<1>> to) {
    for (int p = 0; p < from.owned(); ++p) to[p] = Vec<1>(from[p][0] < 0.5 ? from[p][0] + shift : from[p][0]);
  };
  TaskList start, advance, looking;
  start.newParticles("create", create<1>, gas, creates(x<1>), creates(mark));
  advance.perMaterial("shift", body, gas, requiresOld(x<1>), computes(x<1>));
  advance.relocate(x<1>, gas);
  looking.perMaterial("inspect", inspect<1>, gas, requiresOld(x<1>), requiresOld(data::particleId), requiresOld(mark),
                      computes(wrong));
  TaskGraph begin = run.compile(start, {"p.x", "p.mark", "p.particleID"}),
            step = run.compile(advance, {"p.x", "p.mark"}, true);
  TaskGraph look = run.compile(looking, {"wrong"});
  run.step(begin);
  EXPECT_THROW(run.step(step), NumericalError);
  shift = 0.125;

  run.step(step);
  run.step(look);

  EXPECT_EQ(run.warehouse.reductionValues(run.table.find("wrong", -1)).at(0), 0);
  EXPECT_EQ(
      run.warehouse.particles(Generation::old, 0, 0).owned() + run.warehouse.particles(Generation::old, 0, 1).owned(),
      24);
}

TEST(Relocation, DropsAndCountsWhatLeavesThroughAFreeFace) {
  long dropped = 0;

  EXPECT_EQ(shifted(0.25, true, dropped), "");

  EXPECT_EQ(dropped, 6);  // the particles of the last two of eight cells
}

TEST(Relocation, DropsWhatHasVanishedWithoutCountingItAndCountsWhatIsRemoved) {
  test::Runner run(test::domain({{8, 1, 1}}, {{2, 1, 1}}));
  TaskList start, advance;
  start.newParticles("create", create<1>, gas, creates(x<1>), creates(mark));
  advance.perMaterial(
      "vanish",
      [](const Patch&, const Material&, ParticleView<const Vec<1>> from, ParticleView<const ParticleId> ids,
         ParticleView<Vec<1>> to) {
        const std::array<Vec<1>, 2> gone{Vec<1>(data::vanished), Vec<1>(data::removed)};
        for (int p = 0; p < from.owned(); ++p) to[p] = ids[p] % 3 < 2 ? gone[ids[p] % 3] : from[p];
      },
      gas, requiresOld(x<1>), requiresOld(data::particleId), computes(x<1>));
  advance.relocate(x<1>, gas);

  EXPECT_FALSE(errorOf(run, start, advance));

  EXPECT_EQ(run.scheduler.relocation().lost().left, 0);
  EXPECT_EQ(run.scheduler.relocation().lost().removed, 8);
  EXPECT_EQ(
      run.warehouse.particles(Generation::old, 0, 0).owned() + run.warehouse.particles(Generation::old, 0, 1).owned(),
      8);
}

TEST(Relocation, RefusesToLetParticlesThroughASymmetryPlaneOrToNowhere) {
  long dropped = 0;

  EXPECT_EQ(
      shifted(0.25, false, dropped),
      "particle 18 passed through the symmetry plane x+, from x = 0.813757 m to 1.06376 m; patch 1 (task relocate, "
      "material gas, step 7, time 0.5 s)");
  EXPECT_EQ(
      shifted(std::nan(""), false, dropped),
      "p.x became nan m (was 0), but must be finite: particle 0 in cell (0) at x = 0 m; around it: nan, nan in its "
      "cell, nan, nan, nan in cell (1); 24 of 24 particles are out of bounds; patch 0 (task relocate, material gas, "
      "step "
      "7, time 0.5 s)");
}

namespace {

/// Returns message and advice of a step in which the only particle, in cell 32 of 64, moves by some finest cells.
/// Cells 16 to 47 are there, those around them are of the coarser level.
std::string movedOnLevels(double cells) {
  grid::Domain domain = test::domain({{32, 1, 1}});
  domain.refinement.levels = 2;
  domain.refinement.regions.push_back({1, Vec3(0.25, 0, 0), Vec3(0.75, 1, 1)});
  test::Runner run(domain);
  run.scheduler.relocation().setAdviceNearCoarser("a wider grid");
  TaskList start, advance;
  start.newParticles(
      "create",
      [](const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<1>>& at) {
        if (!patch.cells().contains(Index<1>{{32}}) || patch.level().number() == 0) return;
        maker.add(Index<1>{{32}}, 5);
        at.push_back(Vec<1>(32.5 / 64));
      },
      gas, creates(x<1>));
  shiftAll(advance, cells / 64);
  const auto error = errorOf(run, start, advance);
  return error ? error->what() + ("; try " + error->advice()) : "";
}

}  // namespace

TEST(Relocation, RefusesParticlesBesideCoarserCellsAndInThem) {
  const std::string refused =
      "particle 5 came within 1 cell of coarser cells, where particles are not allowed; patch 1 (task relocate, "
      "material "
      "gas, step 7, time 0.5 s); try a wider grid";

  EXPECT_EQ(movedOnLevels(14), "");
  EXPECT_EQ(movedOnLevels(15), refused);
  EXPECT_EQ(movedOnLevels(-16), refused);
  EXPECT_EQ(movedOnLevels(24), refused);
}

}  // namespace tushar::tasks
