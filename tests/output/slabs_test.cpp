#include "core/output/slabs.hpp"

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <xxhash.h>

#include <cstring>
#include <limits>

#include "core/output/archive_hdf5_chunks.hpp"
#include "core/output/archive_hdf5_input.hpp"
#include "core/output/checkpoint_manifest.hpp"
#include "core/output/shared_hdf5.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace {

/// A source that hands out the values of an array in memory.
class InMemory : public Source {
 public:
  explicit InMemory(Array array) : array_(std::move(array)) {}
  std::size_t entries() const override { return array_.entries(); }
  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    const std::size_t bytes = entryBytes(array_);
    const auto& values = std::get<std::vector<double>>(array_.values);
    std::memcpy(to, reinterpret_cast<const std::byte*>(values.data()) + first * bytes, count * bytes);
  }
  /// Overwrites the values in memory, as later steps would.
  void forget() { array_ = counting("a", array_.components, array_.entries(), 7); }

 private:
  Array array_;
};

Array streamed(const Array& array) {
  return {array.label,           array.unit,
          array.description,     array.components,
          std::vector<double>{}, std::make_shared<InMemory>(array)};
}

}  // namespace

TEST(SlabOf, CutsAtMegabytesOfTheFileAndLeavesNothingOut) {
  for (const ByteRange all : {ByteRange{2048, 2048}, ByteRange{100, 5000}, ByteRange{1000, 3 * slabCut},
                              ByteRange{slabCut - 8, 17 * slabCut + 24}, ByteRange{5 * slabCut, 9 * slabCut}})
    for (int writers = 1; writers <= 20; ++writers) {
      std::uint64_t next = all.first;
      for (int writer = 0; writer < writers; ++writer) {
        const ByteRange slab = slabOf(all, writer, writers);
        if (slab.size() == 0) continue;
        EXPECT_EQ(slab.first, next);
        EXPECT_TRUE(slab.last == all.last || slab.last % slabCut == 0) << slab.last;
        EXPECT_LE(slab.size(), all.size() / static_cast<std::uint64_t>(writers) + 2 * slabCut);
        next = slab.last;
      }
      EXPECT_EQ(next, all.last) << writers;
    }
}

TEST(Chunks, FollowOneAnotherInTheOrderOfEntries) {
  const Extents shapes[] = {{1}, {200001}, {300, 700, 1}, {3, 250, 311, 9}, {2, 1, 400000}, {5, 0, 3}};
  for (const Extents& shape : shapes) {
    const Chunks chunks(shape);
    std::size_t next = 0;
    for (std::size_t k = 0; k < chunks.count(); ++k) {
      EXPECT_EQ(chunks.entries(k, 1).first, next);
      next += chunks.entries(k, 1).count;
    }
    EXPECT_EQ(next, numbersOf(shape));
  }
}

TEST(WriteTogether, WritesWhatIsReadBackToTheBitPackedOrNot) {
  const TemporaryFolder here;
  const std::vector<std::uint64_t> shapes[] = {{1, 1, 400001}, {3, 250, 311}, {40, 1, 2500}};
  for (const int compression : {0, 1})
    for (const auto& shape : shapes)
      for (const int components : {1, 3}) {
        const Array whole = counting("a", components, shape[0] * shape[1] * shape[2], 0.5);
        writeTogether({}, here / "a.h5", {false, compression}, [](Hdf5File&) {}, {{"/a", streamed(whole), shape}});

        EXPECT_TRUE(Hdf5Input(here / "a.h5").dataset("/a") == whole.values) << compression << ' ' << components;
      }
}

