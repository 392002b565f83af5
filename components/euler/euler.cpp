#include "components/euler/euler.hpp"

#include <stdexcept>

#include "components/euler/interpolate_gas.hpp"
#include "components/euler/tasks/advance.hpp"
#include "components/euler/tasks/compute_stable_time_step.hpp"
#include "components/euler/tasks/diagnose.hpp"
#include "components/euler/tasks/initialize.hpp"
#include "components/euler/tasks/measure_error.hpp"

namespace tushar::euler {

template <int D>
void Euler<D>::scheduleInitialize(TaskList& tasks) const {
  tasks.perPatch("euler::initialize", initialize<D>, with(settings_), computes(c::density), computes(c::momentum<D>),
                 computes(c::totalEnergy));
}

template <int D>
void Euler<D>::scheduleComputeStableTimeStep(TaskList& tasks) const {
  tasks.perPatch("euler::computeStableTimeStep", computeStableTimeStep<D>, with(settings_.gas), with(settings_.courant),
                 requiresOld(c::density), requiresOld(c::momentum<D>), requiresOld(c::totalEnergy), computes(delT));
}

template <int D>
void Euler<D>::scheduleTimeAdvance(TaskList& tasks) const {
  tasks.perPatch("euler::advance", chooseAdvance<D>(settings_.method, settings_.gas), with(settings_.gas),
                 all<OldState<D>>(reach(settings_.method)), startTime(), requiresOld(delT), all<NewState<D>>(),
                 all<RimFluxes<D>>(keepsFaceMasses()));
}

template <int D>
void scheduleTotals(TaskList& tasks) {
  tasks.perPatch("euler::sumMass", sumMass<D>, requiresOld(c::density), computes(total::mass));
  tasks.perPatch("euler::sumMomentum", sumMomentum<D>, requiresOld(c::momentum<D>), computes(total::momentum));
  tasks.perPatch("euler::sumEnergy", sumEnergy<D>, requiresOld(c::totalEnergy), computes(total::energy));
  tasks.perPatch("euler::sumKineticEnergy", sumKineticEnergy<D>, requiresOld(c::density), requiresOld(c::momentum<D>),
                 computes(total::kineticEnergy));
  tasks.perPatch("euler::findLeast", findLeast<D>, requiresOld(c::density), requiresOld(c::momentum<D>),
                 requiresOld(c::totalEnergy), computes(total::leastDensity), computes(total::leastEnergy));
}

template <int D>
void Euler<D>::scheduleDiagnostics(TaskList& tasks) const {
  scheduleTotals<D>(tasks);
  tasks.perPatch("euler::sumEntropy", sumEntropy<D>, with(settings_.gas), requiresOld(c::density),
                 requiresOld(c::momentum<D>), requiresOld(c::totalEnergy), computes(total::entropy));
  tasks.perPatch("euler::computePressure", computePressure<D>, with(settings_.gas), requiresOld(c::density),
                 requiresOld(c::momentum<D>), requiresOld(c::totalEnergy), computes(c::pressure));
  tasks.perPatch("euler::computeVelocity", computeVelocity<D>, requiresOld(c::density), requiresOld(c::momentum<D>),
                 computes(c::velocity<D>));
  tasks.perPatch("euler::computeMach", computeMach<D>, with(settings_.gas), requiresOld(c::density),
                 requiresOld(c::momentum<D>), requiresOld(c::totalEnergy), computes(c::mach<D>));
  tasks.perPatch("euler::computeInternalEnergy", computeInternalEnergy<D>, requiresOld(c::density),
                 requiresOld(c::momentum<D>), requiresOld(c::totalEnergy), computes(c::internalEnergy));
}

template <int D>
void Euler<D>::scheduleAfterRefluxing(TaskList& tasks) const {
  tasks.perPatch("euler::checkRefluxed", checkRefluxed<D>, with(settings_.gas), besideFiner(), all<ChangedState<D>>());
}

template <int D>
std::vector<std::shared_ptr<const data::JointInterpolation>> Euler<D>::jointInterpolations() const {
  return {std::make_shared<const GasInterpolation<D>>(settings_.gas, carried())};
}

template <int D>
std::vector<reference::GasLaw> Euler<D>::gases() const {
  if (settings_.gas.law)
    throw std::invalid_argument(
        "the exact solution is for an ideal or stiffened gas, but the gas of the scene has another equation of state");
  return {{settings_.gas.gamma, settings_.gas.pInfinity}};
}

/// The default refinement criteria of a gas. They include the velocity, because two gases that move apart have equal
/// densities and pressures at first.
template <int D>
std::vector<simulation::Criterion> criteria() {
  std::vector<simulation::Criterion> criteria(3);
  criteria[0].variable = c::density.name;
  criteria[1].variable = c::pressure.name;
  criteria[2].variable = c::mach<D>.name;
  for (simulation::Criterion& one : criteria) {
    one.refine = 0.02;
    one.coarsen = 0.01;
  }
  return criteria;
}

template <int D>
void Euler<D>::scheduleMeasureError(TaskList& tasks, const reference::GasReference& exact,
                                    const reference::Clock& clock) const {
  tasks.perPatch("euler::measureCellError", measureCellError<D>, with(settings_.gas), with(&exact), with(&clock),
                 requiresOld(c::density), requiresOld(c::momentum<D>), requiresOld(c::totalEnergy),
                 all<reference::ErrorNorms>(&reference::cellError));
}

template std::vector<simulation::Criterion> criteria<1>();
template std::vector<simulation::Criterion> criteria<2>();
template std::vector<simulation::Criterion> criteria<3>();
template void scheduleTotals<1>(TaskList&);
template void scheduleTotals<2>(TaskList&);
template void scheduleTotals<3>(TaskList&);
template class Euler<1>;
template class Euler<2>;
template class Euler<3>;

}  // namespace tushar::euler
