#pragma once

#include <optional>

#include "components/ice/scalar_decay.hpp"
#include "core/input/schema.hpp"

// The section <exponentialDecay> of a scalar.

namespace tushar::ice {

struct DecayCoefficient {
  Location whereOfFile;
  bool isTable = false;
  std::optional<double> value;
  std::optional<std::string> file;
};
struct DecaySection {
  double factor = 0, rate = 0;  ///< c1, c3
  DecayCoefficient coefficient;
};

const input::Schema<DecaySection>& decaySchema();

/// How a scalar of a model falls: by the rates of <constants> [1/s], and by a decay, if it is given. Reports a file
/// that cannot be read, or that is no table of cells, to the diagnostics.
ScalarDecay decayOf(double constantRate, double linearRate, const std::optional<DecaySection>& decay,
                    const std::string& model, input::Diagnostics& diagnostics);

}  // namespace tushar::ice
