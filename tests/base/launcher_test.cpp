#include "core/base/launcher.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <list>
#include <map>

#include "tests/support/environment.hpp"

namespace tushar {

namespace {

/// Returns what is read from a launcher that sets these variables and no others.
std::array<int, 4> understood(const std::map<std::string, std::string>& set) {
  std::list<test::Environment> variables;
  for (const char* name :
       {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_LOCAL_SIZE", "PMI_SIZE", "PMI_RANK",
        "MPI_LOCALNRANKS", "MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK", "MV2_COMM_WORLD_LOCAL_SIZE", "PMIX_RANK",
        "SLURM_STEP_NUM_TASKS", "SLURM_PROCID", "SLURM_STEP_TASKS_PER_NODE", "SLURM_CPUS_PER_TASK"})
    variables.emplace_back(name, set.contains(name) ? std::optional(set.at(name)) : std::nullopt);
  return {launchedRanks(), launchedRank(), ranksOnThisMachine(), launchedCoresPerRank()};
}

constexpr int any = std::numeric_limits<int>::max();
const std::map<std::string, std::string> allocation{
    {"SLURM_STEP_NUM_TASKS", "16"}, {"SLURM_PROCID", "5"}, {"SLURM_STEP_TASKS_PER_NODE", "8(x2)"}};

}  // namespace

TEST(Launcher, IsNoneWhereNothingIsSet) { EXPECT_EQ(understood({}), (std::array{1, 0, 1, any})); }

TEST(Launcher, MayBeOpenMpi) {
  EXPECT_EQ(understood({{"OMPI_COMM_WORLD_SIZE", "6"},
                        {"OMPI_COMM_WORLD_RANK", "4"},
                        {"OMPI_COMM_WORLD_LOCAL_SIZE", "3"},
                        {"PMIX_RANK", "4"}}),
            (std::array{6, 4, 3, any}));
}

TEST(Launcher, MayBeOneThatSpeaksPmi) {
  EXPECT_EQ(understood({{"PMI_SIZE", "6"}, {"PMI_RANK", "4"}, {"MPI_LOCALNRANKS", "3"}}), (std::array{6, 4, 3, any}));
}

TEST(Launcher, MayBeSrunThatSpeaksPmix) {
  auto set = allocation;
  set.insert({{"PMIX_RANK", "5"}, {"SLURM_CPUS_PER_TASK", "2"}});

  EXPECT_EQ(understood(set), (std::array{16, 5, 8, 2}));
}

TEST(Launcher, IsNotSlurmWhereOnlyTheAllocationIs) { EXPECT_EQ(understood(allocation), (std::array{1, 0, 1, any})); }

}  // namespace tushar
