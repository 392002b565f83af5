#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tushar::output {

/// The program of a run, and how it was started.
struct RunRecord {
  std::string version, build, commit, compiler, flags;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version
  std::vector<std::string> command, overrides;                 ///< arguments of the command line; those of --set
  std::vector<std::string> hosts;                              ///< host names of the ranks, without repeats
  int ranks = 1, threads = 1;
  bool restarts = false;
  int step = 0;  ///< step from which it starts
};

/// `run.json` in the folder of an archive: the runs that wrote there, each start and restart, with dates (UTC). They
/// are here, not in outputs, so that equal results have equal bytes. A run without an end was killed.
class RunLog {
 public:
  /// The format of the archive, raised when an older sus would mistake a newer archive for a damaged one. 2: the
  /// manifests of checkpoints contain sums of parts of files. 3: they have a format of their own.
  static constexpr int format = 3;

  /// Why a file with this text must not be extended: a newer version has written it. Empty: it may be.
  static std::string refusalOf(const std::string& text);
  /// Adds a run that starts now. A file that cannot be read is moved to `run.json.damaged`. FileError if it cannot be
  /// written.
  RunLog(const std::filesystem::path& folder, const RunRecord& record);
  /// Adds `error` and exit code 1 as the end of a run that has none yet.
  ~RunLog();
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;

  /// Adds a library that the run has loaded since; end() writes it to the file.
  void addLibrary(const std::string& name, const std::string& version);
  /// Adds the end of the run: why it ended, after which step, and the exit code. It is lost if the disk is full.
  void end(const std::string& why, int step, int exitCode);

 private:
  std::filesystem::path file_;
  std::string runs_;  ///< the text of the file
  bool ended_ = false;
};

}  // namespace tushar::output
