#pragma once

#include <filesystem>

namespace tushar::output {

/// Locks a folder for one process as long as this object exists; the lock also ends if the process is killed. A file
/// system that does not support locks leaves the folder unlocked. Throws FileError if another process has locked the
/// folder.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace tushar::output
