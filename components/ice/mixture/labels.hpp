#pragma once

#include "core/core.hpp"

namespace tushar::ice {

/// The label of a total of one gas. It refers to the name, whose address must not change while tasks refer to the
/// label.
class GasTotal {
 public:
  explicit GasTotal(const std::string& gas) : name_("TotalMass-" + gas) {}
  GasTotal(const GasTotal&) = delete;
  GasTotal& operator=(const GasTotal&) = delete;

  const ReductionLabel<Sum>& label() const { return label_; }

 private:
  std::string name_;
  ReductionLabel<Sum> label_{name_, "kg", "mass of a gas in all cells"};
};

namespace c {

/// Variables of each gas, if there are several; they are computed only if a scene saves them.
inline constexpr CellLabel<double> ownDensity{"c.ownDensity", "kg/m^3",
                                              "mass of a gas per volume of this gas; 0 in cells without it"};

/// Variables of BinaryProperties.
inline constexpr CellLabel<double> massFraction{"c.massFraction", "1", "mass fraction of the second of two gases"};

}  // namespace c

}  // namespace tushar::ice
