#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/output/snapshot.hpp"

namespace tushar::output {

/// Makes the folder `filebase.NNN`, where NNN is one above the largest existing number, and its parents. Returns its
/// path. Throws FileError if it cannot be made, or if `filebase` itself exists and is not a link.
std::filesystem::path makeNextFolder(const std::filesystem::path& filebase);

/// Makes a folder and its parents, unless they exist. Throws FileError on failure.
void makeFolder(const std::filesystem::path& folder);

/// Points the relative link `filebase` to `folder`, atomically.
void pointLink(const std::filesystem::path& filebase, const std::filesystem::path& folder);

/// Replaces the contents of the file by `text` atomically: a reader sees either the old text or the new one. Throws
/// FileError on failure.
void replaceFile(const std::filesystem::path& file, const std::string& text);

/// Replaces the contents of the file by the text that `write` puts into the stream, atomically.
void replaceFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// Like replaceFile with a text, but returns only when the file is on the disk.
void replaceFileOnDisk(const std::filesystem::path& file, const std::string& text);

/// A file opened for appending, without a buffer. Its functions throw FileError.
class AppendFile {
 public:
  /// Opens the file, or creates it.
  explicit AppendFile(std::filesystem::path file);
  AppendFile(AppendFile&& other) noexcept
      : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}
  ~AppendFile();
  /// Appends text, which is not lost even if the process is killed afterwards.
  void append(std::string_view text);
  /// Waits until all text is on the disk.
  void sync() const;

 private:
  std::filesystem::path path_;
  int descriptor_;
};

/// Bytes that are stored on the disk instead of in memory, in an unnamed file that vanishes with the process. Its
/// functions throw FileError.
class Scratch {
 public:
  /// `file` is a path that exists only while the unnamed file is being created.
  explicit Scratch(std::filesystem::path file) : path_(std::move(file)) {}
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  /// Stores bytes; returns their position.
  std::uint64_t append(std::span<const std::byte> bytes);
  /// Reads the bytes at a position.
  void read(std::uint64_t first, std::span<std::byte> to) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Renames a finished temporary file to its final name. Throws FileError on failure.
void moveInto(const std::filesystem::path& temporary, const std::filesystem::path& file);

/// Waits until a file, or the names in a folder, are on the disk. Throws FileError on failure.
void syncToDisk(const std::filesystem::path& path);

/// The contents of a file; none if it cannot be read.
std::optional<std::string> textOf(const std::filesystem::path& file);

/// The temporary path of a file, used until it is complete and renamed.
std::filesystem::path temporaryOf(const std::filesystem::path& file);

/// A name made suitable for paths in the file system, HDF5 or XDMF: '/' and ':' become '_'.
std::string nameInPath(std::string name);

/// The name of the group of a block: the material's name, or `material2` if it has none.
std::string groupName(const std::string& material, int materialIndex);

/// The name of an output step, such as `t00042`.
std::string stepName(int step);
/// The file name of an output, such as `t00042.h5`.
std::string outputName(int step);
/// The step number in a name such as `t00042`; none if the name has another form.
std::optional<int> stepOf(const std::string& name);

}  // namespace tushar::output
