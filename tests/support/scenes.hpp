#pragma once

#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::test {

/// Runs a scene of `ups/` with some values overridden, without files; returns its report.
inline report::Report runScene(const std::string& scene, const std::vector<std::string>& overrides) {
  simulation::Problem problem = scene::readScene(scene, overrides, catalogue());
  problem.archive.saves.clear();
  simulation::RunOptions options;
  options.quiet = true;
  return simulation::Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run();
}

/// Returns a copy of a scene with a piece of text replaced.
inline std::string changedScene(const std::string& scene, const std::string& from, const std::string& to) {
  std::stringstream text;
  text << std::ifstream(scene).rdbuf();
  std::string changed = text.str();
  const std::size_t at = changed.find(from);
  if (at == std::string::npos) throw std::logic_error("the scene has no " + from);
  const std::string path = temporaryFolder() + "changed.ups";
  std::ofstream(path) << changed.replace(at, from.size(), to);
  return path;
}

/// The sentence of the problem of a scene that is refused, without its place, or all problems if there are several; ""
/// if the scene is accepted.
inline std::string problemOf(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  try {
    scene::readScene(scene, overrides, catalogue());
    return "";
  } catch (const InputError& error) {
    return error.problems().size() == 1 ? error.problems()[0].sentence : std::string(error.what());
  }
}

/// Returns the drift of a quantity of a report.
inline double driftOf(const report::Report& report, const std::string& name) {
  for (const report::Drift& drift : report.drifts)
    if (drift.name == name) return drift.change;
  throw std::logic_error("the report has no drift of " + name);
}

/// Returns the L1 error of a measured variable.
inline double errorOf(const report::Report& report, const std::string& quantity) {
  for (const report::ErrorNorms& error : report.errors)
    if (error.field == quantity) return error.norms.at("L1");
  throw std::logic_error("nothing measured the " + quantity);
}

}  // namespace tushar::test
