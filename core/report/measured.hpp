#pragma once

#include <string>
#include <vector>

#include "core/data/label.hpp"

namespace tushar::report {

/// An error norm that an analysis module computes: `density` at the `particle`s, by the reduction `label` of type
/// data::Norm, or data::Maximum for max alone. `norms` lists those that mean something, of L1, L2, max and relative.
struct MeasuredError {
  std::string field, place;
  const data::Label* label;
  std::vector<std::string> norms;
};

/// A term of an energy budget computed by an analysis module: the total `label` [J].
struct EnergyTerm {
  enum class Side {
    came,  ///< energy present at the start, or added since then
    went,  ///< energy present now, or removed since the start
  };
  std::string name;
  const data::Label* label;
  Side side;
};

}  // namespace tushar::report
