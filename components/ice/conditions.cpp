#include <fmt/format.h>

#include "components/euler/labels.hpp"
#include "components/ice/gas_input.hpp"
#include "core/input/expression.hpp"
#include "core/input/schema.hpp"

// Conditions at sides of the grid in words of Uintah's ICE.

namespace tushar::ice {

using grid::BoundaryCondition;
using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

constexpr const char *wavesTag = "LODI", *sineTag = "SINE_BC", *sineVar = "Sine", *slipVar = "FreeSlipWall";

/// The tag `LODI`: a side that lets waves out.
struct WavesSection {
  double farPressure = 0, sigma = 0;
};

const Schema<WavesSection>& wavesSchema() {
  static const Schema<WavesSection> schema = [] {
    Schema<WavesSection> tags(wavesTag,
                              "Constants for sides that let waves leave, where Pressure and Velocity have var LODI.");
    tags.required("press_infinity", &WavesSection::farPressure, "Pa",
                  "far-field pressure, towards which the pressure of the gas relaxes; positive, or above -p_infinity "
                  "of a stiffened gas")
        .value("sigma", &WavesSection::sigma, 0.27, "1",
               "the pressure relaxes at the rate sigma (1 - M^2) c / L, where L is the length of the grid",
               input::nonNegative())
        .ignored("material", "all gases have one velocity and one pressure")
        .ignored("Li_scale", "waves are not scaled");
    return tags;
  }();
  return schema;
}

/// The tag `SINE_BC`: an oscillation at a side.
struct SineSection {
  double omega = 0, amplitude = 0, pressure = 0;
  Vec3 velocity = Vec3::Zero();
};

const Schema<SineSection>& sineSchema() {
  static const Schema<SineSection> schema =
      Schema<SineSection>(sineTag, "Oscillating pressures or velocities at sides with var Sine: r + A sin(omega t).")
          .required("omega", &SineSection::omega, "1/s", "2 pi times the frequency")
          .required("A", &SineSection::amplitude, "Pa or m/s", "the amplitude")
          .value("reference_pressure", &SineSection::pressure, 0, "Pa", "r for a Pressure")
          .value("reference_velocity", &SineSection::velocity, Vec3::Zero(), "m/s",
                 "r for a Velocity; components of 0 do not oscillate");
  return schema;
}

/// Reads the section of <BoundaryConditions> that a condition needs.
template <class S>
std::optional<S> sectionOf(const Schema<S>& schema, const Element& sides, const Element& condition,
                           Diagnostics& diagnostics) {
  const auto given = sides.child(schema.name());
  if (!given) {
    diagnostics.error(condition, fmt::format("needs a <{}> in <BoundaryConditions>", schema.name()));
    return {};
  }
  const std::size_t before = diagnostics.size();
  S read = schema.read(*given, diagnostics);
  return diagnostics.size() == before ? std::optional(std::move(read)) : std::nullopt;
}

std::vector<BoundaryCondition> readWaves(const std::string& label, const Element& sides, const Element& condition,
                                         Diagnostics& diagnostics) {
  const auto section = sectionOf(wavesSchema(), sides, condition, diagnostics);
  // Variables with LODI other than the pressure need no condition: they follow the waves.
  if (!section || label != euler::boundary::pressure.name) return {};
  BoundaryCondition waves{euler::boundary::waves, BoundaryKind::dirichlet};
  waves.value = Vec3(section->farPressure, section->sigma, 0);
  return {waves};
}

input::Expression swing(double middle, const SineSection& sine) {
  return *input::Expression::parse(
              fmt::format("{:.17g} + {:.17g} * sin({:.17g} * t)", middle, sine.amplitude, sine.omega))
              .value;
}

std::vector<BoundaryCondition> readSine(const std::string& label, const Element& sides, const Element& condition,
                                        Diagnostics& diagnostics) {
  const auto section = sectionOf(sineSchema(), sides, condition, diagnostics);
  if (!section || label == euler::boundary::temperature.name) return {};  // it follows from pressure and density
  if (label == euler::boundary::pressure.name) {
    BoundaryCondition one{euler::boundary::pressure, BoundaryKind::dirichlet};
    one.formula = std::make_shared<const input::VectorExpression>(
        std::array{swing(section->pressure, *section), input::Expression(), input::Expression()});
    return {one};
  }
  if (label == euler::boundary::velocity.name) {
    if (section->velocity.isZero(0))
      diagnostics.error(condition, "needs a <reference_velocity> in <SINE_BC>: components of 0 do not oscillate");
    BoundaryCondition one{euler::boundary::velocity, BoundaryKind::dirichlet};
    std::array<input::Expression, 3> components;
    for (int axis = 0; axis < 3; ++axis)
      if (section->velocity[axis] != 0) components[axis] = swing(section->velocity[axis], *section);
    one.formula = std::make_shared<const input::VectorExpression>(components);
    return {one};
  }
  diagnostics.error(condition.whereOf("var"), condition.path(),
                    "var: 'Sine' applies only to a Pressure, a Velocity or a Temperature");
  return {};
}

std::vector<BoundaryCondition> readSlip(const std::string& label, const Element& condition, Diagnostics& diagnostics) {
  if (label == euler::boundary::velocity.name) return {{grid::symmetric, BoundaryKind::symmetry}};
  diagnostics.error(condition.whereOf("var"), condition.path(), "var: 'FreeSlipWall' applies only to a Velocity");
  return {};
}

std::vector<BoundaryCondition> readCondition(const Element& sides, const Element& condition, Diagnostics& diagnostics) {
  const std::string label = condition.attribute("label").value_or(""), var = condition.attribute("var").value_or("");
  if (var == slipVar) return readSlip(label, condition, diagnostics);
  if (var == sineVar) return readSine(label, sides, condition, diagnostics);
  return readWaves(label, sides, condition, diagnostics);
}

}  // namespace

simulation::ConditionWords gasConditionWords() {
  return {.vars = {wavesTag, slipVar, sineVar},
          .sections = {{wavesTag, &wavesSchema(), false}, {sineTag, &sineSchema(), false}},
          .read = readCondition};
}

}  // namespace tushar::ice
