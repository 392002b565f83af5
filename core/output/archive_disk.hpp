#pragma once

#include <cstdint>

namespace tushar::output {

/// The first failed write: the system's error number, or 0.
struct DiskFailure {
  int error = 0;
};

/// HDF5 file access properties (to be closed by H5Pclose) for plain files whose writes never report a failure to HDF5:
/// the first failure is recorded in `failure`, and later writes are dropped. This is necessary because HDF5 cannot
/// recover from a full disk: closing its files then crashes the program. `failure` must exist until the file is closed.
/// Returns a negative value on failure.
std::int64_t diskAccess(DiskFailure& failure);

}  // namespace tushar::output
