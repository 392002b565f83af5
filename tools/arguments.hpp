#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "core/grid/choose_patches.hpp"
#include "core/simulation/settings.hpp"

namespace tushar {

/// The options and names on the command line.
struct Arguments {
  std::string scene, describe, graph, petsc, trace, schema, completion, paths;
  std::vector<std::string> overrides,
      words;                             ///< values of --set; all words of the command line, with the program name
  std::vector<std::string> modules;      ///< module files given by the user (--load)
  std::vector<std::string> optionNames;  ///< names of all documented options, with two dashes
  bool check = false, list = false, restart = false, schedule = false, version = false;
  bool asksForJson = false;                  ///< whether --json was given; its file name may be missing
  std::optional<int> checkpoint;             ///< step of the checkpoint from which to restart
  std::optional<double> checkpointInterval;  ///< wall time between checkpoints [s]
  std::optional<int> dryRun;
  grid::Workers workers{allowedThreads(), true, 1, {}};
  simulation::RunOptions run;

  /// Whether the command line only requests information about sus.
  bool isQuestion() const {
    return version || list || !(describe.empty() && schema.empty() && completion.empty() && paths.empty());
  }
  /// Whether sus prints nothing but the list of problems of a scene that it checks, as JSON.
  bool showsJson() const { return check && asksForJson && (run.jsonPath.empty() || run.jsonPath == "-"); }
};

/// Parses the words of the command line into `arguments`. Returns an exit code if the program ends here because the
/// words request help or are invalid. In that case, rank 0 has printed the message.
std::optional<ExitCode> parse(const std::vector<std::string>& words, Arguments& arguments);

/// Parses a duration such as `30s`, `10min` or `2h` and returns it in seconds; none for any other text.
std::optional<double> parseDuration(const std::string& text);

}  // namespace tushar
