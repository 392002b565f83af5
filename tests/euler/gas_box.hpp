#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "components/euler/tasks/advance.hpp"
#include "components/euler/tasks/compute_stable_time_step.hpp"

namespace tushar::euler {

/// The unit line, square or cube with `cells` cells along each axis and walls all around.
inline grid::Domain closedBox(int dimension, int cells) {
  grid::Domain domain;
  for (int axis = 0; axis < 3; ++axis) {
    domain.resolution[axis] = axis < dimension ? cells : 1;
    for (int side = 0; side < 2; ++side)
      domain.boundaries.face(axis, side).push_back({grid::symmetric, BoundaryKind::symmetry});
  }
  return domain;
}

/// As closedBox(), but open on all sides.
inline grid::Domain openBox(int dimension, int cells) {
  grid::Domain domain = closedBox(dimension, cells);
  for (int axis = 0; axis < dimension; ++axis)
    for (int side = 0; side < 2; ++side) domain.boundaries.face(axis, side).clear();
  return domain;
}

/// Gas in a box, advanced by direct calls of the tasks' functions.
template <int D>
class GasBox {
 public:
  using Profile = std::function<State<D>(const Vec<D>&)>;

  GasBox(const grid::Domain& domain, const Profile& primitiveAt, Method how = {}, Gas of = {})
      : grid(domain), gas(of), method(how), density(level.cells().size()), energy(density), momentum(density.size()) {
    forEach<D>(level.cells(), [&](const Index<D>& cell) {
      const State<D> u = conserved<D>(gas, primitiveAt(level.cellCentre<D>(cell)));
      const std::size_t i = level.cellNumber<D>(cell);
      density[i] = u[kDensity];
      for (int d = 0; d < D; ++d) momentum[i][d] = u[kVelocity(d)];
      energy[i] = u[kPressure<D>];
    });
  }

  double stableStep(double cfl) { return stableStep(Courant{cfl}); }
  double stableStep(const Courant& courant) {
    Minimum dt;
    for (const Patch& patch : grid.patches())
      computeStableTimeStep<D>(patch, gas, courant, seen<const double>(density, patch, 0),
                               seen<const Vec<D>>(momentum, patch, 0), seen<const double>(energy, patch, 0), dt);
    return dt.value;
  }

  void step(double dt) {
    std::vector<double> newDensity(density.size()), newEnergy(density.size());
    std::vector<Vec<D>> newMomentum(density.size());
    const int ghost = reach(method);
    for (const Patch& patch : grid.patches())
      chooseAdvance<D>(method, gas)(
          patch, gas,
          {{seen<const double>(density, patch, ghost), seen<const Vec<D>>(momentum, patch, ghost),
            seen<const double>(energy, patch, ghost)}},
          time, dt,
          {{seen<double>(newDensity, patch, 0), seen<Vec<D>>(newMomentum, patch, 0),
            seen<double>(newEnergy, patch, 0)}},
          {});
    time += dt;
    density = newDensity;
    momentum = newMomentum;
    energy = newEnergy;
  }

  void run(double until, double cfl) {
    for (double t = 0; t < until;) {
      const double dt = std::min(stableStep(cfl), until - t);
      step(dt);
      t = dt < until - t ? t + dt : until;
    }
  }

  State<D> at(const Index<D>& cell) const {
    const std::size_t i = level.cellNumber<D>(cell);
    State<D> u;
    u[kDensity] = density[i];
    for (int d = 0; d < D; ++d) u[kVelocity(d)] = momentum[i][d];
    u[kPressure<D>] = energy[i];
    return u;
  }
  double mass() const { return total(density); }
  double totalEnergy() const { return total(energy); }

  Grid grid;
  const Level& level = grid.level();
  Gas gas;
  Method method;
  std::vector<double> density, energy;
  std::vector<Vec<D>> momentum;
  double time = 0;

 private:
  template <class T, class Values>
  CellView<T> seen(Values& values, const Patch& patch, int ghost) const {
    return {values.data(), level.cells(), patch.cellsWithin(ghost)};
  }
  double total(const std::vector<double>& values) const {
    Sum sum;
    for (const double value : values) sum.add(value * level.cellVolume());
    return sum.total();
  }
};

inline State<1> gasAt(double density, double velocity, double pressure) { return {density, velocity, pressure}; }
inline State<1> sodGas(const Vec<1>& x) { return x[0] < 0.5 ? gasAt(1, 0, 1) : gasAt(0.125, 0, 0.1); }

/// A state with jumps and without any symmetry: hashes of the cell centres.
template <int D>
State<D> roughGas(const Vec<D>& x) {
  State<D> w;
  double seed = 0.3;
  for (std::size_t k = 0; k < w.size(); ++k) {
    for (int d = 0; d < D; ++d) seed += (k + 1.7) * (d + 2.3) * x[d];
    const double wild = 0.5 + 0.5 * std::sin(97.1 * seed);
    w[k] = k == kDensity || k == kPressure<D> ? 0.1 + wild : 2 * wild - 1;
  }
  return w;
}

inline std::vector<Method> allMethods() {
  std::vector<Method> methods;
  for (const FluxKind flux : {FluxKind::exact, FluxKind::hllc}) {
    methods.push_back({flux, Reconstruction::firstOrder, Limiter::minmod});
    for (const Limiter limiter : {Limiter::minmod, Limiter::vanLeer, Limiter::mc})
      methods.push_back({flux, Reconstruction::musclHancock, limiter});
  }
  return methods;
}

}  // namespace tushar::euler
