#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::reference {

/// `exactRiemann`: errors against the exact solution of a shock tube.
simulation::AnalysisKind exactRiemannKind();
/// `simpleWave`: errors against a right-running simple wave.
simulation::AnalysisKind simpleWaveKind();
/// `isentropicVortex`: errors against a smooth vortex that a uniform flow carries along.
simulation::AnalysisKind isentropicVortexKind();
/// `gresho`: errors against a vortex of two rings.
simulation::AnalysisKind greshoKind();
/// `noh`: errors against cold gas that falls into a plane, a line or a point.
simulation::AnalysisKind nohKind();
/// `sedov`: errors against a self-similar blast wave.
simulation::AnalysisKind sedovKind();
/// `tabulated`: errors against the cells of another run.
simulation::AnalysisKind tabulatedKind();

}  // namespace tushar::reference
