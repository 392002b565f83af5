#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/grid/grid.hpp"
#include "core/simulation/analysis.hpp"
#include "core/simulation/component.hpp"
#include "core/simulation/restart.hpp"
#include "core/simulation/settings.hpp"

namespace tushar::simulation {

/// A scene that has been checked and is ready to run.
struct Problem {
  std::string scenePath, title, componentName;
  std::string inputXml;             ///< the scene with its overrides as XML, for the archive
  std::vector<InputProblem> notes;  ///< notes on parts of the scene that have no effect
  TimeSettings time;
  ArchiveSettings archive;
  RegridSettings regrid;
  std::optional<Location> smallerSteps;  ///< the tag that makes finer levels take smaller steps, if there is one
  std::unique_ptr<grid::Grid> grid;
  int threads = 1;         ///< largest number of threads
  int cellsPerThread = 0;  ///< smallest number of cells per thread; 0: no limit
  std::unique_ptr<Component> component;
  std::vector<std::unique_ptr<Analysis>> analyses;
  std::optional<Restart> restart;  ///< the checkpoint from which the run continues, if any
};

}  // namespace tushar::simulation
