#include "tools/arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "core/base/error.hpp"
#include "core/base/launcher.hpp"
#include "core/input/values.hpp"
#include "tools/messages.hpp"

namespace tushar {

namespace {

void complain(const std::string& sentence) { fmt::print(stderr, "sus: {}\n", withNumber(sentence)); }

/// Adds a dash to Uintah's options: -validate becomes --validate. Options of a single letter are unchanged.
std::string withTwoDashes(const std::string& word) {
  const bool oneDash = word.size() > 2 && word[0] == '-' && word[1] != '-' && std::isalpha(word[1]);
  return oneDash ? "-" + word : word;
}

void setThreads(int count, grid::Workers& workers) {
  workers.threads = count;
  workers.mayBeFewer = false;
}

void setLayout(const std::string& text, grid::Workers& workers) {
  workers.layout = grid::parseLayout(text);
  if (!workers.layout)
    throw CLI::ValidationError(fmt::format(
        "--layout: found '{}', expected AxBxC, the numbers of patches along x, y and z, such as 4x2x1", text));
}

double checkpointInterval(const std::string& text) {
  const std::optional<double> seconds = parseDuration(text);
  if (!seconds)
    throw CLI::ValidationError(fmt::format("--checkpoint: found '{}', expected a time such as 30s, 10min or 2h", text));
  return *seconds;
}

/// Names of all documented options, with two dashes.
std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The words in the order that CLI11 expects, the last one first. The word after --petsc is not changed.
std::vector<std::string> backwards(const std::vector<std::string>& given) {
  std::vector<std::string> words;
  for (const std::string& word : given)
    words.push_back(!words.empty() && words.back() == "--petsc" ? word : withTwoDashes(word));
  std::reverse(words.begin(), words.end());
  return words;
}

/// Reports invalid words of the command line: unknown options, in the form that the user wrote, or a second scene.
void reportUnknown(const CLI::App& app, const std::vector<std::string>& words, const std::string& scene) {
  const std::vector<std::string> unknown = app.remaining(), names = optionNames(app);
  bool options = false;
  for (const std::string& word : words) {
    const std::string full = withTwoDashes(word);
    if (full[0] != '-' || std::find(unknown.begin(), unknown.end(), full) == unknown.end()) continue;
    complain(fmt::format("unknown option '{}'{}; sus -h lists the options", word, didYouMean(full, names)));
    options = true;
  }
  if (!options) complain(fmt::format("only one scene can be run: found '{}' after '{}'", unknown.front(), scene));
}

/// Declares the options for patches, threads, and ranks that write.
void declareWorkers(CLI::App& app, Arguments& arguments) {
  app.add_option_function<std::string>(
      "--layout", [&](const std::string& text) { setLayout(text, arguments.workers); },
      "patches along x, y, z, instead of those of the scene: AxBxC, such as 4x2x1; on several levels, the largest "
      "number of blocks in a patch");
  app.add_option_function<int>(
         "--nthreads", [&](int count) { setThreads(count, arguments.workers); },
         "number of threads; by default one per available core, fewer for a small grid")
      ->check(CLI::Range(1, 1024));
  app.add_option("--writers", arguments.run.writers,
                 "number of ranks that write outputs and checkpoints; by default one on each node. The files do not "
                 "depend on it")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--behind", arguments.run.behind,
                 "largest part of an output, in MB, that a writer may keep in memory while the run continues; by "
                 "default the average share of a rank, at least 16. 0: the run waits until the output is written")
      ->check(CLI::Range(0, 1'000'000));
}

/// Declares all options of sus; `arguments` must outlive `app`.
void declare(CLI::App& app, Arguments& arguments) {
  app.footer(
      "Exit codes: 0 done, 1 failure (files, memory, a bug in sus), 2 bad command line, 3 bad scene,\n"
      "            4 a value became unphysical during the run, 5 interrupted (output written)");
  app.add_option("scene", arguments.scene, "the scene to run (.ups), or with --restart the folder of a run (.uda)");
  CLI::Option* restart = app.add_flag("--restart", arguments.restart,
                                      "continue a run in its .uda folder, from the last intact checkpoint");
  app.add_option("-t", arguments.checkpoint,
                 "with --restart: continue from the checkpoint of this step; later ones are removed")
      ->needs(restart);
  app.add_option("--set", arguments.overrides,
                 "override a value of the scene: PATH=VALUE, e.g.\n"
                 "Grid/Level/Box/resolution=[200,1,1]; may be repeated")
      ->allow_extra_args(false);
  declareWorkers(app, arguments);
  app.add_option("--trace", arguments.trace,
                 "record what each thread does and when, in a file for ui.perfetto.dev or chrome://tracing");
  app.add_option(
         "--json", arguments.run.jsonPath,
         "write the report to a file, as JSON; with --check: write the problems of the scene, by default to the screen")
      ->expected(0, 1);
  app.add_option_function<std::string>(
      "--checkpoint", [&](const std::string& text) { arguments.checkpointInterval = checkpointInterval(text); },
      "write a checkpoint at this interval of wall time, such as 30s, 10min or 2h, in addition to those of the scene");
  app.add_option("--load", arguments.modules, "load a module of your own: a shared library; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--output", arguments.run.outputFolder, "create the .uda folder in this folder");
  app.add_option("--petsc", arguments.petsc,
                 "options for PETSc, as one quoted argument: --petsc \"-ksp_monitor -ksp_type gmres\"");
  app.add_flag("--quiet", arguments.run.quiet, "print neither progress nor report on the screen");
  app.add_flag("--check,--validate", arguments.check,
               "check the scene and compute its initial state, without running or writing anything");
  app.add_option("--dry-run", arguments.dryRun,
                 "compile the tasks of one of N ranks and print their cost, without a run")
      ->check(CLI::Range(1, 10'000'000));
  app.add_flag("--schedule", arguments.schedule,
               "print the tasks in order, what they read and write, and which are left out");
  app.add_option("--graph", arguments.graph, "write the tasks of a step to a file, for Graphviz (dot)");
  app.add_flag("--list", arguments.list, "list components, analysis modules and shapes");
  app.add_option("--describe", arguments.describe, "the manual of a component, a module, or 'scene'");
  app.add_option("--schema", arguments.schema, "print a schema of all scenes for editors: rng (RELAX NG) or xsd")
      ->check(CLI::IsMember({"rng", "xsd"}));
  app.add_option("--completion", arguments.completion,
                 "print a script that lets a shell complete the arguments of sus: source <(sus --completion bash)")
      ->check(CLI::IsMember({"bash"}));
  app.add_option("--paths", arguments.paths, "print the paths of a scene that --set may change")->group("");
  app.add_flag("-V,--version", arguments.version, "version, commit, compiler and libraries");
}

/// Describes the problem with the command line in a sentence; words by CLI11 follow `the command line is wrong`.
std::string sentenceOf(const CLI::App* app, const CLI::Error& error) {
  const std::string text = CLI::FailureMessage::simple(app, error);
  const std::size_t line = text.find('\n');
  const std::string first = text.substr(0, line), ours = withNumber(first);
  const std::string sentence = ours == first ? withNumber("sus: the command line is wrong: " + first) : ours;
  return sentence + (line == std::string::npos ? "" : text.substr(line));
}

/// Handles `--check --json SCENE`: if no other word is the scene, the word after --json is the scene rather than a
/// file.
void settleJson(const CLI::App& app, Arguments& arguments) {
  arguments.asksForJson = app.count("--json") > 0;
  if (arguments.check && arguments.scene.empty()) std::swap(arguments.scene, arguments.run.jsonPath);
}

}  // namespace

std::optional<double> parseDuration(const std::string& text) {
  for (const auto& [unit, seconds] : {std::pair{"min", 60.0}, std::pair{"h", 3600.0}, std::pair{"s", 1.0}}) {
    if (!text.ends_with(unit)) continue;
    const auto count = input::parse<double>(text.substr(0, text.size() - std::string_view(unit).size()));
    if (count && *count > 0) return *count * seconds;
  }
  return {};
}

std::optional<ExitCode> parse(const std::vector<std::string>& words, Arguments& arguments) {
  CLI::App app("sus: runs a scene (.ups) with the component that it names", "sus");
  declare(app, arguments);
  app.failure_message(sentenceOf);
  arguments.optionNames = optionNames(app);
  try {
    app.parse(backwards(words));
    settleJson(app, arguments);
    return {};
  } catch (const CLI::ExtrasError&) {
    if (launchedRank() == 0) reportUnknown(app, words, arguments.scene);
    return ExitCode::badCommandLine;
  } catch (const CLI::ParseError& error) {
    if (launchedRank() == 0) app.exit(error);
    return error.get_exit_code() == 0 ? ExitCode::success : ExitCode::badCommandLine;
  }
}

}  // namespace tushar
