#include "core/data/slots.hpp"

#include <gtest/gtest.h>

namespace tushar::data {

namespace {

/// Whether no two slots overlap.
bool areDisjoint(const Slots& slots) {
  for (std::size_t a = 0; a < slots.first.size(); ++a)
    for (std::size_t b = a + 1; b < slots.first.size(); ++b)
      if (slots.first[a] < slots.first[b] + slots.room[b] && slots.first[b] < slots.first[a] + slots.room[a])
        return false;
  return true;
}

}  // namespace

TEST(Slots, StayWhileTheParticlesFit) {
  const SharedSlots base = slotsThatFit(nullptr, {100, 0, 1000});
  std::vector<std::size_t> counts = base->room;

  EXPECT_EQ(slotsThatFit(base, counts), base);
  EXPECT_TRUE(areDisjoint(*base));
  EXPECT_GE(base->room[1], 1u) << "a patch without particles may get some";
}

TEST(Slots, MoveBehindAllOthersWhereAPatchHasOutgrownItsOwn) {
  const SharedSlots base = slotsThatFit(nullptr, {1000, 20, 1000});

  const SharedSlots grown = slotsThatFit(base, {1000, base->room[1] + 1, 1000});

  EXPECT_EQ(grown->first[0], base->first[0]);
  EXPECT_GE(grown->first[1], base->end);
  EXPECT_TRUE(grown->extends(*base));
  EXPECT_FALSE(base->extends(*grown));
  EXPECT_TRUE(areDisjoint(*grown));
}

/// Whether no slot overlaps one that another patch had before.
bool leavesOthersAlone(const Slots& now, const Slots& before) {
  for (std::size_t a = 0; a < now.first.size(); ++a)
    for (std::size_t b = 0; b < now.first.size(); ++b)
      if (a != b && now.first[a] < before.first[b] + before.room[b] && before.first[b] < now.first[a] + now.room[a])
        return false;
  return true;
}

TEST(Slots, ThatAreLaidOutAnewFromTheSamePlaceOnDoNotExtendTheOldOnes) {
  const SharedSlots base = slotsThatFit(nullptr, {214, 0});

  const SharedSlots anew = slotsThatFit(base, {242, 1});

  ASSERT_EQ(anew->first[0], base->first[0]);
  ASSERT_GE(anew->first[1], base->end) << "so that the second patch seems to have moved behind all others";
  ASSERT_FALSE(leavesOthersAlone(*anew, *base));
  EXPECT_FALSE(anew->extends(*base));
}

TEST(Slots, ThatExtendOthersLeaveAloneWhatOtherPatchesHaveStillToFetch) {
  int extended = 0;
  for (std::size_t third : {0, 2000})
    for (std::size_t large = 100; large < 400; large += 3)
      for (std::size_t more = 0; more < 60; more += 4) {
        const SharedSlots base = slotsThatFit(nullptr, {large, 0, third});
        const SharedSlots next = slotsThatFit(base, {large + more, more / 8, third});
        if (next == base || !next->extends(*base)) continue;
        ++extended;
        ASSERT_TRUE(leavesOthersAlone(*next, *base)) << large << ' ' << more << ' ' << third;
      }
  EXPECT_GT(extended, 100);
}

TEST(Slots, NeverTakeMuchMoreThanTheParticlesHoweverTheyMove) {
  constexpr std::size_t all = 100'000, patches = 10;
  SharedSlots slots;
  for (std::size_t step = 0; step < 200; ++step) {
    std::vector<std::size_t> counts(patches, all / 100);
    counts[step / 3 % patches] += all - patches * (all / 100);
    slots = slotsThatFit(slots, counts);
    ASSERT_TRUE(areDisjoint(*slots));
    for (std::size_t place = 0; place < patches; ++place) ASSERT_GE(slots->room[place], counts[place]);
    ASSERT_LE(slots->end, 2 * all);
  }
}

}  // namespace tushar::data
