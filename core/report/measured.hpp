#pragma once

#include <string>
#include <vector>

#include "core/data/label.hpp"

namespace tushar::report {

/// An error that an analysis module measures, such as that of the quantity `density` at the `particle`s. The reduction
/// `label` computes it; its type is data::Norm or, if only max is computed, data::Maximum. `norms` lists the meaningful
/// ones among L1, L2, max and relative.
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
