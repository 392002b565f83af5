#pragma once

#include "components/euler/boundary.hpp"
#include "components/euler/tasks/add_diffusion.hpp"
#include "components/mpmice/free_space.hpp"
#include "components/mpmice/gas_temperature.hpp"
#include "components/mpmice/tasks/compute_stable_time_step.hpp"
#include "components/mpmice/thin_gas.hpp"
#include "components/mpmice/wall_friction.hpp"

namespace tushar::mpmice {

/// Viscosity and conduction through the open fractions of faces next to bodies. T and v apply at the middle of the gas
/// of a cell; in place of a cell without gas, the neighbour at the face is used.
template <int D>
class DiffusionBeside {
 public:
  DiffusionBeside(const Level& level, const Settings& settings, const GasInCells<D>& cells, const euler::Rows<D>& w)
      : level_(level), cells_(cells), space_(level, settings, cells), w_(w) {}

  /// The cell itself or, if it is outside the grid, the nearest cell on the grid.
  Index<D> onGrid(const Index<D>& cell) const { return nearestOnGrid(level_, cell); }
  /// The diffusive fluxes [Pa and W/m²] along an axis through the lower face of a cell. `how(strain)` returns the
  /// coefficients at the face, where `strain()` returns sqrt(2 S : S) of the gas beside the face [1/s].
  template <class How>
  euler::State<D> fluxThrough(const Index<D>& cell, int axis, How&& how) const {
    const Index<D> below = cell - Index<D>::unit(axis);
    euler::State<D> flux{};
    const double open = openFor(cell, below, axis);
    if (!(open > 0)) return flux;
    const double perWidth = level_.inverseSpacing(axis) / distance(cell, below, axis);
    const euler::Diffusion diffusion = how([&] { return strain(cell, below, axis, perWidth); });
    const double along = rise(cell, below, euler::kVelocity(axis)) * perWidth;
    double others = 0;
    for (int k = 0; k < D; ++k) {
      if (k == axis) continue;
      others += slope(cell, below, k, euler::kVelocity(k));
      flux[euler::kVelocity(k)] = -diffusion.viscosity * (rise(cell, below, euler::kVelocity(k)) * perWidth +
                                                          slope(cell, below, k, euler::kVelocity(axis)));
    }
    flux[euler::kVelocity(axis)] = -diffusion.viscosity * (2 * along - 2.0 / 3 * (along + others));
    double energy = -diffusion.conductivity * rise(cell, below, euler::kDensity) * perWidth;
    for (int k = 0; k < D; ++k) {
      const std::size_t v = euler::kVelocity(k);
      energy += flux[v] * 0.5 * (w_.number(cell, v) + w_.number(below, v));
    }
    flux[euler::kPressure<D>] = energy;
    for (double& number : flux) number *= open;
    return flux;
  }

