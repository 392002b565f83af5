#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/output/archive_hdf5.hpp"
#include "core/output/snapshot.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// An array, its name in a file, and its shape there without the components.
struct Dataset {
  std::string name;
  Array array;
  std::vector<std::uint64_t> shape;
};

/// How a file keeps its numbers.
struct Storage {
  bool doubleAsFloat = false;  ///< 4 of the 8 bytes of each real number
  int compression = 0;         ///< gzip level, 0 (none) to 9
};

/// Writes an HDF5 file that ranks have together: the first makes it, has `header` write what is its alone, and writes
/// the datasets whose values are in memory; all bring the values of those that have a source. How many ranks and
/// writers there are changes no byte. Collective: all have the same datasets. Throws FileError on a rank that cannot
/// write, and FailedElsewhere on the others; what is there of the file then is the caller's to remove.
void writeTogether(const Writers& writers, const std::filesystem::path& file, const Storage& how,
                   const std::function<void(Hdf5File&)>& header, const std::vector<Dataset>& datasets);

}  // namespace tushar::output
