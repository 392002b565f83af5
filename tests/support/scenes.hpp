#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "components/components.hpp"
#include "core/scene/scene.hpp"
#include "core/simulation/simulation.hpp"

namespace tushar::test {

/// Runs a scene of `ups/` with some values overridden, without files; gives its report.
inline report::Report runScene(const std::string& scene, const std::vector<std::string>& overrides) {
  simulation::Problem problem = scene::readScene(scene, overrides, catalogue());
  problem.archive.saves.clear();
  simulation::RunOptions options;
  options.quiet = true;
  return simulation::Simulation(std::move(problem), options, std::chrono::steady_clock::now()).run();
}

}  // namespace tushar::test
