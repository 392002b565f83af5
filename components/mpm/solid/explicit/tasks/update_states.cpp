#include "components/mpm/solid/explicit/tasks/update_states.hpp"

#include <Eigen/LU>

#include "components/mpm/solid/explicit/tasks/deform_particles.hpp"

namespace tushar::mpm::solid {

namespace {

/// The results of a constitutive model for up to stressGroup particles, besides their stresses and wave speeds.
struct StressResults {
  std::array<double, stressGroup> bulkSpeed;      ///< bulk speed [m/s]
  std::array<double, stressGroup> energyDensity;  ///< strain energy density [J/m^3 of the initial volume]
};

/// Passes the positions and masses of the particles from `first` on, and the time, to a model that reads them.
template <int D>
void placePoints(const Level& level, const StateUpdate<D>& u, double time, int first,
                 std::array<Vec3, stressGroup>& positions, StressPoints& points) {
  for (int k = 0; k < points.count; ++k) positions[k] = level.expandPoint<D>(u.x[first + k]);
  points.position = positions.data();
  points.mass = u.mass.values() + first;
  points.time = time;
}

/// The particles starting with `first`, in the form for a constitutive model. `velocityGradient` points to L of the
/// first particle.
template <int D>
StressPoints stressPoints(const StateUpdate<D>& u, double dt, const Matrix3* velocityGradient, int first, int count,
                          double* waveSpeed, StressResults& results) {
  const auto of = [&](const auto& view) { return view ? valuesOf(view) + first : nullptr; };
  return {.count = count,
          .timeStep = dt,
          .oldDeformationGradient = u.oldDeformation.values() + first,
          .deformationGradient = u.deformation.values() + first,
          .velocityGradient = velocityGradient,
          .temperature = of(u.temperature),
          .oldStress = of(u.oldStress),
          .stress = of(u.stress),
          .state = u.state ? valuesOf(u.state) + first * u.stateSize : nullptr,
          .stateStride = u.stateSize,
          .waveSpeed = waveSpeed,
          .bulkSpeed = u.viscosity ? results.bulkSpeed.data() : nullptr,
          .temperatureChange = of(u.temperatureChange),
          .strainEnergyDensity = u.strainEnergy ? results.energyDensity.data() : nullptr};
}

/// Heats a particle by the work of the artificial viscosity while its volume per mass grows by `growth` [m^3/kg].
template <int D>
void heatByViscosity(const Material& material, double growth, const StateUpdate<D>& u, int p) {
  const double heat = -(*u.viscosity)[p] * growth;
  if (u.temperatureChange) {
    const double temperature = u.temperature ? (*u.temperature)[p] : 0.0;
    (*u.temperatureChange)[p] +=
        heat / material.model->heatCapacity(u.deformation[p], temperature, material.specificHeat);
  }
  material.model->addViscousHeat(valuesOf(u.state) + p * u.stateSize, heat);
}

/// Updates the artificial viscosity of particles starting with `first`, and its heat; the arrays of velocity gradients
/// and bulk wave speeds [m/s] start with the first particle.
template <int D>
void updateViscosity(const Material& material, const Method& method, double dt, const StateUpdate<D>& u,
                     const Matrix3* velocityGradient, const double* bulkSpeed, int first, int count) {
  const ArtificialViscosity own =
      material.model->ownViscosity().value_or(method.viscosity.value_or(ArtificialViscosity{}));
  const bool heated = method.viscosityHeats && material.model->hasViscousHeat();
  const double undeformed = material.undeformedDensity();
  double* const viscosity = valuesOf(u.viscosity);
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const double jump = std::max(-velocityGradient[k].trace(), 0.0) * method.meanWidth;
    const double density = undeformed / u.deformation[p].determinant();
    viscosity[p] = density * jump * (own.linear * bulkSpeed[k] + own.quadratic * jump);
    if (heated) heatByViscosity(material, velocityGradient[k].trace() * dt / density, u, p);
  }
}

/// Computes the strain energy of particles starting with `first` from its density [J/m^3 of the volume at F = I]; 0 for
/// failed particles that lose stress.
template <int D>
void updateStrainEnergy(const Material& material, const StateUpdate<D>& u, const double* density, int first,
                        int count) {
  const double undeformed = material.undeformedDensity();
  double* const energy = valuesOf(u.strainEnergy);
  const int* const localized = valuesOf(u.localized);
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const bool bears = !localized || !localized[p] || material.erosion.keepsStress();
    energy[p] = bears ? density[k] * u.mass[p] / undeformed : 0.0;
  }
}

