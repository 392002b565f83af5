#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/input/refuse.hpp"
#include "core/input/schema.hpp"
#include "core/input/values.hpp"
#include "core/scene/scene.hpp"

namespace tushar::scene {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::ArchiveSettings;
using simulation::CheckpointSettings;
using simulation::SaveRequest;
using simulation::TimeSettings;

namespace {

constexpr double unlimited = TimeSettings::unlimited;

constexpr const char* afterRestart =
    "does nothing: a restart continues with the step that the run would have taken; sus --restart --set "
    "Time/delt_max=… makes its steps shorter";

void noteRestartStep(TimeSettings&, const Element& element, Diagnostics& diagnostics) {
  const auto given = element.child("override_restart_delt");
  if (given && input::parse<double>(given->text()).value != 0.0) diagnostics.note(*given, afterRestart);
}

const Schema<TimeSettings>& timeSchema() {
  static const Schema<TimeSettings> schema =
      Schema<TimeSettings>("Time", "When a run starts and ends, and how long its steps are.")
          .required("maxTime", &TimeSettings::maxTime, "s", "time at which the run ends", input::positive())
          .value("initTime", &TimeSettings::initTime, 0, "s", "time at which the run starts")
          .value("delt_min", &TimeSettings::deltMin, 0, "s", "smallest time step", input::nonNegative())
          .value("delt_max", &TimeSettings::deltMax, unlimited, "s", "largest time step; 0 means no limit",
                 input::nonNegative())
          .value("delt_init", &TimeSettings::deltInit, unlimited, "s", "upper limit of the first time step",
                 input::positive())
          .value("max_delt_increase", &TimeSettings::maxDeltIncrease, unlimited, "1",
                 "largest relative growth of the time step from one step to the next; 0 or less means no limit")
          .value("timestep_multiplier", &TimeSettings::timestepMultiplier, 1, "1",
                 "factor by which the stable time step is multiplied", input::positive())
          .value("max_Timesteps", &TimeSettings::maxTimesteps, std::numeric_limits<int>::max(), "1",
                 "number of steps after which the run ends", input::positive())
          .value("max_wall_time", &TimeSettings::maxWallTime, unlimited, "s",
                 "wall time after which the run writes its output and ends", input::positive())
          .value("end_at_max_time_exactly", &TimeSettings::endAtMaxTimeExactly, false, "1",
                 "whether the last step is shortened so that it ends at maxTime")
          .value("clamp_time_to_output", &TimeSettings::clampTimeToOutput, false, "1",
                 "whether steps are shortened so that outputs are at multiples of outputInterval")
          .value("recompute_timestep", &TimeSettings::recomputeTimeStep, false, "1",
                 "if a value becomes unphysical, undo the step and repeat it with half the time step, up to 20 times")
          .ours()
          .value("initial_delt_range", &TimeSettings::initialDeltRange, 0, "s",
                 "time until which delt_init limits the steps; it always limits the first", input::nonNegative())
          .custom("override_restart_delt", noteRestartStep, {"override_restart_delt"}, afterRestart)
          .forms({input::anyForm({"override_restart_delt"})})
          .check([](const TimeSettings& time, const Element& element, Diagnostics& diagnostics) {
            if (time.maxTime <= time.initTime)
              diagnostics.error(element, "maxTime is not after initTime; nothing would be computed");
            if (time.deltMax > 0 && time.deltMin > time.deltMax)
              diagnostics.error(element, "delt_min is greater than delt_max");
          });
  return schema;
}

const Schema<SaveRequest>& saveSchema() {
  static const Schema<SaveRequest> schema =
      Schema<SaveRequest>("save", "A variable to be saved.")
          .requiredAttribute("label", &SaveRequest::label, "1", "its name, such as p.x or KineticEnergy")
          .attributeValue("material", &SaveRequest::material, "", "1", "save the variable for this material only")
          .ignoredAttribute("levels", "all levels are saved")
          .ignoredAttribute("compression", "<compression> in <DataArchiver> applies to all variables")
          .ignoredAttribute("table_lookup", "belongs to components that read tables")
          .location(&SaveRequest::where, "label")
          .location(&SaveRequest::whereOfMaterial, "material")
          .check([](const SaveRequest&, const Element& given, Diagnostics& diagnostics) {
            if (given.attribute("levels") == "-1") return;  // all of them
            input::noteAttribute(given, "levels", "all levels are saved", diagnostics);
          });
  return schema;
}

/// Whether `one` requests everything that `other` requests.
bool covers(const SaveRequest& one, const SaveRequest& other) {
  return one.label == other.label && (one.material.empty() || one.material == other.material);
}

/// Removes save requests that are included in another one.
void takeOutRepeated(std::vector<SaveRequest>& saves, const std::vector<Element>& tags, Diagnostics& diagnostics) {
  if (saves.size() != tags.size()) return;
  std::vector<SaveRequest> kept;
  for (std::size_t k = 0; k < saves.size(); ++k) {
    std::size_t other = 0;
    while (other < saves.size() &&
           (other == k || !covers(saves[other], saves[k]) || (other > k && covers(saves[k], saves[other]))))
      ++other;
    if (other == saves.size())
      kept.push_back(saves[k]);
    else
      diagnostics.note(tags[k],
                       fmt::format("does nothing: '{}' is saved by {}", saves[k].label, saves[other].where.text()));
  }
  saves = std::move(kept);
}

void checkCheckpointIntervals(const CheckpointSettings& checkpoint, const Element& element, Diagnostics& diagnostics) {
  const int given = checkpoint.interval.has_value() + checkpoint.timestepInterval.has_value() +
                    checkpoint.walltimeInterval.has_value() + checkpoint.walltimeIntervalHours.has_value();
  if (given != 1)
    diagnostics.error(
        element,
        fmt::format(
            "gives {} of interval, timestepInterval, walltimeInterval and walltimeIntervalHours; give exactly one",
            given == 0 ? "none" : "more than one"));
  else if (checkpoint.walltimeStart && !checkpoint.walltimeInterval)
    diagnostics.error(element, "gives walltimeStart without walltimeInterval");
  else if (checkpoint.walltimeStartHours && !checkpoint.walltimeIntervalHours)
    diagnostics.error(element, "gives walltimeStartHours without walltimeIntervalHours");
}

const Schema<CheckpointSettings>& checkpointSchema() {
  using Settings = CheckpointSettings;
  static const Schema<Settings> schema =
      Schema<Settings>("checkpoint",
                       "The whole state, from which sus --restart continues. It is saved at the start, at one of "
                       "these intervals, and at the end.")
          .attributeValue("cycle", &Settings::cycle, 2, "1", "number of checkpoints to keep", input::atLeast(1))
          .optionalAttribute("interval", &Settings::interval, "s", "simulated time between checkpoints",
                             input::positive())
          .optionalAttribute("timestepInterval", &Settings::timestepInterval, "1",
                             "steps between checkpoints; 0: only at the start and the end", input::nonNegative())
          .optionalAttribute("walltimeInterval", &Settings::walltimeInterval, "s", "wall time between checkpoints",
                             input::positive())
          .optionalAttribute("walltimeStart", &Settings::walltimeStart, "s",
                             "wall time of the first checkpoint; walltimeInterval by default", input::positive())
          .optionalAttribute("walltimeIntervalHours", &Settings::walltimeIntervalHours, "h",
                             "wall time between checkpoints", input::positive())
          .optionalAttribute("walltimeStartHours", &Settings::walltimeStartHours, "h",
                             "wall time of the first checkpoint; walltimeIntervalHours by default", input::positive())
          .ignoredAttribute("lastTimestep", "the last state is always kept")
          .check(checkCheckpointIntervals);
  return schema;
}

/// Reads the compression of the archive: a level, or one of Uintah's words.
void readCompression(ArchiveSettings& archive, const Element& element, Diagnostics& diagnostics) {
  const auto given = element.child("compression");
  if (!given) return;
  const std::string word = given->text();
  const auto level = input::parse<int>(word);
  if (word.find("gzip") != std::string::npos)
    archive.compression = 1;
  else if (word == "none" || word == "rle" || word == "tryall")
    archive.compression = 0;
  else if (!level.problem.empty() || !input::satisfies(*level.value, input::between(0, 9)))
    diagnostics.error(*given, "found '" + word + "', expected an integer from 0 to 9, gzip, none, rle or tryall");
  else
    archive.compression = *level.value;
}

/// The name of the folder; if an absolute path is given, as in some of Uintah's scenes, only its last part.
std::string nameOf(const std::string& filebase) {
  return filebase.starts_with('/') ? std::filesystem::path(filebase).filename().string() : filebase;
}

const Schema<ArchiveSettings>& archiveSchema() {
  static const Schema<ArchiveSettings> schema =
      Schema<ArchiveSettings>("DataArchiver", "What is saved, where and how often.")
          .required("filebase", &ArchiveSettings::filebase, "1",
                    "name of the folder, such as sod.uda; if it is an absolute path, only the last part is used")
          .value("outputInterval", &ArchiveSettings::outputInterval, 0, "s", "time between outputs",
                 input::nonNegative())
          .value("outputTimestepInterval", &ArchiveSettings::outputTimestepInterval, 0, "1", "steps between outputs",
                 input::nonNegative())
          .flag("outputInitTimestep", &ArchiveSettings::outputInitTimestep,
                "whether to save the state at the start, too")
          .flag("outputLastTimestep", &ArchiveSettings::outputLastTimestep, "whether to save the state at the end, too")
          .flag("outputDoubleAsFloat", &ArchiveSettings::doubleAsFloat,
                "whether to save real numbers with 7 digits only")
          .custom("compression", readCompression, {"compression"},
                  "gzip level, from 0 (none, the default) to 9; gzip means 1; none, rle and tryall mean 0")
          .forms({input::patternForm({"compression"}, R"(.*gzip.*|none|rle|tryall|\+?0*[0-9](\.0*)?)")})
          .ignoredAttribute("type", "there is only one kind of archive: HDF5 with an index for ParaView")
          .ignored("save_crack_geometry", "there are no cracks")
          .ignored("PIDX", "there is only one kind of archive: HDF5 with an index for ParaView")
          .list("save", &ArchiveSettings::saves, saveSchema(), "a variable to be saved")
          .section("checkpoint", &ArchiveSettings::checkpoint, checkpointSchema())
          .check([](const ArchiveSettings& archive, const Element& element, Diagnostics& diagnostics) {
            if (archive.outputInterval > 0 && archive.outputTimestepInterval > 0)
              diagnostics.error(element, "gives both outputInterval and outputTimestepInterval; keep one");
            const std::string name = nameOf(archive.filebase);
            if (name.empty() || name.find('/') != std::string::npos || name == "." || name == "..")
              diagnostics.error(
                  *element.child("filebase"),
                  "found '" + archive.filebase + "', expected the name of a folder inside the current one");
          });
  return schema;
}

}  // namespace

TimeSettings readTime(const Element& section, Diagnostics& diagnostics) {
  return timeSchema().read(section, diagnostics);
}
ArchiveSettings readArchive(const Element& section, Diagnostics& diagnostics) {
  ArchiveSettings archive = archiveSchema().read(section, diagnostics);
  const std::string name = nameOf(archive.filebase);
  if (name != archive.filebase)
    diagnostics.note(
        *section.child("filebase"),
        fmt::format("the folder is called '{}'; sus creates it in the current folder, or in that of --output", name));
  archive.filebase = name;
  takeOutRepeated(archive.saves, section.children("save"), diagnostics);
  return archive;
}
void checkInterval(double interval, const TimeSettings& time, const Element& element, const std::string& what,
                   Diagnostics& diagnostics) {
  const double least = simulation::timeResolution * std::max(std::abs(time.initTime), std::abs(time.maxTime));
  if (interval > 0 && interval <= least)
    diagnostics.error(
        element,
        fmt::format("{}found {:g} s, expected more than {:g} s, which is the resolution of times up to maxTime", what,
                    interval, least));
}
void describeTime(std::ostream& out) { timeSchema().describe(out); }
const input::SchemaBase& timeForm() { return timeSchema(); }
const input::SchemaBase& archiveForm() { return archiveSchema(); }
void describeArchive(std::ostream& out) { archiveSchema().describe(out); }

}  // namespace tushar::scene
