#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `planeAverage`: writes means of cell variables over each plane of cells perpendicular to an axis. Each variable has
/// a file for each time, such as `planeAverage/t00012/L-0/press_CC_0` in the archive, where Uintah writes it. A line
/// has the centre of a plane, the mean, and the divisor of the mean.
simulation::AnalysisKind planeAverageKind();

}  // namespace tushar::analysis