 private:
  bool isBeyond(const Index<D>& cell, int axis) const {
    return !level_.isPeriodic(axis) &&
           (cell[axis] < level_.cells().lower[axis] || cell[axis] >= level_.cells().upper[axis]);
  }
  /// The open fraction of a face, limited so that a stable step does not overshoot.
  double openFor(const Index<D>& cell, const Index<D>& below, int axis) const {
    if (space_.isEmpty(onGrid(cell)) || space_.isEmpty(onGrid(below))) return 0;
    const double open = isBeyond(cell, axis) ? space_.aperture(below, axis, 1) : space_.aperture(cell, axis, 0);
    return std::min(open, 2 * std::min(cells_.free[onGrid(cell)], cells_.free[onGrid(below)]));
  }
  double rise(const Index<D>& cell, const Index<D>& below, std::size_t number) const {
    return w_.number(cell, number) - w_.number(below, number);
  }
  /// The derivative along `axis`, which is not the axis of the face, of a component at the face.
  double slope(const Index<D>& cell, const Index<D>& below, int axis, std::size_t number) const {
    double sum = 0;
    for (const Index<D>& at : {cell, below})
      for (const int side : {-1, 1}) {
        const Index<D> next = side < 0 ? at - Index<D>::unit(axis) : at + Index<D>::unit(axis);
        sum += side * w_.number(space_.isEmpty(onGrid(next)) ? at : next, number);
      }
    return 0.25 * level_.inverseSpacing(axis) * sum;
  }
  double strain(const Index<D>& cell, const Index<D>& below, int axis, double perWidth) const {
    return euler::strainOf<D>([&](int k, int d) {
      const std::size_t v = euler::kVelocity(k);
      return d == axis ? rise(cell, below, v) * perWidth : slope(cell, below, d, v);
    });
  }
  /// Distance along an axis between the centres of the gas in two cells, in cells.
  double distance(const Index<D>& cell, const Index<D>& below, int axis) const {
    if (isBeyond(cell, axis) || isBeyond(below, axis)) {
      const bool isUpper = isBeyond(cell, axis);  // the mirror image is as far away from the side
      return 1 + (isUpper ? -2 : 2) * middle(isUpper ? below : cell, axis);
    }
    return std::max(0.5, 1 + middle(cell, axis) - middle(below, axis));
  }
  /// The position along an axis of the middle of a cell's gas, relative to the centre of the cell, in cells. It is
  /// shifted away from the cell's walls, and towards a small cell with which the cell is merged. Along a wall there is
  /// no shift: there, differences of round-off between neighbouring cells do not count.
  double middle(const Index<D>& cell, int axis) const {
    const OpenFaces faces = space_.faces(cell, axis);
    const double filled = 1 - cells_.free[cell], walls = std::max(faces.wall(0) + faces.wall(1), filled);
    double middle = walls > 0 ? 0.5 * filled * (faces.wall(0) - faces.wall(1)) / walls : 0;
    for (const int side : {0, 1}) {
      if (space_.isAtSide(cell, axis, side) || !(faces.open[side] > offRoundShares)) continue;
      const double next = cells_.free[side == 0 ? cell - Index<D>::unit(axis) : cell + Index<D>::unit(axis)];
      if (next < smallFreeVolume && next < cells_.free[cell] - offRoundShares)
        middle += (side == 0 ? -0.5 : 0.5) * next;
    }
    return std::clamp(middle, -0.25, 0.25);
  }

