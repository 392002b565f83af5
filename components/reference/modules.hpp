#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::reference {

/// `exactRiemann`: compares a run with the exact solution of a shock tube.
simulation::AnalysisKind exactRiemannKind();
/// `simpleWave`: compares a run with a simple wave that runs to the right.
simulation::AnalysisKind simpleWaveKind();
/// `isentropicVortex`: compares a run with a smooth vortex in a uniform flow.
simulation::AnalysisKind isentropicVortexKind();
/// `gresho`: compares a run with a steady vortex that consists of two rings.
simulation::AnalysisKind greshoKind();
/// `noh`: compares a run with cold gas that converges on a plane, a line or a point.
simulation::AnalysisKind nohKind();
/// `sedov`: compares a run with a self-similar blast wave.
simulation::AnalysisKind sedovKind();
/// `tabulated`: compares a run with the cell means of another run.
simulation::AnalysisKind tabulatedKind();

}  // namespace tushar::reference
