#pragma once

#include <filesystem>

namespace tushar::output {

/// Locks a folder for one process while the lock exists; the lock ends even if the process is killed. There is no lock
/// on a file system without locks. FileError if another process has the folder.
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
