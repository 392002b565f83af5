#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/tilted_tube.hpp"

namespace tushar::reference {

namespace {

struct State {
  double density = 0, pressure = 0, velocity = 0;
  std::optional<double> gamma, pInfinity;
};
const input::Schema<State>& stateSchema() {
  static const input::Schema<State> schema =
      input::Schema<State>("left", "A uniform gas.")
          .required("density", &State::density, "kg/m^3", "rho", input::nonNegative())
          .required("pressure", &State::pressure, "Pa", "p", input::nonNegative())
          .value("velocity", &State::velocity, 0, "m/s", "u, along the normal")
          .optional("gamma", &State::gamma, "1", "value for this gas, if the two gases differ", input::greaterThan(1))
          .ours()
          .optional("p_infinity", &State::pInfinity, "Pa", "value for this gas, if the two gases differ",
                    input::nonNegative())
          .ours();
  return schema;
}

struct RiemannSection : GasTags {
  State left, right;
  double diaphragm = 0.5;
  Vec3 normal = Vec3::UnitX();
  std::optional<double> mirror;
};
const input::Schema<RiemannSection>& riemannSchema() {
  static const input::Schema<RiemannSection> schema =
      gasSchema<RiemannSection>("exactRiemann", "Errors relative to the exact solution of a shock tube (Toro, ch. 4).")
          .value("p_infinity", memberOf<RiemannSection>(&GasTags::pInfinity), 0, "Pa", "stiffness of the gas",
                 input::nonNegative())
          .ours()
          .requiredSection("left", &RiemannSection::left, stateSchema(), "the gas below the diaphragm")
          .ours()
          .requiredSection("right", &RiemannSection::right, stateSchema(), "the gas above the diaphragm")
          .ours()
          .value("normal", &RiemannSection::normal, Vec3::UnitX(), "1",
                 "direction of the tube; its length does not matter")
          .ours()
          .value("diaphragm", &RiemannSection::diaphragm, 0.5, "m",
                 "at t = 0, the gases meet where normal · x has this value")
          .ours()
          .optional(
              "mirror", &RiemannSection::mirror, "m",
              "the tube is mirrored where normal · x has this value, and again half a period of the grid further along")
          .ours()
          .check([](const RiemannSection& read, const input::Element& element, input::Diagnostics& diagnostics) {
            if (read.normal.isZero(0)) diagnostics.error(element, "normal is [0,0,0], which is not a direction");
          });
  return schema;
}

/// The law of the gas on one side.
GasLaw gasOf(const State& side, const RiemannSection& read) {
  return {side.gamma.value_or(read.gamma), side.pInfinity.value_or(read.pInfinity)};
}

/// Length along the tube after which a periodic grid repeats [m]; 0 if it never does. Throws std::invalid_argument if
/// this length differs from axis to axis.
double periodAlong(const Vec3& normal, const grid::Level& level) {
  const grid::Domain& domain = level.domain();
  std::vector<double> lengths;
  for (int d = 0; d < 3; ++d)
    if (domain.periodic[d] != 0 && normal[d] != 0)
      lengths.push_back(std::abs(normal[d]) * (domain.upper[d] - domain.lower[d]));
  if (lengths.empty()) return 0;
  const double period = *std::min_element(lengths.begin(), lengths.end());
  for (const double length : lengths)
    if (std::abs(std::remainder(length, period)) > 1e-9 * period)
      throw std::invalid_argument(
          fmt::format("normal: in this direction the grid has a period of {:g} m for one axis, but {:g} m for another",
                      period, length));
  return period;
}

/// Throws std::invalid_argument for a diaphragm outside the grid.
void checkDiaphragm(double position, const Vec3& normal, const grid::Domain& domain) {
  const Vec3 lower = normal.cwiseProduct(domain.lower), upper = normal.cwiseProduct(domain.upper);
  const double first = lower.cwiseMin(upper).sum(), last = lower.cwiseMax(upper).sum();
  if (position < first || position > last)
    throw std::invalid_argument(
        fmt::format("diaphragm: {:g} m along the normal is outside the grid, which extends from {:g} to {:g} m",
                    position, first, last));
}

ReferencePointer tubeOn(const grid::Level& level, const RiemannSection& read) {
  const double length = read.normal.norm();
  const Vec3 normal = read.normal / length, axes = axesOf(level);
  for (int d = 0; d < 3; ++d)
    if (normal[d] != 0 && axes[d] == 0)
      throw std::invalid_argument(
          fmt::format("normal: points along {}, but this grid does not use {}", "xyz"[d], "xyz"[d]));
  RiemannProblem problem;
  problem.left = {read.left.density, read.left.velocity, read.left.pressure};
  problem.right = {read.right.density, read.right.velocity, read.right.pressure};
  problem.gas = gasOf(read.left, read);
  problem.rightGas = gasOf(read.right, read);
  problem.diaphragm = read.diaphragm / length;
  TubePlacement placement{normal, {}, periodAlong(normal, level)};
  if (placement.period == 0) checkDiaphragm(problem.diaphragm, normal, level.domain());
  if (read.mirror) placement.mirror = *read.mirror / length;
  if (normal.maxCoeff(&problem.axis) == 1 && !read.mirror && placement.period == 0)
    return std::make_shared<ExactRiemann>(problem);
  return std::make_shared<TiltedTube>(problem, placement);
}

}  // namespace

simulation::AnalysisKind exactRiemannKind() {
  return gasModule(
      "exactRiemann", "errors relative to the exact solution of a shock tube", riemannSchema,
      [](const RiemannSection& read, const grid::Level& level) { return tubeOn(level, read); },
      [](const RiemannSection& read) {
        return std::vector{gasOf(read.left, read), gasOf(read.right, read)};
      });
}

}  // namespace tushar::reference
