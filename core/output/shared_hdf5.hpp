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

/// The storage of numbers in a file.
struct Storage {
  bool doubleAsFloat = false;  ///< keep 4 of the 8 bytes of each real number
  int compression = 0;         ///< gzip level, 0 (none) to 9
  bool describes = true;       ///< give each dataset the attributes unit and description
};

/// An HDF5 file that ranks write together: rank 0 creates it, calls `header` for contents that only it has, and writes
/// the datasets whose values are in memory; all ranks contribute the values of datasets that have a source. No byte
/// depends on the number of ranks and writers, or on steps taken meanwhile: the constructor takes the values over, and
/// `behind` brings them to the file. Collective: all have the same datasets. Both functions throw FileError on a rank
/// that cannot write, and FailedElsewhere on the others; the caller then removes the incomplete file.
class FileInFlight {
 public:
  /// `writers` and `behind` must outlive it.
  FileInFlight(const Writers& writers, Behind& behind, const std::filesystem::path& file, const Storage& how,
               const std::function<void(Hdf5File&)>& header, const std::vector<Dataset>& datasets);
  ~FileInFlight();
  FileInFlight(const FileInFlight&) = delete;
  FileInFlight& operator=(const FileInFlight&) = delete;

  /// Waits until the file is complete, and closes it. Collective on `ranks`: those of the writers, or the first alone
  /// where it is the only writer.
  void finish(const mpi::Communicator& ranks);
  /// The offsets in the file of the values of datasets with a source; none if they are compressed.
  const std::vector<ByteRange>& places() const { return places_; }
  /// Time and bytes of compression on this rank, once the file is complete.
  PackingUse packing() const;

 private:
  class Chunks;
  std::vector<ByteRange> places_;
  std::optional<SlabsInFlight> slabs_;
  std::unique_ptr<Chunks> chunks_;  ///< only for a compressed file
};

/// Writes such a file at once. Returns FileInFlight::places(). Collective.
std::vector<ByteRange> writeTogether(const Writers& writers, const std::filesystem::path& file, const Storage& how,
                                     const std::function<void(Hdf5File&)>& header,
                                     const std::vector<Dataset>& datasets);

}  // namespace tushar::output
