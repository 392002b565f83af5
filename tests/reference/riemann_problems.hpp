#pragma once

#include <functional>
#include <string>
#include <vector>

#include "components/reference/exact_riemann.hpp"

namespace tushar::reference {

/// A shock tube with its published star state.
struct KnownTube {
  std::string name;
  RiemannProblem problem;
  double time;
  double starPressure, starVelocity, starDensityLeft, starDensityRight;
};

inline RiemannProblem tube(RiemannState left, RiemannState right, double diaphragm = 0.5, double gamma = 1.4) {
  RiemannProblem problem;
  problem.left = left;
  problem.right = right;
  problem.diaphragm = diaphragm;
  problem.gas.gamma = gamma;
  return problem;
}

inline RiemannProblem sodTube() { return tube({1, 0, 1}, {.125, 0, .1}); }

/// Sod, J. Comput. Phys. 27 (1978); Toro, Riemann Solvers, table 4.1 (his test 5 moved by -19.59745 m/s); Lax (1954).
inline std::vector<KnownTube> knownTubes() {
  return {
      {"Sod", sodTube(), .2, 0.30313018, 0.92745262, 0.42631943, 0.26557371},
      {"Toro 1", tube({1, .75, 1}, {.125, 0, .1}, .3), .2, 0.46629357, 1.3609055, 0.57986669, 0.33970023},
      {"Toro 2", tube({1, -2, .4}, {1, 2, .4}), .15, 0.0018938734, 0, 0.021852118, 0.021852118},
      {"Toro 3", tube({1, 0, 1000}, {1, 0, .01}), .012, 460.89379, 19.597451, 0.5750623, 5.9992407},
      {"Toro 4", tube({5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, .4), .035, 1691.647, 8.6897744,
       14.28235, 31.042602},
      {"Toro 5", tube({1, -19.59745, 1000}, {1, -19.59745, .01}, .8), .012, 460.89379, 1.4e-6, 0.5750623, 5.9992407},
      {"Lax", tube({.445, .698, 3.528}, {.5, 0, .571}), .13, 2.4660979, 1.528723, 0.34456847, 1.3040845},
  };
}

/// LeBlanc's tube: a density ratio of 1e3 and a pressure ratio of 1e9.
inline RiemannProblem leblancTube() {
  const double gamma = 5.0 / 3.0;
  return tube({1, 0, .1 * (gamma - 1)}, {1e-3, 0, 1e-10 * (gamma - 1)}, .33, gamma);
}

/// Tubes that are hard for the solver: strong ratios, cold gas, gamma near 1 and large gamma.
inline std::vector<RiemannProblem> hardTubes() {
  return {
      leblancTube(),
      tube({1, 0, 1e10}, {1, 0, 1}),
      tube({1e10, 0, 1e10}, {1, 0, 1}),
      tube({1, 0, 1}, {1e-10, 0, 1e-10}),
      tube({1, 1, 0}, {1, -1, 0}, .5, 5.0 / 3.0),
      tube({1, 0, 1}, {1, 0, 0}),
      tube({1, 0, 1}, {.125, 0, .1}, .5, 1.01),
      tube({1, 0, 1}, {.125, 0, .1}, .5, 7),
      tube({1, 1e-9, 1}, {1, 0, 1}),
      tube({1, 1e3, 1}, {1, -1e3, 1}),
      tube({1, -2.4, .4}, {1, 2.4, .4}),
  };
}

/// Composite midpoint rule with `n` points, for checks that need no higher accuracy.
inline double midpointMean(const std::function<double(double)>& f, double a, double b, int n) {
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += f(a + (b - a) * (k + 0.5) / n);
  return sum / n;
}

}  // namespace tushar::reference
