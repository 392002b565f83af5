#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `planeExtract`: writes variables on parts of planes, one file per variable and time:
/// `<plane>/t00012/L-0/0:press_CC_0.dat` in the archive, where Uintah writes them if it has one patch. A line has the
/// place of a cell or node and the value.
simulation::AnalysisKind planeExtractKind();

}  // namespace tushar::analysis
