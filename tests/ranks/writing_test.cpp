#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "core/base/mpi_together.hpp"
#include "core/collect/sums_before.hpp"
#include "core/output/archive_hdf5_chunks.hpp"
#include "core/output/checkpoint_manifest.hpp"
#include "core/output/pieces.hpp"
#include "core/output/shared_hdf5.hpp"
#include "core/output/slabs.hpp"
#include "tests/output/snapshots.hpp"
#include "tests/ranks/ranks.hpp"

namespace tushar::output {

using test::allRanks;
using test::onRanks;

namespace {

/// Values from 0.5 on; a rank has every n-th run of a given length.
class Shared : public Source {
 public:
  Shared(const mpi::Communicator& ranks, std::size_t entries, int components, std::size_t run)
      : ranks_(ranks), entries_(entries), components_(static_cast<std::size_t>(components)), run_(run) {}

  std::size_t entries() const override { return entries_; }
  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    for (std::size_t k = 0; k < count; ++k)
      if (isMine(first + k)) put(first + k, to + k * bytes());
  }
  std::vector<Stretch> stretches(std::size_t first, std::size_t count) const override {
    std::vector<Stretch> all;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!isMine(first + k)) continue;
      if (!all.empty() && all.back().first + all.back().count == k)
        ++all.back().count;
      else
        all.push_back({k, 1});
    }
    return all;
  }
  void pack(std::size_t first, std::size_t count, std::byte* to) const override {
    for (std::size_t k = first; k < first + count; ++k)
      if (isMine(k)) put(k, std::exchange(to, to + bytes()));
  }

 private:
  bool isMine(std::size_t entry) const {
    return static_cast<int>(entry / run_ % static_cast<std::size_t>(ranks_.size())) == ranks_.rank();
  }
  std::size_t bytes() const { return components_ * sizeof(double); }
  void put(std::size_t entry, std::byte* to) const {
    for (std::size_t k = 0; k < components_; ++k, to += sizeof(double)) {
      const double number = 0.5 + static_cast<double>(entry * components_ + k);
      std::memcpy(to, &number, sizeof(number));
    }
  }

  const mpi::Communicator& ranks_;
  std::size_t entries_, components_, run_;
};

Array sharedArray(const mpi::Communicator& ranks, std::size_t entries, int components, std::size_t run) {
  return {"a",
          "m/s",
          "shared",
          components,
          std::vector<double>{},
          std::make_shared<Shared>(ranks, entries, components, run)};
}

/// A folder whose path all ranks know.
class SharedFolder {
 public:
  explicit SharedFolder(const mpi::Communicator& ranks) {
    if (ranks.isFirst()) folder_.emplace();
    path_ = ranks.broadcast(folder_ ? static_cast<const std::filesystem::path&>(*folder_).string() : "");
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::optional<TemporaryFolder> folder_;
  std::filesystem::path path_;
};

/// Writes a file of datasets: small, cut into slabs, with several components, scattered, and empty.
std::string fileOf(const Writers& writers, const SharedFolder& folder, const Storage& how,
                   std::size_t behindOthers = 0) {
  const mpi::Communicator& ranks = writers.ranks();
  const std::vector<Dataset> datasets{{"/a/small", sharedArray(ranks, 3, 1, 1), {3}},
                                      {"/a/rows", sharedArray(ranks, 7 * 30 * 2000, 1, 100), {7, 30, 2000}},
                                      {"/b/vectors", sharedArray(ranks, 100003, 3, 17), {100003}},
                                      {"/b/scattered", sharedArray(ranks, 200000, 1, 1), {200000}},
                                      {"/b/none", sharedArray(ranks, 0, 1, 1), {0}},
                                      {"/b/values", {"v", "", "", 1, std::vector<double>{1, 2}}, {2}}};
  Behind behind;
  behind.setMost(behindOthers);
  const auto header = [](Hdf5File& file) { file.attribute("/", "step", 7); };
  FileInFlight(writers, behind, folder / "a.h5", how, header, datasets).finish(ranks);
  const std::string bytes = read(folder / "a.h5");
  ranks.any(false);  // nobody writes the next before all have read this one
  return bytes;
}

}  // namespace

TEST(SumsBefore, AreThePlacesOfKeysAmongThoseOfAllRanks) {
  for (const std::uint64_t spread : {1, 1000003})
    onRanks(3, [&](const mpi::Communicator& ranks) {
      std::vector<std::uint64_t> keys, places;
      for (std::uint64_t k = 0; k < 10000; ++k)
        if (static_cast<int>(k * k / 7 % 3) == ranks.rank()) {
          keys.push_back(k * spread + 5);
          places.push_back(k);
        }

      EXPECT_EQ(collect::sumsBefore(ranks, keys), places);
    });
}

TEST(SumsBefore, RefuseKeysThatTwoRanksHave) {
  const std::vector<std::uint64_t> keys{3, 50, 700};
  onRanks(3, [&](const mpi::Communicator& ranks) {
    const std::vector<std::uint64_t> own{keys[static_cast<std::size_t>(ranks.rank())], 1000U + (ranks.rank() + 1) / 2};
    EXPECT_THROW(collect::sumsBefore(ranks, own), TaskError);
  });
}

