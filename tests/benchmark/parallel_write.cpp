// All ranks create one HDF5 file: each writes its part (MPI-IO), or sends it to the first rank, which writes
// (aggregation).
//
//     mpirun -n 2 parallel_write [REPETITIONS]
//
// A field of 4096 x 4096 doubles (134 MB). Ranks share its columns or its rows: the part of a rank is scattered over
// the file, or contiguous.

#include <fcntl.h>
#include <hdf5.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <list>
#include <string>
#include <vector>

namespace {

constexpr hsize_t width = 4096;

/// The part of an array that belongs to a rank: `extent` values along each axis from `first` on.
struct Part {
  hsize_t first[2], extent[2];
  std::vector<double> values;
};

Part partOf(int rank, int ranks, bool columns) {
  const auto share = width / static_cast<hsize_t>(ranks), first = share * static_cast<hsize_t>(rank);
  Part part{{columns ? 0 : first, columns ? first : 0}, {columns ? width : share, columns ? share : width}, {}};
  part.values.assign(part.extent[0] * part.extent[1], rank + 0.5);
  return part;
}

void writePart(hid_t file, hid_t data, const Part& part, hid_t transfer) {
  const hid_t memory = H5Screate_simple(2, part.extent, nullptr);
  H5Sselect_hyperslab(file, H5S_SELECT_SET, part.first, nullptr, part.extent, nullptr);
  if (H5Dwrite(data, H5T_NATIVE_DOUBLE, memory, file, transfer, part.values.data()) < 0) MPI_Abort(MPI_COMM_WORLD, 1);
  H5Sclose(memory);
}

/// Creates a file that is opened with the properties `access`; `write(file space, dataset)` writes its dataset.
template <class Write>
void writeFile(const std::string& path, hid_t access, const Write& write) {
  const hsize_t shape[] = {width, width};
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (file < 0) MPI_Abort(MPI_COMM_WORLD, 1);
  const hid_t space = H5Screate_simple(2, shape, nullptr);
  const hid_t data = H5Dcreate2(file, "a", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  write(space, data);
  H5Dclose(data);
  H5Sclose(space);
  H5Fclose(file);
}

/// Copies the values of several parts into a block of rows.
void assemble(const std::vector<const Part*>& parts, Part& rows) {
  for (hsize_t row = 0; row < rows.extent[0]; ++row)
    for (const Part* part : parts) {
      const hsize_t from = rows.first[0] + row - part->first[0];  // wraps around in front of the part
      if (from >= part->extent[0]) continue;
      const double* first = part->values.data() + from * part->extent[1];
      std::copy(first, first + part->extent[1], rows.values.data() + row * width + part->first[1]);
    }
}

void writeTogether(const std::string& path, const Part& part) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS), transfer = H5Pcreate(H5P_DATASET_XFER);
  H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL);
  H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
  writeFile(path, access, [&](hid_t space, hid_t data) { writePart(space, data, part, transfer); });
  H5Pclose(transfer);
  H5Pclose(access);
}

/// Collects the parts on the first rank, which writes them as rows, a megabyte at a time, as the archive does.
void writeByFirst(const std::string& path, const Part& own, int rank, int ranks, bool columns) {
  const auto count = static_cast<int>(own.values.size());
  if (rank > 0) {
    MPI_Send(own.values.data(), count, MPI_DOUBLE, 0, 0, MPI_COMM_WORLD);
    return;
  }
  std::list<Part> others;
  std::vector<const Part*> parts{&own};
  for (int other = 1; other < ranks; ++other) {
    parts.push_back(&others.emplace_back(partOf(other, ranks, columns)));
    MPI_Recv(others.back().values.data(), count, MPI_DOUBLE, other, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
  Part rows{{0, 0}, {32, width}, std::vector<double>(32 * width)};
  writeFile(path, H5P_DEFAULT, [&](hid_t space, hid_t data) {
    for (; rows.first[0] < width; rows.first[0] += rows.extent[0]) {
      assemble(parts, rows);
      writePart(space, data, rows, H5P_DEFAULT);
    }
  });
}

/// Returns the seconds until a new file is on the disk.
template <class Write>
double timed(const std::string& path, int rank, const Write& write) {
  MPI_Barrier(MPI_COMM_WORLD);
  const double started = MPI_Wtime();
  write();
  if (rank == 0) {
    const int file = open(path.c_str(), O_RDONLY);
    fsync(file);
    close(file);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const double taken = MPI_Wtime() - started;
  if (rank == 0) std::filesystem::remove(path);
  return taken;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void compare(bool columns, int repetitions, int rank, int ranks) {
  const std::string path = std::filesystem::temp_directory_path() / "parallel_write.h5";
  const Part part = partOf(rank, ranks, columns);
  std::vector<double> together, byFirst;
  for (int k = 0; k < repetitions; ++k) {
    together.push_back(timed(path, rank, [&] { writeTogether(path, part); }));
    byFirst.push_back(timed(path, rank, [&] { writeByFirst(path, part, rank, ranks, columns); }));
  }
  if (rank > 0) return;
  std::printf("%s of %d ranks, %d interleaved repetitions: MPI-IO %.3f s, aggregation %.3f s\n",
              columns ? "columns" : "rows", ranks, repetitions, median(together), median(byFirst));
}

}  // namespace

int main(int count, char** words) {
  MPI_Init(&count, &words);
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const int repetitions = count > 1 ? std::max(1, std::atoi(words[1])) : 7;
  for (const bool columns : {true, false}) compare(columns, repetitions, rank, ranks);
  MPI_Finalize();
}
