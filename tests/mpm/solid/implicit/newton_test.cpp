#include <cmath>
#include <iostream>

#include "tests/mpm/solid/implicit/block.hpp"

// Newton's method on the equations of an implicit step.

namespace tushar::mpm::solid::implicit {

using namespace testing;

namespace {

/// Returns the order of convergence at the last Newton step whose residual is well above round-off.
double lastOrder(const std::vector<double>& r) {
  double order = 0;
  for (std::size_t k = 2; k < r.size() && r[k] > 1e-11 * r[0]; ++k)
    if (r[k - 1] < 0.1 * r[k - 2]) order = std::log(r[k] / r[k - 1]) / std::log(r[k - 1] / r[k - 2]);
  return order;
}

std::string textOf(const std::vector<double>& residuals) {
  std::string text = "residuals";
  for (const double r : residuals) text += fmt::format(" {:.3e}", r);
  return text;
}

/// Expects that Newton's method converges with its theoretical order.
template <int D>
void expectQuadraticConvergence(ImplicitSystem<D>& system) {
  std::vector<double> u = system.guess();
  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, direct(), u);
  std::cout << textOf(outcome.residuals) << '\n';
  ASSERT_TRUE(outcome.converged) << outcome.reason;
  EXPECT_GT(lastOrder(outcome.residuals), 1.8) << textOf(outcome.residuals);
}

/// Returns the force [N] that stretches a square plate of 4 m between rigid ends by 1 % (one half, by symmetry),
/// relative to slip-line theory: 2/sqrt(3) Y per m² (R. Hill, The Mathematical Theory of Plasticity, 1950). The flow
/// hardly changes the volume.
double pull(bool sharesVolume) {
  constexpr double yieldStress = 2e3, length = 4;
  auto model = withModuli<CompNeoHookPlastic>(8e7, 2e5);
  model.yieldStress = yieldStress;
  model.hardeningModulus = 1e3;
  Block<LinearShape<2>> block(modelOf(model), {{4, 2, 1}});
  block.sharesVolume = sharesVolume;
  ImplicitSystem<2> system = block.system(false);
  for (int k = 0; k < system.nodes().size(); ++k)
    if (system.nodes().node(k)[0] == length)
      for (int d = 0; d < 2; ++d) system.prescribe(k, d, d == 0 ? 0.01 * length : 0.0);
  clamp(system);
  std::vector<double> u = system.guess();
  EXPECT_TRUE(solvers::solver().solve(system.unknowns(), system, direct(), u).converged);
  double force = 0;
  for (int k = 0; k < system.nodes().size(); ++k)
    if (system.nodes().node(k)[0] == length) force += system.reactions()[2 * k];
  return force / (2 / std::sqrt(3.0) * yieldStress * length / 2);
}

/// Returns the deflection [m] of a cantilever's free end under its weight, with Poisson's ratio .4999.
double sinking(const Index3& cells, double gravity, bool sharesVolume) {
  CompNeoHook model = rubber();
  model.bulkModulus = 2 * model.shearModulus * (1 + 0.4999) / (3 * (1 - 2 * 0.4999));
  Block<LinearShape<2>> block(modelOf(model), cells);
  block.method.gravity = {0, gravity, 0};
  block.sharesVolume = sharesVolume;
  ImplicitSystem<2> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();
  EXPECT_TRUE(solvers::solver().solve(system.unknowns(), system, direct(), u).converged);
  double lowest = 0;
  for (int k = 0; k < system.nodes().size(); ++k) lowest = std::min(lowest, system.displacement(k, u)[1]);
  return -lowest;
}

}  // namespace

TEST(Newton, ConvergesQuadraticallyOnACantilever) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{8, 2, 1}});
  block.method.gravity = {0, -0.25, 0};
  ImplicitSystem<2> system = block.system(false);
  clamp(system);

  expectQuadraticConvergence(system);
}

TEST(Newton, ConvergesQuadraticallyOnCompressedRubber) {
  Block<LinearShape<3>> block(modelOf(mooneyRivlin()), {{2, 2, 2}});
  ImplicitSystem<3> system = block.system(false);
  for (int k = 0; k < system.nodes().size(); ++k)
    if (system.nodes().node(k)[2] == 2)
      for (int d = 0; d < 3; ++d) system.prescribe(k, d, d == 2 ? -0.4 : 0.0);
  clamp(system);

  expectQuadraticConvergence(system);
}

