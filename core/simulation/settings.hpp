#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/grid/level.hpp"
#include "core/simulation/time_control.hpp"

namespace tushar::simulation {

/// Pairs of names of a variable: Uintah's and Tushar's.
using OtherNames = std::vector<std::pair<std::string, std::string>>;

/// One `<save label= material=>`.
struct SaveRequest {
  std::string label;
  std::string material;  ///< empty: all
  Location where;        ///< place of the label
  Location whereOfMaterial;
};

/// The tag `checkpoint`: the number of checkpoints to keep, and one of the intervals.
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

/// A criterion for refinement: an indicator of a cell variable, and thresholds.
struct Criterion {
  enum class Indicator {
    jump,  ///< |q(i+1) - q(i-1)| / 2 divided by the smallest |q| of the three, infinite if that is 0; the maximum over
           ///< axes
    secondDerivative,  ///< Löhner's, between 0 and 1
    gradient,          ///< the magnitude of the gradient, in the unit of the variable per m
    above,             ///< the value itself
    below,             ///< the value itself; cells with smaller values are refined
  };
  std::string variable;
  std::string material;  ///< empty: no material, or each
  Indicator indicator = Indicator::jump;
  double refine = 0;   ///< cells are refined where the indicator is beyond this,
  double coarsen = 0;  ///< and not coarsened where it is beyond this
  Location where;      ///< place in the scene and path of the tag; empty for a component's own criteria
  std::string path;
};

/// When and where a run refines its grid; the sections `AMR/Regridder` and `Refinement_Criteria_Thresholds`.
struct RegridSettings {
  bool adaptive = false;
  bool once = false;  ///< at the start only
  int interval = 8;   ///< steps from one regridding to the next
  int dilation = 1;   ///< cells around those that signals can reach until then
  bool refluxes = true;
  std::vector<Criterion> criteria;
  Location where;  ///< the tag that requests several levels, for messages
};

/// The options of a run on the command line.
struct RunOptions {
  std::string jsonPath;         ///< file for the report; empty: none
  std::string outputFolder;     ///< instead of the current folder
  bool quiet = false;           ///< no progress
  int writers = 0;              ///< number of ranks that write files; 0: one on each node
  std::optional<int> behind{};  ///< MB of an output that a writer may keep during steps; by default a suitable amount
};

}  // namespace tushar::simulation
