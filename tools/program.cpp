#include "tools/program.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
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
#include "core/base/trace.hpp"
#include "core/report/problems.hpp"
#include "core/scene/dry_run.hpp"
#include "core/scene/find_restart.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "core/solvers/solver.hpp"
#include "tools/arguments.hpp"
#include "tools/information.hpp"
#include "tools/messages.hpp"
#include "tools/version.hpp"

namespace tushar {

namespace {

/// The start time of the process, estimated as the current time minus the processor time used.
std::chrono::steady_clock::time_point processStart() {
  const double used = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::steady_clock::now() -
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(used));
}

void writeFile(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text) || !file.flush()) throw FileError(fmt::format("{}: cannot be written", path));
}

/// Throws FileError if a file cannot be written, so that this is not found only after a long run. Leaves no file
/// behind.
void checkWritable(const std::string& path) {
  const bool existed = std::filesystem::exists(path);
  if (!std::ofstream(path, std::ios::app)) throw FileError(fmt::format("{}: cannot be written", path));
  if (!existed) std::filesystem::remove(path);
}

void warn(const std::string& sentence) { fmt::print(stderr, "sus: {}\n", withNumber(sentence)); }

/// Finds the checkpoint from which the run continues. Rank 0 reports the damaged ones that it finds.
simulation::Restart findRestart(const Arguments& arguments, const mpi::Communicator& ranks) {
  const simulation::Restart restart = scene::findRestart(arguments.scene, arguments.checkpoint, ranks);
  if (!ranks.isFirst() || restart.notes.empty()) return restart;
  for (const std::string& note : restart.notes) warn(note);
  warn(simulation::continuesFrom(restart));
  return restart;
}

/// Adds the checkpoints requested on the command line. `name` gives the run a folder if the scene has no
/// <DataArchiver>.
void addCheckpoints(const Arguments& arguments, const std::filesystem::path& name,
                    simulation::ArchiveSettings& archive) {
  if (arguments.checkpointInterval) simulation::addWallTimeInterval(archive.checkpoint, *arguments.checkpointInterval);
  if (archive.filebase.empty()) archive.filebase = name.stem().string() + ".uda";
}

/// Adds notes on overrides that come too late for a run that is continued, or for a part of it.
void noteLateOverrides(const std::vector<std::string>& overrides, std::vector<InputProblem>& notes) {
  for (const std::string& override : overrides) {
    const std::string path = override.substr(0, override.find('='));
    const auto note = [&](std::string sentence) {
      notes.push_back({{"--set " + override, 0, 0}, "", std::move(sentence)});
    };
    if (path.starts_with("DataArchiver/filebase"))
      note("does not change anything: the run goes on in its folder");
    else if (path.find("/geom_object") != std::string::npos)
      note("does not change anything: the state of the run is that of its checkpoint");
    else if (path.starts_with("MaterialProperties/"))
      note("changes the laws of the materials, but not the masses and states of the checkpoint");
  }
}

simulation::Problem readProblem(const Arguments& arguments, const simulation::Catalogue& known,
                                const mpi::Communicator& ranks) {
  const grid::Share share{ranks.rank(), ranks.size()};
  const grid::Workers first = ranks.broadcast(arguments.workers);  // all ranks must choose the same patches
  const grid::Workers workers{first.threads, first.mayBeFewer, ranks.size(), first.layout};
  if (!arguments.restart) {
    simulation::Problem problem = scene::readScene(arguments.scene, arguments.overrides, known, workers, share);
    addCheckpoints(arguments, arguments.scene, problem.archive);
    return problem;
  }
  const simulation::Restart restart = findRestart(arguments, ranks);
  simulation::Problem problem = scene::readScene(restart.scene().string(), arguments.overrides, known, workers, share);
  problem.restart = restart;
  noteLateOverrides(arguments.overrides, problem.notes);
  addCheckpoints(arguments, restart.archive.stem(), problem.archive);
  return problem;
}

/// Writes the spans recorded on all ranks to a file, on rank 0.
void writeTrace(const std::string& path, const mpi::Communicator& ranks) {
  std::string all;
  for (const std::string& events : ranks.gather(trace::events(ranks.rank())))
    all += (all.empty() ? "" : ",\n") + events;
  ranks.onFirst([&] { writeFile(path, trace::fileOf(all)); });
}

/// The size of a run as text: `100 cells and 450 particles at the start`.
std::string sizeOf(simulation::Simulation& run, long particles) {
  const std::size_t cells = run.warehouse().grid().level().cells().size();
  return counted(static_cast<long>(cells), "cell") +
         (particles > 0 ? fmt::format(" and {} at the start", counted(particles, "particle")) : "");
}