  const Level& level_;
  const GasInCells<D>& cells_;
  FreeSpace<D> space_;
  const euler::Rows<D>& w_;
};

/// Loads T and v of the gas in the cells of `w`. Cells without gas get arbitrary values, which are not used.
template <int D>
void findTemperatures(const euler::Gas& gas, const Level& level, const GasInCells<D>& cells, const NearBodies<D>& near,
                      euler::Rows<D>& w) {
  euler::findTemperature<D>(gas, level, cells.held, w);
  near.forEachIn(level.clipCells(w.box()), [&](const Index<D>& cell) {
    if (!(cells.free[cell] < 1) && !cells.isEmpty(cell)) return;
    euler::State<D> state{};
    if (!cells.isEmpty(cell)) {
      state = cells.primitive(gas, cell);
      state[euler::kDensity] = temperatureOf(gas, state[euler::kDensity], state[euler::kPressure<D>]);
    }
    euler::store<D>(w.at(cell), 0, state);
  });
}

/// The storage for the diffusive fluxes [Pa and W/m²] through the rim of the level, before small cells are merged.
template <int D>
struct RimsOfDiffusion : euler::DiffusionRims<D> {
  static RimsOfDiffusion from(auto& take) {
    return {{.momentum = take(keepsFlux(c::unsharedMomentum<D>)), .energy = take(keepsFlux(c::unsharedEnergy))}};
  }
};

/// Adds the changes due to viscosity and conduction in a step to the state before small cells are merged, given the
/// state at the start of the step. The fluxes pass through the open fractions of faces. Friction at walls is computed
/// together with the pressure on walls. Away from bodies and thin gas, the result is bitwise equal to that of `euler`.
template <int D>
void addDiffusion(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, double time, double dt,
                  double diffusivityAtStart, CellView<Vec<D>> momentum, CellView<double> totalEnergy,
                  const RimsOfDiffusion<D>& rims) {
  const Level& level = patch.level();
  const euler::Gas& gas = settings.gas.gas;
  const euler::Diffusion& uniform = settings.diffusion.alone.uniform;
  const euler::GhostRules<D> rules = euler::diffusionRules<D>(level, gas, time);
  const NearBodies<D> near(patch.cells().grown(2, D), nearLayers, cells.free, cells.held.density);
  const std::size_t room = euler::largestBlock<D>(patch.cells()).grown(1, D).size();
  const BoundedDiffusion<D> diffusion(level, settings, cells, diffusivityAtStart);
  euler::Rows<D> w(room), flux(room);
  euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
    w.hold(block.grown(1, D));
    flux.hold(w.box());
    findTemperatures<D>(gas, level, cells, near, w);
    euler::fillBeyondGrid<D>(level, rules, w);
    const DiffusionBeside<D> beside(level, settings, cells, w);
    const std::vector<Index<D>> thin = diffusion.thinCells(level.clipCells(w.box()));
    for (int axis = 0; axis < D; ++axis) {
      Box faces = block;
      ++faces.upper[axis];
      euler::computeDiffusiveFluxes<D>(uniform, level, faces, axis, w, flux);
      const auto correct = [&](const Index<D>& face) {
        const Index<D> cell = beside.onGrid(face), below = beside.onGrid(face - Index<D>::unit(axis));
        const auto how = [&](auto&&) { return diffusion.between(below, cell); };
        euler::store<D>(flux.at(face), 0, beside.fluxThrough(face, axis, how));
      };
      near.forEachIn(faces, correct);
      for (const Index<D>& cell : thin)
        for (const Index<D>& face : {cell, cell + Index<D>::unit(axis)})
          if (faces.template contains<D>(face)) correct(face);
      euler::keepDiffused<D>(rims, faces, axis, flux);
      euler::addDiffused<D>(dt / level.spacing(axis), block, axis, flux, momentum, totalEnergy);
    }
  });
}

/// A function that returns the diffusion properties of each cell; cells without gas are at rest.
template <int D>
auto diffusingGas(const Level& level, const Settings& settings, const GasInCells<D>& cells, double diffusivityAtStart) {
  return [&level, &settings, cells, bound = DiffusivityBound(level, diffusivityAtStart)](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return euler::DiffusingCell<D>{};
    euler::DiffusingCell<D> one = diffusingAt<D>(level, settings, cells, cell);
    one.mostDiffusivity = bound.at(one.soundSpeed);
    return one;
  };
}

/// The object that computes the diffusive fluxes of a patch with varying coefficients, bounded in thin gas; the rules
/// must outlive it.
template <int D>
euler::Diffuser<D> boundedDiffuser(const Patch& patch, const Settings& settings, const euler::GhostRules<D>& rules) {
  return {patch.level(), patch.cells(), rules, settings.diffusion.alone.smagorinsky, euler::Diffusivities::bounded};
}

