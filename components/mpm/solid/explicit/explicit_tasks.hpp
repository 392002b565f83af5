#pragma once

#include "components/mpm/solid/explicit/tasks/affine.hpp"
#include "components/mpm/solid/explicit/tasks/friction.hpp"
#include "components/mpm/solid/explicit/tasks/gradient_enhanced.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/explicit/tasks/interpolate_to_particles_and_update.hpp"
#include "components/mpm/solid/explicit/tasks/measure_work.hpp"
#include "components/mpm/solid/explicit/tasks/separate_bodies.hpp"
#include "components/mpm/solid/explicit/tasks/update_in_parts.hpp"
#include "components/mpm/solid/explicit/tasks/velocity_updates.hpp"
#include "components/mpm/solid/tasks/shaped_tasks.hpp"

namespace tushar::mpm::solid {

/// The bodies of those tasks of SolidMpm that use shape functions, for one kind of shape functions in D dimensions.
template <int D>
struct ExplicitTasks {
  ShapedTasks<D> shaped;
  decltype(&solid::interpolateParticlesToGrid<LinearShape<D>>) interpolateParticlesToGrid;
  decltype(&solid::interpolateMomentum<LinearShape<D>>) interpolateMomentum;
  decltype(&solid::addVelocityGradient<LinearShape<D>>) addVelocityGradient;
  decltype(&solid::computeSurface<LinearShape<D>>) computeSurface;
  decltype(&solid::separateBodies<LinearShape<D>>) separateBodies;
  decltype(&solid::interpolateColor<LinearShape<D>>) interpolateColor;
  decltype(&solid::interpolateToParticlesAndUpdate<LinearShape<D>>) interpolateToParticlesAndUpdate;
  decltype(&solid::moveParticles<LinearShape<D>>) moveParticles;
  decltype(&solid::computeStressTensor<LinearShape<D>>) computeStressTensor, computeSharedStressTensor;
  decltype(&solid::measureWork<LinearShape<D>>) measureWork;
  decltype(&solid::blendVelocity<LinearShape<D>>) blendVelocity;
  decltype(&solid::computeSSPlusVp<LinearShape<D>>) computeSSPlusVp;
  decltype(&solid::applyXpic<LinearShape<D>>) applyXpic;
  decltype(&solid::computeInternalHeatRate<LinearShape<D>>) computeInternalHeatRate;
  decltype(&solid::computeSubgridHeat<LinearShape<D>>) computeSubgridHeat;
  decltype(&solid::followGivenTemperature<LinearShape<D>>) followGivenTemperature;
  decltype(&solid::addAffineVelocity<LinearShape<D>>) addAffineVelocity =
      nullptr;  ///< null if it is not available with these shape functions
  decltype(&solid::updateAffineMoment<LinearShape<D>>) updateAffineMoment =
      nullptr;  ///< null if it is not available with these shape functions
};

template <class Shape, int D = Shape::dimension>
constexpr ExplicitTasks<D> explicitTasks() {
  ExplicitTasks<D> tasks{.shaped = shapedTasks<Shape>(),
                         .interpolateParticlesToGrid = interpolateParticlesToGrid<Shape>,
                         .interpolateMomentum = interpolateMomentum<Shape>,
                         .addVelocityGradient = addVelocityGradient<Shape>,
                         .computeSurface = computeSurface<Shape>,
                         .separateBodies = separateBodies<Shape>,
                         .interpolateColor = interpolateColor<Shape>,
                         .interpolateToParticlesAndUpdate = interpolateToParticlesAndUpdate<Shape>,
                         .moveParticles = moveParticles<Shape>,
                         .computeStressTensor = computeStressTensor<Shape, Volumes::own>,
                         .computeSharedStressTensor = computeStressTensor<Shape, Volumes::shared>,
                         .measureWork = measureWork<Shape>,
                         .blendVelocity = blendVelocity<Shape>,
                         .computeSSPlusVp = computeSSPlusVp<Shape>,
                         .applyXpic = applyXpic<Shape>,
                         .computeInternalHeatRate = computeInternalHeatRate<Shape>,
                         .computeSubgridHeat = computeSubgridHeat<Shape>,
                         .followGivenTemperature = followGivenTemperature<Shape>};
  if constexpr (!Shape::deforms && !Shape::axisymmetric) {
    tasks.addAffineVelocity = addAffineVelocity<Shape>;
    tasks.updateAffineMoment = updateAffineMoment<Shape>;
  }
  return tasks;
}

}  // namespace tushar::mpm::solid
