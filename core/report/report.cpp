#include "core/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"

namespace tushar::report {

namespace {

using Json = nlohmann::ordered_json;

Json errorsOf(const Report& report) {
  Json errors = Json::object();
  for (const ErrorNorms& error : report.errors)
    for (const auto& [norm, value] : error.norms) errors[error.field][error.place][norm] = value;
  return errors;
}

bool isRefined(const Report& report) { return report.levels.size() > 1; }

Json wallOf(const Report& report) {
  Json tasks = Json::object();
  for (const TaskTime& task : report.tasks) tasks[task.name] = tasks.value(task.name, 0.0) + task.seconds;
  Json wall = {{"startup", report.wallStartup},
               {"loop", report.wallLoop},
               {"output", report.wallOutput},
               {"output_wait", report.wallOutputWait},
               {"exchange", report.exchange},
               {"tasks", tasks},
               {"use",
                {{"task", report.use.task},
                 {"message", report.use.message},
                 {"output", report.use.output},
                 {"wait", report.use.wait}}},
               {"imbalance", report.use.imbalance},
               {"rebalanced",
                {{"times", report.rebalancing.times},
                 {"step", report.rebalancing.step},
                 {"before", report.rebalancing.before},
                 {"after", report.rebalancing.after}}}};
  if (isRefined(report)) wall["regrid"] = report.wallRegrid;
  return wall;
}

Json memoryOf(const MemoryUse& use) {
  return {{"peak", use.peak},
          {"fields", use.fields},
          {"particles", use.particles},
          {"buffers", use.buffers},
          {"files", use.files}};
}

Json compressionOf(const Compression& use) {
  return {{"bytes", use.bytes},
          {"packed", use.packed},
          {"packing", use.packing},
          {"writing", use.writing},
          {"saved_bytes", use.bytes - use.packed},
          {"saved_seconds", use.savedSeconds()}};
}

Json limitsOf(const Report& report) {
  Json limits = Json::object();
  for (const auto& [limit, steps] : report.limits) limits[limit] = steps;
  return limits;
}

Json driftOf(const Report& report) {
  Json drift = Json::object();
  for (const Drift& d : report.drifts) drift[d.name] = d.change;
  return drift;
}

Json ofRun(const Report& report) {
  Json numbers = Json::object();
  for (const NumberOfRun& one : report.ofRun)
    numbers[one.key] = one.value.size() == 1 ? Json(one.value.front()) : Json(one.value);
  return numbers;
}

Json energiesOf(const Report& report) {
  const EnergyBudget& energies = report.energies;
  Json came = Json::object(), went = Json::object();
  for (const auto& [name, value] : energies.came) came[name] = value;
  for (const auto& [name, value] : energies.went) went[name] = value;
  return {{"came", came}, {"went", went}, {"unaccounted", energies.unaccounted()}, {"greatest", energies.greatest()}};
}

Json tasksOf(const Report& report) {
  Json leftOut = Json::array();
  for (const tasks::LeftOut& task : report.leftOut) leftOut.push_back({{"name", task.task}, {"why", task.reason}});
  return {{"kept", report.kept}, {"left_out", leftOut}};
}

std::string limitLine(const Report& report) {
  std::string text;
  for (const auto& [limit, steps] : report.limits)
    text += fmt::format("{}{} {}", text.empty() ? "time step limited by " : ", ", limit, steps);
  if (report.retries > 0) text += fmt::format("; {} repeated with a smaller one", report.retries);
  return text.empty() ? "" : text + "\n";
}

std::string errorTable(const Report& report) {
  std::string text;
  for (const std::string& why : report.unmeasured) text += fmt::format("\n  no errors: {}\n", why);
  if (report.errors.empty()) return text;
  text += fmt::format("\n  {:<24} {:>12} {:>12} {:>12}   unit\n", "error of", "L1", "L2", "max");
  for (const ErrorNorms& error : report.errors) {
    const auto norm = [&](const char* name) {
      const auto found = error.norms.find(name);
      return found == error.norms.end() ? std::string("-") : fmt::format("{:.5g}", found->second);
    };
    text += fmt::format("  {:<24} {:>12} {:>12} {:>12}   {}\n", error.field + ", " + error.place, norm("L1"),
                        norm("L2"), norm("max"), error.unit);
  }
  return text;
}

std::string driftTable(const Report& report) {
  if (report.drifts.empty()) return "";
  std::string text = fmt::format("\n  {:<24} {:>12} {:>12} {:>12}\n", "drift of", "start", "end", "change");
  for (const Drift& drift : report.drifts)
    text += fmt::format("  {:<24} {:>12.6g} {:>12.6g} {:>12.2e}   {}\n", drift.name, drift.start, drift.end,
                        drift.change, drift.relative ? "relative" : drift.unit);
  return text;
}

std::string tableOfRun(const Report& report) {
  if (report.ofRun.empty()) return "";
  std::string text = "\n  over the run\n";
  for (const NumberOfRun& one : report.ofRun) {
    std::string value;
    for (const double number : one.value) value += fmt::format("{}{:.6g}", value.empty() ? "" : ", ", number);
    text += fmt::format("  {:<36} {:>14}{}\n", one.text, value, one.unit == "1" ? "" : "   " + one.unit);
  }
  return text;
}

std::string energyTable(const Report& report) {
  const EnergyBudget& energies = report.energies;
  if (energies.came.empty()) return "";
  std::string text = fmt::format("\n  {:<36} {:>14}\n", "energy budget", "J");
  for (const auto& [name, value] : energies.came) text += fmt::format("  {:<36} {:>14.6g}\n", name, value);
  for (const auto& [name, value] : energies.went) text += fmt::format("  - {:<34} {:>14.6g}\n", name, value);
  return text + fmt::format("  {:<36} {:>14.2e}   {:.2e} of the largest term\n", "unaccounted", energies.unaccounted(),
                            energies.greatest() > 0 ? energies.unaccounted() / energies.greatest() : 0.0);
}

/// The fractions of the threads' time spent on each activity, during the time loop and its outputs.
std::string useLine(const Report& report) {
  const TimeUse& use = report.use;
  const double all = use.task + use.message + use.output + use.wait;
  if (all <= 0) return "";
  const std::string ranks = report.ranks > 1 ? fmt::format("{} ranks of ", report.ranks) : "";
  return fmt::format(
      "  {}{} thread{}: {:.1f} % in tasks, {:.1f} % messages, {:.1f} % output, {:.1f} % waiting; "
      "load imbalance {:.3f}\n",
      ranks, report.threads, report.threads == 1 ? "" : "s", 100 * use.task / all, 100 * use.message / all,
      100 * use.output / all, 100 * use.wait / all, use.imbalance);
}

/// The memory of all ranks [MB].
std::string memoryLine(const Report& report) {
  const MemoryUse& sum = report.memoryOfRanks.sum;
  if (sum.peak <= 0) return "";
  const std::string most =
      report.ranks > 1 ? fmt::format(" (at most {:.1f} on one rank)", 1e-6 * report.memoryOfRanks.most.peak) : "";
  return fmt::format(
      "  memory: peak {:.1f} MB{}; fields {:.1f}, particles {:.1f}, kept for later steps {:.1f}, outputs and "
      "checkpoints "
      "{:.1f}\n",
      1e-6 * sum.peak, most, 1e-6 * sum.fields, 1e-6 * sum.particles, 1e-6 * sum.buffers, 1e-6 * sum.files);
}

/// The cost of updating a cell on several levels, relative to the cost on a uniform grid, by the number of dimensions:
/// measured with `euler` in small blocks (ups/euler/README.md, "Several levels"), where it is 5 to 10 in one dimension,
/// 1.4 to 1.6 in two, and 1.5 to 1.6 in three.
double costOnLevels(int dimension) { return std::array{7.0, 1.6, 1.6}.at(std::clamp(dimension, 1, 3) - 1); }

/// The estimated cost of a uniform grid of the finest cells, and whether refinement has paid off.
std::string uniformLine(const Report& report) {
  if (report.updates <= 0 || report.uniformUpdates <= 0) return "";
  const double saved = report.uniformUpdates / report.updates;
  const double cost = costOnLevels(report.dimension);
  const std::string text =
      fmt::format("a uniform grid of the finest cells would need {:.4g} cell updates, {:.3g} times as many\n",
                  report.uniformUpdates, saved);
  if (saved > cost) return text;
  return text +
         fmt::format(
             "  it would probably be faster, because an update takes about {:g} times as long on several levels\n",
             cost);
}

/// The number of cell updates on each level, if finer levels take smaller steps.
std::string updatesLine(const Report& report) {
  std::string updates;
  for (const double one : report.levelUpdates) updates += fmt::format("{}{:.4g}", updates.empty() ? "" : " + ", one);
  return updates.empty() ? "" : fmt::format("  cell updates by level, each with its own time steps: {}\n", updates);
}

/// The number of cells of each level, and the cost of updating and regridding them.
std::string levelsLine(const Report& report) {
  if (!isRefined(report)) return "";
  std::string cells;
  for (const long count : report.levels) cells += fmt::format("{}{}", cells.empty() ? "" : " + ", count);
  return fmt::format("cells of {} levels: {}; {:.4g} cell updates, {}\n", report.levels.size(), cells, report.updates,
                     counted(report.regrids, "regrid")) +
         updatesLine(report) + uniformLine(report);
}

std::string rebalancingLine(const Report& report) {
  const Rebalancing& change = report.rebalancing;
  if (change.times == 0) return "";
  return fmt::format(
      "  patches changed ranks {} time{}, last after step {}: this reduced the load of the busiest rank from {:.2f} to "
      "{:.2f} times the mean load\n",
      change.times, change.times == 1 ? "" : "s", change.step, change.before, change.after);
}

std::string recutsLine(const Report& report) {
  if (report.recuts == 0) return "";
  return fmt::format("  the cuts between patches were moved {}, to share particles evenly\n",
                     counted(report.recuts, "time"));
}

std::string compressionLine(const Compression& use) {
  if (use.bytes <= 0) return "";
  return fmt::format(
      "  compression: from {:.4g} to {:.4g} MB; packing took {:.2f} ms in total on all ranks, and shortened writing by "
      "about {:.2f} ms\n",
      1e-6 * use.bytes, 1e-6 * use.packed, 1e3 * use.packing, 1e3 * (use.savedSeconds() + use.packing));
}

std::string timeTable(const Report& report) {
  std::string text = fmt::format("\n  {:<36} {:>10}\n", "wall time", "ms");
  const auto row = [&](const std::string& name, double seconds) {
    text += fmt::format("  {:<36} {:>10.2f}\n", name, 1e3 * seconds);
  };
  row("start-up", report.wallStartup);
  row("time loop", report.wallLoop);
  for (const TaskTime& task : report.tasks) row("  " + task.name, task.seconds);
  if (report.patches > 1) row("  ghost exchange", report.exchange);
  if (isRefined(report)) row("  regridding", report.wallRegrid);
  row("output", report.wallOutput);
  if (report.wallOutputWait > 0) row("  waiting for the previous output", report.wallOutputWait);
  return text + compressionLine(report.compression) + useLine(report) + memoryLine(report) + recutsLine(report) +
         rebalancingLine(report);
}

}  // namespace

double EnergyBudget::unaccounted() const {
  double rest = 0;
  for (const auto& term : came) rest += term.second;
  for (const auto& term : went) rest -= term.second;
  return rest;
}

double EnergyBudget::greatest() const {
  double most = 0;
  for (const auto* terms : {&came, &went})
    for (const auto& term : *terms) most = std::max(most, std::abs(term.second));
  return most;
}

std::string toJson(const Report& report) {
  Json json;
  json["scene"] = report.scene;
  json["title"] = report.title;
  json["component"] = report.component;
  json["version"] = report.version;
  json["build"] = report.build;
  json["layout"] = {{"dimension", report.dimension}, {"cells", report.cells}, {"h", report.spacing},
                    {"patches", report.patches},     {"ranks", report.ranks}, {"threads", report.threads}};
  if (report.recuts > 0) json["layout"]["recuts"] = report.recuts;
  if (isRefined(report)) {
    json["levels"] = report.levels;
    json["updates"] = report.updates;
    if (!report.levelUpdates.empty()) json["level_updates"] = report.levelUpdates;
    json["uniform_updates"] = report.uniformUpdates;
    json["regrids"] = report.regrids;
  }
  json["steps"] = report.steps;
  json["retries"] = report.retries;
  json["time_step_limits"] = limitsOf(report);
  json["time"] = report.time;
  json["ended"] = report.ended;
  json["failure"] = report.failure;
  json["particles"] = report.particles;
  json["particles_dropped"] = report.dropped;
  json["particles_removed"] = report.removed;
  json["particle_steps_per_second"] = report.wallLoop > 0 ? report.particleSteps / report.wallLoop : 0;
  json["memory"] = {{"resident", report.memory.now},
                    {"peak", report.memory.peak},
                    {"sum", memoryOf(report.memoryOfRanks.sum)},
                    {"most", memoryOf(report.memoryOfRanks.most)}};
  json["wall"] = wallOf(report);
  if (report.compression.bytes > 0) json["compression"] = compressionOf(report.compression);
  json["errors"] = errorsOf(report);
  json["unmeasured"] = report.unmeasured;
  json["drift"] = driftOf(report);
  if (!report.ofRun.empty()) json["of_run"] = ofRun(report);
  if (!report.energies.came.empty()) json["energies"] = energiesOf(report);
  json["tasks"] = tasksOf(report);
  json["archive"] = report.archive;
  json["unused_petsc_options"] = report.unusedOptions;
  json["fingerprint"] = report.fingerprint;
  if (!report.fingerprintOfOthers.empty()) json["fingerprint_of_others"] = report.fingerprintOfOthers;
  return json.dump(2) + "\n";
}

namespace {

/// The numbers of particles that a run has lost, in parentheses; empty if there are none.
std::string lossesOf(const Report& report) {
  std::string text;
  if (report.dropped > 0) text = fmt::format("{} left the grid", report.dropped);
  if (report.removed > 0)
    text += fmt::format("{}{} removed: turned inside out, deformed too much or thrown through a symmetry plane",
                        text.empty() ? "" : ", ", report.removed);
  return text.empty() ? "" : " (" + text + ")";
}

}  // namespace

std::string toText(const Report& report) {
  std::string text = fmt::format("{} to t = {:.6g} s ({}), {}", counted(report.steps, "step"), report.time,
                                 report.ended, counted(report.cells, "cell"));
  if (report.particles > 0 || report.dropped > 0 || report.removed > 0) {
    text += ", " + counted(report.particles, "particle") + lossesOf(report);
    if (report.wallLoop > 0)
      text += fmt::format(", {:.3g} million particle-steps/s", 1e-6 * report.particleSteps / report.wallLoop);
  }
  text += '\n';
  text += levelsLine(report) + limitLine(report) + errorTable(report) + driftTable(report) + tableOfRun(report) +
          energyTable(report) + timeTable(report);
  if (!report.archive.empty()) text += fmt::format("\n  saved in {}\n", report.archive);
  text += fmt::format("\n  fingerprint {}\n", report.fingerprint);
  if (!report.fingerprintOfOthers.empty())
    text += fmt::format("  fingerprint {} of other saved variables\n", report.fingerprintOfOthers);
  return text;
}

}  // namespace tushar::report
