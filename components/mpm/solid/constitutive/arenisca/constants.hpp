#pragma once

#include <fmt/format.h>

#include <cmath>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid::arenisca {

/// The constants of Arenisca in a scene, with the symbols of its publications. Stresses are positive in tension; I1 is
/// the trace of the stress, J2 the second invariant of its deviator.
struct Constants {
  double peakI1 = 0;         ///< I1 at the vertex of the yield surface [Pa]
  double vertexSlope = 0;    ///< FSLOPE: -d(sqrt J2)/dI1 at the vertex [1]
  double strength = 0;       ///< STREN: sqrt J2 of the limit surface at high pressure [Pa]; 0: no such limit
  double pressureSlope = 0;  ///< YSLOPE: -d(sqrt J2)/dI1 at high pressure [1]
  double flowFactor = 1;     ///< beta, the factor of the deviator in the space of closest points; 1: associated flow
  double b0 = 0, b1 = 0;     ///< bulk modulus at low pressure, and its increase at high pressure [Pa]
  double b2 = 0;             ///< 3 times the pressure at which the bulk modulus increases [Pa]
  double b3 = 0,
         /// Reduction of the bulk modulus by plastic compaction [Pa], and the strain for that reduction [1].
      b4 = 0;
  double g0 = 0;             ///< shear modulus [Pa]
  double g1 = 0, g2 = 0;     ///< Poisson's ratio at low pressure, and its increase at high pressure [1]; 0: G = g0
  double p0 = 0;             ///< I1 at which pores begin to collapse [Pa]
  double p1 = 0;             ///< constant of the crush curve [1/Pa]
  double p3 = 0;             ///< volumetric strain at which all pores have collapsed [1]
  double capRatio = 0;       ///< CR: (vertex - start of the cap) / (vertex - end of the cap)
  double fluidBulk = 0;      ///< K_f, bulk modulus of the fluid [Pa]; 0: pores are empty
  double fluidPressure = 0;  ///< initial pressure of the fluid [Pa]
  double t1 = 0, t2 = 0;     ///< constants of the relaxation time t1 |D|^-t2 [s], with |D| in 1/s
  /// CR of Arenisca: ratio of height to length of the ellipse of a tangent cap; 0: capRatio is used
  double capShape = 0;
  double mostSubsteps = 256;
  int lodeType = 0;      ///< dependence on the Lode angle; 0: none, 1: Gudehus, 3: Mohr-Coulomb
  double lodeRatio = 1;  ///< psi: ratio of the strength in triaxial compression to that in extension

  /// Whether Poisson's ratio is given; otherwise G = g0.
  bool hasPoissonRatio() const { return g1 != 0 && g2 != 0; }
  /// Whether the cap is an ellipse tangent to the cone, and the moduli are constant: the model type `Arenisca`.
  bool hasTangentCap() const { return capShape > 0; }
  /// K_m, bulk modulus of the grains [Pa].
  double matrixBulk() const { return b0 + b1; }
  /// phi_0, initial porosity.
  double porosity() const { return 1 - std::exp(-p3); }
  /// C_1 = K_f (1 - phi_0) + K_m phi_0 [Pa]
  double mixedBulk() const { return fluidBulk * (1 - porosity()) + matrixBulk() * porosity(); }
  /// Whether a fluid fills the pores at a volumetric strain. At larger strains, the fluid would be in tension, and
  /// ruptures.
  bool isSaturated(double strain) const {
    return fluidBulk != 0 && strain <= mixedBulk() * fluidPressure / (fluidBulk * matrixBulk());
  }
};

/// Whether the four constants of the limit surface have one of the forms that YieldSurface supports.
inline bool hasLimit(const Constants& c) {
  const bool cone = c.vertexSlope > 0 && c.peakI1 >= 0 && c.strength == 0 && c.pressureSlope == 0;
  const bool cylinder = c.vertexSlope == 0 && c.peakI1 == 0 && c.strength > 0 && c.pressureSlope == 0;
  const bool coneToCylinder = c.vertexSlope > 0 && c.pressureSlope == 0 && c.strength > 0 && c.peakI1 == 0;
  const bool curved = c.vertexSlope > c.pressureSlope && c.pressureSlope > 0 && c.peakI1 >= 0 &&
                      c.strength > c.pressureSlope * c.peakI1;
  return cone || cylinder || coneToCylinder || curved;
}