TEST(SumsBefore, AddWeightsWhereSomeRanksHaveNoKeys) {
  const std::vector<std::uint64_t> some{3, 4, 8}, weights{10, 0, 5}, sums{0, 10, 10};

  const bool has = allRanks().rank() == 2;
  const std::vector<std::uint64_t> found =
      has ? collect::sumsBefore(allRanks(), some, weights) : collect::sumsBefore(allRanks(), {}, {});

  EXPECT_EQ(found, has ? sums : std::vector<std::uint64_t>{});
}

TEST(WriteTogether, MakesTheSameBytesOnAnyRanksByAnyWriters) {
  const SharedFolder folder(allRanks());
  for (const Storage& how : {Storage{}, Storage{true, 0}, Storage{false, 1}, Storage{true, 4}}) {
    const std::string expected = allRanks().broadcast(allRanks().isFirst() ? fileOf({}, folder, how) : "");
    for (const int count : {2, 3, 4})
      for (int writers = 1; writers <= count; ++writers)
        for (const std::size_t behind : {0, 3 << 20})
          onRanks(count, [&](const mpi::Communicator& ranks) {
            EXPECT_TRUE(fileOf(Writers::spread(ranks, writers), folder, how, behind) == expected)
                << count << " ranks, " << writers << " writers, compression " << how.compression << ", " << behind;
          });
  }
}

TEST(WriteTogether, TellsOnTheRankThatCannotWriteAndEndsOnTheOthers) {
  const SharedFolder folder(allRanks());
  const std::vector<Dataset> datasets{{"/a", sharedArray(allRanks(), 1 << 20, 1, 1000), {1 << 20}}};
  const auto remove = [&](Hdf5File&) { std::filesystem::remove(folder / "gone.h5"); };
  const Writers writers(allRanks(), {0, 2});
  std::string said;
  bool failedElsewhere = false;

  try {
    writeTogether(writers, folder / "gone.h5", {}, remove, datasets);
  } catch (const FileError& error) {
    said = error.what();
  } catch (const mpi::FailedElsewhere&) {
    failedElsewhere = true;
  }

  EXPECT_EQ(failedElsewhere, writers.mine() < 0);
  EXPECT_EQ(said.find("gone.h5': No such file or directory") != std::string::npos, writers.mine() >= 0) << said;
}

TEST(CheckpointManifest, IsCheckedByAllRanksWhichAllSeeWhatOneHasFound) {
  const SharedFolder folder(allRanks());
  constexpr std::size_t block = std::size_t{1} << 24;
  std::string content(2 * block + 5, 's');
  const auto put = [&] { allRanks().onFirst([&] { std::ofstream(folder / "state.h5") << content; }); };
  put();
  writeManifest(folder / "", Writers(allRanks(), {0, 2}));
  EXPECT_EQ(damageOf(folder / "", allRanks()), "");
  onRanks(2, [&](const mpi::Communicator& ranks) { EXPECT_EQ(damageOf(folder / "", ranks), ""); });
  for (const std::size_t place : {std::size_t{0}, block, 2 * block + 4}) {
    content[place] ^= 1;
    put();
    EXPECT_EQ(damageOf(folder / "", allRanks()), "the content of state.h5 has changed") << place;
    content[place] ^= 1;
  }
  content.pop_back();
  put();
  EXPECT_EQ(damageOf(folder / "", allRanks()), "state.h5 has 33554436 bytes instead of 33554437");
  allRanks().onFirst([&] { std::filesystem::remove(folder / "state.h5"); });
  EXPECT_EQ(damageOf(folder / "", allRanks()), "state.h5 is missing");
}

TEST(Writers, AreSpreadEvenlyAndStayIfTheySaySo) {
  const Writers two = Writers::spread(allRanks(), 2), one = Writers::spread(allRanks(), 0);

  EXPECT_EQ(two.rankOf(1), 2);
  EXPECT_EQ(one.count(), 1);
  EXPECT_EQ(Writers::spread(allRanks(), 9).count(), 4);
  EXPECT_EQ(Writers::spread(allRanks(), 4).only(allRanks().rank() == 3).rankOf(1), 3);
  EXPECT_EQ(two.only(false).count(), 1);
}

TEST(Load, BringsAllToTheFirstRank) {
  Snapshot snapshot;
  snapshot.fields.push_back({Centring::cell, "", -1, sharedArray(allRanks(), 600001, 1, 3)});

  load(snapshot, allRanks());

  const Array& array = snapshot.fields.front().array;
  const auto& values = std::get<std::vector<double>>(array.values);
  EXPECT_EQ(array.source, nullptr);
  EXPECT_EQ(values.size(), allRanks().isFirst() ? 600001u : 0u);
  if (!values.empty()) {
    EXPECT_EQ(values[12345], 12345.5);
    EXPECT_EQ(values.back(), 600000.5);
  }
}

}  // namespace tushar::output