TEST(FileInFlight, HasTakenOverItsValuesWhenItIsMadeAndHasTheBytesOfOneThatIsWrittenAtOnce) {
  const TemporaryFolder here;
  const std::vector<std::uint64_t> shape{7, 400, 311};
  for (const Storage& how : {Storage{}, Storage{true, 0}, Storage{false, 1}})
    for (const std::size_t most : {std::size_t{2} << 20, std::size_t{64} << 20}) {
      auto changing = std::make_shared<InMemory>(counting("a", 3, 7 * 400 * 311, 0.5));
      const std::vector<Dataset> datasets{{"/a", {"a", "m", "", 3, std::vector<double>{}, changing}, shape}};
      writeTogether(
          {}, here / "at_once.h5", how, [](Hdf5File&) {}, datasets);
      Behind behind;
      behind.setMost(most);
      const Writers alone;

      FileInFlight file(
          alone, behind, here / "behind.h5", how, [](Hdf5File&) {}, datasets);
      changing->forget();
      file.finish(alone.ranks());

      EXPECT_TRUE(read(here / "behind.h5") == read(here / "at_once.h5")) << how.compression << ' ' << most;
    }
}

TEST(WriteTogether, RoundsAsFarAsHdf5Does) {
  const TemporaryFolder here;
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const Array whole{"a", "", "", 1, std::vector<double>{0.1, 1e-42, 1e-50, 1e300, -inf, nan, 3.4028234e38, -0.0, 7}};
  const std::uint64_t count = whole.entries();

  writeTogether({}, here / "slab.h5", {true, 0}, [](Hdf5File&) {}, {{"/a", streamed(whole), {count}}});
  Hdf5File file(here / "hdf5.h5", true, 0);
  file.dataset("/a", whole, {count});
  file.close();

  const auto slab = std::get<std::vector<double>>(Hdf5Input(here / "slab.h5").dataset("/a"));
  const auto hdf5 = std::get<std::vector<double>>(Hdf5Input(here / "hdf5.h5").dataset("/a"));
  EXPECT_EQ(std::memcmp(slab.data(), hdf5.data(), count * sizeof(double)), 0);
}

TEST(WriteTogether, PacksAsHdf5Does) {
  const TemporaryFolder here;
  const Array whole = counting("a", 1, 300007, 0.1);

  writeTogether({}, here / "chunks.h5", {false, 4}, [](Hdf5File&) {}, {{"/a", streamed(whole), {300007}}});
  Hdf5File file(here / "hdf5.h5", false, 4);
  file.dataset("/a", streamed(whole), {300007});
  file.close();

  EXPECT_NEAR(static_cast<double>(std::filesystem::file_size(here / "chunks.h5")),
              static_cast<double>(std::filesystem::file_size(here / "hdf5.h5")), 4096);  // groups and their like
  EXPECT_LT(std::filesystem::file_size(here / "chunks.h5"), 300007u * 4);
}

TEST(CheckpointManifest, SeesAnyBlockThatIsChanged) {
  const TemporaryFolder here;
  const std::size_t size = (std::size_t{1} << 24) * 2 + 5;
  const auto change = [&](std::size_t place) {
    std::fstream file(here / "state.h5", std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(place));
    const char old = static_cast<char>(file.get());
    file.seekp(static_cast<std::streamoff>(place));
    file.put(static_cast<char>(old ^ 1));
  };
  std::ofstream(here / "state.h5") << std::string(size, 's');
  writeManifest(here);
  EXPECT_EQ(damageOf(here), "");

  for (const std::size_t place : {std::size_t{0}, size / 2, size - 1}) {
    change(place);
    EXPECT_EQ(damageOf(here), "the content of state.h5 has changed") << place;
    change(place);
  }
  EXPECT_EQ(damageOf(here), "");
}

TEST(CheckpointManifest, OfAnOlderVersionIsUnderstood) {
  const TemporaryFolder here;
  const std::string content((std::size_t{1} << 24) + 1, 's');
  std::ofstream(here / "state.h5") << content;
  const auto hash = [](const std::string& text) { return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0)); };
  const std::string line = fmt::format("{} {} state.h5\n", hash(content), content.size());
  std::ofstream(here / "manifest") << line << hash(line) << " manifest\n";
  EXPECT_EQ(damageOf(here), "");

  std::ofstream(here / "state.h5") << content.substr(1) << 't';

  EXPECT_EQ(damageOf(here), "the content of state.h5 has changed");
}

}  // namespace tushar::output
