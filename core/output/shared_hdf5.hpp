#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/output/archive_hdf5.hpp"
#include "core/output/archive_hdf5_chunks.hpp"
#include "core/output/slabs.hpp"
#include "core/output/snapshot.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// An array, its path in a file, and its shape without components.
struct Dataset {
  std::string name;
  Array array;
  std::vector<std::uint64_t> shape;
};

/// How numbers are stored in a file.
struct Storage {
  bool doubleAsFloat = false;  ///< store each real number in 4 instead of 8 bytes
  int compression = 0;         ///< gzip level, 0 (none) to 9
  bool describes = true;       ///< give each dataset the attributes unit and description
};

/// An HDF5 file that ranks write together: rank 0 creates it, calls `header` for contents that only rank 0 has, and
/// writes the datasets whose values are in memory; all ranks contribute the values of datasets that have a source. The
/// bytes do not depend on the number of ranks and writers, or on time steps made meanwhile: the constructor copies the
/// values, and `behind` writes them to the file. Collective: all ranks must pass the same datasets. The constructor and
/// finish() throw FileError on a rank that cannot write, and FailedElsewhere on the others; the caller then removes the
/// incomplete file.
class FileInFlight {
 public:
  /// `writers` and `behind` must outlive this object.
  FileInFlight(const Writers& writers, Behind& behind, const std::filesystem::path& file, const Storage& how,
               const std::function<void(Hdf5File&)>& header, const std::vector<Dataset>& datasets);
  ~FileInFlight();
  FileInFlight(const FileInFlight&) = delete;
  FileInFlight& operator=(const FileInFlight&) = delete;

  /// Waits until the file is complete, and closes it. Collective on `ranks`: the ranks of the writers, or rank 0 alone
  /// if it is the only writer.
  void finish(const mpi::Communicator& ranks);
  /// The byte ranges in the file of all datasets with a source; empty if the file is compressed.
  const std::vector<ByteRange>& places() const { return places_; }
  /// Time and size of compression on this rank, once the file is complete.
  PackingUse packing() const;

 private:
  class Chunks;
  std::vector<ByteRange> places_;
  std::optional<SlabsInFlight> slabs_;
  std::unique_ptr<Chunks> chunks_;  ///< chunks being compressed; null if the file is not compressed
};

/// Writes such a file and waits until it is complete. Returns FileInFlight::places(). Collective.
std::vector<ByteRange> writeTogether(const Writers& writers, const std::filesystem::path& file, const Storage& how,
                                     const std::function<void(Hdf5File&)>& header,
                                     const std::vector<Dataset>& datasets);

}  // namespace tushar::output
