#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tushar::output {

/// The program that performs a run, and how it was started.
struct RunRecord {
  std::string version, build, commit, compiler, flags;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version of each library
  /// All arguments of the command line, and those of --set.
  std::vector<std::string> command, overrides;
  std::vector<std::string> hosts;  ///< host names of the ranks, without duplicates
  int ranks = 1, threads = 1;
  bool restarts = false;
  int step = 0;  ///< step from which the run starts
};

/// The file `run.json` in the folder of an archive: a list of the runs that wrote to the archive, with dates (UTC);
/// each start and each restart is an entry. Dates are not stored in outputs, so that the files of equal results are
/// bitwise equal. A run without an end was killed.
class RunLog {
 public:
  /// The format of the archive, raised when an older sus would otherwise report a newer archive as damaged. 2: the
  /// manifests of checkpoints contain sums of parts of files. 3: they have a format of their own.
  static constexpr int format = 3;

  /// The reason why a file with this text must not be extended (a newer version has written it); empty if it may be.
  static std::string refusalOf(const std::string& text);
  /// Adds a run that starts now. A file that cannot be read is moved to `run.json.damaged`. Throws FileError if the
  /// file cannot be written.
  RunLog(const std::filesystem::path& folder, const RunRecord& record);
  /// If the run has no end yet, records `error` and exit code 1.
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// Adds a library that the run has loaded in the meantime; end() writes it to the file.
  void addLibrary(const std::string& name, const std::string& version);
  /// Adds the end of the run: the reason, the last step, and the exit code. It is lost if the disk is full.
  void end(const std::string& why, int step, int exitCode);

 private:
  std::filesystem::path file_;
  std::string runs_;  ///< the text of the file
  bool ended_ = false;
};

}  // namespace tushar::output
