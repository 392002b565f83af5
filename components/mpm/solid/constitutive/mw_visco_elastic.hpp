#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/maxwell.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"

namespace tushar::mpm::solid {

/// A spring in parallel with a Maxwell element, each with a deviator and a pressure; Simo & Hughes, Computational
/// Inelasticity (1998), section 10.2. sigma = s_e + s_v - (p_e + p_v) I with ds_e/dt = 2 G_e dev D, dp_e/dt = -K_e tr
/// D, ds_v/dt = 2 G_v (dev D - s_v/eta_d), dp_v/dt = -K_v (tr D + 3 p_v/eta_v), as in Uintah. The stresses rotate with
/// the material; Uintah's do not.
struct MwViscoElastic {
  struct State {
    double pressure;  ///< pressure p_v [Pa]
    Tensor deviator;  ///< deviator s_v [Pa]
  };
  using Capabilities = CapabilityList<capability::IgnoresTemperature, capability::BulkSpeed>;
  static constexpr std::array<StateVariable, 2> stateVariables{
      {{"p.stress_ve_v", "Pa", "pressure of the Maxwell element"},
       {"p.stress_ve_d", "Pa", "stress deviator of the Maxwell element", 9}}};
  static constexpr std::string_view name = "mw_visco_elastic";
  static constexpr bool strainEnergyIsRate = false;

  double springShear = 0, springBulk = 0;    ///< G_e and K_e of the spring [Pa]
  double maxwellShear = 0, maxwellBulk = 0;  ///< G_v and K_v of the Maxwell element [Pa]
  double bulkViscosity = 0;                  ///< bulk viscosity eta_v [Pa s]
  double shearViscosity = 0;                 ///< shear viscosity eta_d [Pa s]

  static const input::Schema<MwViscoElastic>& schema() {
    using Self = MwViscoElastic;
    static const input::Schema<Self> schema =
        input::Schema<Self>("mw_visco_elastic", "A spring in parallel with a Maxwell element.")
            .required("e_shear_modulus", &Self::springShear, "Pa", "G_e of the spring", input::nonNegative())
            .required("e_bulk_modulus", &Self::springBulk, "Pa", "K_e of the spring", input::nonNegative())
            .required("ve_shear_modulus", &Self::maxwellShear, "Pa", "G_v of the Maxwell element", input::positive())
            .required("ve_bulk_modulus", &Self::maxwellBulk, "Pa", "K_v of the Maxwell element", input::positive())
            .required("ve_volumetric_viscosity", &Self::bulkViscosity, "Pa s",
                      "eta_v: the pressure relaxes in eta_v/(3 K_v)", input::positive())
            .required("ve_deviatoric_viscosity", &Self::shearViscosity, "Pa s",
                      "eta_d: the deviator relaxes in eta_d/(2 G_v)", input::positive());
    return schema;
  }
  State initialState() const { return {0, {}}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const Corotated step(d, oldStress);
    const MaxwellStep shear(2 * maxwellShear / shearViscosity * d.timeStep);
    const MaxwellStep volume(3 * maxwellBulk / bulkViscosity * d.timeStep);
    const Matrix3 shearing = solid::deviator(step.strain), old = step.seen(matrixOf(state.deviator));
    const double dilatation = step.strain.trace();

    const Matrix3 relaxed = shear.kept * old + shear.gained * 2 * maxwellShear * shearing;
    const double pressure = volume.kept * state.pressure - volume.gained * maxwellBulk * dilatation;
    Matrix3 stress = step.stress + 2 * springShear * shearing + relaxed - old;
    stress.diagonal().array() += springBulk * dilatation - (pressure - state.pressure);

    state.pressure = pressure;
    state.deviator = tensorOf(step.turned(relaxed));
    return step.turned(stress);
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const double modulus = springBulk + maxwellBulk + 4.0 / 3.0 * (springShear + maxwellShear);
    return std::sqrt(modulus * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt((springBulk + maxwellBulk) * d.deformationGradient.determinant() / initialDensity);
  }
  /// Energy stored in both springs: J (s:s/(4 G) + p²/(2 K)) for each.
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3& stress, const State& state) const {
    const Matrix3 viscous = matrixOf(state.deviator), elastic = solid::deviator(stress) - viscous;
    const double pressure = -stress.trace() / 3 - state.pressure;
    return d.deformationGradient.determinant() *
           (held(elastic.squaredNorm(), 4 * springShear) + held(viscous.squaredNorm(), 4 * maxwellShear) +
            held(pressure * pressure, 2 * springBulk) + held(state.pressure * state.pressure, 2 * maxwellBulk));
  }

 private:
  static double held(double squared, double modulus) { return modulus > 0 ? squared / modulus : 0; }
};
static_assert(ConstitutiveModel<MwViscoElastic>);

}  // namespace tushar::mpm::solid
