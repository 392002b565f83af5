#include "tools/program.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/interrupt.hpp"
#include "core/base/launcher.hpp"
#include "core/base/mpi.hpp"
#include "core/base/threads.hpp"
#include "core/base/trace.hpp"
#include "core/input/geometry.hpp"
#include "core/scene/dry_run.hpp"
#include "core/scene/find_restart.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "core/solvers/solver.hpp"

namespace tushar {

namespace {

struct Arguments {
  std::string scene, describe, graph, petsc, trace;
  std::vector<std::string> overrides;
  bool check = false, list = false, restart = false, schedule = false, version = false;
  std::optional<int> checkpoint;  ///< step of the one to restart from
  std::optional<int> dryRun;
  grid::Workers workers{allowedThreads(), true, 1, {}};
  simulation::RunOptions run;
};

/// When the process started: now, less the processor time that it has used.
std::chrono::steady_clock::time_point processStart() {
  const double used = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::steady_clock::now() -
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(used));
}

/// Uintah's words begin with one dash: -validate becomes --validate. Single letters stay.
std::string withTwoDashes(const std::string& word) {
  const bool oneDash = word.size() > 2 && word[0] == '-' && word[1] != '-' && std::isalpha(word[1]);
  return oneDash ? "-" + word : word;
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The words as CLI11 takes them, the last first; what follows -petsc is PETSc's and stays as it is.
std::vector<std::string> backwards(const std::vector<std::string>& given) {
  std::vector<std::string> words;
  for (const std::string& word : given)
    words.push_back(!words.empty() && words.back() == "--petsc" ? word : withTwoDashes(word));
  std::reverse(words.begin(), words.end());
  return words;
}

/// Says which words of the command line mean nothing: the options, as they were written, or else a second scene.
void reportUnknown(const CLI::App& app, const std::vector<std::string>& words, const std::string& scene) {
  const std::vector<std::string> unknown = app.remaining(), names = optionNames(app);
  bool options = false;
  for (const std::string& word : words) {
    const std::string full = withTwoDashes(word);
    if (full[0] != '-' || std::find(unknown.begin(), unknown.end(), full) == unknown.end()) continue;
    fmt::print(stderr, "sus: unknown option '{}'{}; sus -h lists the options\n", word, didYouMean(full, names));
    options = true;
  }
  if (!options) fmt::print(stderr, "sus: runs one scene at a time: found '{}' after '{}'\n", unknown.front(), scene);
}

void setThreads(int count, grid::Workers& workers) {
  workers.threads = count;
  workers.mayBeFewer = false;
}

void setLayout(const std::string& text, grid::Workers& workers) {
  workers.layout = grid::parseLayout(text);
  if (!workers.layout)
    throw CLI::ValidationError(
        fmt::format("--layout: found '{}', expected AxBxC, the patches along x, y and z, such as 4x2x1", text));
}

void declare(CLI::App& app, Arguments& arguments) {
  app.footer(
      "Exit codes: 0 done, 1 failure (files, memory, a defect of sus), 2 bad command line, 3 bad scene,\n"
      "            4 a value became impossible during the run, 5 interrupted (output written)");
  app.add_option("scene", arguments.scene, "the scene to run (.ups), or with --restart the folder of a run (.uda)");
  CLI::Option* restart = app.add_flag("--restart", arguments.restart,
                                      "go on with the run of a .uda, in that folder, from its last whole checkpoint");
  app.add_option("-t", arguments.checkpoint, "with --restart: from the checkpoint of this step; later ones are removed")
      ->needs(restart);
  app.add_option("--set", arguments.overrides,
                 "override a value of the scene: PATH=VALUE, e.g.\n"
                 "Grid/Level/Box/resolution=[200,1,1]; may be repeated")
      ->allow_extra_args(false);
  app.add_option_function<std::string>(
      "--layout", [&](const std::string& text) { setLayout(text, arguments.workers); },
      "patches along x, y, z, in place of those of the scene: AxBxC, such as 4x2x1");
  app.add_option_function<int>(
         "--nthreads", [&](int count) { setThreads(count, arguments.workers); },
         "threads to run on; without it as many as there are cores for and as pay")
      ->check(CLI::Range(1, 1024));
  app.add_option("--trace", arguments.trace,
                 "write what each thread did when to a file, for ui.perfetto.dev or chrome://tracing");
  app.add_option("--json", arguments.run.jsonPath, "write the report to a file, as JSON");
  app.add_option("--output", arguments.run.outputFolder, "put the .uda into this folder");
  app.add_option("--petsc", arguments.petsc, "options for PETSc, in one word: -petsc \"-ksp_monitor -ksp_type gmres\"");
  app.add_flag("--quiet", arguments.run.quiet, "no progress, no report on the screen");
  app.add_flag("--check,--validate", arguments.check, "check the scene and make its start; run and write nothing");
  app.add_option("--dry-run", arguments.dryRun,
                 "compile what one of so many ranks would do, and say what that takes; run nothing")
      ->check(CLI::Range(1, 10'000'000));
  app.add_flag("--schedule", arguments.schedule,
               "print the tasks in order, what they read and write, what is left out");
  app.add_option("--graph", arguments.graph, "write the tasks of a step to a file, for Graphviz (dot)");
  app.add_flag("--list", arguments.list, "list components, analysis modules and shapes");
  app.add_option("--describe", arguments.describe, "the manual of a component, a module, or 'scene'");
  app.add_flag("-V,--version", arguments.version, "version");
}

void printList(const simulation::Catalogue& known) {
  fmt::print("components (SimulationComponent type=)\n");
  for (const auto& kind : known.components) fmt::print("  {:<16} {}\n", kind.name, kind.sentence);
  fmt::print("analysis modules (DataAnalysis/Module name=)\n");
  for (const auto& kind : known.analyses) fmt::print("  {:<16} {}\n", kind.name, kind.sentence);
  fmt::print("shapes (geom_object)\n");
  for (const std::string& name : input::geometryNames()) fmt::print("  {}\n", name);
}

ExitCode describe(const std::string& name, const simulation::Catalogue& known) {
  if (name == "scene") {
    scene::describeSharedSections(std::cout);
  } else if (const auto* component = findKind(known.components, name)) {
    component->describe(std::cout);
  } else if (const auto* analysis = findKind(known.analyses, name)) {
    analysis->describe(std::cout);
  } else {
    std::vector<std::string> names = namesOf(known.components);
    for (const std::string& other : namesOf(known.analyses)) names.push_back(other);
    names.emplace_back("scene");
    fmt::print(stderr, "sus: nothing is called '{}'{}; there are {}\n", name, didYouMean(name, names),
               alternatives(names));
    return ExitCode::badCommandLine;
  }
  return ExitCode::success;
}

void writeFile(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text) || !file.flush()) throw FileError(fmt::format("{}: cannot be written", path));
}

