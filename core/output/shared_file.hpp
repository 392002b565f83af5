#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace tushar::output {

/// An existing file of which this process writes parts; other processes may write other parts at the same time. The
/// first failure is kept, and later writes are dropped, so that a process that fails still takes part in collective
/// operations.
class SharedFile {
 public:
  explicit SharedFile(std::filesystem::path path);
  ~SharedFile();
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// Writes bytes at an offset; `what` describes them in error messages.
  void write(std::uint64_t at, const std::byte* from, std::size_t count, const std::string& what);
  /// Throws FileError with `what`, the path and the system's reason if a write has failed.
  void close();

 private:
  void note(const std::string& what);

  std::filesystem::path path_;
  int descriptor_;
  std::string failure_;
};

}  // namespace tushar::output
