#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/fibre_elasticity.hpp"
#include "components/mpm/solid/constitutive/maxwell.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"

namespace tushar::mpm::solid {

/// Ligament with relaxation: the stress s_e of FibreElasticity, and six Maxwell elements driven by it, sigma = s_e +
/// sum_k y_k h_k, dh_k/dt = ds_e/dt - h_k/t_k: the quasi-linear viscoelasticity of Fung, with the recursion of Puso &
/// Weiss, J. Biomech. Eng. 120 (1998) 62, eqs. 10-14. They use the second Piola-Kirchhoff stress, and Uintah the Cauchy
/// stress in fixed axes; here the Cauchy stress in axes that rotate with the material is used, so that rotation has no
/// effect, and stretching without rotation gives Uintah's stresses.
struct ViscoTransIsoHyper : FibreElasticity {
  struct State {
    double stretch;                   ///< stretch of the fibres [1]
    Tensor elasticStress;             ///< elastic stress s_e [Pa]
    std::array<Tensor, 6> histories;  ///< histories h_k [Pa]
  };
  using Capabilities = CapabilityList<capability::AbsentVariables, capability::IgnoresTemperature,
                                      capability::NominalTangent, capability::BulkSpeed, capability::InitialWaveSpeed>;
  static constexpr std::array<StateVariable, 8> stateVariables{
      {{"p.stretch", "1", "stretch of the fibres"},
       {"p.ElasticStress", "Pa", "stress without viscosity", 9},
       {"p.history1", "Pa", "stress of the Maxwell element 1 for y1 = 1", 9},
       {"p.history2", "Pa", "stress of the Maxwell element 2 for y2 = 1", 9},
       {"p.history3", "Pa", "stress of the Maxwell element 3 for y3 = 1", 9},
       {"p.history4", "Pa", "stress of the Maxwell element 4 for y4 = 1", 9},
       {"p.history5", "Pa", "stress of the Maxwell element 5 for y5 = 1", 9},
       {"p.history6", "Pa", "stress of the Maxwell element 6 for y6 = 1", 9}}};
  static constexpr std::array<StateVariable, 1> absentVariables{{{"p.fail", "1", "0: no particle fails"}}};
  static constexpr std::string_view name = "visco_trans_iso_hyper";
  static constexpr bool strainEnergyIsRate = false;

  double y1 = 0, y2 = 0, y3 = 0, y4 = 0, y5 = 0, y6 = 0;  ///< y1, y2, y3, y4, y5 and y6 [1]
  double t1 = 0, t2 = 0, t3 = 0, t4 = 0, t5 = 0, t6 = 0;  ///< t1, t2, t3, t4, t5 and t6 [s]

