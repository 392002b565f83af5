#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `minMax`: writes the minimum and maximum of variables over time. Each variable has a file, such as
/// `MinMax/L-0/press_CC_0` in the archive, where Uintah writes it. A line has the time [s], the minimum and the
/// maximum; for vectors and tensors, the latter two are lists of components in brackets.
simulation::AnalysisKind minMaxKind();

}  // namespace tushar::analysis
