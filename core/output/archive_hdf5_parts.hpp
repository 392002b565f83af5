#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/output/archive_hdf5_input.hpp"

namespace tushar::output {

/// A dataset that is read in parts when they are needed, without the rest in memory. Its functions may throw FileError.
class Hdf5Parts {
 public:
  /// `file` must outlive it.
  Hdf5Parts(const Hdf5Input& file, std::string name);

  /// No values, of the type that the dataset has.
  const Array::Values& type() const { return type_; }
  /// Its number of values, whatever the shape.
  std::size_t count() const { return count_; }

  /// Numbers of the dataset, in the order of the file, and the memory that they go to.
  struct Part {
    std::size_t first, count;
    std::byte* to;
  };
  /// Reads parts in any order; contiguous ones are read together.
  void read(std::vector<Part> parts) const;

 private:
  void readWhole(const std::vector<Part>& parts) const;
  void readRun(int descriptor, const Part* first, const Part* last) const;

  const Hdf5Input* file_;
  std::string name_;
  Array::Values type_;
  std::size_t count_ = 0, bytes_ = 0;  ///< of a number
  std::int64_t offset_ = -1;           ///< in the file; negative where their layout differs from that in memory
};

}  // namespace tushar::output
