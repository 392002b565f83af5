#pragma once

// The names that a component uses.

#include "core/base/error.hpp"
#include "core/base/vec.hpp"
#include "core/data/label.hpp"
#include "core/data/reduction.hpp"
#include "core/data/views.hpp"
#include "core/data/wide_sum.hpp"
#include "core/grid/grid.hpp"
#include "core/simulation/component.hpp"
#include "core/tasks/marks.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar {

using data::Bound;
using data::CellLabel;
using data::CellView;
using data::Counts;
using data::delT;
using data::Maximum;
using data::Minimum;
using data::NodeLabel;
using data::NodeView;
using data::Norm;
using data::ParticleLabel;
using data::ParticleView;
using data::recomputeTimeStep;
using data::ReductionLabel;
using data::RimFlux;
using data::Sum;
using data::VectorSum;
using data::WideSum;
using grid::BoundaryKind;
using grid::BoundaryLabel;
using grid::BoundarySides;
using grid::BoundaryValue;
using grid::Box;
using grid::forEach;
using grid::forEachRow;
using grid::Grid;
using grid::Level;
using grid::Patch;
using simulation::Component;
using tasks::all;
using tasks::besideFiner;
using tasks::computes;
using tasks::computesOwn;
using tasks::creates;
using tasks::following;
using tasks::forEachOn;
using tasks::keepsFlux;
using tasks::Marks;
using tasks::marks;
using tasks::modifies;
using tasks::newCells;
using tasks::offers;
using tasks::ofMaterials;
using tasks::ParticleMaker;
using tasks::RankPatches;
using tasks::requiresNew;
using tasks::requiresOld;
using tasks::startTime;
using tasks::TaskList;
using tasks::togetherOnRanks;
using tasks::totals;
using tasks::when;
using tasks::with;
using tasks::withWorkers;
using tasks::Workers;

}  // namespace tushar