/// Throws FileError now rather than after a long run; leaves no file behind.
void checkWritable(const std::string& path) {
  const bool existed = std::filesystem::exists(path);
  if (!std::ofstream(path, std::ios::app)) throw FileError(fmt::format("{}: cannot be written", path));
  if (!existed) std::filesystem::remove(path);
}

/// Finds the checkpoint to go on from, and says what was found damaged on the way; the first rank does so for all.
simulation::Restart findRestart(const Arguments& arguments, const mpi::Communicator& ranks) {
  simulation::Restart restart;
  ranks.onFirst([&] { restart = scene::findRestart(arguments.scene, arguments.checkpoint); });
  for (const std::string& note : restart.notes) fmt::print(stderr, "sus: {}\n", note);
  if (!restart.notes.empty()) fmt::print(stderr, "sus: goes on from the checkpoint of step {}\n", restart.step);
  restart.archive = ranks.broadcast(restart.archive.string());
  restart.step = ranks.broadcast(restart.step);
  return restart;
}

simulation::Problem readProblem(const Arguments& arguments, const simulation::Catalogue& known,
                                const mpi::Communicator& ranks) {
  const grid::Share share{ranks.rank(), ranks.size()};
  const grid::Workers first = ranks.broadcast(arguments.workers);  // all ranks must choose the same patches
  const grid::Workers workers{first.threads, first.mayBeFewer, ranks.size(), first.layout};
  if (!arguments.restart) return scene::readScene(arguments.scene, arguments.overrides, known, workers, share);
  const simulation::Restart restart = findRestart(arguments, ranks);
  simulation::Problem problem = scene::readScene(restart.scene().string(), arguments.overrides, known, workers, share);
  problem.restart = restart;
  return problem;
}

