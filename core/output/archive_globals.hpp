#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/output/archive.hpp"
#include "core/output/archive_files.hpp"

namespace tushar::output {

/// The `.dat` files of an archive. append() returns after the system has received the line, so that a killed run loses
/// no line.
class GlobalFiles {
 public:
  explicit GlobalFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The file name of a global quantity.
  static std::string nameOf(const std::string& global);
  /// Adds a line to the file of a global quantity; the first sample of a quantity replaces an old file. Returns whether
  /// this sample was the first.
  bool append(const GlobalSample& sample);
  /// Continues the files of these global quantities, without the lines after `time` [s]. Returns a sentence for each
  /// file that lacks earlier lines.
  std::vector<std::string> resume(const std::vector<std::string>& globals, double time);
  /// Waits until all lines are on the disk.
  void sync() const;

 private:
  std::filesystem::path pathOf(const std::string& global) const { return folder_ / nameOf(global); }

  std::filesystem::path folder_;
  std::map<std::string, AppendFile> files_;  ///< the file of each global quantity, by name
  std::string line_;                         ///< memory for one line, reused for the next
};

}  // namespace tushar::output
