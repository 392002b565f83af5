#include <gtest/gtest.h>

#include <cmath>

#include "components/ice/tasks/advance_implicitly.hpp"
#include "components/ice/tasks/limit_implicit_step.hpp"
#include "tests/euler/gas_box.hpp"

// The effect of sides of the grid on an implicit step, computed by calls of task bodies.

namespace tushar::ice {

namespace {

using Conditions = std::vector<grid::BoundaryCondition>;
namespace label = euler::boundary;

grid::BoundaryCondition given(const grid::BoundaryVariable& variable, double value) {
  return {variable, BoundaryKind::dirichlet, Vec3(value, 0, 0)};
}
grid::BoundaryCondition varying(const grid::BoundaryVariable& variable, const std::string& formula) {
  grid::BoundaryCondition condition = given(variable, 0);
  condition.formula = std::make_shared<const input::VectorExpression>(
      input::VectorExpression({*input::Expression::parse(formula), input::Expression(), input::Expression()}));
  return condition;
}

grid::Domain lineWith(const Conditions& lower, const Conditions& upper) {
  grid::Domain domain = euler::openBox(1, 4);
  domain.boundaries.face(0, 0) = lower;
  domain.boundaries.face(0, 1) = upper;
  return domain;
}

/// A line of four cells of 1/4 m with gas of 1 kg/m³ at rest and pressure 3 Pa plus a gradient `rise` [Pa/m].
class Line {
 public:
  Line(const Conditions& lower, const Conditions& upper, double rise = 0) : grid_(lineWith(lower, upper)) {
    method_.courant.number = 0.5;
    settings_.gravity = Vec3(rise, 0, 0);
    for (int i = 0; i < 4; ++i) {
      pressure_[i] = 3 + rise * level().cellCentre<1>(Index<1>{{i}})[0];
      energy_[i] = method_.gas.energyOf(1, pressure_[i]);
    }
  }

  double stableStep() {
    Minimum dt;
    limitImplicitStep<1>(patch(), method_, settings_, before(), 0, seen<const double>(pressure_, 1), dt);
    return dt.value;
  }
  /// The stable step with a viscosity [Pa s], uniform or as that of a box which holds the whole grid.
  double stableStepWith(double viscosity, bool inBox) {
    Minimum dt;
    const auto pressure = seen<const double>(pressure_, 1);
    settings_.diffusion.viscosity = viscosity;
    if (inBox) {
      settings_.diffusion = {};
      const euler::VaryingDiffusion how{.sponges = {{Vec3::Constant(-1), Vec3::Constant(2), viscosity}}};
      limitVaryingImplicitStep<1>(patch(), method_, settings_, how, before(), 0, pressure, dt);
    } else {
      limitImplicitStep<1>(patch(), method_, settings_, before(), 0, pressure, dt);
    }
    return dt.value;
  }
  /// The momentum after a step in which no pressure changes [kg/(m² s)].
  std::vector<double> momentumAfter(double dt) {
    std::vector<double> density(4), energy(4), change(4), pushed;
    std::vector<Vec<1>> momentum(4);
    advanceImplicitly<1>(patch(), method_, settings_, before(), 0, dt, seen<const double>(change, 2),
                         {{seen<double>(density, 0), seen<Vec<1>>(momentum, 0), seen<double>(energy, 0)}}, {});
    for (const Vec<1>& one : momentum) pushed.push_back(one[0]);
    return pushed;
  }
  std::optional<double> velocityAt(int face) {
    const euler::GhostRules<1> rules = euler::ghostRules<1>(level(), method_.gas);
    const Box cells = level().cells().grown(1, 1);
    GasBefore<1> gas(level(), method_.gas, settings_, rules, cells.size());
    gas.hold(cells, before());
    return gas.givenVelocity(Index<1>{{face}}, 0);
  }

 private:
  const Level& level() const { return grid_.level(); }
  const Patch& patch() const { return grid_.patches().front(); }
  euler::OldState<1> before() {
    return {{seen<const double>(density_, 2), seen<const Vec<1>>(momentum_, 2), seen<const double>(energy_, 2)}};
  }
  template <class T, class Values>
  CellView<T> seen(Values& values, int ghost) const {
    return {values.data(), level().cells(), patch().cellsWithin(ghost)};
  }

  Grid grid_;
  euler::Settings method_;
  IceSettings settings_;
  std::vector<double> density_ = std::vector<double>(4, 1.0), energy_ = std::vector<double>(4),
                      pressure_ = std::vector<double>(4);
  std::vector<Vec<1>> momentum_ = std::vector<Vec<1>>(4, Vec<1>::Zero());
};

}  // namespace

TEST(ImplicitSides, TakeFormulasInTheMiddleOfTheCellsBeyondBoth) {
  Line line({varying(label::velocity, "3 + x")}, {varying(label::velocity, "3 + x")});
  EXPECT_EQ(line.velocityAt(0), 3 - 0.125);
  EXPECT_EQ(line.velocityAt(4), 3 + 1.125);
  EXPECT_EQ(line.velocityAt(2), std::nullopt);
}

TEST(ImplicitSides, LimitStepsByWhatFlowsThroughThem) {
  EXPECT_TRUE(std::isinf(Line({given(label::velocity, 0)}, {}).stableStep())) << "nothing moves";
  const double width = 0.25, cfl = 0.5;
  EXPECT_DOUBLE_EQ(Line({given(label::velocity, 8), given(label::density, 1)}, {}).stableStep(), cfl * width / 8);
  EXPECT_DOUBLE_EQ(Line({}, {given(label::velocity, 4)}).stableStep(), cfl * width / 4);
}

TEST(ImplicitSides, LimitStepsByVaryingViscosityAsByTheSameUniformOne) {
  Line pushed({given(label::velocity, 0)}, {given(label::velocity, 0)}, 5);
  const double without = pushed.stableStepWith(0, false);
  for (const double viscosity : {0.01, 0.3, 5.0}) {
    const double uniform = pushed.stableStepWith(viscosity, false);
    EXPECT_LT(uniform, without);
    EXPECT_NEAR(pushed.stableStepWith(viscosity, true), uniform, 1e-14 * uniform);
  }
}

TEST(ImplicitSides, KeepLayersAtRestWithAVelocityAndAPressure) {
  const Conditions still{given(label::velocity, 0), varying(label::pressure, "3 - x")};
  Line line(still, still, -1);
  for (const double momentum : line.momentumAfter(0.1)) EXPECT_NEAR(momentum, 0, 1e-14);
  Line walled({given(label::velocity, 0)}, {given(label::velocity, 0)}, -1);
  for (const double momentum : walled.momentumAfter(0.1)) EXPECT_NEAR(momentum, 0, 1e-14);
  Line open({given(label::velocity, 0)}, {}, -1);
  for (const double momentum : open.momentumAfter(0.1)) EXPECT_NEAR(momentum, 0, 1e-14);
}

}  // namespace tushar::ice
