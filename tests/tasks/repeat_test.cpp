#include <gtest/gtest.h>

#include <cstring>

#include "core/base/error.hpp"
#include "tests/support/run.hpp"

// A step that is undone and repeated.

namespace tushar::tasks {

namespace {

using data::Bound;
using data::Generation;
using data::Minimum;
using data::ParticleLabel;
using data::ParticleView;
using data::recomputeTimeStep;
using data::Sum;
using grid::forEach;
using grid::Patch;

constexpr ParticleLabel<Vec<1>> x{"p.x", "m", "position"};
constexpr ParticleLabel<double> mass{"p.mass", "kg", "mass", Bound::positive};
constexpr data::ReductionLabel<Sum> total{"TotalMass", "kg", "mass"};
constexpr data::ReductionLabel<Sum> ran{"ran", "1", "runs of the last task"};

struct Material {
  std::string name;
};
const std::vector<Material> gas{{"gas"}};

/// A tube of 8 cells, open at its upper end, with three particles in each cell, and a step that moves them.
class Tube {
 public:
  explicit Tube(int patches) : run(domain(patches)) {
    TaskList start, advance;
    start.newParticles("create", create, gas, creates(x), creates(mass));
    advance.perMaterial(
        "shift",
        [this](const Patch&, const Material&, ParticleView<const Vec<1>> from, ParticleView<const double> m, Sum& sum,
               ParticleView<Vec<1>> to, ParticleView<double> newMass) {
          for (int p = 0; p < from.owned(); ++p) {
            to[p] = Vec<1>(from[p][0] + shift);
            newMass[p] = m[p] - loss;
            sum.add(m[p]);
          }
        },
        gas, requiresOld(x), requiresOld(mass), computes(total), computes(x), computes(mass));
    advance.relocate(x, gas);
    advance.perMaterial(
        "ask",
        [this](const Patch& patch, const Material&, ParticleView<const Vec<1>>, Minimum& factor) {
          if (patch.id() == 0) factor.add(ask, "too far");
        },
        gas, requiresNew(x), computes(recomputeTimeStep));
    advance.perMaterial(
        "last", [](const Patch&, const Material&, ParticleView<const Vec<1>>, Sum& count) { count.add(1); }, gas,
        requiresNew(x), computes(ran));
    begin = run.compile(start, {"p.x", "p.mass"});
    step = run.compile(advance, {"p.x", "p.mass", "TotalMass", "recomputeTimeStep", "ran"}, true);
    run.step(begin);
  }

  double value(std::string_view label) { return run.warehouse.reductionValues(run.table.find(label, -1)).at(0); }
  /// Returns the bytes of all old variables.
  std::string state() {
    std::string bytes;
    for (const char* label : {"p.x", "p.mass", "p.particleID"})
      for (int patch = 0; patch < run.warehouse.patches(); ++patch) {
        const auto owned = static_cast<std::size_t>(run.warehouse.particles(Generation::old, 0, patch).owned());
        const auto& values = run.warehouse.variable(Generation::old, run.table.find(label, 0), patch).values;
        bytes.append(reinterpret_cast<const char*>(values), 8 * owned);
      }
    return bytes;
  }

  test::Runner run;
  TaskGraph begin, step;
  double shift = 0, loss = 0, ask = 1;

