#include "components/ice/tracers/input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "core/input/refuse.hpp"
#include "core/input/text.hpp"

namespace tushar::ice {

using input::Diagnostics;
using input::Schema;

namespace {

constexpr const char* tracersPath = "Models/Model/TracerParticles";

/// Declares the shape of a region, and what Uintah writes into checkpoints.
Schema<TracerRegion>& addRegion(Schema<TracerRegion>& tags) {
  input::addShape(tags, &TracerRegion::where, &TracerRegion::shape,
                  "the region: cells whose centre is inside; several shapes form their union")
      .ignored("isInteriorRegion", "the section says whether it is one")
      .ignoredAttribute("name", "a note for readers");
  return tags;
}

const Schema<TracerRegion>& initialTracersSchema() {
  static const Schema<TracerRegion> schema = [] {
    Schema<TracerRegion> tags("geom_object", "A region with tracers at the start.");
    addRegion(tags).required("particlesPerCell", &TracerRegion::perCell, "1", "number of tracers in each cell",
                             input::nonNegative());
    return tags;
  }();
  return schema;
}

const Schema<TracerRegion>& tracerSourceSchema() {
  static const Schema<TracerRegion> schema = [] {
    Schema<TracerRegion> tags("geom_object", "A region in which tracers are made during the run.");
    addRegion(tags).required("particlesPerCellPerSecond", &TracerRegion::perCellPerTime, "1/s",
                             "number of tracers that are made in each cell per unit time", input::nonNegative());
    return tags;
  }();
  return schema;
}

const Schema<TracerScalarSection>& tracerScalarSchema() {
  static const Schema<TracerScalarSection> schema =
      Schema<TracerScalarSection>("scalar", "A quantity that each tracer carries.")
          .location(&TracerScalarSection::where)
          .requiredAttribute("name", &TracerScalarSection::name, "1",
                             "it is saved as NAME, after p. if NAME does not begin so; with <exponentialDecay> also "
                             "NAME_totalDecay and NAME_expDecayCoef")
          .required("initialValue", &TracerScalarSection::initialValue, "1", "its value when the tracer is made")
          .section("exponentialDecay", &TracerScalarSection::decay, decaySchema());
  return schema;
}

const Schema<TracerSection>& tracerSchema() {
  static const Schema<TracerRegions> initial =
      Schema<TracerRegions>("initialization", "Where tracers are at the start, if timeStart is not later.")
          .list("geom_object", &TracerRegions::list, initialTracersSchema(), "a region", 1);
  static const Schema<TracerRegions> sources =
      Schema<TracerRegions>("interiorSources", "Where tracers are made from timeStart to timeStop.")
          .list("geom_object", &TracerRegions::list, tracerSourceSchema(), "a region", 1);
  static const Schema<TracerSection> schema =
      Schema<TracerSection>("tracer", "The tracers.")
          .requiredAttribute("name", &TracerSection::name, "1", "a note for readers")
          .requiredSection("initialization", &TracerSection::initial, initial)
          .section("interiorSources", &TracerSection::sources, sources);
  return schema;
}

const Schema<ClonesSection>& clonesSchema() {
  static const Schema<ClonedVariable> clone =
      Schema<ClonedVariable>("CCVarLabel", "A variable of cells.")
          .location(&ClonedVariable::where, "label")
          .requiredAttribute("label", &ClonedVariable::name, "1",
                             "its name in Uintah or here; the value in the cell of a tracer is saved as p.clone-NAME");
  static const Schema<ClonesSection> schema =
      Schema<ClonesSection>("cloneVariables", "Variables of the gas that tracers show.")
          .list("CCVarLabel", &ClonesSection::list, clone, "a variable of cells");
  return schema;
}

/// Reports a scalar whose name has characters that files cannot have, or belongs to one of the variables `taken`; adds
/// the names of its variables to these.
void checkName(const TracerScalarSection& one, std::set<std::string>& taken, Diagnostics& diagnostics) {
  const std::string path = fmt::format("{}/scalar", tracersPath);
  const auto isAllowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
  };
  if (one.name.empty() || !std::all_of(one.name.begin(), one.name.end(), isAllowed))
    diagnostics.error(one.where, path,
                      fmt::format("found the name '{}', expected letters, digits, '_', '-' and '.'", one.name));
  const std::string name = particleName(one.name);
  bool isNew = taken.insert(name).second;
  if (one.decay)
    for (const char* suffix : {"_totalDecay", "_expDecayCoef"}) isNew = taken.insert(name + suffix).second && isNew;
  if (!isNew)
    diagnostics.error(one.where, path,
                      fmt::format("the name '{}' is given twice, or belongs to another variable", one.name));
}

}  // namespace

