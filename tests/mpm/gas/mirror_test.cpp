#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tests/mpm/gas/gas_scene.hpp"

// The mirror image of a scene in two and three dimensions, with the conserving methods.

namespace tushar::mpm::gas {

namespace {

const std::vector<std::string> methods{
    "<conserving_gas_dynamics/>", "<conserving_gas_dynamics><remap><every>4</every></remap></conserving_gas_dynamics>",
    "<conserving_gas_dynamics><transfer>affine_flip</transfer><remap><every>4</every></remap></"
    "conserving_gas_dynamics>"};

using Signs = std::array<int, 3>;  ///< -1 along the axes that are mirrored, 1 along the others.

struct Body {
  std::array<double, 3> lower, upper, velocity;
  double density, pressure;
};

/// Bodies that fill the box from -1 to 1 m without any symmetry.
const std::vector<Body> bodies{{{-1, -1, -1}, {-.25, 1, 1}, {.3, .2, .1}, 1, 1},
                               {{-.25, -1, -1}, {1, 0, 1}, {-.2, .5, -.2}, .5, .4},
                               {{-.25, 0, -1}, {.5, 1, .25}, {.1, -.3, .2}, .2, .3},
                               {{-.25, 0, .25}, {.5, 1, 1}, {.2, .1, -.4}, .4, .2},
                               {{.5, 0, -1}, {1, 1, 1}, {-.4, -.1, .3}, .8, 2}};

std::string geomObject(const Body& body, const Signs& signs) {
  std::array<double, 3> lower, upper, velocity;
  for (std::size_t d = 0; d < 3; ++d) {
    std::tie(lower[d], upper[d]) = std::minmax({signs[d] * body.lower[d], signs[d] * body.upper[d]});
    velocity[d] = signs[d] * body.velocity[d];
  }
  return fmt::format(
      "<geom_object><box><min>[{}]</min><max>[{}]</max></box><res>[1,1,1]</res><velocity>[{}]</velocity>"
      "<density>{}</density><pressure>{}</pressure></geom_object>",
      fmt::join(lower, ","), fmt::join(upper, ","), fmt::join(velocity, ","), body.density, body.pressure);
}

/// Returns a geom_object, mirrored by `signs`, whose values vary within cells.
std::string varying(const Signs& signs) {
  const std::string x = fmt::format("({}*x)", signs[0]), y = fmt::format("({}*y)", signs[1]);
  return fmt::format(
      "<geom_object><box><min>[-1,-1,-1]</min><max>[1,1,1]</max></box><res>[1,1,1]</res>"
      "<velocity>[{2}*(0.3+0.5*sin(2*{0}-{1})), {3}*(0.2+0.5*cos(3*{0}+{1})), 0]</velocity>"
      "<density>1+0.4*sin(3*{0}+1)*cos(2*{1})</density><pressure>1+0.9*sin(5*{0}+2*{1})</pressure></geom_object>",
      x, y, signs[0], signs[1]);
}

/// Returns position, velocity and energy of each particle, mirrored back and sorted.
std::vector<std::array<double, 7>> run(const std::string& gas, const std::string& method, const Signs& signs,
                                       const std::string& resolution) {
  GasScene scene(
      "<Uintah_specification><Meta><title>box</title></Meta><SimulationComponent "
      "type='mpm'/><Time><maxTime>.3</maxTime>"
      "</Time><Grid>" +
      walls() + "<Level><Box label='box'><lower>[-1,-1,-1]</lower><upper>[1,1,1]</upper><resolution>[" + resolution +
      "]</resolution></Box></Level></Grid><DataArchiver><filebase>box.uda</filebase></DataArchiver>"
      "<MPM><time_integrator>explicit</time_integrator>" +
      method +
      "</MPM><MaterialProperties><MPM><material name='gas'>"
      "<constitutive_model type='ideal_gas'><gamma>1.4</gamma></constitutive_model>" +
      gas + "</material></MPM></MaterialProperties></Uintah_specification>");
  const auto x = scene.values("p.x"), velocity = scene.values("p.velocity"), energy = scene.values("p.internalEnergy");
  std::vector<std::array<double, 7>> particles(energy.size());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    for (std::size_t d = 0; d < 3; ++d) {
      particles[p][d] = signs[d] * x[3 * p + d] + 0.0;  // no -0
      particles[p][3 + d] = signs[d] * velocity[3 * p + d] + 0.0;
    }
    particles[p][6] = energy[p];
  }
  std::sort(particles.begin(), particles.end());
  return particles;
}

/// Returns the geometry of all bodies; planeOf() returns that of the bodies which the plane in the middle of z cuts.
std::string boxOf(const Signs& signs) {
  std::string all;
  for (const Body& body : bodies) all += geomObject(body, signs);
  return all;
}
std::string planeOf(const Signs& signs) {
  std::string all;
  for (const Body& body : bodies)
    if (body.lower[2] < 0) all += geomObject(body, signs);
  return all;
}

}  // namespace

TEST(Mirror, ImageOfAPlaneHasTheMirroredBits) {
  for (const std::string& method : methods) {
    const auto ours = run(planeOf({1, 1, 1}), method, {1, 1, 1}, "24,20,1");
    EXPECT_GE(ours.size(), 480u);  // some are halved
    for (const Signs& signs : {Signs{-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}})
      EXPECT_EQ(ours, run(planeOf(signs), method, signs, "24,20,1")) << method << ' ' << signs[0] << ' ' << signs[1];
  }
}

TEST(Mirror, ImageOfABoxHasTheMirroredBits) {
  const auto ours = run(boxOf({1, 1, 1}), methods.front(), {1, 1, 1}, "8,8,8");
  for (const Signs& signs : {Signs{-1, 1, 1}, {1, 1, -1}, {-1, -1, -1}})
    EXPECT_EQ(ours, run(boxOf(signs), methods.front(), signs, "8,8,8"))
        << signs[0] << ' ' << signs[1] << ' ' << signs[2];
}

TEST(Mirror, ImageOfAGasThatVariesHasTheMirroredBits) {
  const auto ours = run(varying({1, 1, 1}), methods.front(), {1, 1, 1}, "24,20,1");
  for (const Signs& signs : {Signs{-1, 1, 1}, {1, -1, 1}})
    EXPECT_EQ(ours, run(varying(signs), methods.front(), signs, "24,20,1")) << signs[0] << ' ' << signs[1];
}

}  // namespace tushar::mpm::gas
