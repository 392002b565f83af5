#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/output/archive_hdf5.hpp"
#include "core/output/archive_hdf5_parts.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace {

constexpr std::size_t count = 3000;  ///< more parts than the system accepts in one call

void writeSample(const std::filesystem::path& path, int compression) {
  Hdf5File file(path, false, compression);
  file.dataset("/a", counting("a", 1, count, 0.5), {count});
  file.dataset("/none", counting("none", 1, 0, 0), {0});
  file.close();
}

/// Returns parts of one value each, with targets in `to` from its end on; every seventh is omitted.
std::vector<Hdf5Parts::Part> scattered(std::vector<double>& to) {
  std::vector<Hdf5Parts::Part> parts;
  for (std::size_t k = 0; k < count; ++k)
    if (k % 7 != 0) parts.push_back({k, 1, reinterpret_cast<std::byte*>(&to[count - 1 - k])});
  std::reverse(parts.begin() + 100, parts.end());
  return parts;
}

}  // namespace

TEST(Hdf5Parts, GoWhereTheyAreNeededWhetherTheFileIsCompressedOrNot) {
  const TemporaryFolder here;
  for (const int compression : {0, 4}) {
    writeSample(here / "a.h5", compression);
    const Hdf5Input file(here / "a.h5");
    const Hdf5Parts parts(file, "/a");
    std::vector<double> to(count, -1);

    parts.read(scattered(to));

    EXPECT_EQ(parts.count(), count);
    for (std::size_t k = 0; k < count; ++k)
      ASSERT_EQ(to[count - 1 - k], k % 7 == 0 ? -1 : 0.5 + static_cast<double>(k)) << k;
  }
}

TEST(Hdf5Parts, OfNothingAreNothing) {
  const TemporaryFolder here;
  writeSample(here / "a.h5", 0);
  const Hdf5Input file(here / "a.h5");
  const Hdf5Parts parts(file, "/none");
  EXPECT_EQ(parts.count(), 0u);
  EXPECT_NO_THROW(parts.read({}));
}

TEST(Hdf5Parts, SayWhereAFileIsTooShort) {
  const TemporaryFolder here;
  writeSample(here / "a.h5", 0);
  const Hdf5Input file(here / "a.h5");
  const Hdf5Parts parts(file, "/a");
  std::filesystem::resize_file(here / "a.h5", 4096);
  std::vector<double> to(count);
  EXPECT_THROW(parts.read({{0, count, reinterpret_cast<std::byte*>(to.data())}}), FileError);
}

TEST(Hdf5Parts, SayWhereAFileCannotBeReadThoughThePartsBeginWithNothing) {
  const TemporaryFolder here;
  writeSample(here / "a.h5", 0);
  const Hdf5Input file(here / "a.h5");
  const Hdf5Parts parts(file, "/a");
  std::vector<double> to(count);
  auto* const bytes = reinterpret_cast<std::byte*>(to.data());
  const auto read = [&] { parts.read({{0, 0, bytes}, {0, count, bytes}}); };
  EXPECT_NO_THROW(read());

  std::filesystem::remove(here / "a.h5");
  EXPECT_THROW(read(), FileError);
  std::filesystem::create_directory(here / "a.h5");  // opens, but does not read
  EXPECT_THROW(read(), FileError);
}

}  // namespace tushar::output