template <class M>
void check(const M& c, const input::Element& element, input::Diagnostics& diagnostics) {
  if (!hasLimit(c))
    diagnostics.error(element,
                      "PEAKI1, FSLOPE, STREN and YSLOPE define no limit surface; allowed: FSLOPE > 0, STREN and YSLOPE "
                      "0 (a cone); STREN > 0 alone (a cylinder); FSLOPE and STREN > 0, the other two 0; FSLOPE > "
                      "YSLOPE > 0 and STREN > YSLOPE PEAKI1");
  if (c.p0 >= 0) diagnostics.error(element, "p0_crush_curve: is not below 0, but pores collapse in compression");
  if (c.p1 == 0) diagnostics.error(element, "p1_crush_curve: is 0, so pores would not collapse at any pressure");
  if (c.hasPoissonRatio())
    for (const double ratio : {c.g1, c.g1 + c.g2})
      if (ratio <= -1 || ratio >= 0.5)
        diagnostics.error(element, fmt::format("G1 and G1 + G2: Poisson's ratio is {:g}, so the shear modulus would "
                                               "not be positive; keep it between -1 and 0.5",
                                               ratio));
  if ((c.t1 > 0) != (c.t2 > 0))
    diagnostics.error(element, "T1_rate_dependence and T2_rate_dependence: one is 0, the other is positive");
  if (c.lodeType != 0 && c.lodeType != 1 && c.lodeType != 3)
    diagnostics.error(element, "J3_type: expected 0, 1 (Gudehus) or 3 (Mohr-Coulomb)");
}

/// Declares tags of a model that fill members of its Constants.
template <class M>
struct Tags {
  input::Schema<M>& schema;

  void require(const char* tag, double Constants::*member, const char* unit, const char* sentence,
               const auto&... limit) const {
    schema.required(tag, static_cast<double M::*>(member), unit, sentence, limit...);
  }
  void value(const char* tag, double Constants::*member, double otherwise, const char* unit, const char* sentence,
             const auto&... limit) const {
    schema.value(tag, static_cast<double M::*>(member), otherwise, unit, sentence, limit...);
  }
};

/// Declares the tags of the cone with a cap, the crush curve, and the rate dependence.
template <class M>
void addConeTags(input::Schema<M>& schema) {
  const Tags<M> tags{schema};
  tags.require("PEAKI1", &Constants::peakI1, "Pa", "trace of the stress at the vertex of the yield surface",
               input::nonNegative());
  tags.require("FSLOPE", &Constants::vertexSlope, "1", "slope of the limit surface at the vertex",
               input::nonNegative());
  tags.require("B0", &Constants::b0, "Pa", "bulk modulus at low pressure", input::positive());
  tags.require("G0", &Constants::g0, "Pa", "shear modulus", input::positive());
  tags.require("p0_crush_curve", &Constants::p0, "Pa", "trace of the stress at which pores begin to collapse, below 0");
  tags.require("p1_crush_curve", &Constants::p1, "1/Pa", "determines how fast the stress rises while pores collapse");
  tags.require("p3_crush_curve", &Constants::p3, "1", "volumetric strain at which all pores have collapsed",
               input::positive());
  tags.value("T1_rate_dependence", &Constants::t1, 0, "s", "relaxation time at a strain rate of 1/s",
             input::nonNegative());
  tags.value("T2_rate_dependence", &Constants::t2, 0, "1",
             "exponent with which the relaxation time decreases with the strain rate", input::nonNegative());
  tags.require("fluid_B0", &Constants::fluidBulk, "Pa", "bulk modulus of the fluid in the pores; 0 means empty pores",
               input::nonNegative());
  schema.ignored("gruneisen_parameter", "as in Uintah, it has no effect").check(check<M>);
}

