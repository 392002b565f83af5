#pragma once

#include <cstdint>

namespace tushar::output {

/// The first failed write: the system's error number, or 0.
struct DiskFailure {
  int error = 0;
};

/// HDF5 file access properties (to be closed by H5Pclose) for plain files whose writes never report a failure to HDF5:
/// the first failure is recorded in `failure`, and later writes are dropped. HDF5 cannot unwind from a full disk: its
/// files then crash the program when they are closed. `failure` must live until the file is closed. Negative if it
/// cannot be made.
std::int64_t diskAccess(DiskFailure& failure);

}  // namespace tushar::output