/// The first rank writes what all have recorded.
void writeTrace(const std::string& path, const mpi::Communicator& ranks) {
  std::string all;
  for (const std::string& events : ranks.gather(trace::events(ranks.rank())))
    all += (all.empty() ? "" : ",\n") + events;
  ranks.onFirst([&] { writeFile(path, trace::fileOf(all)); });
}

/// `100 cells and 450 particles at the start`.
std::string sizeOf(simulation::Simulation& run, long particles) {
  const std::size_t cells = run.warehouse().level().cells().size();
  return fmt::format("{} cell{}", cells, cells == 1 ? "" : "s") +
         (particles > 0 ? fmt::format(" and {} particles at the start", particles) : "");
}

/// What is said of a scene without running it.
void inspect(const Arguments& arguments, simulation::Simulation& run, bool isFirst) {
  const long particles = arguments.check ? run.tryStart() : 0;
  if (!isFirst) return;
  if (!arguments.graph.empty()) {
    std::ostringstream dot;
    run.phases().printDot(dot);
    writeFile(arguments.graph, dot.str());
  }
  if (arguments.schedule) run.phases().printSchedule(std::cout);
  if (arguments.check) fmt::print("{}: fine, {}\n", arguments.scene, sizeOf(run, particles));
}

/// Options that a typing error may have made useless.
void noteUnused(const Arguments& arguments, const report::Report& report) {
  for (const std::string& option : report.unusedOptions)
    fmt::print(stderr, "note: PETSc: no solve has looked at the option {}\n", option);
  if (!arguments.petsc.empty() && !solvers::isLoaded())
    fmt::print(stderr, "note: -petsc: this run has not solved anything by PETSc\n");
}

ExitCode runScene(const Arguments& arguments, const simulation::Catalogue& known,
                  std::chrono::steady_clock::time_point startedAt, const mpi::Communicator& ranks) {
  simulation::Problem problem = readProblem(arguments, known, ranks);
  if (!arguments.run.quiet && ranks.isFirst())
    for (const InputProblem& note : problem.notes) fmt::print(stderr, "note: {}\n", note.text());
  simulation::Simulation run(std::move(problem), arguments.run, startedAt, ranks);
  if (arguments.check || arguments.schedule || !arguments.graph.empty()) {
    inspect(arguments, run, ranks.isFirst());
    return ExitCode::success;
  }
  const bool reports = !arguments.run.jsonPath.empty(), traces = !arguments.trace.empty();
  ranks.onFirst([&] {
    if (reports) checkWritable(arguments.run.jsonPath);
    if (traces) checkWritable(arguments.trace);
  });
  catchInterrupts();
  if (traces) trace::start();
  const report::Report report = run.run();
  if (traces) writeTrace(arguments.trace, ranks);
  if (reports) ranks.onFirst([&] { writeFile(arguments.run.jsonPath, toJson(report)); });
  if (ranks.isFirst()) noteUnused(arguments, report);
  if (!report.failure.empty()) throw NumericalError(report.failure, report.advice);
  if (!arguments.run.quiet && ranks.isFirst()) fmt::print("{}", toText(report));
  return report.ended == "interrupted" ? ExitCode::interrupted : ExitCode::success;
}

ExitCode refuse(const std::string& sentence) {
  if (launchedRank() == 0) fmt::print(stderr, "sus: {}\n", sentence);
  return ExitCode::badCommandLine;
}

