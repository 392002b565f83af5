#pragma once

#include <functional>
#include <vector>

#include "core/simulation/catalogue.hpp"

namespace tushar::burgers {

/// An initial profile for Burgers' equation.
struct BurgersProblem {
  std::function<double(double)> velocity;  ///< u [m/s] at t = 0 as a function of x [m]; must be bounded
  double viscosity = 0;                    ///< viscosity nu [m²/s]
  double lower = 0, upper = 1;             ///< beginning and end of the profile [m]
  /// Whether the profile is periodic; otherwise it is constant beyond its ends.
  bool periodic = false;
};

/// The exact solution of Burgers' equation in one dimension, including shocks.
///
/// With U the integral of the profile, u = dPhi/dx of
///   Phi = min over y of U(y) + (x-y)²/2t                                                       nu = 0
///   Phi = -2 nu ln of (4 pi nu t)^(-1/2) integral exp(-(U(y) + (x-y)²/2t) / 2 nu) dy           nu > 0
/// so that a mean of u is a difference of Phi. U is tabulated at 8193 points and integrated by Gauss-Legendre between
/// them; the integral is a sum over these points. Exact to about 1e-12 where the profile is smooth; a jump of the
/// profile is located to within 1/8192 of its extent, and if it lies at one of these points, u is accurate to 1e-6.
/// Sources: E. Hopf, Comm. Pure Appl. Math. 3 (1950) 201; J. D. Cole, Quart. Appl. Math. 9 (1951) 225; P. D. Lax, Comm.
/// Pure Appl. Math. 10 (1957) 537.
class BurgersWave {
 public:
  /// Throws std::invalid_argument if nu < 0, if upper <= lower, or if the profile is not finite.
  explicit BurgersWave(BurgersProblem problem);

  /// The value of u at `x` [m] and time `t` [s]; on a shock, the value on one of its sides. Throws std::domain_error
  /// where holdsAt is false.
  double at(double x, double t) const;
  /// Mean of u over [lower, upper] [m]. Throws the same exceptions as at().
  double average(double lower, double upper, double t) const;
  /// Whether the solution is available at time `t` [s]. It is not available before t = 0, nor as long as viscosity acts
  /// over less than the table resolves, (2 nu t)^(1/2) < 2 steps.
  bool holdsAt(double t) const;

 private:
  /// The point y of a minimum, and the value of U(y) + (x-y)²/2t there.
  struct Least {
    double place, value;
  };
  void checkTime(double t) const;
  double profile(double y) const;
  double place(long node) const { return problem_.lower + static_cast<double>(node) * step_; }
  double integralAt(long node) const;
  double integral(double y) const;
  Least least(double x, double t) const;
  Least leastOfNodes(double x, double t, long first, long last) const;
  double potential(double x, double t) const;
  template <class F>
  double sum(double x, double t, double least, const F& f) const;
  long nodeBelow(double y) const;

  BurgersProblem problem_;
  double step_ = 0;                  ///< step of the table [m]
  double least_ = 0, greatest_ = 0;  ///< smallest and largest u of the profile [m/s]
  std::vector<double> integrals_;    ///< U at the points of the table [m²/s]
};

/// `burgersWave`: computes errors of the component burgers in one dimension, relative to the exact solution for the
/// scene.
simulation::AnalysisKind waveKind();

}  // namespace tushar::burgers
