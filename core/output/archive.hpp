#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/output/snapshot.hpp"

namespace tushar::output {

/// How numbers are stored in an archive.
struct ArchiveOptions {
  bool doubleAsFloat = false;  ///< store each real number in 4 instead of 8 bytes
  int compression = 0;         ///< gzip level, 0 (none) to 9
  std::string version{};       ///< version of the program that writes the archive
};

/// The values of a global quantity at one time.
struct GlobalSample {
  std::string name, unit, description;
  double time = 0;  ///< time [s]
  std::vector<double> values;
};

/// The extent of an archive at the time when a checkpoint was written.
struct ArchivePoint {
  int step = 0;
  double time = 0;    ///< time [s]
  std::string index;  ///< content of index.xml
};

/// The `.uda` folder of a run: the scene, an index, one HDF5 file per output, an XDMF file with which ParaView opens
/// them, and a text file per global quantity. One process writes it; other ranks help with the outputs. Any function
/// may throw FileError, which names the file and the system's reason.
///
///     sod.uda -> sod.uda.001      link to the newest run
///     sod.uda.001/input.xml       the scene
///                 index.xml       variables, globals and times
///                 sod.xdmf        for ParaView
///                 sod.vtkhdf, sod.gas.vtkhdf    the same for newer readers of VTK
///                 KineticEnergy.dat
///                 t00042.h5       /grid, /particles/<material>/<label>, /cells/…, /nodes/…, /reference/<column>
///
/// Files other than `.dat` are written under another name and then renamed, so that a killed run leaves no incomplete
/// files; lines of `.dat` files are passed to the system immediately. index.xml and the XDMF file list all outputs.
/// They may be out of date by a second or a twentieth of the run time, so that the cost of an output does not grow with
/// the number of outputs.
class Archive {
 public:
  /// Makes the folder `filebase.NNN`, where NNN is one above the largest existing number, and points the link
  /// `filebase` to it. Throws FileError if `filebase` exists and is not a link, or if nothing can be written there.
  Archive(const std::filesystem::path& filebase, const std::string& inputXml, const ArchiveOptions& options = {});
  /// Continues in the folder of another run from some point; later outputs and lines of `.dat` files are removed.
  /// `name` is the name of the filebase. If index.xml is damaged, it is replaced by the index of the point; entries
  /// missing in the XDMF file are read from the outputs.
  Archive(const std::filesystem::path& folder, const std::string& name, const ArchivePoint& from,
          const std::string& inputXml, const ArchiveOptions& options);
  /// Flushes; errors are ignored, so call flush() first to detect them.
  ~Archive();
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// Writes an output. If the step has been written before, the old output is replaced.
  void write(const Snapshot& snapshot);
  /// Adds to the index an output that the ranks have already written into the folder together.
  void list(const Snapshot& snapshot);
  /// Adds a line to `<name>.dat`.
  void appendGlobal(const GlobalSample& sample);
  /// Writes index.xml and the XDMF file if they have been out of date for long enough. Call it after each step.
  void keepUp();
  /// Writes index.xml and the XDMF file if they are out of date.
  void flush();
  /// Waits until the lines of globals are on the disk.
  void sync() const;
  /// The extent of the archive after a step. A checkpoint stores it, so that it can replace lists that are out of date
  /// or were destroyed by a power cut.
  ArchivePoint pointAt(int step, double time) const;

  /// The folder of this run, such as `sod.uda.001`.
  const std::filesystem::path& folder() const;
  /// Sentences about `.dat` files of the run that is continued which lack lines; new lines are added to them all the
  /// same.
  const std::vector<std::string>& damages() const;
  /// The step of the last write(); -1 before the first one.
  int lastStep() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tushar::output
