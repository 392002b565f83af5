#include <gtest/gtest.h>

#include <numeric>

#include "core/base/mpi.hpp"
#include "tests/ranks/ranks.hpp"

namespace tushar::mpi {

using test::allRanks;
using test::onRanks;

TEST(Communicator, IsOfFourRanksInTheseTests) { EXPECT_EQ(allRanks().size(), 4); }

TEST(Communicator, TellsTheGreatestTheSumAndWhetherAnyOfAllRanks) {
  EXPECT_EQ(allRanks().max(10.0 - allRanks().rank()), 10.0);
  EXPECT_EQ(allRanks().sum(1L << allRanks().rank()), 15);
  EXPECT_TRUE(allRanks().any(allRanks().rank() == 2));
  EXPECT_FALSE(allRanks().any(false));
}

TEST(Communicator, MergesInTheOrderOfRanks) {
  onRanks(3, [](const Communicator& ranks) {
    std::array<char, 4> word{};
    word[0] = static_cast<char>('a' + ranks.rank());

    ranks.merge(std::as_writable_bytes(std::span(word)), [](const std::byte* from, std::byte* into) {
      auto* end = into + std::strlen(reinterpret_cast<char*>(into));
      std::memcpy(end, from, std::strlen(reinterpret_cast<const char*>(from)));
    });

    EXPECT_EQ(std::string(word.data()), "abc");
  });
}

TEST(Communicator, CarriesMessagesOfAnyLengthInTheOrderInWhichTheyAreSent) {
  const int next = (allRanks().rank() + 1) % allRanks().size(), last = (allRanks().rank() + 3) % allRanks().size();
  Outbox outbox(allRanks());
  for (const std::size_t length : {0u, 1u, 8u, 100001u}) outbox.send(next, Tag::ghosts, Bytes(length, std::byte{42}));

  for (const std::size_t length : {0u, 1u, 8u, 100001u})
    EXPECT_EQ(allRanks().receive(last, Tag::ghosts), Bytes(length, std::byte{42}));
  outbox.wait();
}

TEST(Communicator, CarriesMessagesWhoseOutboxIsNoMore) {
  const Bytes message(8'000'000, std::byte{42});
  if (allRanks().isFirst()) {
    Outbox outbox(allRanks());
    outbox.send(1, Tag::ghosts, message);
  }
  const Bytes other(message.size(), std::byte{7});  // in the memory of the first, had that been given back
  allRanks().any(false);

  if (allRanks().rank() == 1) {
    EXPECT_EQ(allRanks().receive(0, Tag::ghosts), message);
  }
  allRanks().any(false);
}

TEST(Communicator, LetsTheFirstRankActAndTheOthersKnowThatItFailed) {
  const auto fail = [] { throw std::runtime_error("disk full"); };
  if (allRanks().isFirst())
    EXPECT_THROW(allRanks().onFirst(fail), std::runtime_error);
  else
    EXPECT_THROW(allRanks().onFirst(fail), FailedElsewhere);

  bool done = false;
  allRanks().onFirst([&] { done = true; });

  EXPECT_EQ(done, allRanks().isFirst());
}

TEST(Communicator, BroadcastsTextsAndGathersThem) {
  EXPECT_EQ(allRanks().broadcast(allRanks().rank() == 2 ? std::string("two") : std::string(), 2), "two");
  EXPECT_EQ(allRanks().gather(std::string(allRanks().rank(), 'x')), (std::vector<std::string>{"", "x", "xx", "xxx"}));
}

}  // namespace tushar::mpi
