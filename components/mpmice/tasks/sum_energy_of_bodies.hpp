#pragma once

#include "components/mpm/solid/constitutive/comp_mooney_rivlin.hpp"
#include "components/mpm/solid/constitutive/comp_neo_hook.hpp"
#include "components/mpm/solid/constitutive/rigid.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// Whether the body stores strain energy, as a function of F. The stress of a rigid body does no work.
inline bool storesStrain(const mpm::solid::Material& material) {
  const auto name = material.model->name();
  return !material.isRigid && !material.isDamageable() &&
         (name == mpm::solid::CompNeoHook::name || name == mpm::solid::CompMooneyRivlin::name);
}

/// Whether the energy of bodies is known without the history of their particles: they store all strain, or none.
inline bool isEnergyKnown(const std::vector<mpm::solid::Material>& materials) {
  for (const mpm::solid::Material& material : materials)
    if (!storesStrain(material) && !material.isRigid && material.model->name() != mpm::solid::Rigid::name) return false;
  return true;
}

/// Adds the strain energy of the particles of a body that stores it [J]: the energy density of its model at F, times
/// the volume at F = I.
inline void addStrainEnergy(const mpm::solid::Material& material, ParticleView<const double> mass,
                            ParticleView<const mpm::solid::Matrix3> deformation, Sum& total) {
  using mpm::solid::stressGroup;
  const std::vector<mpm::solid::Matrix3> atRest(stressGroup, mpm::solid::Matrix3::Zero());
  std::array<double, stressGroup> density{}, speed{};
  const double undeformed = material.undeformedDensity();
  WideSum sum(total);
  for (int first = 0; first < mass.owned(); first += stressGroup) {
    const int count = std::min(stressGroup, mass.owned() - first);
    const mpm::solid::Matrix3* f = deformation.values() + first;
    material.model->updateStress(material.density, {.count = count,
                                                    .oldDeformationGradient = f,
                                                    .deformationGradient = f,
                                                    .velocityGradient = atRest.data(),
                                                    .waveSpeed = speed.data(),
                                                    .strainEnergyDensity = density.data()});
    sum.addAll(count, [&](int k) { return density[k] * mass[first + k] / undeformed; });
  }
}

/// Computes the kinetic and strain energy of a body and, if its temperature is given, its heat m c T [J].
template <int D>
void sumEnergyOfBody(const Patch&, const mpm::solid::Material& material, ParticleView<const double> mass,
                     ParticleView<const Vec<D>> velocity, ParticleView<const mpm::solid::Matrix3> deformation,
                     const std::optional<ParticleView<const double>>& temperature, Sum& total) {
  if (storesStrain(material)) addStrainEnergy(material, mass, deformation, total);
  const double specificHeat = material.specificHeat;
  WideSum(total).addAll(mass.owned(), [&](int p) {
    return mass[p] * (0.5 * velocity[p].squaredNorm() + (temperature ? specificHeat * (*temperature)[p] : 0));
  });
}

}  // namespace tushar::mpmice
