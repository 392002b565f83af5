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

/// Makes the folder `filebase.NNN`, where NNN is one above the largest existing number, with its parents. Returns its
/// path. FileError if it cannot be made, or if `filebase` itself exists and is not a link.
std::filesystem::path makeNextFolder(const std::filesystem::path& filebase);

/// Makes a folder and its parents, unless they exist. FileError if it cannot.
void makeFolder(const std::filesystem::path& folder);

/// Points the relative link `filebase` to `folder`, atomically.
void pointLink(const std::filesystem::path& filebase, const std::filesystem::path& folder);

/// Replaces the contents of the file by `text` atomically: a reader sees either the old text or the new. FileError if
/// it cannot.
void replaceFile(const std::filesystem::path& file, const std::string& text);

/// The same with the text that `write` puts into the stream.
void replaceFile(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// Like the first of these; the file is on the disk when it returns.
void replaceFileOnDisk(const std::filesystem::path& file, const std::string& text);

/// A file open for appending, without a buffer. Its functions throw FileError.
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
  /// `file` is its path, which exists only while the file is created.
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

/// Renames a finished temporary file to its final name. FileError if it cannot.
void moveInto(const std::filesystem::path& temporary, const std::filesystem::path& file);

/// Waits until a file, or the names in a folder, are on the disk. FileError if they cannot be.
void syncToDisk(const std::filesystem::path& path);

/// The contents of a file; nothing if it cannot be read.
std::optional<std::string> textOf(const std::filesystem::path& file);

/// The temporary path of a file until it is renamed.
std::filesystem::path temporaryOf(const std::filesystem::path& file);

/// A name that can be part of a path in the file system, HDF5 or XDMF: '/' and ':' become '_'.
std::string nameInPath(std::string name);

/// The name of a block's group: that of the material, or `material2` if it has no name.
std::string groupName(const std::string& material, int materialIndex);

/// `t00042`.
std::string stepName(int step);
/// `t00042.h5`.
std::string outputName(int step);
/// The step of `t00042`, or none if a name is not a stepName.
std::optional<int> stepOf(const std::string& name);

}  // namespace tushar::output
