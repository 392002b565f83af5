#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/output/archive_hdf5_input.hpp"
#include "core/output/checkpoint_manifest.hpp"

namespace tushar::output {

/// A dataset that is read in parts as they are needed. Its functions may throw FileError.
class Hdf5Parts {
 public:
  /// `file` and `checks` must outlive this object. If `checks` is given, all ranks read together.
  Hdf5Parts(const Hdf5Input& file, std::string name, CheckedParts* checks = nullptr);

  /// The type of the values in the dataset, without values.
  const Array::Values& type() const { return type_; }
  /// Number of values in the dataset: the product of its extents.
  std::size_t count() const { return count_; }

  /// A range of numbers of the dataset, in the order of the file, and its destination in memory.
  struct Part {
    std::size_t first, count;
    std::byte* to;
    /// Number of values at the end that also belong to another part or rank, which adds them to the checksum.
    std::size_t others = 0;
  };
  /// Reads parts in any order; contiguous parts are read together, and numbers that belong to several parts are read
  /// once. Throws DamageError if the numbers that the ranks have read are not those that were written.
  void read(std::vector<Part> parts) const;

 private:
  void readWhole(const std::vector<Part>& parts) const;
  void readOnce(const std::vector<Part>& parts) const;
  void readRuns(const std::vector<Part>& parts) const;
  void readRun(int descriptor, const Part* first, const Part* last) const;

  const Hdf5Input* file_;
  CheckedParts* checks_;
  std::string name_;
  Array::Values type_;
  std::size_t count_ = 0, bytes_ = 0;  ///< number of values, and size of a value [bytes]
  /// Offset of the values in the file [bytes]; negative if the layout differs from the layout in memory.
  std::int64_t offset_ = -1;
};

}  // namespace tushar::output
