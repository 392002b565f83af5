#include <gtest/gtest.h>

#include "components/ice/tasks/carry_scalar.hpp"
#include "tests/euler/gas_box.hpp"
#include "tests/support/scenes.hpp"

// Scalars that a gas carries along.

namespace tushar::ice {

namespace {

using test::changedScene;
using test::driftOf;
using Overrides = std::vector<std::string>;

const std::string scalars = "ups/ice/scalars.ups";
const Overrides coarse{"Grid/Level/Box/resolution=[32,32,1]"};

double errorOf(const std::string& scene, const Overrides& overrides, const std::string& norm = "L1") {
  return test::runScene(scene, overrides).errors.at(0).norms.at(norm);
}

/// A gas with a scalar, stepped by the bodies of the tasks alone.
template <int D>
class ScalarBox : public euler::GasBox<D> {
 public:
  using Profile = std::function<double(const Vec<D>&)>;

  ScalarBox(const grid::Domain& domain, const typename euler::GasBox<D>::Profile& gasAt, const Profile& scalarAt,
            ScalarSettings settings = {})
      : euler::GasBox<D>(domain, gasAt), scalar_(std::move(settings)), held(this->density.size()) {
    forEach<D>(this->level.cells(), [&](const Index<D>& cell) {
      const std::size_t i = this->level.template cellNumber<D>(cell);
      held[i] = this->density[i] * scalarAt(this->level.template cellCentre<D>(cell));
    });
  }

  void step(double dt) {
    using namespace euler;
    const std::vector<double> before = this->density;
    std::vector<double> newDensity(held.size()), newEnergy(held.size()), after(held.size());
    std::vector<Vec<D>> newMomentum(held.size()), below(held.size()), above(held.size());
    for (const Patch& patch : this->grid.patches()) {
      FaceMasses<D> masses;
      masses.below.emplace(seen<Vec<D>>(below, patch, 0));
      masses.above.emplace(seen<Vec<D>>(above, patch, 0));
      chooseAdvance<D>(this->method)(
          patch, this->gas,
          {{seen<const double>(this->density, patch, 2), seen<const Vec<D>>(this->momentum, patch, 2),
            seen<const double>(this->energy, patch, 2)}},
          0, dt,
          {{seen<double>(newDensity, patch, 0), seen<Vec<D>>(newMomentum, patch, 0),
            seen<double>(newEnergy, patch, 0)}},
          {{}, {}, {}, masses});
    }
    for (const Patch& patch : this->grid.patches())
      carryScalar<D>(patch, &scalar_, this->gas, true,
                     {seen<const double>(before, patch, 2), seen<const double>(held, patch, 2),
                      seen<const Vec<D>>(below, patch, 1), seen<const Vec<D>>(above, patch, 1)},
                     0, dt, seen<double>(after, patch, 0), {});
    this->density = newDensity;
    this->momentum = newMomentum;
    this->energy = newEnergy;
    held = after;
  }
  double value(std::size_t i) const { return held[i] / this->density[i]; }
  double total() const {
    Sum sum;
    for (const double one : held) sum.add(one);
    return sum.total();
  }

 private:
  template <class T, class Values>
  CellView<T> seen(Values& values, const Patch& patch, int ghost) const {
    return {values.data(), this->level.cells(), patch.cellsWithin(ghost)};
  }

  CarriedScalar scalar_;