/// Writes the problems of a scene that is only checked, as JSON: to the screen, or to the file given with --json.
void writeProblems(const Arguments& arguments, const std::vector<InputProblem>& problems) {
  const std::string text =
      report::toJson(problems, [](const InputProblem& problem) { return messageNumber(problem.text()); });
  if (arguments.showsJson())
    fmt::print("{}", text);
  else
    writeFile(arguments.run.jsonPath, text);
}

/// Prints what the command line requests about a scene, without running the scene.
void inspect(const Arguments& arguments, simulation::Simulation& run, bool isFirst) {
  const long particles = arguments.check ? run.tryStart() : 0;
  if (!isFirst) return;
  if (!arguments.graph.empty()) {
    std::ostringstream dot;
    run.phases().printDot(dot);
    writeFile(arguments.graph, dot.str());
  }
  if (arguments.schedule) run.phases().printSchedule(std::cout);
  if (!arguments.check) return;
  if (arguments.asksForJson) writeProblems(arguments, {});
  if (!arguments.showsJson()) fmt::print("{}: fine, {}\n", arguments.scene, sizeOf(run, particles));
}

/// Notes options that have had no effect, because they may be misspelt.
void noteUnused(const Arguments& arguments, const report::Report& report) {
  for (const std::string& option : report.unusedOptions)
    fmt::print(stderr, "note: {}\n", withNumber(fmt::format("PETSc: no solve has used the option {}", option)));
  if (!arguments.petsc.empty() && !solvers::isLoaded())
    fmt::print(stderr, "note: {}\n", withNumber("--petsc: this run has not used PETSc"));
}

output::RunRecord recordOf(const Arguments& arguments) {
  output::RunRecord record = buildRecord();
  record.command = arguments.words;
  record.overrides = arguments.overrides;
  return record;
}

ExitCode runScene(const Arguments& arguments, const simulation::Catalogue& known,
                  std::chrono::steady_clock::time_point startedAt, const mpi::Communicator& ranks) {
  simulation::Problem problem = readProblem(arguments, known, ranks);
  if (!arguments.run.quiet && !arguments.showsJson() && ranks.isFirst())
    for (const InputProblem& note : problem.notes) fmt::print(stderr, "note: {}\n", withNumber(note.text()));
  simulation::Simulation run(std::move(problem), arguments.run, startedAt, ranks);
  run.setWarning(warn);
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
  run.setRecord(recordOf(arguments));
  const report::Report report = run.run();
  if (traces) writeTrace(arguments.trace, ranks);
  if (reports) ranks.onFirst([&] { writeFile(arguments.run.jsonPath, toJson(report)); });
  if (ranks.isFirst()) noteUnused(arguments, report);
  if (!report.failure.empty()) throw NumericalError(report.failure, report.advice);
  if (!arguments.run.quiet && ranks.isFirst()) fmt::print("{}", toText(report));
  return simulation::exitCodeOf(report);
}

ExitCode refuse(const std::string& sentence) {
  if (launchedRank() == 0) fmt::print(stderr, "sus: {}\n", withNumber(sentence));
  return ExitCode::badCommandLine;
}

/// Does what the command line requests. Opens `session` if this is to run a scene.
ExitCode dispatch(const Arguments& arguments, const OpenCatalogue& open,
                  std::chrono::steady_clock::time_point startedAt, std::optional<mpi::Session>& session) {
  if ((arguments.isQuestion() || arguments.scene.empty()) && launchedRank() > 0)
    return ExitCode::success;  // rank 0 reports it
  if (arguments.isQuestion()) return answer(arguments, open(arguments.modules));
  if (arguments.scene.empty()) {
    return refuse(
        "no scene given; sus scene.ups runs one, sus --restart x.uda continues one, sus -h lists the options");
  }
  if (!arguments.restart && std::filesystem::is_directory(arguments.scene + "/checkpoints"))
    return refuse(fmt::format("{0} is the folder of a run; sus --restart {0} continues it", arguments.scene));
  if (arguments.asksForJson && !arguments.check && arguments.run.jsonPath.empty())
    return refuse("--json needs a file name for the report");
  if (arguments.check && arguments.asksForJson && !arguments.showsJson() && launchedRank() == 0)
    checkWritable(arguments.run.jsonPath);
  if (arguments.restart && !arguments.run.outputFolder.empty())
    return refuse("--output cannot be used with --restart: a run continues in its own folder");
  if (arguments.dryRun) {
    const grid::Workers workers{arguments.workers.threads, true, *arguments.dryRun, arguments.workers.layout};
    if (launchedRank() == 0)
      fmt::print("{}", toText(scene::dryRun(arguments.scene, arguments.overrides, open(arguments.modules), workers)));
    return ExitCode::success;
  }
  session.emplace();
  return runScene(arguments, open(arguments.modules), startedAt, session->ranks());
}

