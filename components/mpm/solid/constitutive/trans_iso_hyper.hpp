#pragma once

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <optional>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/fibre_elasticity.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"

namespace tushar::mpm::solid {

/// Ligament: Mooney-Rivlin rubber with fibres in one direction; see FibreElasticity.
///
/// With failure_option 1, the fibres fail when their stretch exceeds max_fiber_strain, and the matrix when the largest
/// shear (C1 - C3)/2 exceeds max_matrix_strain, with the greatest and the least eigenvalue of C = Fᵀ F; Ionescu,
/// Guilkey, Berzins, Kirby & Weiss, J. Biomech. Eng. 128 (2006) 917. What has failed has no stress and does not heal.
struct TransIsoHyper : FibreElasticity {
  struct State {
    double stretch;  ///< stretch of the fibres [1]
    double failure;  ///< 1 if the matrix has failed, plus 2 if the fibres have [1]
  };
  using Capabilities = CapabilityList<capability::IgnoresTemperature, capability::NominalTangent, capability::BulkSpeed,
                                      capability::InitialWaveSpeed>;
  static constexpr std::array<StateVariable, 2> stateVariables{
      {{"p.stretch", "1", "stretch of the fibres"},
       {"p.fail", "1", "0: intact, 1: the matrix has failed, 2: the fibres have failed, 3: both have"}}};
  static constexpr std::string_view name = "trans_iso_hyper";
  static constexpr bool strainEnergyIsRate = false;

  int failureOption = 0;                   ///< whether fibres and matrix may fail
  std::optional<double> mostFibreStretch;  ///< stretch at which fibres fail [1]
  std::optional<double> mostShear;         ///< shear at which the matrix fails [1]

  static const input::Schema<TransIsoHyper>& schema() {
    static const input::Schema<TransIsoHyper> schema = [] {
      input::Schema<TransIsoHyper> tags{name, "Rubber with fibres in one direction, such as a ligament."};
      addTags(tags);
      tags.choice("failure_option", &TransIsoHyper::failureOption, {{"0", 0}, {"1", 1}}, 0,
                  "1: the fibres and the matrix may fail; 0: they do not")
          .optional("max_fiber_strain", &TransIsoHyper::mostFibreStretch, "1",
                    "with failure_option 1: stretch beyond which the fibres fail", input::positive())
          .optional("max_matrix_strain", &TransIsoHyper::mostShear, "1",
                    "with failure_option 1: the matrix fails when half the difference of the largest and the smallest "
                    "eigenvalue of C = F^T F exceeds this value",
                    input::positive())
          .check(requireLimits);
      return tags;
    }();
    return schema;
  }
  State initialState() const { return {1, 0}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State& state) const {
    const Point at(*this, d.deformationGradient);
    state.stretch = at.stretch * std::cbrt(at.j);
    state.failure = failureAt(d.deformationGradient, at, state);
    return elasticStress(at, intactWith(state.failure)) / at.j;
  }
  Matrix9 nominalTangent(const Deformation& d, const Matrix3&, const State& old) const {
    const Point at(*this, d.deformationGradient);
    const IntactParts intact = intactWith(failureAt(d.deformationGradient, at, old));
    return solid::nominalTangent(d.deformationGradient, elasticStress(at, intact),
                                 [&](const Matrix3& h) { return elasticChange(at, h, intact); });
  }
  double initialWaveSpeed(double initialDensity) const { return std::sqrt(initialModulus() / initialDensity); }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const Point at(*this, d.deformationGradient);
    return std::sqrt(largestModulus(at) * at.j / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State& state) const {
    return elasticEnergy(d.deformationGradient, intactWith(state.failure));
  }

 private:
  static IntactParts intactWith(double failure) { return {failure != 1 && failure != 3, failure < 2}; }
  /// p.fail at the deformation F, if it was `old.failure` before.
  double failureAt(const Matrix3& f, const Point& at, const State& old) const {
    if (failureOption == 0) return 0;
    const IntactParts before = intactWith(old.failure);
    const Eigen::Vector3d squares =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(f.transpose() * f, Eigen::EigenvaluesOnly).eigenvalues();
    const bool matrixFails = !before.matrix || 0.5 * (squares[2] - squares[0]) > *mostShear;
    const bool fibresFail = !before.fibres || at.stretch * std::cbrt(at.j) > *mostFibreStretch;
    return (matrixFails ? 1 : 0) + (fibresFail ? 2 : 0);
  }
  static void requireLimits(const TransIsoHyper& read, const input::Element& element, input::Diagnostics& diagnostics) {
    for (const auto& [tag, given] : {std::pair{"max_fiber_strain", read.mostFibreStretch.has_value()},
                                     std::pair{"max_matrix_strain", read.mostShear.has_value()}}) {
      if (read.failureOption == 1 && !given)
        diagnostics.error(element, fmt::format("missing tag <{}>, which failure_option 1 needs", tag));
      if (read.failureOption == 0 && given)
        diagnostics.note(*element.child(tag), "does nothing without failure_option 1");
    }
  }
};
static_assert(ConstitutiveModel<TransIsoHyper>);

}  // namespace tushar::mpm::solid
