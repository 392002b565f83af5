#include <gtest/gtest.h>
#include <hdf5.h>
#include <mpi.h>

#include "core/base/error.hpp"
#include "core/output/archive.hpp"
#include "tests/output/snapshots.hpp"

namespace tushar::output {

namespace fs = std::filesystem;

namespace {

struct Dataset {
  std::vector<hsize_t> shape;
  std::vector<double> values;
  std::size_t bytes = 0;  ///< of a number in the file
  bool chunked = false;
};

std::vector<hsize_t> shapeOf(hid_t space) {
  std::vector<hsize_t> shape(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

/// An HDF5 file that is open for reading.
class Reader {
 public:
  explicit Reader(const fs::path& path) : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~Reader() { H5Fclose(file_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  bool has(const std::string& name) const { return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0; }

  Dataset dataset(const std::string& name) const {
    const hid_t data = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(data), type = H5Dget_type(data), creation = H5Dget_create_plist(data);
    Dataset read{shapeOf(space), {}, H5Tget_size(type), H5Pget_layout(creation) == H5D_CHUNKED};
    read.values.resize(H5Sget_simple_extent_npoints(space));
    H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.values.data());
    H5Pclose(creation);
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(data);
    return read;
  }

  std::vector<double> numbers(const std::string& object, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Aget_space(attribute);
    std::vector<double> values(H5Sget_simple_extent_npoints(space));
    H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data());
    H5Sclose(space);
    H5Aclose(attribute);
    return values;
  }

  std::string text(const std::string& object, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(file_, object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    char* read = nullptr;
    H5Aread(attribute, type, &read);
    const std::string copy = read;
    H5free_memory(read);
    H5Tclose(type);
    H5Aclose(attribute);
    return copy;
  }

 private:
  hid_t file_;
};

const std::vector<double>& reals(const Array& array) { return std::get<std::vector<double>>(array.values); }

/// Writes a snapshot into a new archive and opens its file.
struct Written {
  explicit Written(const Snapshot& snapshot, const ArchiveOptions& options = {})
      : archive(here / "a.uda", "", options) {
    archive.write(snapshot);
    file = archive.folder() / "t00042.h5";
  }
  TemporaryFolder here;
  Archive archive;
  fs::path file;
};

}  // namespace

TEST(ArchiveHdf5, KeepsTimeStepAndVersion) {
  const Written written(snapshot3d(42, 0.1), {.version = "1.2.3"});
  const Reader reader(written.file);
  EXPECT_EQ(reader.numbers("/", "time"), std::vector<double>{0.1});
  EXPECT_EQ(reader.numbers("/", "delT"), std::vector<double>{0.125});
  EXPECT_EQ(reader.numbers("/", "step"), std::vector<double>{42});
  EXPECT_EQ(reader.text("/", "version"), "1.2.3");
}

TEST(ArchiveHdf5, KeepsTheGrid) {
  const Written written(snapshot3d(42, 0.1));
  const Reader reader(written.file);
  EXPECT_EQ(reader.numbers("/grid", "lower"), (std::vector<double>{-1, 0, 2}));
  EXPECT_EQ(reader.numbers("/grid", "spacing"), (std::vector<double>{0.5, 0.25, 2}));
  EXPECT_EQ(reader.numbers("/grid", "cells"), (std::vector<double>{4, 3, 2}));
  EXPECT_EQ(reader.numbers("/grid", "dimension"), std::vector<double>{3});
}

TEST(ArchiveHdf5, KeepsTheBoxesOfARefinedGridAndTheirCellsOneAfterTheOther) {
  const Snapshot snapshot = snapshotRefined(42, 0.1);
  for (const bool doubleAsFloat : {false, true}) {
    const Written written(snapshot, {.doubleAsFloat = doubleAsFloat, .compression = 4});
    const Reader reader(written.file);
    EXPECT_EQ(reader.numbers("/grid", "cells"), (std::vector<double>{4, 2, 1})) << "of the coarsest level";
    const Dataset boxes = reader.dataset("/grid/boxes"), levels = reader.dataset("/grid/levels");
    EXPECT_EQ(boxes.shape, (std::vector<hsize_t>{4, 7}));
    EXPECT_EQ(boxes.values, (std::vector<double>{0, 0, 0, 0, 2, 2, 1, 1, 4,  0, 0, 6,  4, 1,
                                                 1, 6, 0, 0, 8, 2, 1, 2, 12, 4, 0, 16, 8, 1}));
    EXPECT_EQ(levels.shape, (std::vector<hsize_t>{3, 3}));
    EXPECT_EQ(levels.values, (std::vector<double>{0.1, 0.2, 2, 0.05, 0.1, 2, 0.025, 0.05, 2}));
    EXPECT_EQ(reader.dataset("/cells/c.temperature").shape, std::vector<hsize_t>{32});
    EXPECT_EQ(reader.dataset("/cells/c.velocity").shape, (std::vector<hsize_t>{32, 3}));
    if (doubleAsFloat) continue;
    EXPECT_EQ(reader.dataset("/cells/gas/c.density").values, reals(snapshot.fields[2].array));
  }
}

TEST(ArchiveHdf5, SaysNothingOfBoxesWhereThereIsOneLevel) {
  const Written written(snapshot3d(42, 0.1));
  EXPECT_FALSE(Reader(written.file).has("/grid/boxes"));
  EXPECT_FALSE(Reader(written.file).has("/grid/levels"));
}

TEST(ArchiveHdf5, ReturnsParticleArraysToTheLastBit) {
  const Snapshot snapshot = snapshot3d(42, 0.1);
  const Written written(snapshot);
  const Reader reader(written.file);
  for (const Array& array : snapshot.particles[0].arrays) {
    const Dataset read = reader.dataset("/particles/gas/" + array.label);
    const std::vector<hsize_t> scalar{5}, several{5, static_cast<hsize_t>(array.components)};
    EXPECT_EQ(read.shape, array.components == 1 ? scalar : several) << array.label;
    if (array.values.index() != 0) continue;
    EXPECT_EQ(read.values, reals(array)) << array.label;
  }
  EXPECT_EQ(reader.dataset("/particles/gas/p.particleID").values[3], 1099511627776.0 + 3);
  EXPECT_EQ(reader.dataset("/particles/gas/p.mark").values[4], -7);
}

TEST(ArchiveHdf5, KeepsUnitAndDescriptionBesideTheValues) {
  const Written written(snapshot3d(42, 0));
  const Reader reader(written.file);
  EXPECT_EQ(reader.text("/particles/gas/p.velocity", "unit"), "m/s");
  EXPECT_EQ(reader.text("/particles/gas/p.particleID", "unit"), "");
  EXPECT_EQ(reader.text("/particles/gas/p.particleID", "description"), "identity");
}

TEST(ArchiveHdf5, WritesAMaterialWithoutParticles) {
  const Written written(snapshot3d(42, 0.1), {.compression = 4});
  const Reader reader(written.file);
  EXPECT_EQ(reader.dataset("/particles/steel ball/p.x").shape, (std::vector<hsize_t>{0, 3}));
  EXPECT_EQ(reader.numbers("/particles/steel ball", "index"), std::vector<double>{1});
}

TEST(ArchiveHdf5, OrdersFieldsByZThenYThenX) {
  const Snapshot snapshot = snapshot3d(42, 0.1);
  const Written written(snapshot);
  const Reader reader(written.file);
  const Dataset cells = reader.dataset("/cells/c.temperature"), nodes = reader.dataset("/nodes/gas/g.velocity");
  EXPECT_EQ(cells.shape, (std::vector<hsize_t>{2, 3, 4}));
  EXPECT_EQ(cells.values, reals(snapshot.fields[0].array));
  EXPECT_EQ(nodes.shape, (std::vector<hsize_t>{3, 4, 5, 3}));
  EXPECT_EQ(nodes.values, reals(snapshot.fields[2].array));
}

TEST(ArchiveHdf5, GivesAnAxisThatIsLeftOutOneNode) {
  Snapshot snapshot;
  snapshot.step = 42;
  snapshot.grid = {{0, 0, 0}, {1, 0.1, 1}, {{1, 10, 1}}, 1};
  snapshot.fields = {{Centring::node, "", -1, counting("g.mass", 1, 11, 0)}};
  const Written written(snapshot);
  EXPECT_EQ(Reader(written.file).dataset("/nodes/g.mass").shape, (std::vector<hsize_t>{1, 11, 1}));
}

TEST(ArchiveHdf5, KeepsRealNumbersInFourBytesIfAsked) {
  const Written written(snapshot3d(42, 0.1), {.doubleAsFloat = true});
  const Reader reader(written.file);
  EXPECT_EQ(reader.dataset("/particles/gas/p.density").bytes, 4u);
  EXPECT_EQ(reader.dataset("/particles/gas/p.density").values[0], 10.6f);
  EXPECT_EQ(reader.dataset("/particles/gas/p.particleID").bytes, 8u);
}

TEST(ArchiveHdf5, CompressesWithoutLoss) {
  Snapshot snapshot = snapshot3d(42, 0.1);
  snapshot.particles = {particles("gas", 0, 300000, 0)};
  const Written plain(snapshot), packed(snapshot, {.compression = 6});
  EXPECT_LT(fs::file_size(packed.file), fs::file_size(plain.file) / 4);
  const Dataset read = Reader(packed.file).dataset("/particles/gas/p.stress");
  EXPECT_TRUE(read.chunked);
  EXPECT_EQ(read.values, reals(snapshot.particles[0].arrays[3]));
}

TEST(ArchiveHdf5, LeavesOutAVariableThatIsNotHeld) {
  Snapshot snapshot = snapshot3d(42, 0);
  snapshot.particles[0].arrays.push_back({"p.pressure", "Pa", "", 1, {}});
  const Written written(snapshot);
  EXPECT_FALSE(Reader(written.file).has("/particles/gas/p.pressure"));
}

TEST(ArchiveHdf5, KeepsTheFirstOfEachReferenceColumn) {
  Snapshot snapshot = snapshot3d(42, 0);
  snapshot.reference.push_back(counting("x", 1, 3, 100));
  const Written written(snapshot);
  EXPECT_EQ(Reader(written.file).dataset("/reference/x").values.size(), 11u);
}

TEST(ArchiveHdf5, NamesAMaterialWithoutANameByItsIndex) {
  Snapshot snapshot = snapshot3d(42, 0);
  snapshot.particles = {particles("", 3, 2, 0), particles("air/water", 4, 2, 0)};
  const Written written(snapshot);
  EXPECT_TRUE(Reader(written.file).has("/particles/material3"));
  EXPECT_TRUE(Reader(written.file).has("/particles/air_water"));
}

TEST(ArchiveHdf5, TellsTheInnermostReasonAndPrintsNothing) {
  Snapshot snapshot = snapshot3d(42, 0);
  snapshot.particles.push_back(snapshot.particles[0]);
  testing::internal::CaptureStderr();
  std::string sentence;
  try {
    const Written written(snapshot);
  } catch (const FileError& error) {
    sentence = error.what();
  }
  EXPECT_NE(sentence.find("/particles/gas in"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("name already exists"), std::string::npos) << sentence;
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ArchiveHdf5, NeverStartsMpi) {
  const Written written(snapshot3d(42, 0.1));
  int started = 1;
  MPI_Initialized(&started);
  EXPECT_EQ(started, 0);
}

}  // namespace tushar::output
