#include "core/output/archive_hdf5_input.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "core/base/error.hpp"
#include "core/output/archive_hdf5.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace {

void writeSample(const std::filesystem::path& path) {
  Hdf5File file(path, false, 0);
  file.attribute("/", "time", 0.1);
  file.attribute("/", "step", -3);
  file.attribute("/", "dropped", std::uint64_t{1} << 60);
  file.attribute("/", "version", std::string("1.2 ü"));
  file.group("/grid");
  file.attribute("/grid", "lower", Vec3(1, 2, 0.3));
  file.attribute("/grid", "cells", Index3{{4, 5, 6}});
  file.dataset("/a/x", counting("x", 3, 4, 0.1), {4});
  file.dataset("/a/ids", {"ids", "", "", 1, std::vector<std::uint64_t>{7, ~std::uint64_t{0}}}, {2});
  file.dataset("/a/marks", {"marks", "", "", 1, std::vector<std::int32_t>{-7}}, {1});
  file.dataset("/a/none", {"none", "", "", 1, std::vector<double>{}}, {0});
  file.text("/scene/text", std::string(200000, 'a') + "ü");
  file.close();
}

/// Computes the values of an array on demand.
class Maker : public Source {
 public:
  explicit Maker(Array array) : array_(std::move(array)) {}
  std::size_t entries() const override { return array_.entries(); }
  void read(std::size_t first, std::size_t count, std::byte* to) const override {
    const auto numbers = static_cast<std::size_t>(array_.components);
    const double* from = std::get<std::vector<double>>(array_.values).data() + first * numbers;
    std::memcpy(to, from, count * numbers * sizeof(double));
  }

 private:
  Array array_;
};

}  // namespace

TEST(Hdf5Input, ReadsBackToTheBitWhatASourceMadePieceByPiece) {
  const TemporaryFolder here;
  const std::vector<std::uint64_t> shapes[] = {{100000}, {1, 1, 200001}, {3, 250, 311}, {40, 1, 2500}};
  for (const int compression : {0, 1})
    for (const auto& shape : shapes)
      for (const int components : {1, 3}) {
        std::size_t entries = 1;
        for (const std::uint64_t extent : shape) entries *= extent;
        const Array whole = counting("a", components, entries, 0.5);
        const Array array{"a", "m/s", "made", components, {}, std::make_shared<Maker>(whole)};

        Hdf5File file(here / "a.h5", false, compression);
        file.dataset("/a", array, shape);
        file.close();

        EXPECT_TRUE(Hdf5Input(here / "a.h5").dataset("/a") == whole.values) << shape.size() << " axes, " << components;
      }
}

TEST(Hdf5Input, ReadsBackToTheBitWhatWasWritten) {
  const TemporaryFolder here;
  writeSample(here / "a.h5");

  const Hdf5Input file(here / "a.h5");

  EXPECT_EQ(file.real("/", "time"), 0.1);
  EXPECT_EQ(file.integer("/", "step"), -3);
  EXPECT_EQ(file.count("/", "dropped"), std::uint64_t{1} << 60);
  EXPECT_EQ(file.text("/", "version"), "1.2 ü");
  EXPECT_EQ(file.vector("/grid", "lower"), Vec3(1, 2, 0.3));
  EXPECT_EQ(file.index("/grid", "cells"), (Index3{{4, 5, 6}}));
  EXPECT_EQ(file.dataset("/a/x"), counting("x", 3, 4, 0.1).values);
  EXPECT_EQ(file.dataset("/a/ids"), (Array::Values{std::vector<std::uint64_t>{7, ~std::uint64_t{0}}}));
  EXPECT_EQ(file.dataset("/a/marks"), (Array::Values{std::vector<std::int32_t>{-7}}));
  EXPECT_EQ(file.dataset("/a/none"), (Array::Values{std::vector<double>{}}));
  EXPECT_EQ(file.text("/scene/text"), std::string(200000, 'a') + "ü");
}

TEST(Hdf5Input, KnowsWhatThereIs) {
  const TemporaryFolder here;
  writeSample(here / "a.h5");

  const Hdf5Input file(here / "a.h5");

  EXPECT_TRUE(file.has("/a/x"));
  EXPECT_FALSE(file.has("/a/y"));
  EXPECT_FALSE(file.has("/b/x"));
  EXPECT_EQ(file.names("/a"), (std::vector<std::string>{"ids", "marks", "none", "x"}));
  EXPECT_EQ(file.names("/b"), std::vector<std::string>{});
}

TEST(Hdf5Input, SaysInASentenceWhatItCannotRead) {
  const TemporaryFolder here;
  std::ofstream(here / "text.h5") << "no HDF5 file";
  writeSample(here / "a.h5");

  EXPECT_THROW(Hdf5Input(here / "none.h5"), FileError);
  EXPECT_THROW(Hdf5Input(here / "text.h5"), FileError);
  const Hdf5Input file(here / "a.h5");
  EXPECT_THROW(file.dataset("/a/y"), FileError);
  EXPECT_THROW(file.real("/", "delT"), FileError);
  EXPECT_THROW(file.vector("/", "time"), FileError);
}

}  // namespace tushar::output
