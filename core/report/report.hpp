#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/memory.hpp"
#include "core/report/memory_use.hpp"
#include "core/report/time_use.hpp"
#include "core/tasks/prune.hpp"

namespace tushar::report {

/// The norms of one error; NaN for a norm that is not meaningful.
struct ErrorNorms {
  std::string field, place;
  std::map<std::string, double> norms;  ///< value of each norm: L1, L2, max, relative
  std::string unit;
};

/// Change of a total from the start to the end of a run.
struct Drift {
  std::string name;  ///< name of the total: mass, momentum, energy
  double start = 0, end = 0;
  double change = 0;  ///< relative to the start if that is not 0, otherwise absolute
  bool relative = true;
  std::string unit;
};

/// A number of the whole run, from a reduction of the component.
struct NumberOfRun {
  std::string key, text, unit;  ///< name in JSON, meaning, and SI unit
  std::vector<double> value;    ///< one number or, for a vector, x, y, z
};

/// The energy budget of a run [J].
struct EnergyBudget {
  std::vector<std::pair<std::string, double>> came,
      went;  ///< names and amounts of the terms; work done on the surroundings is negative

  /// The energy that the terms do not account for.
  double unaccounted() const;
  /// The largest term, which is the scale for `unaccounted`.
  double greatest() const;
};

/// Changes of the distribution of patches over the ranks during a run.
struct Rebalancing {
  int times = 0;
  int step = 0;  ///< the latest step after which patches changed ranks
  double before = 1,
         after = 1;  ///< the ratio of the largest cost of a rank to the mean, before and after the last change
};

/// The time and size of compressed outputs, summed over all ranks.
struct Compression {
  double bytes = 0, packed = 0;     ///< size of the values without and with compression [bytes]
  double packing = 0, writing = 0;  ///< time spent on compressing, and on writing the result [s]

  /// The time that compression saved [s]: the additional time for writing all bytes uncompressed at the same speed,
  /// minus the time for compressing; negative if compression did not pay off.
  double savedSeconds() const { return packed > 0 ? writing * (bytes / packed - 1) - packing : 0; }
};

/// Wall time of a task over the whole run.
struct TaskTime {
  std::string name;
  double seconds = 0;
};

/// The report of a run.
struct Report {
  std::string scene, title, component, version, build;
  int dimension = 0, patches = 0, ranks = 1, threads = 1;
  long cells = 0, particles = 0;
  long dropped = 0;            ///< number of particles that left the grid
  long removed = 0;            ///< number of particles removed because they could not be advanced
  double spacing = 0;          ///< smallest cell width [m]
  int steps = 0, retries = 0;  ///< number of steps taken, and of steps undone and repeated
  std::vector<std::pair<std::string, int>>
      limits;       ///< reasons that limit the time step, and how many steps each has limited
  double time = 0;  ///< time reached [s]
  /// Why the run ended: maxTime, max_Timesteps, max_wall_time, stop_now, interrupted, failed.
  std::string ended;
  std::string failure, advice;  ///< if the run failed: the unphysical value, and what to try
  double particleSteps = 0;
  ResidentMemory memory;  ///< memory of the rank that uses most, at the end of the run
  MemoryOfRanks memoryOfRanks;
  double wallStartup = 0, wallLoop = 0, wallOutput = 0;  ///< wall time [s]
  double wallOutputWait = 0;  ///< part of wallOutput spent waiting for an output that was still being written [s]
  Compression compression;
  TimeUse use;
  Rebalancing rebalancing;
  int recuts = 0;  ///< how often the cuts between patches were moved, to share particles evenly
  /// Number of cells of each level at the end, the coarsest first; 0 for a single level.
  std::vector<long> levels;
  double updates = 0;                ///< cell updates: the number of cells of all levels, summed over the steps
  std::vector<double> levelUpdates;  ///< cell updates of each level; empty if all take the same steps
  double uniformUpdates = 0;         ///< number of cell updates if all cells were on the finest level
  int regrids = 0;                   ///< number of times that the grid was changed
  double wallRegrid = 0;             ///< part of wallLoop spent on regridding [s]
  std::vector<TaskTime> tasks;
  double exchange = 0;  ///< part of wallLoop spent on filling ghosts [s]
  std::vector<ErrorNorms> errors;
  std::vector<std::string> unmeasured;  ///< why errors are missing: a sentence for each module without valid errors
  std::vector<Drift> drifts;
  std::vector<NumberOfRun> ofRun;
  EnergyBudget energies;  ///< empty if not requested
  std::vector<std::string> kept;
  std::vector<tasks::LeftOut> leftOut;
  std::string fingerprint;
  std::string fingerprintOfOthers;         ///< of what else is saved; empty if there is nothing
  std::string archive;                     ///< folder of the archive, if anything was saved
  std::vector<std::string> unusedOptions;  ///< PETSc options that were not used by any solve
};

/// The report as JSON, with the keys documented in tools/README.md.
std::string toJson(const Report& report);
/// The report as a table for a terminal.
std::string toText(const Report& report);

}  // namespace tushar::report
