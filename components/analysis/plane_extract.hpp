#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `planeExtract`: writes variables on parts of planes. Each variable has a file for each time, such as
/// `<plane>/t00012/L-0/0:press_CC_0.dat` in the archive, where Uintah writes it if the grid has one patch. A line has
/// the position of a cell or node and the value.
simulation::AnalysisKind planeExtractKind();

}  // namespace tushar::analysis