/// Adds the changes due to viscosity and conduction in a step, like addDiffusion, for varying coefficients or several
/// gases. The flux through a face uses the means of the coefficients of the cells on both sides.
template <int D>
void addVaryingDiffusion(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, double time,
                         double dt, double diffusivityAtStart, CellView<Vec<D>> momentum, CellView<double> totalEnergy,
                         const RimsOfDiffusion<D>& rims) {
  const Level& level = patch.level();
  const euler::GhostRules<D> rules = euler::diffusionRules<D>(level, settings.gas.gas, time);
  const NearBodies<D> near(patch.cells().grown(2, D), nearLayers, cells.free, cells.held.density);
  euler::Diffuser<D> diffuser = boundedDiffuser<D>(patch, settings, rules);
  const auto cellAt = diffusingGas<D>(level, settings, cells, diffusivityAtStart);
  euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
    diffuser.hold(block, cellAt);
    const DiffusionBeside<D> beside(level, settings, cells, diffuser.state());
    for (int axis = 0; axis < D; ++axis) {
      Box faces = block;
      ++faces.upper[axis];
      euler::Rows<D>& flux = diffuser.computeFluxes(faces, axis);
      near.forEachIn(faces, [&](const Index<D>& cell) {
        const auto how = [&](auto&& strain) { return diffuser.atFace(cell, axis, strain); };
        euler::store<D>(flux.at(cell), 0, beside.fluxThrough(cell, axis, how));
      });
      euler::keepDiffused<D>(rims, faces, axis, flux);
      euler::addDiffused<D>(dt / level.spacing(axis), block, axis, flux, momentum, totalEnergy);
    }
  });
}

/// Computes dt = cfl / max(sum_d (|v_d| + c) / h_d + 2 nu / (l h_d)²) of the gas, where nu is the largest diffusivity,
/// which is bounded in thin gas, and l the thickness, in cells, of the layer of gas in the cell.
template <int D>
void limitDiffusion(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, double diffusivityAtStart,
                    Minimum& dt) {
  const euler::Gas& gas = settings.gas.gas;
  const Level& level = patch.level();
  const DiffusivityBound bound(level, diffusivityAtStart);
  double widths = 0, squares = 0, greatest = 0;
  for (int d = 0; d < D; ++d) widths += level.inverseSpacing(d);
  for (int d = 0; d < D; ++d) squares += level.inverseSpacing(d) * level.inverseSpacing(d);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const double perFree = 1 / cells.free[cell], layer = std::min(1.0, layerOf(cells.free[cell]));
    const double rho = cells.held.density[cell] * perFree;
    const Vec<D> momentum = cells.held.momentum[cell] * perFree;
    const double internal = cells.held.totalEnergy[cell] * perFree - 0.5 * momentum.squaredNorm() / rho;
    const double c2 = gas.soundSpeedSquared(rho, gas.last(rho, internal));
    const double c = std::sqrt(c2), nu = std::min(settings.diffusion.alone.uniform.greatest(gas, rho), bound.at(c));
    double rate = c * widths + 2 * nu * squares / (layer * layer);
    for (int d = 0; d < D; ++d) rate += std::abs(momentum[d]) / rho * level.inverseSpacing(d);
    greatest = rate > greatest ? rate : greatest;
  });
  if (greatest > 0) dt.add(settings.gas.courant.number / greatest, "diffusion");
}

/// Computes dt = cfl / max(sum_d (|v_d| + c) / h_d + (nu_below + nu_above) / (l h_d)²) for varying viscosity and
/// conductivity; nu and l are as in limitDiffusion.
template <int D>
void limitVaryingDiffusion(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, double time,
                           double diffusivityAtStart, Minimum& dt) {
  const euler::GhostRules<D> rules = euler::diffusionRules<D>(patch.level(), settings.gas.gas, time);
  euler::Diffuser<D> diffuser = boundedDiffuser<D>(patch, settings, rules);
  const auto cellAt = diffusingGas<D>(patch.level(), settings, cells, diffusivityAtStart);
  double greatest = 0;
  euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
    diffuser.hold(block, cellAt);
    forEach<D>(block, [&](const Index<D>& cell) {
      if (cells.isEmpty(cell)) return;
      const double layer = std::min(1.0, layerOf(cells.free[cell]));
      const euler::Crossing rate = diffuser.crossingOf(cell, cellAt(cell), 1);
      greatest = std::max(greatest, rate.byFlow + rate.byDiffusion / (layer * layer));
    });
  });
  if (greatest > 0) dt.add(settings.gas.courant.number / greatest, "diffusion");
}

}  // namespace tushar::mpmice
