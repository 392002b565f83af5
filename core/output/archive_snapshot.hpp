#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/output/archive.hpp"
#include "core/output/archive_hdf5_chunks.hpp"
#include "core/output/behind.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

class FileInFlight;

/// A snapshot that is being written to an HDF5 file, which has a temporary name until it is complete. The constructor
/// copies the values, and `behind` then writes them to the file. All ranks construct one, each with its own values. The
/// constructor and finish() throw FileError on a rank that cannot write, and FailedElsewhere on the others; no file is
/// left then.
class SnapshotInFlight {
 public:
  /// `writers` and `behind` must outlive this object.
  SnapshotInFlight(std::filesystem::path file, const Snapshot& snapshot, const ArchiveOptions& options,
                   const Writers& writers, Behind& behind);
  ~SnapshotInFlight();
  SnapshotInFlight(SnapshotInFlight&&) noexcept;
  /// Waits until the file is complete, and renames it to its final name. Collective on `ranks`: the ranks of the
  /// writers, or rank 0 alone if it is the only writer.
  void finish(const mpi::Communicator& ranks);
  /// Time and size of compression on this rank, once the file is finished.
  PackingUse packing() const;
  /// Removes the incomplete file.
  void abandon();

 private:
  std::filesystem::path path_;
  std::unique_ptr<FileInFlight> file_;
};

/// Writes a snapshot, and waits until it is complete.
void writeSnapshot(const std::filesystem::path& file, const Snapshot& snapshot, const ArchiveOptions& options);

/// Total size, on all ranks, of the values of a snapshot that have sources.
std::uint64_t bytesInFlight(const Snapshot& snapshot);

/// A copy of a snapshot that keeps the numbers of values, but not the values.
Snapshot withoutValues(Snapshot snapshot);

/// A source for an array whose values have been moved or are stored elsewhere: it provides only their number.
std::shared_ptr<const Source> valuesElsewhere(std::size_t entries);

/// The path of a particle array in the HDF5 file: `/particles/gas/p.density`.
std::string pathInFile(const ParticleBlock& block, const Array& array);

/// The path of a field in the HDF5 file: `/cells/c.temperature` or `/nodes/gas/g.mass`.
std::string pathInFile(const FieldBlock& field);

/// Whether an array is part of the file; a variable that does not exist at this time has no values.
bool isHeld(const ParticleBlock& block, const Array& array);

/// Number of entries of a field along z, y, x; on a grid with boxes, which has no nodes, the total number.
std::vector<std::uint64_t> fieldShape(const GridInfo& grid, Centring centring);

/// Number of cells of a box along z, y, x.
std::vector<std::uint64_t> boxShape(const GridBox& box);

/// Number of entries of an array with this shape.
std::uint64_t volumeOf(const std::vector<std::uint64_t>& shape);

/// Cell widths of a level [m].
Vec3 spacingOf(const GridInfo& grid, int level);

/// The axes that the scene uses (0: x, 1: y, 2: z).
std::vector<int> axesInUse(const GridInfo& grid);

}  // namespace tushar::output
