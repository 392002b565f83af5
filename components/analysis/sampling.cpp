#include "components/analysis/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "core/input/refuse.hpp"
#include "core/output/archive_files.hpp"

namespace tushar::analysis {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::SampledVariable;

namespace {

Schema<Analyzed> variableSchema() {
  return Schema<Analyzed>("analyze", "A cell or node variable.")
      .location(&Analyzed::where, "label")
      .location(&Analyzed::whereOfMaterial, "matl")
      .requiredAttribute("label", &Analyzed::label, "1", "its name, such as press_CC or c.pressure")
      .attributeValue("matl", &Analyzed::material, "", "1", "index of its material; by default that of the module")
      .ignoredAttribute("level", "the module samples the whole grid")
      .check([](const Analyzed&, const Element& given, Diagnostics& diagnostics) {
        input::noteAttribute(given, "level", "the module samples the whole grid", diagnostics);
      });
}

Schema<AnalyzedList> listSchema(const Schema<Analyzed>& variable) {
  return Schema<AnalyzedList>("Variables", "The variables that are sampled.")
      .list("analyze", &AnalyzedList::list, variable, "a cell or node variable", 1);
}

}  // namespace

const Schema<AnalyzedList>& analyzedSchema() {
  static const Schema<Analyzed> variable = variableSchema();
  static const Schema<AnalyzedList> schema = listSchema(variable);
  return schema;
}

const Schema<AnalyzedList>& weightedSchema() {
  static const Schema<Analyzed> variable = variableSchema().choiceAttribute(
      "weighting", &Analyzed::weighting,
      {{"none", Weighting::none}, {"nCells", Weighting::cells}, {"mass", Weighting::weight}}, Weighting::none,
      "the sum over the plane (none), divided by the number of cells (nCells), or divided by the sum of <weight> "
      "(mass)");
  static const Schema<AnalyzedList> schema = listSchema(variable);
  return schema;
}

void checkTimes(const Times& times, const Element& module, Diagnostics& diagnostics) {
  if (times.start > times.stop)
    diagnostics.error(*module.child("timeStop"),
                      fmt::format("found {:g} s, expected timeStart, {:g} s, or later", times.stop, times.start));
}

void SampleTimes::pass(double time, double sinceStart) {
  if (sinceStart == since_start_) return;
  const bool isFirst = since_start_ < 0;
  since_start_ = sinceStart;
  const double count = sinceStart <= 0 || time < start_ ? -1 : std::floor((time - start_) * frequency_);
  due_ = !isFirst && time <= stop_ && count > count_;
  count_ = count;
}

std::string linesBefore(const std::string& text, double time, int column) {
  std::string kept;
  for (std::size_t from = 0, end; (end = text.find('\n', from)) != std::string::npos; from = end + 1) {
    const std::string line = text.substr(from, end + 1 - from);
    std::istringstream words(line);
    std::string word;
    for (int k = 0; k <= column; ++k) words >> word;
    if (line.starts_with('#') || std::strtod(word.c_str(), nullptr) < time * (1 - 1e-6)) kept += line;
  }
  return kept;
}

void SampleFiles::add(const std::filesystem::path& file, const std::string& header, const std::string& line,
                      double time) {
  if (!begun_.insert(file.string()).second) return output::AppendFile(file).append(line);
  const std::string before = linesBefore(output::textOf(file).value_or(""), time, column_);
  output::replaceFile(file, (before.empty() ? header : before) + line);
}

SamplingModule::SamplingModule(const Sampling& sampling) : times_(sampling) {
  for (const Analyzed& one : sampling.variables.list)
    variables_.push_back({{one.label, one.material.empty() ? sampling.material : one.material, one.where,
                           one.material.empty() ? sampling.where : one.whereOfMaterial},
                          one.label});
}

std::vector<SaveRequest> SamplingModule::samples() const {
  std::vector<SaveRequest> requests;
  for (const SampledVariable& variable : variables_) requests.push_back(variable.request);
  return requests;
}

const output::FieldBlock* SamplingModule::find(const output::Snapshot& snapshot, const SampledVariable& variable) {
  const auto found = std::find_if(snapshot.fields.begin(), snapshot.fields.end(), [&](const auto& field) {
    return field.array.label == variable.request.label && field.material == variable.request.material;
  });
  return found == snapshot.fields.end() ? nullptr : &*found;
}

std::vector<SamplingModule::Found> SamplingModule::findAll(const output::Snapshot& snapshot) const {
  std::vector<Found> all;
  for (const SampledVariable& variable : variables_)
    if (const auto* field = find(snapshot, variable)) all.push_back({&variable, field});
  return all;
}

std::string SamplingModule::nameOf(const SampledVariable& variable) {
  return output::nameInPath(fmt::format("{}_{}", variable.called, variable.material));
}

std::vector<simulation::OwnFile> SamplingModule::filesIn(const std::string& folder) const {
  std::vector<simulation::OwnFile> files;
  for (const SampledVariable& variable : variables_)
    files.push_back({folder + '/' + nameOf(variable), variable.request.where});
  return files;
}

std::string nameOfComponent(const std::string& name, int component, int components) {
  if (components == 1) return name;
  if (components == 3) return fmt::format("{}.{}", name, "xyz"[component]);
  return fmt::format("{}({},{})", name, component / 3, component % 3);
}

double numberAt(const output::Array& array, std::size_t place) {
  return std::visit([&](const auto& values) { return static_cast<double>(values[place]); }, array.values);
}

}  // namespace tushar::analysis