/// A Krylov method keeps prescribed displacements only to its tolerance.
TEST(Newton, HoldsWhatIsPrescribedWhateverTheSolverMakesOfIt) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{4, 2, 1}});
  block.method.gravity = {0, -0.25, 0};
  ImplicitSystem<2> system = block.system(false);
  clamp(system);
  const std::vector<double> u = system.guess();
  std::vector<double> astray = u, expected(u.size()), found(u.size());
  for (int k = 0; k < system.nodes().size(); ++k)
    if (system.nodes().node(k)[0] == 0) astray[2 * k] += 1e-3;
  ASSERT_NE(astray, u);

  EXPECT_TRUE(system.residual(u, expected));
  EXPECT_TRUE(system.residual(astray, found));
  EXPECT_EQ(found, expected);
  system.hold(astray);
  EXPECT_EQ(astray, u);
}

TEST(Fbar, BendsWhatIsNearlyIncompressibleWithoutLocking) {
  // Two beams of one shape under loads that bend them alike; the second has twice the cells along each axis.
  const double coarse = sinking({{8, 2, 1}}, -1e-3, true), fine = sinking({{16, 4, 1}}, -5e-4, true) / 2;
  const double locked = sinking({{8, 2, 1}}, -1e-3, false);
  EXPECT_NEAR(coarse / fine, 1, 0.15);  // bilinear cells are a little too stiff in bending
  EXPECT_LT(locked / fine, 0.3);
}

TEST(Fbar, LetsWhatFlowsKeepItsVolumeWithoutLocking) {
  EXPECT_NEAR(pull(true), 1, 0.05);  // plastic strains of some hundredths harden it by 1 or 2 %
  EXPECT_GT(pull(false), 10);
}

TEST(Newton, GoesOnUntilOnlyRoundingIsLeftOfALoad) {
  Block<GimpShape<2>> block(modelOf(rubber()), {{4, 2, 1}});
  block.method.gravity = {0, -1e-9, 0};
  ImplicitSystem<2> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess(), r(u.size());
  solvers::NewtonSettings settings = direct();
  settings.displacement = settings.energy = 1e-300;  // nothing else ends it

  EXPECT_TRUE(system.residual(u, r));
  EXPECT_FALSE(system.isNegligible(u, r));
  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, settings, u);

  EXPECT_TRUE(outcome.converged) << outcome.reason << ' ' << textOf(outcome.residuals);
  EXPECT_TRUE(system.residual(u, r));
  EXPECT_TRUE(system.isNegligible(u, r));
  // A hundred times the strain that counts as rounding, in one cell.
  for (int k = 0; k < system.nodes().size(); ++k)
    if (system.nodes().node(k) == Index<2>{{2, 1}}) u[2 * k] += 1e-12;
  EXPECT_TRUE(system.residual(u, r));
  EXPECT_FALSE(system.isNegligible(u, r));
}

TEST(Newton, SolvesWithOneParticleInACellAtItsEdge) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{3, 1, 1}});
  block.method.gravity = {1, 0, 0};
  block.removeLast(3);
  block.x().back()[0] = 2 + 1e-10;
  ImplicitSystem<2> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();

  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, direct(), u);

  EXPECT_TRUE(outcome.converged) << outcome.reason << ' ' << textOf(outcome.residuals);
}

TEST(Newton, SolvesWithACellThatHoldsAParticleAtItsEdgeOnly) {
  Block<LinearShape<2>> block(modelOf(rubber()), {{3, 1, 1}});
  for (Vec<2>& x : block.x())
    if (x[0] > 2) x[0] = 2 + 1e-10 * x[0];
  block.method.gravity = {1, 0, 0};
  ImplicitSystem<2> system = block.system(false);
  clamp(system);
  std::vector<double> u = system.guess();

  const solvers::Outcome outcome = solvers::solver().solve(system.unknowns(), system, direct(), u);

  EXPECT_TRUE(outcome.converged) << outcome.reason;
}

TEST(RigidMotions, HelpMultigridWithASolid) {
  Block<LinearShape<3>> block(modelOf(rubber()), {{16, 4, 4}});
  block.method.gravity = {0, 0, -1e-3};
  const auto iterations = [&](bool givesPositions) {
    ImplicitSystem<3> system = block.system(false);
    clamp(system);
    std::vector<double> u = system.guess();
    solvers::Unknowns unknowns = system.unknowns();
    if (!givesPositions) unknowns.coordinates.clear();
    solvers::NewtonSettings settings;
    settings.linear = {"gmres", "gamg", 1e-8, 1000, ""};
    const solvers::Outcome outcome = solvers::solver().solve(unknowns, system, settings, u);
    EXPECT_TRUE(outcome.converged) << outcome.reason;
    return double(outcome.krylovIterations) / outcome.newtonIterations;
  };
  const double with = iterations(true), without = iterations(false);
  std::cout << "iterations of gmres with GAMG: " << with << ", without rigid motions " << without << '\n';
  EXPECT_LT(with, without / 2);
}

}  // namespace tushar::mpm::solid::implicit