 public:
  std::vector<double> held;
};

}  // namespace

TEST(PassiveScalar, StaysInItsRangeAndIsKeptInAWildFlow) {
  // Shocks and rarefactions of any strength, with the longest steps that the gas allows.
  ScalarBox<2> box(euler::closedBox(2, 30), euler::roughGas<2>,
                   [](const Vec<2>& x) { return std::sin(91 * x[0] + 57 * x[1] * x[1]) > 0 ? 1.0 : 0.0; });
  const double total = box.total();
  for (int step = 0; step < 30; ++step) {
    box.step(box.stableStep(0.8));
    for (std::size_t i = 0; i < box.held.size(); ++i) {
      ASSERT_GE(box.value(i), -1e-14);
      ASSERT_LE(box.value(i), 1 + 1e-14);
    }
  }
  EXPECT_NEAR(box.total() / total, 1, 1e-13);
}

TEST(PassiveScalar, ThatIsUniformStaysSo) {
  ScalarBox<2> box(euler::closedBox(2, 30), euler::roughGas<2>, [](const Vec<2>&) { return 0.7; });
  for (int step = 0; step < 30; ++step) box.step(box.stableStep(0.8));
  for (std::size_t i = 0; i < box.held.size(); ++i) EXPECT_NEAR(box.value(i), 0.7, 1e-13);
}

TEST(PassiveScalar, GoesWithTheGas) {
  EXPECT_LT(errorOf(scalars, {}), 0.0035);
  EXPECT_GT(errorOf(scalars, coarse) / errorOf(scalars, {}), 3.2);
}

TEST(PassiveScalar, SpreadsByItsDiffusivity) {
  // The product of sines decays by exp(-8 pi² D t) while it moves.
  const std::string scene =
      changedScene(changedScene(scalars, "sin(2*pi*(y-t))</value>", "sin(2*pi*(y-t))*exp(-0.008*pi^2*t)</value>"),
                   "<scalar name=\"wave\">\n          <constants><diffusivity>0<",
                   "<scalar name=\"wave\">\n          <constants><diffusivity>0.001<");
  EXPECT_LT(errorOf(scene, {}), 0.0022);
}

TEST(PassiveScalar, GoesWithTheGasInImplicitSteps) {
  const std::string scene = changedScene(
      scalars, "<TimeStepControl>", "<ImplicitSolver/><TimeStepControl><knob_for_speedSound>0</knob_for_speedSound>");
  const report::Report report = test::runScene(scene, coarse);
  EXPECT_LT(report.errors.at(0).norms.at("L1"), 0.011);
}

TEST(PassiveScalar, HasTheSameErrorsToTheBitOnAnyPatches) {
  // The flow does not depend on scalars, so they are not part of its fingerprint.
  Overrides shortened = coarse;
  shortened.push_back("Time/maxTime=0.1");
  const auto whole = test::runScene(scalars, shortened).errors.at(0).norms;
  shortened.push_back("Grid/Level/Box/patches=[4,2,1]");
  EXPECT_EQ(test::runScene(scalars, shortened).errors.at(0).norms, whole);
  EXPECT_GT(whole.at("L1"), 1e-4);
}

TEST(PassiveScalar, ComesInThroughASideThatGivesIt) {
  const std::string side =
      "<Face side=\"x-\"><BCType id=\"0\" label=\"Velocity\" var=\"Dirichlet\"><value>[1,0,0]"
      "</value></BCType><BCType id=\"0\" label=\"scalar-f\" var=\"Dirichlet\"><value>0.25"
      "</value></BCType></Face><Face side=\"z-\">";
  std::string scene = changedScene(scalars, "<Face side=\"z-\">", side);
  scene = changedScene(scene, "<periodic>[1,1,0]</periodic>", "<periodic>[0,1,0]</periodic>");
  scene = changedScene(scene, "<scalar name=\"wave\">", "<scalar name=\"f\">");
  scene = changedScene(scene, "c.scalar-wave", "c.scalar-f");
  for (const char* name : {"scalar-wave", "totalSum_scalar-wave"})
    scene = changedScene(scene, "<save label=\"" + std::string(name) + "\"/>", "");
  Overrides overrides = coarse;
  overrides.insert(overrides.end(), {"MaterialProperties/ICE/material/geom_object/velocity=[1,0,0]",
                                     "DataAnalysis/Module/value=0.25", "Time/maxTime=2"});
  EXPECT_LT(errorOf(scene, overrides, "max"), 1e-6);
}

TEST(Scalars, HaveTwoNamesAtSides) {
  const auto withInflow = [](const std::string& conditions) {
    std::string scene = changedScene(scalars, "<periodic>[1,1,0]</periodic>", "<periodic>[0,1,0]</periodic>");
    scene = changedScene(scene, "<scalar name=\"wave\">", "<scalar name=\"f\">");
    for (int saved = 0; saved < 3; ++saved) scene = changedScene(scene, "scalar-wave", "scalar-f");
    return changedScene(scene, "<BoundaryConditions>",
                        "<BoundaryConditions><Face side=\"x-\">" + conditions + "</Face>");
  };
  const auto given = [](const std::string& label) {
    return "<BCType id=\"0\" label=\"" + label + "\" var=\"Dirichlet\"><value>3</value></BCType>";
  };
  const double error = errorOf(withInflow(given("scalar-f")), coarse);
  EXPECT_NE(error, errorOf(withInflow(""), coarse));
  EXPECT_EQ(error, errorOf(withInflow(given("scalar-f_CC")), coarse));
  const std::string problem = test::problemOf(withInflow(given("scalar-f") + given("scalar-f_CC")));
  EXPECT_NE(problem.find("scalar-f already has a condition on this face, at "), std::string::npos) << problem;
}

}  // namespace tushar::ice
