#include "components/mpm/solid/cohesive/schedule_zones.hpp"

#include "components/mpm/solid/cohesive/zone_tasks.hpp"

namespace tushar::mpm::solid {

namespace {

auto zonesOf(const Problem& problem) { return tasks::following(problem.materials, problem.zones); }

tasks::MaterialRange bodiesOf(const Problem& problem) { return {0, static_cast<int>(problem.materials.size())}; }

tasks::MaterialRange rangeOfZones(const Problem& problem) {
  const int first = static_cast<int>(problem.materials.size());
  return {first, first + static_cast<int>(problem.zones.size())};
}

}  // namespace

template <int D>
void scheduleNewZones(TaskList& tasks, const Problem& problem) {
  tasks.newParticles("mpm::createCohesiveZones", createZones<D>, zonesOf(problem), all<NewZones<D>>());
}

template <int D>
void scheduleZoneForces(TaskList& tasks, const Problem& problem) {
  tasks.perMaterial("mpm::weighCohesiveZones", weighCohesiveZones<D>, zonesOf(problem),
                    ofMaterials(bodiesOf(problem), requiresNew(g::record)), requiresOld(p::x<D>),
                    requiresOld(p::czBotMat), requiresOld(p::czTopMat), computes(p::czMassBottom),
                    computes(p::czMassTop));
  tasks.acrossMaterials("mpm::addCohesiveZoneForces", addCohesiveZoneForces<D>, problem.materials,
                        ofMaterials(rangeOfZones(problem), all<ActingZones<D>>()), modifies(g::record));
}

template <int D>
void scheduleZoneMotion(TaskList& tasks, const Problem& problem) {
  const auto records = ofMaterials(bodiesOf(problem), requiresNew(g::record));
  tasks.perMaterial("mpm::measureCohesiveWork", measureCohesiveWork<D>, zonesOf(problem), requiresOld(delT), records,
                    all<ZonePlaces<D>>(), requiresOld(p::czForce<D>), requiresOld(p::czWork), computes(p::czWork));
  tasks.perMaterial("mpm::updateCohesiveZones", updateCohesiveZones<D>, zonesOf(problem), requiresOld(delT), records,
                    all<ZoneState<D>>());
}

template <int D>
void scheduleZoneTotals(TaskList& tasks, const Problem& problem) {
  tasks.perMaterial("mpm::sumCohesiveWork", sumCohesiveWork, zonesOf(problem), requiresOld(p::czWork),
                    computes(total::cohesiveWork));
}

template void scheduleNewZones<1>(TaskList&, const Problem&);
template void scheduleNewZones<2>(TaskList&, const Problem&);
template void scheduleNewZones<3>(TaskList&, const Problem&);
template void scheduleZoneForces<1>(TaskList&, const Problem&);
template void scheduleZoneForces<2>(TaskList&, const Problem&);
template void scheduleZoneForces<3>(TaskList&, const Problem&);
template void scheduleZoneMotion<1>(TaskList&, const Problem&);
template void scheduleZoneMotion<2>(TaskList&, const Problem&);
template void scheduleZoneMotion<3>(TaskList&, const Problem&);
template void scheduleZoneTotals<1>(TaskList&, const Problem&);
template void scheduleZoneTotals<2>(TaskList&, const Problem&);
template void scheduleZoneTotals<3>(TaskList&, const Problem&);

}  // namespace tushar::mpm::solid
