#pragma once

#include "components/euler/labels.hpp"
#include "components/euler/settings.hpp"

namespace tushar::euler {

/// The state of the last object that contains the middle of each cell, there.
/// Throws InputError where no object does, or where its density or p + p_inf is not positive, or its state not finite.
template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<double> density, CellView<Vec<D>> momentum,
                CellView<double> totalEnergy);

}  // namespace tushar::euler
