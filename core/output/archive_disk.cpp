#include "core/output/archive_disk.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>
#if __has_include(<H5FDdevelop.h>)
#include <H5FDdevelop.h>
#endif

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

namespace tushar::output {

namespace {

/// The contents of the access properties, used by open().
struct Settings {
  DiskFailure* failure;
};

/// An open file; the first members are those of HDF5.
struct DiskFile : H5FD_t {
  int descriptor;
  haddr_t allocated;  ///< end of the space that HDF5 has allocated
  haddr_t size;
  DiskFailure* failure;

  void note() {
    if (failure->error == 0) failure->error = errno ? errno : EIO;
  }
};

DiskFile& of(H5FD_t* file) { return *static_cast<DiskFile*>(file); }
const DiskFile& of(const H5FD_t* file) { return *static_cast<const DiskFile*>(file); }

/// Opens a file. To find out whether the file exists, HDF5 first tries to open it without H5F_ACC_CREAT, which may
/// fail.
H5FD_t* open(const char* name, unsigned flags, hid_t access, haddr_t) {
  DiskFailure* failure = static_cast<const Settings*>(H5Pget_driver_info(access))->failure;
  const bool creates = (flags & H5F_ACC_CREAT) != 0;
  const int how = ((flags & H5F_ACC_RDWR) ? O_RDWR : O_RDONLY) | (creates ? O_CREAT : 0) |
                  ((flags & H5F_ACC_TRUNC) ? O_TRUNC : 0) | O_CLOEXEC;
  const int descriptor = ::open(name, how, 0666);
  if (descriptor < 0) {
    if (creates) failure->error = errno;
    return nullptr;
  }
  auto* file = new (std::nothrow) DiskFile{};
  if (!file) {
    ::close(descriptor);
    return nullptr;
  }
  file->descriptor = descriptor;
  file->size = static_cast<haddr_t>(std::max<off_t>(0, lseek(descriptor, 0, SEEK_END)));
  file->failure = failure;
  return file;
}

herr_t close(H5FD_t* base) {
  if (::close(of(base).descriptor) != 0) of(base).note();
  delete &of(base);
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated(const H5FD_t* base, H5FD_mem_t) { return of(base).allocated; }

herr_t setAllocated(H5FD_t* base, H5FD_mem_t, haddr_t address) {
  of(base).allocated = address;
  return 0;
}

haddr_t size(const H5FD_t* base, H5FD_mem_t) { return of(base).size; }

/// Reads bytes; bytes beyond the end of the file are 0.
herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t from, size_t count, void* buffer) {
  auto* to = static_cast<char*>(buffer);
  while (count > 0) {
    const ssize_t done = pread(of(base).descriptor, to, count, static_cast<off_t>(from));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) of(base).note();
    if (done <= 0) break;
    to += done;
    from += static_cast<haddr_t>(done);
    count -= static_cast<size_t>(done);
  }
  std::memset(to, 0, count);
  return 0;
}

/// Makes the system start to write a large part to the disk while the next part is prepared. Failures are detected when
/// the file is synchronised.
void startOnDisk(const DiskFile& file, haddr_t from, size_t count) {
  constexpr size_t large = size_t{1} << 18;
  if (count >= large)
    sync_file_range(file.descriptor, static_cast<off_t>(from), static_cast<off_t>(count), SYNC_FILE_RANGE_WRITE);
}

herr_t write(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t to, size_t count, const void* buffer) {
  DiskFile& file = of(base);
  const haddr_t first = to;
  const size_t all = count;
  const auto* from = static_cast<const char*>(buffer);
  file.size = std::max<haddr_t>(file.size, to + count);
  while (count > 0 && file.failure->error == 0) {
    const ssize_t done = pwrite(file.descriptor, from, count, static_cast<off_t>(to));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) {
      file.note();
      break;
    }
    from += done;
    to += static_cast<haddr_t>(done);
    count -= static_cast<size_t>(done);
  }
  startOnDisk(file, first, all);
  return 0;
}

herr_t truncate(H5FD_t* base, hid_t, hbool_t) {
  DiskFile& file = of(base);
  if (file.size == file.allocated) return 0;
  if (ftruncate(file.descriptor, static_cast<off_t>(file.allocated)) != 0) file.note();
  file.size = file.allocated;
  return 0;
}

/// Sets the version and the number of the driver, which HDF5 requires since 1.14.
template <class Class>
void setVersion(Class& driver) {
  if constexpr (requires { driver.version; }) {
    driver.version = 1;
    driver.value = static_cast<decltype(driver.value)>(300);
  }
}

H5FD_class_t makeDriver() {
  H5FD_class_t driver{};
  setVersion(driver);
  driver.name = "tushar_disk";
  driver.maxaddr = static_cast<haddr_t>(INT64_MAX);
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(Settings);
  driver.open = open;
  driver.close = close;
  driver.query = query;
  driver.get_eoa = allocated;
  driver.set_eoa = setAllocated;
  driver.get_eof = size;
  driver.read = read;
  driver.write = write;
  driver.truncate = truncate;
  const H5FD_mem_t lists[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
  std::copy(lists, lists + H5FD_MEM_NTYPES, driver.fl_map);
  return driver;
}

}  // namespace

std::int64_t diskAccess(DiskFailure& failure) {
  static const H5FD_class_t driver = makeDriver();
  static const hid_t number = H5FDregister(&driver);  // HDF5 uses the class beyond the last file's end
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  const Settings settings{&failure};
  const bool made = number >= 0 && access >= 0 && H5Pset_driver(access, number, &settings) >= 0;
  if (!made && access >= 0) H5Pclose(access);
  return made ? access : -1;
}

}  // namespace tushar::output