 private:
  static grid::Domain domain(int patches) {
    grid::Domain domain = test::domain({{8, 1, 1}}, {{patches, 1, 1}});
    domain.boundaries.face(0, 1).clear();
    return domain;
  }
  static void create(const Patch& patch, const Material&, ParticleMaker& maker, std::vector<Vec<1>>& at,
                     std::vector<double>& m) {
    forEach<1>(patch.cells(), [&](const Index<1>& cell) {
      for (ParticleId k = 0; k < 3; ++k) {
        maker.add(cell, 3 * patch.level().cellNumber(cell) + k);
        at.push_back(Vec<1>((cell[0] + 0.25 * static_cast<double>(k + 1)) / 8));
        m.push_back(1);
      }
    });
  }
};

}  // namespace

TEST(Repeat, EndsTheStepWithTheTaskThatAsksAndLeavesTheOldStateAsItIs) {
  for (const int patches : {1, 3, 8}) {
    Tube tube(patches);
    const std::string before = tube.state();
    tube.shift = 0.3;
    tube.ask = 0.25;

    const auto asked = tube.run.scheduler.run(tube.step, {});

    ASSERT_TRUE(asked);
    EXPECT_EQ(asked->value, 0.25);
    EXPECT_EQ(asked->reason.text(), "too far");
    EXPECT_EQ(tube.state(), before);
    EXPECT_EQ(tube.run.warehouse.reductionValues(tube.run.table.find("ran", -1)), std::vector<double>{});
    EXPECT_EQ(tube.run.scheduler.relocation().lost().left, 0);
  }
}

TEST(Repeat, GivesWhatAStepThatWasNeverUndoneGives) {
  for (const int patches : {1, 3, 8}) {
    Tube plain(patches), repeated(patches);
    for (int k = 0; k < 5; ++k) {
      repeated.shift = 0.7;
      repeated.ask = 0.1;
      EXPECT_TRUE(repeated.run.scheduler.run(repeated.step, {}));
      EXPECT_TRUE(repeated.run.scheduler.run(repeated.step, {}));
      repeated.shift = plain.shift = 0.07;
      repeated.ask = 1;
      repeated.run.step(repeated.step);
      plain.run.step(plain.step);
    }

    EXPECT_EQ(repeated.state(), plain.state());
    EXPECT_EQ(repeated.value("TotalMass"), plain.value("TotalMass"));
    EXPECT_EQ(repeated.run.scheduler.relocation().lost().left, plain.run.scheduler.relocation().lost().left);
    EXPECT_GT(plain.run.scheduler.relocation().lost().left, 0);
  }
}

TEST(Repeat, IsAskedForByABrokenBoundWhereTheRunAllowsIt) {
  Tube tube(3);
  const std::string before = tube.state();
  tube.loss = 1;
  StepInfo at;
  at.mayRepeat = true;

  const auto asked = tube.run.scheduler.run(tube.step, at);

  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->value, 0.5);
  EXPECT_EQ(asked->reason.text(), "p.mass");
  EXPECT_EQ(tube.state(), before);
  EXPECT_THROW(tube.run.scheduler.run(tube.step, {}), NumericalError);
}

TEST(Repeat, IsAskedForByAParticleThatPassesThroughAPlaneWhereTheRunAllowsIt) {
  Tube tube(2);
  tube.shift = -0.5;
  StepInfo at;
  at.mayRepeat = true;

  const auto asked = tube.run.scheduler.run(tube.step, at);

  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->reason.text(), "p.x");
}

TEST(Repeat, IsWhatATaskGetsThatAsksAndBreaksABoundAtOnce) {
  test::Runner run(test::domain({{4, 1, 1}}, {{4, 1, 1}}));
  constexpr data::CellLabel<double> heat{"c.heat", "J", "heat", Bound::positive};
  TaskList advance;
  advance.perPatch(
      "cool",
      [](const Patch& patch, data::CellView<double> to, Minimum& factor) {
        to.fill(patch.id() < 2 ? -1 : 1);
        if (patch.id() == 3) factor.add(0.7, "heat");
      },
      computes(heat), computes(recomputeTimeStep));
  TaskGraph graph = run.compile(advance, {"c.heat", "recomputeTimeStep"});
  run.warehouse.grow(0);

  const auto asked = run.scheduler.run(graph, {});

  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->value, 0.7);
}

TEST(Minimum, KeepsTheReasonOfTheLeastWhateverTheOrder) {
  Minimum a, b, empty;
  a.add(3, "viscosity");
  a.add(2, "CFL");
  b.add(2, "acceleration");
  b.add(5, "source");

  Minimum ab = a, ba = b;
  ab.merge(b);
  ba.merge(a);
  ab.merge(empty);

  EXPECT_EQ(ab.value, 2);
  EXPECT_EQ(ab.reason.text(), "CFL");
  EXPECT_EQ(ab.reason, ba.reason);
  EXPECT_EQ(data::Reason::of("a text that is longer than it may be").text(), "a text that is longer than it m");
}

}  // namespace tushar::tasks
