#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <random>
#include <regex>

#include "components/components.hpp"
#include "components/mpm/gas/labels.hpp"
#include "core/scene/find_restart.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/support/temporary.hpp"

// A wrong value in a run of Sod's tube is found at its place and time, on any patches.

namespace tushar::simulation {

using report::Report;
using scene::findRestart;
using scene::readScene;

namespace {

/// A wrong value planted into a run.
struct Planted {
  double value;
  ParticleId id;
  double from;  ///< from [s]
};

/// A component with an additional task that spoils the internal energy of one particle.
class Spoiled : public Component {
 public:
  Spoiled(std::unique_ptr<Component> sound, const Planted& planted) : sound_(std::move(sound)), planted_(planted) {}

  void scheduleInitialize(tasks::TaskList& tasks) const override { sound_->scheduleInitialize(tasks); }
  void scheduleComputeStableTimeStep(tasks::TaskList& tasks) const override {
    sound_->scheduleComputeStableTimeStep(tasks);
  }
  void scheduleTimeAdvance(tasks::TaskList& tasks) const override {
    sound_->scheduleTimeAdvance(tasks);
    static const std::vector<Gas> materials{{"gas"}};
    tasks.perMaterial(
        "spoil",
        [planted = planted_](const grid::Patch&, const Gas&, double time, data::ParticleView<const ParticleId> ids,
                             data::ParticleView<double> energy) {
          for (int p = 0; p < energy.owned(); ++p)
            if (ids[p] == planted.id && time >= planted.from) energy[p] = planted.value;
        },
        materials, tasks::startTime(), tasks::requiresNew(data::particleId),
        tasks::modifies(mpm::gas::p::internalEnergy));
  }
  void scheduleDiagnostics(tasks::TaskList& tasks) const override { sound_->scheduleDiagnostics(tasks); }

 private:
  struct Gas {
    std::string name;
  };
  std::unique_ptr<Component> sound_;
  Planted planted_;
};

Problem sod(int patches) {
  const std::string layout = "Grid/Level/Box/patches=[" + std::to_string(patches) + ",1,1]";
  return readScene("ups/mpm/sod_conserving.ups", {layout, "DataArchiver/outputInterval=0"}, catalogue());
}

Report run(Problem problem) {
  RunOptions options;
  options.quiet = true;
  options.outputFolder = test::temporaryFolder();
  return Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run();
}

Report runSpoiled(const Planted& planted, int patches) {
  Problem problem = sod(patches);
  problem.component = std::make_unique<Spoiled>(std::move(problem.component), planted);
  problem.analyses.clear();
  return run(std::move(problem));
}

/// Returns the message without the patch and the path of the saved state.
std::string sentenceOf(const Report& report) {
  const std::string text = std::regex_replace(report.failure, std::regex("patch \\d+"), "patch *");
  return text.substr(0, text.find(", is saved"));
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST(Detection, NamesTheValueTheParticleThePlaceAndTheStepOnAnyPatches) {
  std::mt19937 chance(11);
  for (const double value : {nan, -0.5}) {
    const int cell = static_cast<int>(chance() % 100);  // where the particle starts; it moves by some cells until then
    const Planted planted{value, static_cast<ParticleId>(cell) << 16, 0.1};
    const std::string number = std::isnan(value) ? "nan" : "-0.5";
    const std::regex expected(
        "p\\.internalEnergy became " + number + " J/kg \\(was \\S+\\), but must be at least 0: particle " +
        std::to_string(planted.id) +
        " in cell \\(\\d+\\) at x = 0\\.\\d+ m; around it: .* in its cell, .* in cell \\(\\d+\\).*; 1 of \\d+ "
        "particles is out of bounds \\(task spoil, patch \\*, material gas, step \\d+, time 0\\.10\\d* s, time step "
        "0\\.00\\d+ s\\); "
        "the last complete step, \\d+ at t = 0\\.10\\d* s");

    const Report alone = runSpoiled(planted, 1);

    EXPECT_TRUE(std::regex_match(sentenceOf(alone), expected)) << sentenceOf(alone);
    EXPECT_EQ(alone.ended, "failed");
    EXPECT_EQ(alone.advice, "a smaller time step (timestep_multiplier in <Time>); or recompute_timestep in <Time>");
    for (const int patches : {3, 7, 100}) EXPECT_EQ(sentenceOf(runSpoiled(planted, patches)), sentenceOf(alone));
  }
}

TEST(Detection, LeavesTheLastGoodStateFromWhichTheSoundRunGoesOnToTheSameBits) {
  const Report spoiled = runSpoiled({nan, ParticleId{30} << 16, 0.1}, 3);

  const Restart restart = findRestart(spoiled.archive, {});
  Problem rest = readScene(restart.scene().string(), {}, catalogue());
  rest.restart = restart;

  EXPECT_EQ(restart.step, spoiled.steps);
  EXPECT_EQ(run(std::move(rest)).fingerprint, run(sod(1)).fingerprint);
}

}  // namespace tushar::simulation