/// Declares the tags of the curved limit surface, nonlinear elasticity and the fluid.
template <class M>
void addSoilTags(input::Schema<M>& schema) {
  const Tags<M> tags{schema};
  tags.require("CR", &Constants::capRatio, "1",
               "where the cap begins: 0 is the vertex of the yield surface, 1 the end of the cap",
               input::between(0, 1));
  tags.value("subcycling_characteristic_number", &Constants::mostSubsteps, 256, "1", "largest number of substeps",
             input::positive());
  tags.require("STREN", &Constants::strength, "Pa", "strength in shear at high pressure", input::nonNegative());
  tags.require("YSLOPE", &Constants::pressureSlope, "1", "slope of the limit surface at high pressure",
               input::nonNegative());
  tags.require("BETA_nonassociativity", &Constants::flowFactor, "1", "1: plastic flow is normal to the yield surface",
               input::positive());
  tags.require("B1", &Constants::b1, "Pa", "increase of the bulk modulus at high pressure", input::nonNegative());
  tags.require("B2", &Constants::b2, "Pa", "scale of the trace of the stress for the increase <B1>",
               input::nonNegative());
  tags.require("B3", &Constants::b3, "Pa", "reduction of the bulk modulus by plastic compaction", input::nonNegative());
  tags.require("B4", &Constants::b4, "1", "scale of the volumetric plastic strain for the reduction <B3>",
               input::nonNegative());
  tags.require("G1", &Constants::g1, "1", "Poisson's ratio at low pressure, instead of <G0>");
  tags.require("G2", &Constants::g2, "1",
               "increase of Poisson's ratio at high pressure; if <G1> or <G2> is 0, <G0> is used");
  for (const char* unused : {"G3", "G4", "p2_crush_curve"}) schema.ignored(unused, "as in Uintah, it has no effect");
  tags.require("fluid_pressure_initial", &Constants::fluidPressure, "Pa", "pressure of the fluid at the start",
               input::nonNegative());
}

/// Declares the tags of the cap that is tangent to the cone, for the model type `Arenisca` only.
template <class M>
void addTangentCapTags(input::Schema<M>& schema) {
  const Tags<M> tags{schema};
  tags.require("CR", &Constants::capShape, "1", "ratio of the semi-axes of the elliptical cap, along r and along z",
               input::positive());
  tags.value("p4_fluid_effect", &Constants::b1, 0, "Pa", "bulk modulus of the grains minus <B0>", input::nonNegative());
  tags.value("fluid_pressure_initial", &Constants::fluidPressure, 0, "Pa", "pressure of the fluid at the start",
             input::nonNegative());
  tags.value("subcycling_characteristic_number", &Constants::mostSubsteps, 1, "1",
             "number of substeps for every 0.1 % of strain", input::positive());
  for (const char* unused : {"FSLOPE_p", "hardening_modulus", "kinematic_hardening_constant"})
    schema.ignored(unused, "as in Uintah, it has no effect: plastic flow is associated, and the cone does not harden");
  for (const char* unused : {"internal_variable_model", "useTaylorSeriesForDefGrad", "num_taylor_terms"})
    schema.ignored(unused, "from an older Uintah, in which the other tags have the same meaning");
}

/// Declares the tags of Lode's angle, for Arenisca4 only.
template <class M>
void addLodeTags(input::Schema<M>& schema) {
  schema
      .value("J3_type", static_cast<int M::*>(&Constants::lodeType), 0, "1",
             "dependence on the Lode angle: 0 none, 1 Gudehus, 3 Mohr-Coulomb", input::nonNegative())
      .value("J3_psi", static_cast<double M::*>(&Constants::lodeRatio), 1, "1",
             "ratio of the strengths in triaxial compression and extension; the surface is convex from 7/9 to 9/7 for "
             "J3_type 1, from 1/2 to 2 for J3_type 3",
             input::between(0.5, 2))
      .ignored("principal_stress_cutoff", "as in Uintah, it has no effect");
}

}  // namespace tushar::mpm::solid::arenisca
