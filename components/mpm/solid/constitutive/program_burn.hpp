#pragma once

#include <Eigen/LU>

#include <algorithm>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/explosive.hpp"

namespace tushar::mpm::solid {

/// An explosive with programmed burn: a detonation starts at a point, or from a plane to both sides, and moves at a
/// given velocity, independent of the pressure; Wilkins, Methods in Computational Physics 3 (1964) 211. From t_b = T0 +
/// |x - x_0| / D on, a particle of mass m burns during the time in which the detonation advances by 1.5 (m /
/// rho_0)^(1/3). sigma = -p I, where p is the average of the pressures of Murnaghan and of Jones, Wilkins and Lee,
/// weighted by the burned fraction.
struct ProgramBurn {
  struct State {
    double burned;  ///< F, burned fraction [1]
  };
  using Capabilities = CapabilityList<capability::IgnoresTemperature, capability::PlaceAndTime, capability::BulkSpeed,
                                      capability::InitialWaveSpeed>;
  static constexpr std::array<StateVariable, 1> stateVariables{{{"p.progressF", "1", "burned fraction"}}};
  static constexpr std::string_view name = "program_burn";
  static constexpr bool strainEnergyIsRate = true;

  double compressibility = 0, exponent = 0;  ///< kappa [1/Pa] and n [1] of the explosive
  double a = 0, b = 0, c = 0;                ///< A, B, C of the products [Pa]
  double r1 = 0, r2 = 0, omega = 0;          ///< R1, R2, omega of the products [1]
  double density = 0;                        ///< density rho_0 [kg/m^3]
  double detonationVelocity = 0;             ///< detonation velocity D [m/s]
  double ignitionTime = 0;                   ///< ignition time T0 [s]
  std::array<double, 3> origin{};            ///< x_0, point of ignition [m]
  /// Normal of the plane of ignition through x_0; 0: ignition at the point x_0.
  std::array<double, 3> direction{};

  static const input::Schema<ProgramBurn>& schema() {
    static const input::Schema<ProgramBurn> schema = makeSchema();
    return schema;
  }
  Murnaghan explosive() const { return {compressibility, exponent}; }
  Jwl products() const { return {a, b, c, r1, r2, omega}; }

  State initialState() const { return {0}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State& state) const {
    state.burned = burnedAt(d);
    return -mixedPressure(explosive(), products(), state.burned, volumeOf(d)) * Matrix3::Identity();
  }
  /// Wave speed of the unburned explosive [m/s].
  double initialWaveSpeed(double initialDensity) const { return speed(explosive(), density / initialDensity); }
  /// The wave speed, c² = -J² dp/dJ / rho_0. It is the larger of two speeds: that of the products, once burning has
  /// started, and that of the explosive, as long as some is left. At high compression the explosive is stiffer than the
  /// products.
  double waveSpeed(double, const Deformation& d, const Matrix3&, const State& state) const {
    const double j = volumeOf(d);
    if (state.burned <= 0) return speed(explosive(), j);
    return state.burned < 1 ? std::max(speed(products(), j), speed(explosive(), j)) : speed(products(), j);
  }
  /// Bulk wave speed: c_b² = J / (kappa rho_0), as in Uintah.
  double bulkSpeed(double, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(volumeOf(d) / (compressibility * density));
  }
  /// Returns 0 as in Uintah, so that StrainEnergy can be compared.
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }

 private:
  static double volumeOf(const Deformation& d) { return d.deformationGradient.determinant(); }
  template <class Law>
  double speed(const Law& law, double j) const {
    return j * std::sqrt(law.stiffness(j) / density);
  }

  static input::Schema<ProgramBurn> makeSchema() {
    using Self = ProgramBurn;
    input::Schema<Self> tags("program_burn", "An explosive burned by a detonation front of given velocity.");
    tags.required("K", &Self::compressibility, "1/Pa", "compressibility of the explosive", input::positive())
        .required("n", &Self::exponent, "1", "explosive: exponent of the density", input::positive())
        .required("A", &Self::a, "Pa", "products: factor of exp(-R1 V)", input::nonNegative())
        .required("B", &Self::b, "Pa", "products: factor of exp(-R2 V)")
        .required("C", &Self::c, "Pa", "products: factor of V^-(1 + om)", input::nonNegative())
        .required("R1", &Self::r1, "1", "constant in the equation of state of the products", input::positive())
        .required("R2", &Self::r2, "1", "constant in the equation of state of the products", input::positive())
        .required("om", &Self::omega, "1", "constant in the equation of state of the products", input::nonNegative())
        .required("rho0", &Self::density, "kg/m^3", "density at zero pressure", input::positive())
        .required("D", &Self::detonationVelocity, "m/s", "velocity of the detonation", input::positive())
        .value("T0", &Self::ignitionTime, 0, "s", "time at which the detonation starts")
        .ignored("P0", "it has no effect on the pressure");
    declareVector(tags, "starting_location", &Self::origin, true, "point (m) at which the detonation starts");
    declareVector(
        tags, "direction_if_plane", &Self::direction, false,
        "normal of the plane through that point on which the detonation starts; [0,0,0]: it starts at the point");
    return tags;
  }

  /// The burned fraction at the start of the step.
  double burnedAt(const Deformation& d) const {
    const Vec3 way = d.position - Vec3(origin[0], origin[1], origin[2]),
               normal(direction[0], direction[1], direction[2]);
    const double length = normal.norm();
    const double distance = length > 0 ? std::abs(normal.dot(way)) / length : way.norm();
    const double since = d.time - ignitionTime - distance / detonationVelocity;
    if (since < 0) return 0;
    constexpr double complete = 0.96;  // above it all has burned, as in Uintah
    const double fraction = since * detonationVelocity / (1.5 * std::cbrt(d.mass / density));
    return fraction > complete ? 1 : fraction;
  }
};
static_assert(ConstitutiveModel<ProgramBurn>);

}  // namespace tushar::mpm::solid
