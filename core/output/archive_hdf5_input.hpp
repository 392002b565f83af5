#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/output/snapshot.hpp"

namespace tushar::output {

/// Reads one HDF5 file that Hdf5File wrote. It needs no MPI and never starts it. Each function may throw FileError with
/// the path and HDF5's innermost reason.
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
  /// The offset in the file at which a group or dataset begins; later ones have larger offsets.
  std::uint64_t placeOf(const std::string& name) const;
  /// Names in a group, sorted; none if there is no such group.
  std::vector<std::string> names(const std::string& group) const;
  /// The values of a dataset of any shape, as they were written.
  Array::Values dataset(const std::string& name) const;
  /// The place of a dataset in the file.
  struct Placed {
    Array::Values type;        ///< no values, but their type
    std::size_t count = 0;     ///< number of values, for any shape
    std::int64_t offset = -1;  ///< of the first value; -1 if the layout differs from that in memory
  };
  Placed placed(const std::string& name) const;
  /// A dataset that Hdf5File::text wrote.
  std::string text(const std::string& name) const;

  /// An attribute of a group; `/` is the root.
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
