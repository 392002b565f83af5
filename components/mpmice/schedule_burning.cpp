#include "components/mpmice/burn/burn_bodies.hpp"
#include "components/mpmice/burn/burn_modes.hpp"
#include "components/mpmice/burn/unsteady_surface.hpp"
#include "components/mpmice/mpmice.hpp"

namespace tushar::mpmice {

/// Adds the tasks that find the mass that burns in the step, given the state at its start.
template <int D>
void GasAround<D>::scheduleBurning(TaskList& tasks, const Materials& materials,
                                   const ParticleLabel<double>& state) const {
  constexpr typename GasInCells<D>::Reach reach{.state = 1, .mass = 3, .room = 3};
  tasks.acrossMaterials("mpmice::measureReactant", measureReactant<D>, materials, with(settings_),
                        all<ParticlesAtStart>(), withoutMaterial(all<NewReactant>()));
  if (hasCracks()) {
    tasks.acrossMaterials("mpmice::measureLoad", measureLoad<D>, materials, with(settings_), with(state.components),
                          all<StressedParticles>(keepsStress(materials[settings_.burning->body]),
                                                 settings_.burning->model.ddt()->burnsCracks, &state),
                          withoutMaterial(computes(c::bodyPressure)), withoutMaterial(computes(c::crackRadius)));
    tasks.perPatch("mpmice::findBurnModes", findBurnModes<D>, with(settings_), requiresOld(delT),
                   gasIn(readsOld, reach), all<Reactant>(1), all<Load>(1), all<Waited>(waitsForFlames()),
                   all<NewBurnModes>());
  }
  if (isUnsteady()) {
    tasks.acrossMaterials("mpmice::measureSurface", measureSurface<D>, materials, with(settings_), requiresOld(p::mass),
                          all<OldSurface>(), withoutMaterial(computes(c::surfaceTemperatureBefore)),
                          withoutMaterial(computes(c::surfaceGradientBefore)));
    tasks.perPatch("mpmice::advanceSurface", advanceSurface<D>, with(settings_), requiresOld(delT),
                   gasIn(readsOld, reach), all<Reactant>(1), all<SurfaceBefore>(1), all<SurfaceNow>());
    tasks.perMaterial("mpmice::keepSurface", keepSurface<D>, materials, with(settings_),
                      withoutMaterial(requiresNew(c::surfaceTemperature)),
                      withoutMaterial(requiresNew(c::surfaceGradient)), requiresOld(p::mass), all<NewSurface>());
  }
  tasks.perPatch("mpmice::findBurning", findBurning<D>, with(settings_), gasIn(readsOld, reach), all<Reactant>(1),
                 all<KnownModes>(hasCracks(), isUnsteady(), 1), all<NewBurning<D>>());
  tasks.perPatch("mpmice::findBurntShare", findBurntShare<D>, with(settings_), startTime(), requiresOld(delT),
                 requiresNew(c::burnRate<D>, 2), requiresNew(c::burnRateWithin, 1), requiresNew(c::reactantMass, 1),
                 computes(c::burntShare));
}

template void GasAround<1>::scheduleBurning(TaskList&, const Materials&, const ParticleLabel<double>&) const;
template void GasAround<2>::scheduleBurning(TaskList&, const Materials&, const ParticleLabel<double>&) const;
template void GasAround<3>::scheduleBurning(TaskList&, const Materials&, const ParticleLabel<double>&) const;

}  // namespace tushar::mpmice
