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
  /// `file` and `checks` must outlive it. With `checks`, all ranks read together.
  Hdf5Parts(const Hdf5Input& file, std::string name, CheckedParts* checks = nullptr);

  /// No values, but the type of those in the dataset.
  const Array::Values& type() const { return type_; }
  /// Number of values in the dataset, for any shape.
  std::size_t count() const { return count_; }

  /// Numbers of the dataset, in the order of the file, and their destination in memory.
  struct Part {
    std::size_t first, count;
    std::byte* to;
    std::size_t others = 0;  ///< values at its end that another part or rank also has, and adds to the sum
  };
  /// Reads parts in any order; contiguous ones are read together, and numbers that several have are read once.
  /// DamageError where the numbers that all ranks read are not those that were written.
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
  std::size_t count_ = 0, bytes_ = 0;  ///< of a number
  std::int64_t offset_ = -1;           ///< in the file; negative if the layout differs from that in memory
};

}  // namespace tushar::output