/// The message to the user about a failure, and the exit code.
struct Failure {
  std::string text;
  ExitCode code = ExitCode::failure;
  std::vector<InputProblem> problems;  ///< problems of the scene
};

/// Lists the first problems, and the number of further ones: a generated scene may have the same mistake in thousands
/// of materials.
std::string listOf(const std::vector<InputProblem>& problems) {
  constexpr std::size_t most = 100;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, problems.size()); ++k) text += withNumber(problems[k].text()) + '\n';
  if (problems.size() > most) text += fmt::format("and {} more\n", problems.size() - most);
  return text;
}

/// The message about a lack of memory, with what the process has taken and what the machine has.
std::string lackOfMemory() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const std::string sentence = fmt::format(
      "sus: not enough memory for this scene: it had {:.3g} GB, and the system refused more (the machine has {:.3g} "
      "GB); "
      "use fewer cells or particles, or more ranks on more machines",
      1024e-9 * static_cast<double>(used.ru_maxrss), 1e-9 * machine);
  return withNumber(sentence) + '\n';
}

/// The failure that an exception describes; its text is empty if another rank reports it.
Failure failureOf(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    return {listOf(error.problems()), ExitCode::badInput, error.problems()};
  } catch (const NumericalError& error) {
    const std::string advice = error.advice().empty() ? "" : fmt::format("     try {}\n", error.advice());
    return {fmt::format("sus: {}\n{}", withNumber(error.what()), advice), ExitCode::numerical, {}};
  } catch (const mpi::FailedElsewhere&) {
    return {};
  } catch (const std::bad_alloc&) {
    return {lackOfMemory(), ExitCode::failure, {}};
  } catch (const std::exception& error) {
    return {fmt::format("sus: {}\n", withNumber(error.what())), ExitCode::failure, {}};
  }
}

/// Keeps memory that tasks release in the process, for the next step. Otherwise, the system would clear the same pages
/// in every step.
void keepMemory() {
  constexpr int mebibyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);
  mallopt(M_TRIM_THRESHOLD, 256 * mebibyte);
}

/// Limits the number of memory arenas. The C library reserves 64 MB of address space for each thread that allocates
/// memory. The threads of MPI, and the one that writes outputs, would use almost none of it; where address space is
/// limited, the state would lack it.
void shareMemory(int threads) { mallopt(M_ARENA_MAX, threads); }

/// Reports a failure once for all ranks, and ends them.
int endWith(const Failure& failure, const Arguments& arguments, std::optional<mpi::Session>& session) {
  int code = static_cast<int>(failure.code);
  const bool speaks = !session || session->speaks(!failure.text.empty(), code);
  const bool isChecked = arguments.check && arguments.asksForJson && !failure.problems.empty();
  if (speaks && isChecked) writeProblems(arguments, failure.problems);
  if (speaks && !(isChecked && arguments.showsJson())) fmt::print(stderr, "{}", failure.text);
  if (session && !session->isAgreed()) {
    if (speaks) fmt::print(stderr, "     (rank {} of {})\n", session->ranks().rank(), session->ranks().size());
    std::fflush(stdout);
    std::fflush(stderr);
    session->abort(code);
  }
  return code;
}

}  // namespace

int runProgram(int count, char** words, const OpenCatalogue& open) {
  keepMemory();
  const auto startedAt = processStart();
  Arguments arguments;
  arguments.words.assign(words, words + count);
  std::optional<mpi::Session> session;
  try {
    if (const std::optional<ExitCode> code = parse({words + 1, words + count}, arguments))
      return static_cast<int>(*code);
    shareMemory(arguments.workers.threads);
    if (!arguments.petsc.empty()) setenv("PETSC_OPTIONS", arguments.petsc.c_str(), 1);
    const ExitCode code = dispatch(arguments, open, startedAt, session);
    if (std::fflush(stdout) != 0 || !std::cout.flush()) throw FileError("standard output cannot be written");
    return static_cast<int>(code);
  } catch (...) {
    return endWith(failureOf(std::current_exception()), arguments, session);
  }
}

}  // namespace tushar
