#include <gtest/gtest.h>

#include "components/ice/gas_input.hpp"
#include "core/input/document.hpp"

// The input of a gas, as read by other components.

namespace tushar::ice {

namespace {

const std::string scene = R"(<Uintah_specification>
  <Grid><BoundaryConditions><Face side="x-">
    <BCType id="0" label="Velocity" var="Dirichlet"><value>[1,2,3]</value></BCType>
    <BCType id="1" label="Temperature" var="Dirichlet"><value>300</value></BCType>
  </Face></BoundaryConditions></Grid>
  <CFD><cfl>0.25</cfl><ICE><advection type="FirstOrder" useCompatibleFluxes="true"/></ICE></CFD>
  <PhysicalConstants><gravity>[0,-9.81,0]</gravity><reference_pressure>101325</reference_pressure></PhysicalConstants>
  <MaterialProperties>
    <MPM><material/></MPM>
    <ICE><material name="air">
      <EOS type="ideal_gas"/>
      <gamma>1.4</gamma>
      <specific_heat>716</specific_heat>
      <dynamic_viscosity>2e-5</dynamic_viscosity>
      <thermal_conductivity>0.03</thermal_conductivity>
      <isSurroundingMatl>true</isSurroundingMatl>
      <geom_object>
        <box label="all"><min>[0,0,0]</min><max>[1,1,1]</max></box>
        <res>[2,2,2]</res>
        <velocity>[1,0,0]</velocity>
        <density>1.2</density>
        <temperature>300</temperature>
        <pressure>103104</pressure>
      </geom_object>
    </material></ICE>
    <exchange_properties><exchange_coefficients>
      <momentum>[0,1e15,1e15]</momentum>
      <heat>[0,1,1]</heat>
    </exchange_coefficients></exchange_properties>
  </MaterialProperties>
</Uintah_specification>)";

}  // namespace

TEST(GasScene, TakesNoConstantOfTheGas) {
  std::string given = scene;
  given.replace(given.find(R"(<EOS type="ideal_gas"/>)"), 23,
                R"(<EOS type="ideal_gas"><gas_constant>999</gas_constant></EOS>)");
  input::Diagnostics diagnostics;
  const input::Document document = input::Document::parse(given, "gas.ups", diagnostics);
  const GasScene gas = readGas(document.root(), 1, diagnostics);
  EXPECT_FALSE(diagnostics.any()) << "as Uintah does not: it is (gamma - 1) c_v";
  EXPECT_EQ(gas.specificHeat, 716);
}

TEST(GasScene, LimitsTheRateAlongEachAxisUnlessItIsConservative) {
  const auto read = [](const std::string& control, int solids) {
    std::string given = scene;
    const auto drop = [&](const std::string& from, const std::string& to) {
      const std::size_t at = given.find(from);
      given.erase(at, given.find(to, at) + to.size() - at);
    };
    if (solids == 0)
      drop("<MPM>", "</MPM>"), drop("<exchange_properties>", "</exchange_properties>"), drop("<Face", "</Face>");
    given.replace(given.find("<ICE>"), 5, "<ICE>" + control);
    input::Diagnostics diagnostics;
    const input::Document document = input::Document::parse(given, "gas.ups", diagnostics);
    const GasScene gas = readGas(document.root(), solids, diagnostics);
    EXPECT_FALSE(diagnostics.any()) << diagnostics.sorted()[0].sentence;
    return gas.gas.courant;
  };
  const auto control = [](const std::string& scheme) {
    return "<TimeStepControl><Scheme_for_delT_calc>" + scheme + "</Scheme_for_delT_calc></TimeStepControl>";
  };
  for (const std::string& words : {std::string(), control("aggressive")}) {
    EXPECT_EQ(read(words, 0).sum, 0.8);
    EXPECT_EQ(read(words, 1).sum, 0.5) << "bodies may half fill a cell";
    EXPECT_EQ(read(words, 1).number, 0.25);
  }
  EXPECT_FALSE(read(control("conservative"), 1).sum);
}

TEST(GasScene, HasWhatTheSceneSays) {
  input::Diagnostics diagnostics;
  const input::Document document = input::Document::parse(scene, "gas.ups", diagnostics);
  const GasScene gas = readGas(document.root(), 1, diagnostics);
  ASSERT_FALSE(diagnostics.any()) << diagnostics.sorted()[0].sentence;
  EXPECT_TRUE(diagnostics.notes().empty());
  EXPECT_EQ(gas.gas.courant.number, 0.25);
  EXPECT_EQ(gas.gas.method.reconstruction, euler::Reconstruction::firstOrder);
  EXPECT_EQ(gas.gas.gas.gamma, 1.4);
  EXPECT_EQ(gas.gas.gas.material, 1);
  EXPECT_EQ(gas.specificHeat, 716);
  EXPECT_EQ(gas.viscosity, 2e-5);
  EXPECT_EQ(gas.conductivity, 0.03);
  EXPECT_EQ(gas.gravity, Vec3(0, -9.81, 0));
  EXPECT_EQ(gas.referencePressure, 101325);
  ASSERT_EQ(gas.gas.objects.size(), 1U);
  EXPECT_EQ((*gas.gas.objects[0].temperature)(Vec3::Zero()), 300);
  ASSERT_TRUE(gas.exchange);
  EXPECT_EQ(gas.exchange->momentum, (std::vector<double>{0, 1e15, 1e15}));
  EXPECT_EQ(gas.exchange->heat, (std::vector<double>{0, 1, 1}));
}

TEST(GasScene, CountsSolidsBeforeTheGas) {
  input::Diagnostics diagnostics;
  const input::Document document = input::Document::parse(scene, "gas.ups", diagnostics);
  readGas(document.root(), 0, diagnostics);
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics.sorted()[0].sentence, "there is no material 1: the gas has index 0");
}

TEST(GasScene, RefusesATemperatureAtASideThatDensityAndPressureContradict) {
  const auto problemOf = [](const std::string& temperature) {
    const std::string sides =
        "<BCType id=\"1\" label=\"Density\" var=\"Dirichlet\"><value>1.2</value></BCType>"
        "<BCType id=\"0\" label=\"Pressure\" var=\"Dirichlet\"><value>103104</value></BCType>"
        "<BCType id=\"1\" label=\"Temperature\" var=\"Dirichlet\"><value>" +
        temperature + "</value></BCType>";
    const std::size_t old = scene.find("<BCType id=\"1\""), end = scene.find("  </Face>");
    input::Diagnostics diagnostics;
    const std::string text = scene.substr(0, old) + sides + scene.substr(end);
    const input::Document document = input::Document::parse(text, "gas.ups", diagnostics);
    readGas(document.root(), 1, diagnostics);
    return diagnostics.any() ? diagnostics.sorted()[0].sentence : "";
  };
  EXPECT_EQ(problemOf("300.1"), "") << "1.2 kg/m³ and 103104 Pa make 300 K";
  EXPECT_EQ(problemOf("500"),
            "found 500 K, but the Density, at gas.ups:4:6, and the Pressure, at gas.ups:4:80, give 300 K; keep two of "
            "the three");
  EXPECT_EQ(problemOf("300 + x"), "the temperature already follows from Density and Pressure; keep two of the three");
}

}  // namespace tushar::ice
