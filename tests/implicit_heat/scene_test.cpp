#include <gtest/gtest.h>

#include "components/components.hpp"
#include "core/scene/scene.hpp"

// Which component reads the section <Heat>.

namespace tushar::implicit_heat {

namespace {

/// What is wrong with the scene of a sine of temperature, with some of its values overridden; empty if nothing is.
std::string problemWith(const std::vector<std::string>& overrides) {
  try {
    scene::readScene("ups/heat/sine.ups", overrides, catalogue());
  } catch (const InputError& error) {
    return error.problems().size() == 1 ? error.problems()[0].sentence : std::string(error.what());
  }
  return "";
}

}  // namespace

TEST(HeatSection, SendsImplicitStepsToTheComponentThatTakesThem) {
  EXPECT_EQ(problemWith({"Heat/time_integrator=explicit"}), "");
  EXPECT_EQ(problemWith({"Heat/time_integrator=backward_euler"}),
            "found 'backward_euler', expected explicit: for implicit steps, use <SimulationComponent "
            "type=\"implicit_heat\"/>");
}

TEST(HeatSection, IsTheSameForImplicitSteps) {
  const std::string implicit = "SimulationComponent/@type=implicit_heat";

  EXPECT_EQ(problemWith({implicit}), "");
  EXPECT_EQ(problemWith({implicit, "Heat/cfl=0.5"}), "");
  EXPECT_EQ(problemWith({implicit, "Heat/time_integrator=crank_nicolson", "Heat/Solver/solver=cg"}), "");
}

}  // namespace tushar::implicit_heat
