#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/threads.hpp"
#include "core/grid/choose_patches.hpp"
#include "core/simulation/settings.hpp"

namespace tushar {

/// What the command line asks for.
struct Arguments {
  std::string scene, describe, graph, petsc, trace, schema, completion, paths;
  std::vector<std::string> overrides;
  bool check = false, list = false, restart = false, schedule = false, version = false;
  bool asksForJson = false;                  ///< -json was given; its file may be missing
  std::optional<int> checkpoint;             ///< step of the one to restart from
  std::optional<double> checkpointInterval;  ///< wall time between checkpoints, s
  std::optional<int> dryRun;
  grid::Workers workers{allowedThreads(), true, 1, {}};
  simulation::RunOptions run;

  /// Whether the command line only asks what sus can do.
  bool isQuestion() const {
    return version || list || !(describe.empty() && schema.empty() && completion.empty() && paths.empty());
  }
  /// Whether the problems of a scene that is only checked go to the screen as JSON, and nothing else does.
  bool showsJson() const { return check && asksForJson && (run.jsonPath.empty() || run.jsonPath == "-"); }
};

/// Declares all options of sus; `arguments` must outlive `app`.
void declare(CLI::App& app, Arguments& arguments);

/// The words as CLI11 takes them, the last first; what follows -petsc is PETSc's and stays as it is.
std::vector<std::string> backwards(const std::vector<std::string>& given);

/// Names of all options that are shown, with two dashes.
std::vector<std::string> optionNames(const CLI::App& app);

/// Says which words of the command line mean nothing: the options, as they were written, or else a second scene.
void reportUnknown(const CLI::App& app, const std::vector<std::string>& words, const std::string& scene);

/// Seconds in `30s`, `10min` or `2h`; none for any other text.
std::optional<double> parseDuration(const std::string& text);

}  // namespace tushar
