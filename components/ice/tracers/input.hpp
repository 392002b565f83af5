#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/ice/decay_input.hpp"
#include "components/ice/gas_input.hpp"
#include "components/ice/tracers/tracers.hpp"
#include "core/input/schema.hpp"

// The section <TracerParticles> of a scene.

namespace tushar::ice {

struct TracerRegions {
  std::vector<TracerRegion> list;
};
struct TracerScalarSection {
  Location where;
  std::string name;
  double initialValue = 0;
  std::optional<DecaySection> decay;
};
struct ClonesSection {
  std::vector<ClonedVariable> list;
};
struct TracerSection {
  std::string name;
  TracerRegions initial;
  std::optional<TracerRegions> sources;
};
/// The tag `TracerParticles`.
struct TracersSection {
  Location where;
  std::string material;
  double start = 0;
  std::optional<double> stop;
  std::optional<ClonesSection> clones;
  std::vector<TracerScalarSection> scalars;
  TracerSection tracer;
};

const input::Schema<TracersSection>& tracersSchema();
/// The settings of tracers. Reports names that are given twice, and files of coefficients that cannot be read.
TracerSettings settingsOfTracers(const TracersSection& read, input::Diagnostics& diagnostics);
/// Checks that the gas of the tracers and the variables that they clone exist, beside `solids` bodies.
void checkTracers(const GasScene& scene, int solids, input::Diagnostics& diagnostics);

}  // namespace tushar::ice
