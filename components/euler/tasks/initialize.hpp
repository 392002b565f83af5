#pragma once

#include <optional>

#include "components/euler/labels.hpp"
#include "components/euler/settings.hpp"

namespace tushar::euler {

/// Throws InputError for objects that contain no cell centre of the whole grid.
template <int D>
void checkObjects(const Level& level, const Settings& settings);

/// The initial rho, rho v and E at a point, from the last object that contains it; none if no object does. Throws
/// InputError where density or p + p_inf is not positive, or the state is not finite.
template <int D>
std::optional<State<D>> stateAt(const Level& level, const Settings& settings, const Vec3& point);

/// The last object of a gas that contains a point; null if no object does.
const GasObject* objectAt(const Settings& settings, const Vec3& point);
/// The initial volume fraction of a gas at a point, from the last object that contains it; 0 if no object does.
double shareAt(const Settings& settings, const Vec3& point);

/// Throws the InputError for a cell with the centre `point` that has no gas at the start.
[[noreturn]] void refuseUncovered(const Settings& settings, const Vec3& point);

/// Sets each cell to the state that the last object containing its centre gives there; a face between objects belongs
/// to the object above it. Throws InputError if an object contains no cell centre, if no object contains a centre, if
/// density or p + p_inf is not positive, or if the state is not finite.
template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> density, CellView<Vec<D>> momentum,
                CellView<double> totalEnergy);

}  // namespace tushar::euler
