#pragma once

#include "components/mpm/solid/problem.hpp"
#include "core/solvers/report.hpp"

namespace tushar::mpm::solid::implicit {

/// Settings of implicit steps; names and defaults are Uintah's.
struct ImplicitMethod {
  /// Whether to use Newmark's method; otherwise there is no inertia, and each step ends in equilibrium.
  bool dynamic = true;
  /// Whether the grid is reset after each step; otherwise it moves with the solid, and shape functions do not change.
  bool resetsGrid = true;
  /// F-bar: whether the particles of a cell share one change of volume, which prevents locking.
  bool sharesVolume = false;
  solvers::NewtonSettings newton;
  bool movesBodies = true;  ///< otherwise bodies rest, and only heat is conducted
  bool conductsHeat = false;
  solvers::LinearSettings heat{"automatic", "gamg", 1e-10, 1000, ""};  ///< solver for the conduction of heat
  int iterationsToDecrease = 12;  ///< smallest number of iterations after which the next step is shorter
  int iterationsToIncrease = 4;   ///< number of iterations up to which the next step is longer
  double decreaseFactor = 0.6;
  double increaseFactor = 2;

  /// The largest next time step [s], after a step of length `dt` [s] that took `iterations` iterations.
  double nextTimeStep(double dt, int iterations) const {
    if (iterations >= iterationsToDecrease) return decreaseFactor * dt;
    return iterations <= iterationsToIncrease ? increaseFactor * dt : dt;
  }
};

namespace p {
using namespace solid::p;
template <int D>
inline constexpr ParticleLabel<Vec<D>> acceleration{"p.acceleration", "m/s^2", "acceleration at the end of the step"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> deformedPosition{
    "p.xx", "m", "position; if do_grid_reset is false, p.x is the position at the start"};
}  // namespace p
namespace g {
using namespace solid::g;
template <int D>
inline constexpr NodeLabel<Vec<D>> increment{"g.displacement", "m", "displacement in the step"};
template <int D>
inline constexpr NodeLabel<Vec<D>> newAcceleration{"g.newAcceleration", "m/s^2", "acceleration at the end of the step"};
}  // namespace g
namespace total {
using namespace solid::total;
inline constexpr ReductionLabel<Maximum> newtonIterations{"NewtonIterations", "1",
                                                          "Newton iterations of the latest step"};
inline constexpr ReductionLabel<Maximum> newtonResidual{
    "NewtonResidual", "1", "residual at the end of the latest step, relative to the largest in that step"};
inline constexpr ReductionLabel<Maximum> krylovIterations{"KrylovIterations", "1",
                                                          "iterations of all linear solves in the latest step"};
inline constexpr ReductionLabel<Minimum> nextTimeStep{"nextTimeStep", "s",
                                                      "next time step, by the number of Newton iterations"};
}  // namespace total

}  // namespace tushar::mpm::solid::implicit