/// `session` is opened where a scene is run.
ExitCode dispatch(const Arguments& arguments, const simulation::Catalogue& known,
                  std::chrono::steady_clock::time_point startedAt, std::optional<mpi::Session>& session) {
  const bool only = arguments.version || arguments.list || !arguments.describe.empty() || arguments.scene.empty();
  if (only && launchedRank() > 0) return ExitCode::success;  // the first says it
  if (arguments.version) {
    fmt::print("sus {} ({})\n", TUSHAR_VERSION, TUSHAR_BUILD_TYPE);
    return ExitCode::success;
  }
  if (arguments.list) {
    printList(known);
    return ExitCode::success;
  }
  if (!arguments.describe.empty()) return describe(arguments.describe, known);
  if (arguments.scene.empty()) {
    fmt::print(stderr,
               "sus: no scene given; sus scene.ups runs one, sus -restart x.uda goes on with one, sus -h lists "
               "the options\n");
    return ExitCode::badCommandLine;
  }
  if (!arguments.restart && std::filesystem::is_directory(arguments.scene + "/checkpoints"))
    return refuse(fmt::format("{0} is the folder of a run; sus -restart {0} goes on with it", arguments.scene));
  if (arguments.restart && !arguments.run.outputFolder.empty())
    return refuse("--output has no meaning with --restart: a run goes on in its own folder");
  if (arguments.dryRun) {
    const grid::Workers workers{arguments.workers.threads, true, *arguments.dryRun, arguments.workers.layout};
    if (launchedRank() == 0)
      fmt::print("{}", toText(scene::dryRun(arguments.scene, arguments.overrides, known, workers)));
    return ExitCode::success;
  }
  session.emplace();
  return runScene(arguments, known, startedAt, session->ranks());
}

/// A sentence for the user, and what the shell gets.
struct Failure {
  std::string text;
  ExitCode code = ExitCode::failure;
};

/// What went wrong; no text where another rank has it.
Failure failureOf(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    return {fmt::format("{}\n", error.what()), ExitCode::badInput};
  } catch (const NumericalError& error) {
    const std::string advice = error.advice().empty() ? "" : fmt::format("     try {}\n", error.advice());
    return {fmt::format("sus: {}\n{}", error.what(), advice), ExitCode::numerical};
  } catch (const mpi::FailedElsewhere&) {
    return {};
  } catch (const std::bad_alloc&) {
    return {"sus: not enough memory for this scene\n"};
  } catch (const std::exception& error) {
    return {fmt::format("sus: {}\n", error.what())};
  }
}

/// What a task takes for its work and gives back stays with the process for the next step: else the system clears the
/// same pages anew in every step.
void keepMemory() {
  constexpr int mebibyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);
  mallopt(M_TRIM_THRESHOLD, 256 * mebibyte);
}

/// Says once for all ranks what went wrong, and ends them.
int endWith(const Failure& failure, std::optional<mpi::Session>& session) {
  int code = static_cast<int>(failure.code);
  const bool speaks = !session || session->speaks(!failure.text.empty(), code);
  if (speaks) fmt::print(stderr, "{}", failure.text);
  if (session && !session->isAgreed()) {
    if (speaks) fmt::print(stderr, "     (rank {} of {})\n", session->ranks().rank(), session->ranks().size());
    std::fflush(stderr);
    session->abort(code);
  }
  return code;
}

}  // namespace

int runProgram(int count, char** words, const simulation::Catalogue& known) {
  keepMemory();
  const auto startedAt = processStart();
  const std::vector<std::string> given(words + 1, words + count);
  Arguments arguments;
  CLI::App app("sus: runs a scene (.ups) with the component that it names", "sus");
  declare(app, arguments);
  std::optional<mpi::Session> session;
  try {
    app.parse(backwards(given));
    if (!arguments.petsc.empty()) setenv("PETSC_OPTIONS", arguments.petsc.c_str(), 1);
    const ExitCode code = dispatch(arguments, known, startedAt, session);
    if (std::fflush(stdout) != 0 || !std::cout.flush()) throw FileError("standard output cannot be written");
    return static_cast<int>(code);
  } catch (const CLI::ExtrasError&) {
    if (launchedRank() == 0) reportUnknown(app, given, arguments.scene);
    return static_cast<int>(ExitCode::badCommandLine);
  } catch (const CLI::ParseError& error) {
    if (launchedRank() > 0) return error.get_exit_code() == 0 ? 0 : static_cast<int>(ExitCode::badCommandLine);
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::badCommandLine);
  } catch (...) {
    return endWith(failureOf(std::current_exception()), session);
  }
}

}  // namespace tushar
