#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace tushar::test {

/// A folder of this test process alone, `/` at its end; removed when the process ends. Tests run side by side.
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

/// A new folder in it.
inline std::filesystem::path newFolder(const std::string& name) {
  const std::filesystem::path folder = temporaryFolder() + name;
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace tushar::test
