#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/core.hpp"
#include "core/input/document.hpp"
#include "core/simulation/component.hpp"

// The fields that modules sample if the variables of a gas belong to no material.

namespace tushar::analysis {

/// Whether a cell variable that belongs to no material is computed by diagnostics (otherwise it is part of the state);
/// none if there is no such variable.
std::optional<bool> isDerived(const simulation::Component& component, std::string_view label);

/// Whether diagnostics compute a total of this name.
bool computesTotal(const simulation::Component& component, std::string_view label);

/// The velocity along an axis at a side of the grid [m/s], for kernels that visit the cells there: the conditions of
/// the side and of its parts are looked up once.
class VelocityAtEnd {
 public:
  VelocityAtEnd(const Level& level, int axis, int side, int material);

  /// The velocity given on a part of the side or, if none is given, that of the gas `inside`.
  double operator()(double inside, int part = grid::restOfSide) const {
    return (part == grid::restOfSide ? rest_ : parts_[part]).value_or(inside);
  }

 private:
  std::optional<double> rest_;
  std::vector<std::optional<double>> parts_;
};

/// The number of bodies, which is also the index of the gas among the materials of the scene, since bodies come first.
int bodiesOf(const simulation::Component& component);

/// Throws InputError if the <material> of a module is not a gas of the component. The tag may be missing; as in Uintah,
/// it may have any text if the scene has only one material.
void checkGas(const std::string& material, const simulation::Component& component, const input::Element& module);

}  // namespace tushar::analysis
