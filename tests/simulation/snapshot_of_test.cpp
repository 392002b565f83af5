#include "core/simulation/snapshot_of.hpp"

#include <gtest/gtest.h>

#include "components/components.hpp"
#include "core/scene/scene.hpp"

namespace tushar::simulation {

namespace {

/// An analysis that samples one variable everywhere.
class Asks : public Analysis {
 public:
  explicit Asks(SaveRequest request) : request_(std::move(request)) {}
  void schedule(tasks::TaskList&) const override {}
  void setTime(double, double) override {}
  std::vector<SaveRequest> samples() const override { return {request_}; }

 private:
  SaveRequest request_;
};

/// Two discs at the start of a run.
class Discs : public RunState {
 public:
  Discs()
      : RunState(scene::readScene("ups/solid/two_discs.ups", {}, catalogue()), {{}, {}, true}, Clock::now(),
                 mpi::Communicator::alone()) {
    scheduler.run(phases.initialize, {0, 0});
    scheduler.commit(phases.initialize);
  }
  /// Returns the number of particles of each material that a module which samples a variable receives.
  std::vector<std::size_t> countsFor(const std::string& label, const std::string& material) {
    std::vector<std::size_t> counts;
    for (const output::ParticleBlock& block : partsOf(*this, Asks({label, material, {}, {}})).front().particles)
      counts.push_back(block.count());
    return counts;
  }
};

}  // namespace

TEST(PartsOf, HaveTheParticlesThatAModuleAsksForAlone) {
  Discs run;
  ASSERT_EQ(run.materials(), 2);
  const std::vector<std::size_t> all = run.countsFor("p.velocity", "");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_GT(all[0], 0u);
  EXPECT_GT(all[1], 0u);

  EXPECT_EQ(run.countsFor("p.velocity", run.phases.materials()[1]), (std::vector<std::size_t>{0, all[1]}));
  EXPECT_EQ(run.countsFor("p.x", run.phases.materials()[0]), (std::vector<std::size_t>{all[0], 0}));
  EXPECT_EQ(run.countsFor("TotalMass", ""), (std::vector<std::size_t>{0, 0}));
}

}  // namespace tushar::simulation
