#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/grid/level.hpp"
#include "core/simulation/time_control.hpp"

namespace tushar::simulation {

/// Pairs of names of the same variable: Uintah's and Tushar's.
using OtherNames = std::vector<std::pair<std::string, std::string>>;

/// One tag `<save label= material=>`.
struct SaveRequest {
  std::string label;
  std::string material;  ///< name or index of the material; empty: all
  Location where;        ///< location of the label
  Location whereOfMaterial;
};

/// The tag `checkpoint`: the number of checkpoints to keep, and the interval between them.
struct CheckpointSettings {
  int cycle = 2;
  std::optional<double> interval = {};       ///< interval in simulated time [s]
  std::optional<int> timestepInterval = {};  ///< interval in steps
  /// First checkpoint and interval in wall time [s].
  std::optional<double> walltimeStart = {}, walltimeInterval = {};
  /// First checkpoint and interval in wall time [h].
  std::optional<double> walltimeStartHours = {}, walltimeIntervalHours = {};
};

/// The `DataArchiver` section.
struct ArchiveSettings {
  std::string filebase;
  double outputInterval = 0;       ///< interval in simulated time [s]; 0: none
  int outputTimestepInterval = 0;  ///< interval in steps; 0: none
  bool outputInitTimestep = false;
  bool outputLastTimestep = false;
  bool doubleAsFloat = false;
  int compression = 0;  ///< gzip level, 0-9
  std::vector<SaveRequest> saves;
  std::optional<CheckpointSettings> checkpoint;
};

/// A criterion for refinement: an indicator computed from a cell variable, and thresholds.
struct Criterion {
  enum class Indicator {
    jump,  ///< |q(i+1) - q(i-1)| / 2 divided by the smallest |q| of the three, infinite if that is 0; the maximum over
           ///< axes
    secondDerivative,  ///< Löhner's indicator, between 0 and 1
    gradient,          ///< magnitude of the gradient, in the unit of the variable per metre
    above,             ///< the value itself; cells with larger values are refined
    below,             ///< the value itself; cells with smaller values are refined
  };
  std::string variable;
  std::string material;  ///< name of the material; empty: no material, or each material
  Indicator indicator = Indicator::jump;
  double refine = 0;   ///< cells are refined if the indicator is beyond this threshold
  double coarsen = 0;  ///< cells are not coarsened if the indicator is beyond this threshold
  Location where;      ///< location in the scene and path of the tag; empty for a component's own criteria
  std::string path;
};

/// When and where a run refines its grid; the sections `AMR/Regridder` and `Refinement_Criteria_Thresholds`.
struct RegridSettings {
  bool adaptive = false;
  bool once = false;  ///< whether to refine only at the start
  int interval = 8;   ///< number of steps between regriddings
  int dilation = 1;   ///< additional number of cells around those that signals can reach until the next regridding
  bool refluxes = true;
  std::vector<Criterion> criteria;
  Location where;  ///< the tag that requests several levels, for messages
};

/// The options of a run given on the command line.
struct RunOptions {
  std::string jsonPath;      ///< file for the report as JSON; empty: none
  std::string outputFolder;  ///< folder for the archive, instead of the current folder
  bool quiet = false;        ///< whether to omit the progress
  int writers = 0;           ///< number of ranks that write files; 0: one on each node
  /// Amount of an output that a writer may keep in memory during steps [MB]; by default a suitable amount.
  std::optional<int> behind{};
};

}  // namespace tushar::simulation
