#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/grid/level.hpp"
#include "core/simulation/time_control.hpp"

namespace tushar::simulation {

/// One `<save label= material=>`.
struct SaveRequest {
  std::string label;
  std::string material;  ///< empty: all
  Location where;        ///< of the label
  Location whereOfMaterial;
};

/// The tag `checkpoint`: how many are kept, and one of the intervals.
struct CheckpointSettings {
  int cycle = 2;
  std::optional<double> interval = {};                                        ///< s of simulated time
  std::optional<int> timestepInterval = {};                                   ///< steps
  std::optional<double> walltimeStart = {}, walltimeInterval = {};            ///< s
  std::optional<double> walltimeStartHours = {}, walltimeIntervalHours = {};  ///< h
};

/// The `DataArchiver` section.
struct ArchiveSettings {
  std::string filebase;
  double outputInterval = 0;       ///< s; 0: none
  int outputTimestepInterval = 0;  ///< steps; 0: none
  bool outputInitTimestep = false;
  bool outputLastTimestep = false;
  bool doubleAsFloat = false;
  int compression = 0;  ///< of gzip, 0-9
  std::vector<SaveRequest> saves;
  std::optional<CheckpointSettings> checkpoint;
};

/// The options of a run on the command line.
struct RunOptions {
  std::string jsonPath;      ///< where the report goes; empty: nowhere
  std::string outputFolder;  ///< instead of the current folder
  bool quiet = false;        ///< no progress
};

}  // namespace tushar::simulation
