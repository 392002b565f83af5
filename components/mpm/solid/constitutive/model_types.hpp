#pragma once

#include <string_view>

#include "components/mpm/solid/tensor.hpp"

namespace tushar::mpm::solid {

/// Coefficients of a pressure that opposes compression, q = rho (A1 c |D| h + A2 D^2 h^2) where D = tr L < 0; von
/// Neumann & Richtmyer, with the linear term of Landshoff.
struct ArtificialViscosity {
  double linear = 0.2;     ///< A1
  double quadratic = 2.0;  ///< A2
};

/// Constants that a scene gives for a material in addition to those of its constitutive model.
struct MaterialConstants {
  double density = 0;            ///< density at the start of the run [kg/m^3]
  double specificHeat = 0;       ///< specific heat [J/(kg K)]
  double meltTemperature = 295;  ///< melting temperature [K]
  double roomTemperature = 294;  ///< room temperature [K]
};

/// The deformation of one material point in one time step.
struct Deformation {
  Matrix3 deformationGradient;     ///< F at the end of the step [1]
  Matrix3 oldDeformationGradient;  ///< F at the start of the step [1]
  Matrix3 velocityGradient;        ///< L = dv_i/dx_j in the step [1/s]
  double timeStep;                 ///< time step [s]
  double temperature;              ///< temperature [K]
  // Only for a model with capability::PlaceAndTime.
  Vec3 position = Vec3::Zero();  ///< position at the start of the step [m]
  double mass = 0;               ///< mass [kg]; per radian in axisymmetric scenes
  double time = 0;               ///< time at the start of the step [s]
};

/// Initial properties of a particle that may determine its State.
struct Birth {
  ParticleId id = 0;
  double color = 0;  ///< p.color [1]
};

/// A variable of a model's State that a scene may save by its label.
struct StateVariable {
  std::string_view label;  ///< label as in Uintah: `p.plasticStrain`
  std::string_view unit;
  std::string_view description;
  int components = 1;  ///< number of components: 1, or 9 for a Tensor
};

}  // namespace tushar::mpm::solid