  static const input::Schema<ViscoTransIsoHyper>& schema() {
    static const input::Schema<ViscoTransIsoHyper> schema = makeSchema();
    return schema;
  }
  State initialState() const { return {1, {}, {}}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State& state) const {
    const Point at(*this, d.deformationGradient);
    const Matrix3 elastic = elasticStress(at) / at.j;
    Matrix3 stress = elastic;
    if (relaxes()) {
      const Matrix3 turn = rotationOf(d.deformationGradient) * rotationOf(d.oldDeformationGradient).transpose();
      const auto turned = [&](const Tensor& old) { return Matrix3(turn * matrixOf(old) * turn.transpose()); };
      const Matrix3 change = elastic - turned(state.elasticStress);
      for (int k = 0; k < 6; ++k) {
        const auto [share, time] = element(k);
        if (time <= 0) continue;
        const MaxwellStep step(d.timeStep / time);
        const Matrix3 history = step.kept * turned(state.histories[k]) + step.gained * change;
        state.histories[k] = tensorOf(history);
        stress += share * history;
      }
    }
    state.stretch = at.stretch * std::cbrt(at.j);
    state.elasticStress = tensorOf(elastic);
    return stress;
  }
  /// Computes the tangent. With y = 1 + sum_k y_k (1 - exp(-dt/t_k)) t_k/dt, tau_e = J s_e, v = tau - y tau_e, and W
  /// the spin that h adds to the rotation: d tau = y d tau_e + tr h v + W v - v W
  Matrix9 nominalTangent(const Deformation& d, const Matrix3& oldStress, const State& old) const {
    const Matrix3& f = d.deformationGradient;
    const Point at(*this, f);
    State state = old;
    const Matrix3 tau = at.j * updateStress(d, oldStress, state);
    double stiffening = 1;
    for (int k = 0; k < 6; ++k)
      if (const auto [share, time] = element(k); time > 0) stiffening += share * MaxwellStep(d.timeStep / time).gained;
    const Matrix3 memory = tau - stiffening * elasticStress(at), stretch = f * rotationOf(f).transpose();
    return solid::nominalTangent(f, tau, [&](const Matrix3& h) {
      const Matrix3 spin = spinOf(h, stretch);
      return Matrix3(stiffening * elasticChange(at, h) + h.trace() * memory + spin * memory - memory * spin);
    });
  }
  double initialWaveSpeed(double initialDensity) const {
    return std::sqrt(fastStiffening() * initialModulus() / initialDensity);
  }
  /// The speed of a fast wave, in which all Maxwell elements act as springs.
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const Point at(*this, d.deformationGradient);
    return std::sqrt(fastStiffening() * largestModulus(at) * at.j / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  /// The energy W of the elastic stress, as in Uintah; the Maxwell elements store and dissipate the rest of the work.
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State&) const {
    return elasticEnergy(d.deformationGradient);
  }

 private:
  struct Element {
    double share;  ///< share y_k [1]
    double time;   ///< t_k [s]; 0: the element is omitted
  };
  Element element(int k) const {
    const std::array<Element, 6> all{{{y1, t1}, {y2, t2}, {y3, t3}, {y4, t4}, {y5, t5}, {y6, t6}}};
    return all[k];
  }
  bool relaxes() const { return std::max({t1, t2, t3, t4, t5, t6}) > 0; }
  /// Ratio of the stiffness in a fast deformation to the elastic stiffness.
  double fastStiffening() const {
    double sum = 1;
    for (int k = 0; k < 6; ++k)
      if (element(k).time > 0) sum += element(k).share;
    return sum;
  }

  static input::Schema<ViscoTransIsoHyper> makeSchema() {
    using Self = ViscoTransIsoHyper;
    input::Schema<Self> tags{name, "Rubber with fibres in one direction, whose stress relaxes."};
    addTags(tags);
    tags.choice("StrainEnergy", in<Self>(&FibreElasticity::rubber),
                {{"MooneyRivlin", Rubber::mooneyRivlin}, {"VerondaWestmann", Rubber::verondaWestmann}},
                Rubber::mooneyRivlin, "strain energy of the matrix; with VerondaWestmann, <c2> has no unit");
    const std::array<std::pair<double Self::*, double Self::*>, 6> members{{{&Self::y1, &Self::t1},
                                                                            {&Self::y2, &Self::t2},
                                                                            {&Self::y3, &Self::t3},
                                                                            {&Self::y4, &Self::t4},
                                                                            {&Self::y5, &Self::t5},
                                                                            {&Self::y6, &Self::t6}}};
    for (int k = 0; k < 6; ++k) {
      const std::string number = std::to_string(k + 1);
      tags.required("y" + number, members[k].first, "1",
                    "stiffness of a Maxwell element, relative to the elastic stiffness", input::nonNegative());
      tags.required("t" + number, members[k].second, "s", "relaxation time of this element; 0: the element is omitted",
                    input::nonNegative());
    }
    tags.ignored("max_fiber_strain", "only Uintah's failure_option 1 uses it")
        .ignored("max_matrix_strain", "only Uintah's failure_option 1 uses it");
    refuseSwitch(tags, "failure_option", "neither the fibres nor the matrix fail");
    refuseSwitch(tags, "active", "the stress follows from the deformation alone");
    return tags;
  }
};
static_assert(ConstitutiveModel<ViscoTransIsoHyper>);

}  // namespace tushar::mpm::solid