/// Updates stress, artificial viscosity and strain energy of up to stressGroup particles, if they are stored, and
/// computes the wave speeds [m/s].
template <int D>
void updateStress(const Level& level, const Material& material, const Method& method, double time, double dt,
                  const StateUpdate<D>& u, const Matrix3* velocityGradient, int first, int count, double* waveSpeed) {
  if (u.state)
    std::copy_n(valuesOf(u.oldState) + first * u.stateSize, count * u.stateSize,
                valuesOf(u.state) + first * u.stateSize);
  StressResults results;
  StressPoints points = stressPoints(u, dt, velocityGradient, first, count, waveSpeed, results);
  std::array<Vec3, stressGroup> positions;
  if (material.model->usesPlaceAndTime()) placePoints<D>(level, u, time, first, positions, points);
  material.model->updateStress(material.density, points);
  if (u.viscosity) updateViscosity(material, method, dt, u, velocityGradient, results.bulkSpeed.data(), first, count);
  if (u.strainEnergy) updateStrainEnergy(material, u, results.energyDensity.data(), first, count);
}

}  // namespace

template <int D>
Matrix3* MovedParticles<D>::add(const Index<D>& cell, const data::ParticleRange& range) {
  cells.add(cell, range);
  if (velocityGradient.size() < static_cast<std::size_t>(cells.count())) {
    velocityGradient.resize(std::max(cells.count(), stressGroup));
    waveSpeed.resize(velocityGradient.size());
  }
  return velocityGradient.data() + (range.first - cells.first());
}

template <int D>
void updateStates(const Level& level, const Material& material, const Method& method, double time, double dt,
                  const StateUpdate<D>& u, const CrossingRate<D>& none, const BetweenPlanes<D>& space,
                  MovedParticles<D>& moved) {
  if (moved.cells.count() == 0) return;
  const int first = moved.cells.first();
  Matrix3* const velocityGradient = moved.velocityGradient.data();
  if constexpr (!updatesTogether<D>)
    moved.hasLost = deformParticles<D>(method, dt, u, first, moved.cells.count(), velocityGradient);
  finishDeformation<D>(material, u, first, moved.cells.count(), velocityGradient);
  if (moved.volumes == Volumes::shared)
    moved.cells.forEachCell([&](const Index<D>&, const data::ParticleRange& range) {
      shareVolume<D>(dt, range, u, velocityGradient + (range.first - first));
    });
  moved.cells.forEachGroup([&](int k, int count) {
    updateStress<D>(level, material, method, time, dt, u, velocityGradient + k, first + k, count,
                    moved.waveSpeed.data() + k);
  });
  moved.cells.forEachCell([&](const Index<D>& cell, const data::ParticleRange& range) {
    CrossingRate<D> rate = none;
    const double* const waveSpeed = moved.waveSpeed.data() + (range.first - first);
    rate.add(waveSpeed, u.velocity.values() + range.first, range.size());
    if (moved.hasLost || !rate.isKnown() ||
        (u.newX && !space.containAll(cell, u.newX->values() + range.first, range.size())))
      rate = withoutLost<D>(level, u, cell, range, none, space, waveSpeed);
    u.stableTimeStep.add(rate.time());
    if (u.stableTimeSteps) (*u.stableTimeSteps)[cell] = rate.time();
  });
  moved.cells.clear();
  moved.hasLost = false;
}

template struct MovedParticles<1>;
template struct MovedParticles<2>;
template struct MovedParticles<3>;
template void updateStates(const Level&, const Material&, const Method&, double, double, const StateUpdate<1>&,
                           const CrossingRate<1>&, const BetweenPlanes<1>&, MovedParticles<1>&);
template void updateStates(const Level&, const Material&, const Method&, double, double, const StateUpdate<2>&,
                           const CrossingRate<2>&, const BetweenPlanes<2>&, MovedParticles<2>&);
template void updateStates(const Level&, const Material&, const Method&, double, double, const StateUpdate<3>&,
                           const CrossingRate<3>&, const BetweenPlanes<3>&, MovedParticles<3>&);

}  // namespace tushar::mpm::solid
