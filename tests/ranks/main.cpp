#include <gtest/gtest.h>

#include "tests/ranks/ranks.hpp"

// Tests of several ranks: started by mpirun, every rank runs every test. The first rank prints.

namespace tushar::test {

namespace {
const mpi::Communicator* world = nullptr;
}

const mpi::Communicator& allRanks() { return *world; }

}  // namespace tushar::test

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  tushar::mpi::Session session;
  tushar::test::world = &session.ranks();
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  if (!session.ranks().isFirst()) delete listeners.Release(listeners.default_result_printer());
  const bool failed = RUN_ALL_TESTS() != 0;
  return session.ranks().any(failed) ? 1 : 0;
}
