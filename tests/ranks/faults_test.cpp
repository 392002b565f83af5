#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/ranks/ranks.hpp"

// All ranks report a fault of any rank in the same way.

namespace tushar::tasks {

namespace {

using namespace test;

/// Returns the outcome of a run in which one task harms one cell.
template <class Harm>
std::string failure(const mpi::Communicator& ranks, bool mayRepeat, const Harm& harm) {
  test::Runner run(plane({{4, 3, 1}}, false), 1, ranks);
  TaskList list;
  list.perPatch(
      "harm",
      [harm](const Patch& patch, CellView<double> cells, Minimum& factor) {
        forEach<2>(patch.cells(), [&](const Index<2>& at) { cells[at] = numberOf(at, false); });
        harm(patch, cells, factor);
      },
      computes(number), computes(data::recomputeTimeStep));
  list.perPatch(
      "neighbours",
      [](const Patch&, CellView<const double> cells, Sum& bad) {
        forEach<2>(cells.box(), [&](const Index<2>& at) { bad.add(cells[at]); });
      },
      requiresNew(number, 1), computes(wrong));
  TaskGraph graph = run.compile(list, {"wrong", "recomputeTimeStep"});
  run.warehouse.grow(0);
  StepInfo at;
  at.mayRepeat = mayRepeat;
  try {
    const auto asked = run.scheduler.run(graph, at);
    return asked ? std::string(asked->reason.text()) + " " + std::to_string(asked->value) : "";
  } catch (const NumericalError& error) {
    return error.what();
  }
}

void breakTwo(const Patch& patch, CellView<double> cells, Minimum&) {
  for (const Index<2>& bad : {Index<2>{{2, 6}}, Index<2>{{9, 2}}})
    if (patch.cells().contains(bad)) cells[bad] = -1;
}
void throwTwo(const Patch& patch, CellView<double>, Minimum&) {
  for (const Index<2>& bad : {Index<2>{{2, 6}}, Index<2>{{9, 2}}})
    if (patch.cells().contains(bad))
      throw NumericalError("cell " + std::to_string(patch.level().cellNumber(bad)), "", "value",
                           patch.level().cellNumber(bad));
}
void askAndThrow(const Patch& patch, CellView<double> cells, Minimum& factor) {
  if (patch.cells().contains(Index<2>{{11, 9}})) factor.add(0.4, "far");
  throwTwo(patch, cells, factor);
}

}  // namespace

TEST(Ranks, TellTheSameOfAFaultOnAnyOfThem) {
  for (const auto& harm : {breakTwo, throwTwo, askAndThrow}) {
    const std::string alone = failure(mpi::Communicator::alone(), false, harm);
    const std::string repeated = failure(mpi::Communicator::alone(), true, harm);
    EXPECT_NE(alone, "");
    for (const int ranks : {2, 4})
      onRanks(ranks, [&](const mpi::Communicator& some) {
        EXPECT_EQ(failure(some, false, harm), alone);
        EXPECT_EQ(failure(some, true, harm), repeated);
      });
  }
}

TEST(Ranks, RefuseATaskThatBreaksABoundOnceAndNotAgain) {
  onRanks(2, [](const mpi::Communicator& some) {
    bool isBroken = false;
    const auto breakOnce = [&isBroken](const Patch& patch, CellView<double> cells, Minimum&) {
      const Index<2> bad{{2, 6}};
      if (patch.cells().contains(bad) && !std::exchange(isBroken, true)) cells[bad] = -1;
    };

    EXPECT_THROW(failure(some, false, breakOnce), TaskError);
  });
}

}  // namespace tushar::tasks
