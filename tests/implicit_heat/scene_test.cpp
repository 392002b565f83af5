#include <gtest/gtest.h>

#include "components/components.hpp"
#include "core/scene/scene.hpp"

// Selection of the component that reads the section <Heat>.

namespace tushar::implicit_heat {

namespace {

/// The problem of the scene of a temperature sine, with some of its values overridden; empty if there is none.
std::string problemWith(const std::vector<std::string>& overrides) {
  try {
    scene::readScene("ups/heat/sine.ups", overrides, catalogue());
  } catch (const InputError& error) {
    return error.problems().size() == 1 ? error.problems()[0].sentence : std::string(error.what());
  }
  return "";
}

/// The place of the first problem of the scene with an override.
std::string blamed(const std::string& change) {
  try {
    scene::readScene("ups/heat/sine.ups", {change}, catalogue());
  } catch (const InputError& error) {
    return error.problems()[0].where.text();
  }
  return "";
}

}  // namespace

TEST(HeatSection, SendsImplicitStepsToTheComponentThatTakesThem) {
  EXPECT_EQ(problemWith({"Heat/time_integrator=explicit"}), "");
  EXPECT_EQ(problemWith({"Heat/time_integrator=backward_euler"}),
            "found 'backward_euler', expected explicit: for implicit steps, use <SimulationComponent "
            "type=\"implicit_heat\"/>");
  EXPECT_EQ(
      problemWith({"Heat/Solver/solver=cg"}),
      "is not available; explicit steps solve no linear system; <SimulationComponent type=\"implicit_heat\"/> does");
}

TEST(HeatSection, SendsExplicitStepsBack) {
  EXPECT_EQ(problemWith({"SimulationComponent/@type=implicit_heat", "Heat/time_integrator=explicit"}),
            "found 'explicit', expected 'backward_euler' or 'crank_nicolson': for explicit steps, use "
            "<SimulationComponent type=\"heat\"/>");
}

TEST(Overrides, AreBlamedForWhatTheyGetWrong) {
  const std::string face = "Grid/BoundaryConditions/Face[1]/BCType/";
  for (const std::string& change :
       {std::string("SimulationComponent/@type=heatt"), std::string("DataAnalysis/Module/@name=exactSolutio"),
        face + "@var=Dirichle", face + "@label=Temperatur", face + "@id=one", face + "value=cold"})
    EXPECT_EQ(blamed(change), "--set " + change);
}

TEST(HeatSection, IsTheSameForImplicitSteps) {
  const std::string implicit = "SimulationComponent/@type=implicit_heat";

  EXPECT_EQ(problemWith({implicit}), "");
  EXPECT_EQ(problemWith({implicit, "Heat/cfl=0.5"}), "");
  EXPECT_EQ(problemWith({implicit, "Heat/time_integrator=crank_nicolson", "Heat/Solver/solver=cg"}), "");
}

}  // namespace tushar::implicit_heat
