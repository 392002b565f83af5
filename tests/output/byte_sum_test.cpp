#include "core/output/byte_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "core/base/error.hpp"
#include "core/output/checkpoint_manifest.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace {

std::vector<std::byte> chance(std::size_t count) {
  std::mt19937 random(3);
  std::vector<std::byte> bytes(count);
  std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::byte>(random() & 255); });
  return bytes;
}

std::uint64_t sumOf(std::uint64_t at, std::span<const std::byte> bytes) {
  ByteSum sum;
  sum.add(at, bytes);
  return sum.value();
}

void write(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

TEST(ByteSum, IsTheSumOfWordsTimesPowers) {
  constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1, base = 0x16c86fac93223801;
  const std::byte one{1};
  EXPECT_EQ(sumOf(0, {&one, 1}), 1u);
  EXPECT_EQ(sumOf(3, {&one, 1}), 1u << 24);
  EXPECT_EQ(sumOf(8, {&one, 1}), base);
  EXPECT_EQ(sumOf(15, {&one, 1}),
            static_cast<std::uint64_t>((__extension__ static_cast<unsigned __int128>(base) << 56) % prime));
  const std::vector<std::byte> full(8, std::byte{255});
  EXPECT_EQ(sumOf(0, full), ~std::uint64_t{0} % prime);
}

TEST(ByteSum, IsTheSameHoweverBytesAreDividedAndInAnyOrder) {
  const std::vector<std::byte> bytes = chance(4099);
  std::mt19937 random(5);
  for (const std::uint64_t at : {0u, 3u, 8u, 100005u}) {
    const std::uint64_t whole = sumOf(at, bytes);
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<std::size_t> cuts{0, bytes.size()};
      for (int k = 0; k < 30; ++k) cuts.push_back(random() % bytes.size());
      std::sort(cuts.begin(), cuts.end());
      std::vector<std::size_t> order(cuts.size() - 1);
      for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
      std::shuffle(order.begin(), order.end(), random);
      ByteSum sum;
      for (const std::size_t k : order) sum.add(at + cuts[k], std::span(bytes).subspan(cuts[k], cuts[k + 1] - cuts[k]));
      ASSERT_EQ(sum.value(), whole);
    }
  }
}

TEST(ByteSum, OfAFileSharesAnyRanges) {
  const TemporaryFolder here;
  const std::vector<std::byte> bytes = chance((std::size_t{1} << 21) + 77);
  write(here / "a", bytes);
  const std::vector<ByteRange> ranges{{5, 700}, {701, 701}, {9000, bytes.size() - 1}};
  ByteSum expected;
  for (const ByteRange& range : ranges) expected.add(range.first, std::span(bytes).subspan(range.first, range.size()));
  constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1;
  for (const int several : {1, 2, 5}) {
    std::uint64_t sum = 0;
    for (int one = 0; one < several; ++one) sum = (sum + sumOfFile(here / "a", ranges, {one, several})) % prime;
    EXPECT_EQ(sum, expected.value()) << several;
  }
  EXPECT_THROW(sumOfFile(here / "none", ranges, {}), FileError);
}

TEST(CheckedParts, AreLeftOutByInspectionAndCheckedWhenTheyAreRead) {
  const TemporaryFolder here;
  std::filesystem::create_directory(here / "t");
  std::vector<std::byte> bytes = chance(300'000);
  write(here / "t/state.h5", bytes);
  writeManifest(here / "t", {}, {{"state.h5", {100'001, 200'000}}, {"state.h5", {50, 90}}});
  EXPECT_EQ(damageOf(here / "t"), "");
  const auto inspected = [&](std::size_t at) {
    bytes[at] ^= std::byte{4};
    write(here / "t/state.h5", bytes);
    bytes[at] ^= std::byte{4};
    return inspect(here / "t");
  };

  EXPECT_EQ(inspected(100'000).damage, "the content of state.h5 has changed");
  EXPECT_EQ(inspected(200'000).damage, "the content of state.h5 has changed");
  EXPECT_EQ(inspected(60).damage, "the content of state.h5 has changed");  // too short for a sum of its own
  for (const std::size_t at : {100'001u, 199'999u}) {
    const Inspection found = inspected(at);
    EXPECT_EQ(found.damage, "");
    ASSERT_EQ(found.parts.size(), 1u);
    EXPECT_EQ(damageOf(here / "t"), "the content of state.h5 has changed");
    CheckedParts checks(here / "t", found.parts, mpi::Communicator::alone());
    EXPECT_NO_THROW(checks.read("state.h5", 50, [](ByteSum* sum) { EXPECT_EQ(sum, nullptr); }));
    EXPECT_THROW(
        checks.read("state.h5", 100'001, [](ByteSum* sum) { sum->add(100'001, std::vector<std::byte>(99'999)); }),
        DamageError);
    EXPECT_THROW(checks.checkOthers(), DamageError);
  }
}

}  // namespace tushar::output
