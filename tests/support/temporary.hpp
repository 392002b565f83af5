#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace tushar::test {

/// A folder for this test process alone, ending in `/`; removed when the process ends. Tests run concurrently.
inline const std::string& temporaryFolder() {
  struct Folder {
    std::string path;
    Folder() {
      path = (std::filesystem::temp_directory_path() / ("tushar-test-" + std::to_string(getpid()))).string() + "/";
      std::filesystem::create_directories(path);
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

/// Creates a new folder in the temporary folder.
inline std::filesystem::path newFolder(const std::string& name) {
  const std::filesystem::path folder = temporaryFolder() + name;
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace tushar::test
