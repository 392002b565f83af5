#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/output/snapshot.hpp"

namespace tushar::output {

/// Reads one HDF5 file written by Hdf5File. It needs no MPI and never starts MPI. Each function may throw FileError
/// with the path and HDF5's innermost reason.
class Hdf5Input {
 public:
  explicit Hdf5Input(std::filesystem::path path);
  ~Hdf5Input();
  Hdf5Input(const Hdf5Input&) = delete;
  Hdf5Input& operator=(const Hdf5Input&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Whether there is a group or dataset with this path.
  bool has(const std::string& name) const;
  /// Whether an existing path is a group.
  bool isGroup(const std::string& name) const;
  /// The offset in the file at which a group or dataset begins; offsets increase in the order of creation.
  std::uint64_t placeOf(const std::string& name) const;
  /// The names in a group, sorted; empty if there is no such group.
  std::vector<std::string> names(const std::string& group) const;
  /// The values of a dataset of any shape, in the order of the file.
  Array::Values dataset(const std::string& name) const;
  /// The location of a dataset in the file.
  struct Placed {
    Array::Values type;     ///< the type of the values, without values
    std::size_t count = 0;  ///< number of values: the product of the extents
    /// Offset of the first value in the file [bytes]; -1 if the layout differs from the layout in memory.
    std::int64_t offset = -1;
  };
  Placed placed(const std::string& name) const;
  /// A text written by Hdf5File::text.
  std::string text(const std::string& name) const;

  /// The value of an attribute of a group; `/` is the root group.
  double real(const std::string& object, const char* name) const;
  int integer(const std::string& object, const char* name) const;
  std::uint64_t count(const std::string& object, const char* name) const;
  std::string text(const std::string& object, const char* name) const;
  Vec3 vector(const std::string& object, const char* name) const;
  Index3 index(const std::string& object, const char* name) const;

 private:
  using Id = std::int64_t;  ///< HDF5's hid_t
  struct Dataset;
  template <class Result>
  Result checked(Result result, const std::string& what) const;
  void readAttribute(const std::string& object, const char* name, Id type, std::size_t numbers, void* data) const;

  std::filesystem::path path_;
  Id file_ = -1;
};

}  // namespace tushar::output
