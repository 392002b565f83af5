#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/fibre_elasticity.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"

namespace tushar::mpm::solid {

/// Ligament: Mooney-Rivlin rubber with fibres in one direction; see FibreElasticity.
struct TransIsoHyper : FibreElasticity {
  struct State {
    double stretch;  ///< stretch of the fibres [1]
  };
  using Capabilities = CapabilityList<capability::AbsentVariables, capability::IgnoresTemperature,
                                      capability::NominalTangent, capability::BulkSpeed, capability::InitialWaveSpeed>;
  static constexpr std::array<StateVariable, 1> stateVariables{{{"p.stretch", "1", "stretch of the fibres"}}};
  static constexpr std::array<StateVariable, 1> absentVariables{{{"p.fail", "1", "0: no particle fails"}}};
  static constexpr std::string_view name = "trans_iso_hyper";
  static constexpr bool strainEnergyIsRate = false;

  static const input::Schema<TransIsoHyper>& schema() {
    static const input::Schema<TransIsoHyper> schema = [] {
      input::Schema<TransIsoHyper> tags{name, "Rubber with fibres in one direction, such as a ligament."};
      addTags(tags);
      return tags;
    }();
    return schema;
  }
  State initialState() const { return {1}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State& state) const {
    const Point at(*this, d.deformationGradient);
    state.stretch = at.stretch * std::cbrt(at.j);
    return elasticStress(at) / at.j;
  }
  Matrix9 nominalTangent(const Deformation& d, const Matrix3&, const State&) const {
    const Point at(*this, d.deformationGradient);
    return solid::nominalTangent(d.deformationGradient, elasticStress(at),
                                 [&](const Matrix3& h) { return elasticChange(at, h); });
  }
  double initialWaveSpeed(double initialDensity) const { return std::sqrt(initialModulus() / initialDensity); }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const Point at(*this, d.deformationGradient);
    return std::sqrt(largestModulus(at) * at.j / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State&) const {
    return elasticEnergy(d.deformationGradient);
  }
};
static_assert(ConstitutiveModel<TransIsoHyper>);

}  // namespace tushar::mpm::solid
