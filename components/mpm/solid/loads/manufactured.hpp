#pragma once

#include <functional>
#include <memory>
#include <string>

#include "components/mpm/solid/material.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// The constants of a linear or neo-Hookean elastic material.
struct Elastic {
  double lambda, shear;  ///< Lamé's constants [Pa]
  double young;          ///< Young's modulus [Pa]
  double density;        ///< initial density [kg/m^3]
};

/// The constants of a material with the model cnh_mms.
Elastic elasticOf(const Material& material);

/// A manufactured solution, as a reference for errors: a prescribed motion, and the body force under which a
/// neo-Hookean solid moves in this way. Kamojjala, Brannon, Sadeghirad & Guilkey, Eng. Comput. 31 (2015) 193.
class Manufactured {
 public:
  virtual ~Manufactured() = default;
  /// The largest displacement at the start [m].
  virtual double farthestAtStart() const { return 0; }
  /// Displacement [m] and velocity [m/s] of the point that started at X [m].
  virtual Vec3 displacement(const Elastic& elastic, const Vec3& start, double time) const = 0;
  virtual Vec3 velocity(const Elastic& elastic, const Vec3& start, double time) const = 0;
  virtual Matrix3 deformationGradient(const Elastic& elastic, const Vec3& start, double time) const = 0;
  /// The force per mass [m/s^2] in x, y, z at a given time, as a function of the point X [m].
  virtual std::function<Vec3(const Vec3& start)> bodyForce(const Elastic& elastic, double time) const = 0;
};

/// Makes AxisAligned, ExpandingRing or GeneralizedVortex; returns null for any other name.
std::shared_ptr<const Manufactured> makeManufactured(const std::string& name);

}  // namespace tushar::mpm::solid
