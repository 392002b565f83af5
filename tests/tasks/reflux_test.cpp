#include "core/tasks/reflux.hpp"

#include <gtest/gtest.h>

#include "core/core.hpp"

namespace tushar::tasks {

TEST(Reflux, IsFollowedByTheTasksThatCheckAllOfItsVariables) {
  static constexpr CellLabel<double> value{"c.value", "1", "a number in each cell"};
  static constexpr CellLabel<double> other{"c.other", "1", "another number in each cell"};
  static constexpr CellLabel<double> still{"c.still", "1", "a number without fluxes"};
  const auto nothing = [](const Patch&, const std::vector<Box>&, CellView<double>) {};
  const auto none = [](const Patch&, const std::vector<Box>&, CellView<double>, CellView<double>) {};
  const auto keep = [](const Patch&, CellView<double>, const RimFlux<double>&) {};
  TaskList list, after;
  list.perPatch("advect", keep, computes(value), keepsFlux(value));
  list.perPatch("advect other", keep, computes(other), keepsFlux(other));
  list.perPatch(
      "source", [](const Patch&, CellView<double>) {}, modifies(other));
  after.perPatch("check both", none, besideFiner(), modifies(value), modifies(other));
  after.perPatch("check value", nothing, besideFiner(), modifies(value));
  after.perPatch("check still", nothing, besideFiner(), modifies(still));
  const auto namesOf = [](const TaskList& tasks) {
    std::string names;
    for (const Task& task : tasks.tasks()) names += task.name + ", ";
    return names;
  };
  EXPECT_EQ(namesOf(withRefluxing(list, after)),
            "advect, reflux c.value, check value, advect other, reflux c.other, check both, source, ");
  EXPECT_EQ(namesOf(withRegisters(list, after).reflux), "reflux c.value, check value, reflux c.other, check both, ");
}

}  // namespace tushar::tasks
