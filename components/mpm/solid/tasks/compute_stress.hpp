#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

/// Most particles that a constitutive model is given at once.
inline constexpr int stressGroup = 64;

/// Time in which a wave of speed c in a material that moves with v crosses a cell, s; the least over x, y, z.
template <int D>
double crossingTime(const Level& level, double c, const Vec<D>& v) {
  double time = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (const double h = level.cellWidth(axis); h > 0) time = std::min(time, h / c);
  for (int d = 0; d < D; ++d) time = std::min(time, level.spacing(d) / (c + std::abs(v[d])));
  return time;
}

/// The mean cell width over x, y, z, m: the length of Uintah's artificial viscosity.
inline double meanWidth(const Level& level) {
  double sum = 0;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (const double h = level.cellWidth(axis); h > 0) {
      sum += h;
      ++axes;
    }
  return sum / axes;
}

/// What the stress of each particle is made from, and what comes of it.
template <int D>
struct StressViews {
  ParticleView<const double> mass, volume;
  ParticleView<const Vec<D>> velocity;
  ParticleView<const Matrix3> oldDeformation, deformation, velocityGradient, oldStress;
  ParticleView<Matrix3> stress;
  // Null where nobody asks:
  const double* temperature;
  double *viscosity, *strainEnergy;
};

/// The values of an optional view.
template <class T>
T* valuesOf(const ParticleView<T>& view) {
  return view.owned() > 0 ? &view[0] : nullptr;
}
inline double* valuesOf(const Nothing&) { return nullptr; }

/// Updates the stress of consecutive particles of a cell and returns their least crossing time.
template <int D>
double updateStress(const Level& level, const Material& material, const Method& method, double dt,
                    const StressViews<D>& v, int first, int count) {
  std::array<double, stressGroup> waveSpeed, bulkSpeed, energyDensity;
  StressPoints points;
  points.count = count;
  points.timeStep = dt;
  points.oldDeformationGradient = &v.oldDeformation[first];
  points.deformationGradient = &v.deformation[first];
  points.velocityGradient = &v.velocityGradient[first];
  points.temperature = v.temperature ? v.temperature + first : nullptr;
  points.oldStress = &v.oldStress[first];
  points.stress = &v.stress[first];
  points.waveSpeed = waveSpeed.data();
  points.bulkSpeed = v.viscosity ? bulkSpeed.data() : nullptr;
  points.strainEnergyDensity = v.strainEnergy ? energyDensity.data() : nullptr;
  material.model->updateStress(material.density, points);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const auto at = static_cast<std::size_t>(k);
    least = std::min(least, crossingTime<D>(level, waveSpeed[at], v.velocity[p]));
    if (v.viscosity) {
      const double jump = std::max(-v.velocityGradient[p].trace(), 0.0) * meanWidth(level);
      const double density = v.mass[p] / v.volume[p];
      v.viscosity[p] = density * jump * (method.viscosity->linear * bulkSpeed[at] + method.viscosity->quadratic * jump);
    }
    if (v.strainEnergy) v.strainEnergy[p] = energyDensity[at] * v.mass[p] / material.density;
  }
  return least;
}

/// Stress of every particle, artificial viscosity and strain energy where a scene asks, and how long a step its cell may
/// take.
template <int D, bool Thermal, bool Viscous, bool Energetic>
void computeStressTensor(const Patch& patch, const Material& material, const Method& method,
                         ParticleView<const double> mass, ParticleView<const double> volume,
                         ParticleView<const Vec<D>> velocity, ParticleView<const Matrix3> oldDeformation,
                         ParticleView<const Matrix3> deformation, ParticleView<const Matrix3> velocityGradient,
                         ParticleView<const Matrix3> oldStress, double dt,
                         Optional<Thermal, ParticleView<const double>> temperature, ParticleView<Matrix3> stress,
                         Optional<Viscous, ParticleView<double>> viscosity,
                         Optional<Energetic, ParticleView<double>> strainEnergy, CellView<double> stableTimeStep) {
  const StressViews<D> views{mass,      volume, velocity,              oldDeformation,      deformation, velocityGradient,
                             oldStress, stress, valuesOf(temperature), valuesOf(viscosity), valuesOf(strainEnergy)};
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const data::ParticleRange range = mass.in(cell);
    double least = std::numeric_limits<double>::infinity();
    for (int first = range.first; first < range.last; first += stressGroup)
      least = std::min(least, updateStress<D>(patch.level(), material, method, dt, views, first,
                                              std::min(stressGroup, range.last - first)));
    stableTimeStep[cell] = least;
  });
}

/// The same of the state at the start, whose stress is 0.
template <int D>
void computeInitialTimeStep(const Patch& patch, const Material& material, ParticleView<const Vec<D>> velocity,
                            ParticleView<const double> temperature, CellView<double> stableTimeStep) {
  const Matrix3 identity = Matrix3::Identity(), zero = Matrix3::Zero();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double least = std::numeric_limits<double>::infinity();
    for (const int p : velocity.in(cell)) {
      Matrix3 stress;
      double waveSpeed = 0;
      StressPoints point;
      point.count = 1;
      point.oldDeformationGradient = point.deformationGradient = &identity;
      point.velocityGradient = point.oldStress = &zero;
      point.temperature = &temperature[p];
      point.stress = &stress;
      point.waveSpeed = &waveSpeed;
      material.model->updateStress(material.density, point);
      least = std::min(least, crossingTime<D>(patch.level(), waveSpeed, velocity[p]));
    }
    stableTimeStep[cell] = least;
  });
}

/// The least over all cells.
template <int D>
void computeStableTimeStep(const Patch& patch, const Material&, CellView<const double> stableTimeStep,
                           data::Minimum& dt) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { dt.add(stableTimeStep[cell]); });
}

}  // namespace tushar::mpm::solid
