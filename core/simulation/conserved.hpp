#pragma once

#include <array>
#include <string>

#include "core/data/label.hpp"
#include "core/data/reduction.hpp"

namespace tushar::simulation {

/// Quantities that a method may conserve; the report shows the drift of their totals.
enum class Conserved { mass, momentum, energy };

/// A conserved quantity, and the reduction that computes its total.
struct ConservedTotal {
  Conserved quantity;
  std::string label;

  /// The name of the quantity in reports and checkpoints.
  std::string name() const { return std::array{"mass", "momentum", "energy"}[static_cast<std::size_t>(quantity)]; }
};

/// Labels of totals of conserved quantities. A component whose total has another unit or meaning declares its own label
/// of the same name.
namespace total {
inline constexpr data::ReductionLabel<data::Sum> mass{"TotalMass", "kg", "mass"};
inline constexpr data::ReductionLabel<data::VectorSum> momentum{"TotalMomentum", "kg m/s", "momentum"};
inline constexpr data::ReductionLabel<data::Sum> energy{"TotalEnergy", "J", "internal and kinetic energy"};
inline constexpr data::ReductionLabel<data::Sum> kineticEnergy{"KineticEnergy", "J", "kinetic energy"};
}  // namespace total

}  // namespace tushar::simulation
