#pragma once

#include "components/mpm/shapes/tensor_shape.hpp"
#include "components/mpm/solid/tasks/heat.hpp"
#include "components/mpm/solid/tasks/show_grid.hpp"

namespace tushar::mpm::solid {

/// The bodies of tasks that use shape functions, in explicit and implicit steps, for one kind of shape functions in D
/// dimensions. Their parameters depend on D alone, so that the same schedule, compiled once for each D, works with all
/// kinds.
template <int D>
struct ShapedTasks {
  ShapeTraits shape;
  decltype(&solid::interpolateTemperatureToGrid<LinearShape<D>>) interpolateTemperatureToGrid;
  decltype(&solid::updateTemperature<LinearShape<D>>) updateTemperature;
  decltype(&solid::showMotion<LinearShape<D>>) showMotion;
  decltype(&solid::showForce<LinearShape<D>>) showForce;
  decltype(&solid::showStress<LinearShape<D>>) showStress;
};
template <class Shape, int D = Shape::dimension>
constexpr ShapedTasks<D> shapedTasks() {
  return {.shape = traitsOf<Shape>,
          .interpolateTemperatureToGrid = interpolateTemperatureToGrid<Shape>,
          .updateTemperature = updateTemperature<Shape>,
          .showMotion = showMotion<Shape>,
          .showForce = showForce<Shape>,
          .showStress = showStress<Shape>};
}

template <int D>
void scheduleNodalTemperature(TaskList& tasks, const ShapedTasks<D>& shaped, const std::vector<Material>& materials,
                              const Vec3& commonSize, KeptSizes keepsSizes, bool isAnyGiven) {
  tasks.perMaterial("mpm::interpolateTemperatureToGrid", shaped.interpolateTemperatureToGrid, materials,
                    with(commonSize), all<HeatToNodes<D>>(shaped.shape.reach, keepsSizes, isAnyGiven));
}

template <int D>
void scheduleTemperatureUpdate(TaskList& tasks, const ShapedTasks<D>& shaped, const std::vector<Material>& materials,
                               const Vec3& commonSize, KeptSizes keepsSizes, bool conductsInCells) {
  tasks.perMaterial("mpm::updateTemperature", shaped.updateTemperature, materials, with(commonSize),
                    all<HeatToParticles<D>>(shaped.shape.ghostNodes, keepsSizes, conductsInCells), requiresOld(delT));
}

/// Adds motion, forces, stresses and accelerations on the nodes. Separate tasks compute them, because a scene may need
/// the forces in every step, and the other quantities only for outputs. `volume` and `stress` read these variables of
/// particles, with the ghost cells that shape functions reach; `isViscous`: whether they have a viscous pressure.
template <int D, class Volume, class Stress>
void scheduleShowOnGrid(TaskList& tasks, const ShapedTasks<D>& shaped, const std::vector<Material>& materials,
                        const Vec3& commonSize, KeptSizes keepsSizes, Volume volume, Stress stress,
                        bool isViscous = false) {
  const int reach = shaped.shape.reach;
  const auto particles = all<StressedParticles<D>>(reach, keepsSizes, volume, stress, isViscous);
  tasks.perMaterial("mpm::showMotion", shaped.showMotion, materials, with(commonSize),
                    all<MotionPicture<D>>(reach, keepsSizes));
  tasks.perMaterial("mpm::showForce", shaped.showForce, materials, with(commonSize), particles, computes(g::volume),
                    computes(g::internalForce<D>));
  tasks.perMaterial("mpm::showStress", shaped.showStress, materials, with(commonSize), particles,
                    requiresNew(g::volume), computes(g::stress));
  tasks.perMaterial("mpm::showAcceleration", showAcceleration<D>, materials, requiresNew(g::mass),
                    requiresNew(g::internalForce<D>), computes(g::acceleration<D>));
}

}  // namespace tushar::mpm::solid