const Schema<TracersSection>& tracersSchema() {
  static const Schema<TracersSection> schema = [] {
    Schema<TracersSection> tags("TracerParticles", "Particles without mass that move with the gas.");
    tags.location(&TracersSection::where)
        .value("material", &TracersSection::material, "", "1", "name of the gas; not needed if there is only one")
        .value("timeStart", &TracersSection::start, 0, "s", "time from which tracers are made")
        .optional("timeStop", &TracersSection::stop, "s", "time after which no tracers are made")
        .section("cloneVariables", &TracersSection::clones, clonesSchema())
        .list("scalar", &TracersSection::scalars, tracerScalarSchema(), "a quantity that each tracer carries")
        .requiredSection("tracer", &TracersSection::tracer, tracerSchema())
        .ignored("modelPreviouslyInitialized", "a restarted run has the tracers of its checkpoint");
    input::refuseSwitch(tags, "reinitializeDomain", "a run starts with <initialization>");
    input::refuseTag(tags, "newVariables", "write <cloneVariables>, Uintah's present name of the tag");
    return tags;
  }();
  return schema;
}

TracerSettings settingsOfTracers(const TracersSection& read, Diagnostics& diagnostics) {
  TracerSettings settings;
  settings.where = read.where;
  settings.material = read.material;
  settings.start = read.start;
  if (read.stop) settings.stop = *read.stop;
  settings.initial = read.tracer.initial.list;
  settings.sources = read.tracer.sources.value_or(TracerRegions()).list;
  settings.clones = read.clones.value_or(ClonesSection()).list;
  if (read.stop && *read.stop < read.start)
    diagnostics.error(read.where, tracersPath,
                      fmt::format("timeStop, {:g} s, is before timeStart, {:g} s", *read.stop, read.start));
  std::set<std::string> names{"p.x", "p.velocity", "p.displacement", "p.particleID"};
  for (const ClonedVariable& one : settings.clones) names.insert("p.clone-" + one.name);
  for (const TracerScalarSection& one : read.scalars) {
    checkName(one, names, diagnostics);
    settings.scalars.push_back({.where = one.where,
                                .name = one.name,
                                .initialValue = one.initialValue,
                                .decay = decayOf(0, 0, one.decay, "TracerParticles", diagnostics)});
  }
  return settings;
}

void checkTracers(const GasScene& scene, int solids, Diagnostics& diagnostics) {
  const TracerSettings& tracers = *scene.tracers;
  std::vector<std::string> gases;
  for (const euler::Settings& gas : scene.mixture) gases.push_back(gas.name);
  if (scene.mixture.empty() || scene.binary) gases = {scene.gas.name};
  if (tracers.material.empty() && gases.size() > 1)
    diagnostics.error(tracers.where, tracersPath, "missing tag <material>: name one of " + input::listed(gases));
  const std::string problem = input::choiceProblem(tracers.material, gases);
  if (!tracers.material.empty() && !problem.empty())
    diagnostics.error(tracers.where, tracersPath, "material: " + problem);
  CarriedScalars scalars;
  for (const ScalarSettings& one : scene.scalars) scalars.push_back(std::make_shared<const CarriedScalar>(one));
  std::vector<std::string> names;
  for (const Cloneable& one : cloneableOf(scalars, std::max<std::size_t>(1, scene.mixture.size()), solids > 0))
    names.push_back(one.name);
  std::set<std::string> cloned;
  for (const ClonedVariable& one : tracers.clones) {
    const std::string path = fmt::format("{}/cloneVariables/CCVarLabel", tracersPath);
    if (const std::string unknown = input::choiceProblem(one.name, names); !unknown.empty())
      diagnostics.error(one.where, path, unknown);
    else if (!cloned.insert(one.name).second)
      diagnostics.error(one.where, path, fmt::format("'{}' is given twice", one.name));
  }
}

}  // namespace tushar::ice
