#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/input/schema.hpp"
#include "core/simulation/analysis.hpp"

// Shared by the modules that sample variables of cells and nodes at chosen times.

namespace tushar::analysis {

using output::Snapshot;
using simulation::Analysis;
using simulation::SaveRequest;

/// How values are weighted in a mean.
enum class Weighting { none, cells, weight };

/// A tag `<analyze label= matl=>`.
struct Analyzed {
  Location where, whereOfMaterial;
  std::string label, material;
  Weighting weighting = Weighting::none;
};

struct AnalyzedList {
  std::vector<Analyzed> list;
};

/// The sampling times of a module, from its tags.
struct Times {
  double frequency = 0, start = 0, stop = 0;  ///< sampling frequency [1/s], first and last time [s]
};

/// The tags of a module that samples variables.
struct Sampling : Times {
  std::string name;
  Location where;
  std::string material;  ///< material of variables without `matl`
  AnalyzedList variables;
};

const input::Schema<AnalyzedList>& analyzedSchema();
/// Like analyzedSchema, with the additional attribute `weighting`.
const input::Schema<AnalyzedList>& weightedSchema();
void checkTimes(const Times& times, const input::Element& module, input::Diagnostics& diagnostics);

/// Adds the tags for the sampling times.
template <class Settings>
void addTimes(input::Schema<Settings>& schema) {
  double Settings::*const frequency = &Times::frequency;
  double Settings::*const start = &Times::start;
  double Settings::*const stop = &Times::stop;
  schema
      .required("samplingFrequency", frequency, "1/s", "samples per second of simulated time; never more than steps",
                input::positive())
      .required("timeStart", start, "s", "no samples before this time")
      .required("timeStop", stop, "s", "no samples after this time")
      .check([](const Settings& read, const input::Element& module, input::Diagnostics& diagnostics) {
        checkTimes(read, module, diagnostics);
      });
}

/// The schema of a module that samples variables; the module adds its own tags to it.
template <class Settings>
input::Schema<Settings> samplingSchema(const std::string& name, const std::string& sentence,
                                       const input::Schema<AnalyzedList>& list = analyzedSchema()) {
  std::string Settings::*const called = &Sampling::name;
  std::string Settings::*const material = &Sampling::material;
  AnalyzedList Settings::*const variables = &Sampling::variables;
  Location Settings::*const where = &Sampling::where;
  input::Schema<Settings> schema("Module", sentence);
  schema.requiredAttribute("name", called, "1", name)
      .location(where)
      .value("material", material, "", "1", "name of the material of variables without matl; the first by default");
  addTimes(schema);
  return schema.requiredSection("Variables", variables, list, "the variables to sample");
}

/// Determines when samples are due: after the first step between `start` and `stop`, and then after each step that
/// passes a time start + k / frequency. The initial state is never sampled. Whether a sample is due depends only on the
/// times of the state and of the previous one, so a run that continues from a checkpoint takes the same samples.
class SampleTimes {
 public:
  SampleTimes(double frequency, double start, double stop) : frequency_(frequency), start_(start), stop_(stop) {}
  explicit SampleTimes(const Times& times) : SampleTimes(times.frequency, times.start, times.stop) {}

  /// Sets the time of the state, and the time since the start of the first run [s].
  void pass(double time, double sinceStart);
  bool isDue() const { return due_; }

 private:
  double frequency_, start_, stop_;
  double since_start_ = -1, count_ = -1;
  bool due_ = false;
};

/// The part of a file that remains valid if a run is repeated from a time [s] on: the comments, and the lines before
/// this time. `column` is the index of the column that contains the time. An incomplete last line, left by a killed
/// run, is dropped.
std::string linesBefore(const std::string& text, double time, int column = 0);

/// Text files to which each sample adds a line. If an earlier run has left such a file, the lines of the steps that
/// this run repeats are removed from it.
class SampleFiles {
 public:
  /// `column` is the index of the column that contains the time [s].
  explicit SampleFiles(int column = 0) : column_(column) {}
  /// Adds a line to a file. Throws FileError.
  void add(const std::filesystem::path& file, const std::string& header, const std::string& line, double time);

 private:
  int column_;
  std::set<std::string> begun_;
};

/// A module that samples variables.
class SamplingModule : public simulation::Analysis {
 public:
  explicit SamplingModule(const Sampling& sampling);

  void schedule(tasks::TaskList&) const override {}
  void setTime(double time, double sinceStart) override { times_.pass(time, sinceStart); }
  std::vector<simulation::SaveRequest> samples() const override;
  std::vector<simulation::SampledVariable>* variables() override { return &variables_; }
  bool isSampleDue(int) const override { return times_.isDue() && !variables_.empty(); }

 protected:
  /// The values of a variable; null if it has no values at this time.
  static const output::FieldBlock* find(const output::Snapshot& snapshot, const simulation::SampledVariable& variable);
  /// The variables that have values at this time.
  struct Found {
    const simulation::SampledVariable* variable;
    const output::FieldBlock* field;
  };
  std::vector<Found> findAll(const output::Snapshot& snapshot) const;
  /// The name of a variable in paths: its name in the scene and the index of the material, without characters that
  /// paths cannot contain.
  static std::string nameOf(const simulation::SampledVariable& variable);
  /// One file for each variable.
  std::vector<simulation::OwnFile> filesIn(const std::string& folder) const;

  std::vector<simulation::SampledVariable> variables_;

 private:
  SampleTimes times_;
};

/// The name that file headers give to a component of a variable: `v`, `v.x` for a vector, `v(0,1)` for a tensor.
std::string nameOfComponent(const std::string& name, int component, int components);

/// The element at `place` of an array with numbers of any type.
double numberAt(const output::Array& array, std::size_t place);

}  // namespace tushar::analysis
