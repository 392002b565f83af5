#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "components/ice/tasks/solve_pressure.hpp"
#include "components/mpmice/tasks/wall_force.hpp"

namespace tushar::mpmice {

/// Views of the state of the gas itself, per volume of the gas. Cells without gas have arbitrary values, which are not
/// used.
template <int D>
struct GasAlone {
  euler::StateViews<D, const double> state;

  static GasAlone from(auto& take, int ghost) {
    return {.state = {take(requiresNew(c::alone<D>.density, ghost)), take(requiresNew(c::alone<D>.momentum, ghost)),
                      take(requiresNew(c::alone<D>.totalEnergy, ghost))}};
  }
};
template <int D>
struct NewGasAlone {
  euler::StateViews<D, double> state;

  static NewGasAlone from(auto& take) {
    return {.state = {take(computes(c::alone<D>.density)), take(computes(c::alone<D>.momentum)),
                      take(computes(c::alone<D>.totalEnergy))}};
  }
};

/// Views of the normal velocities of the walls at the lower and upper faces of cells [m/s], and of the acceleration of
/// these walls per pressure of the gas in the cell [m/(s² Pa)].
template <int D>
struct WallSpeeds {
  CellView<const Vec<D>> below, above, yieldBelow, yieldAbove;

  static WallSpeeds from(auto& take) {
    return {.below = take(requiresNew(c::wallSpeed<D>[0])),
            .above = take(requiresNew(c::wallSpeed<D>[1])),
            .yieldBelow = take(requiresNew(c::wallYield<D>[0])),
            .yieldAbove = take(requiresNew(c::wallYield<D>[1]))};
  }
  double at(const Index<D>& cell, int axis, int side) const {
    return side == 0 ? below[cell][axis] : above[cell][axis];
  }
  double yield(const Index<D>& cell, int axis, int side) const {
    return side == 0 ? yieldBelow[cell][axis] : yieldAbove[cell][axis];
  }
};
template <int D>
struct NewWallSpeeds {
  CellView<Vec<D>> below, above, yieldBelow, yieldAbove;

  static NewWallSpeeds from(auto& take) {
    return {.below = take(computes(c::wallSpeed<D>[0])),
            .above = take(computes(c::wallSpeed<D>[1])),
            .yieldBelow = take(computes(c::wallYield<D>[0])),
            .yieldAbove = take(computes(c::wallYield<D>[1]))};
  }
};

/// The pressure used in the equations for cells without gas [Pa].
inline constexpr double pressureOfNothing = 1;

/// Computes the state of the gas itself, per volume of the gas; sets arbitrary values in cells without gas.
template <int D>
void takeGasAlone(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                  const NewGasAlone<D>& alone) {
  euler::State<D> none{};
  none[euler::kDensity] = 1;
  none[euler::kPressure<D>] = pressureOfNothing;
  none = euler::conserved<D>(settings.gas.gas, none);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const euler::State<D> u = cells.isEmpty(cell) ? none : cells.conserved(cell);
    alone.state.density[cell] = u[euler::kDensity];
    for (int d = 0; d < D; ++d) alone.state.momentum[cell][d] = u[euler::kVelocity(d)];
    alone.state.totalEnergy[cell] = u[euler::kPressure<D>];
  });
}

/// Computes the pressure of the gas [Pa], which is the initial guess of the first solve.
template <int D>
void guessPressure(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                   CellView<double> pressure) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    pressure[cell] =
        cells.isEmpty(cell) ? pressureOfNothing : cells.primitive(settings.gas.gas, cell)[euler::kPressure<D>];
  });
}

/// Computes the speed of walls at the start of the step, and their acceleration per pressure. The accelerated mass is
/// that which belongs to the face, as if the same pressure acted on the faces beside it, which push the same nodes.
template <int D>
void findWallSpeeds(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                    const GasInCells<D>& cells, const typename BodiesAtNodes<D>::Records& records,
                    const NewWallSpeeds<D>& speeds) {
  const Level& level = patch.level();
  for (const CellView<Vec<D>>& of : {speeds.below, speeds.above, speeds.yieldBelow, speeds.yieldAbove})
    of.fill(Vec<D>::Zero());
  const NearBodies<D> near(patch.cells(), nearLayers, cells.free, cells.held.density);
  const FreeSpace<D> space(level, settings, cells);
  const BodiesAtNodes<D> bodies(level, records);
  constexpr double facesOfNode = 1 << (D - 1);
  near.forEachIn(patch.cells(), [&](const Index<D>& cell) {
    for (int d = 0; d < D; ++d) {
      const OpenFaces faces = space.faces(cell, d);
      const auto speed = [&](const Index<D>& face) {
        return bodies.velocityAt(face, d, mpm::solid::lane::velocity)[d];
      };
      const auto yield = [&](const Index<D>& face, double wall) {
        const double mass = settings.areRigid ? 0 : bodies.massAt(face, d);
        return mass > 0 ? wall * level.cellVolume() * level.inverseSpacing(d) * facesOfNode / mass : 0;
      };
      const Index<D> above = cell + Index<D>::unit(d);
      if (faces.wall(0) > 0) {
        speeds.below[cell][d] = speed(cell);
        speeds.yieldBelow[cell][d] = yield(cell, faces.wall(0));
      }
      if (faces.wall(1) > 0) {
        speeds.above[cell][d] = speed(above);
        speeds.yieldAbove[cell][d] = yield(above, faces.wall(1));
      }
    }
  });
}

/// Marks the cells in which the state has no slopes, because a body is in them or next to them. Cells beyond the grid
/// are like the nearest ones on it.
template <int D>
class FlatCells {
 public:
  /// Marks the cells of `box`, which must be at least one cell inside the views; their neighbours are looked at, too.
  FlatCells(const Level& level, const GasInCells<D>& cells, const Box& box) : box_(box), is_flat_(box.size(), 0) {
    const Box around = box.grown(1, D);
    std::vector<std::uint8_t> hasBody(around.size());
    forEach<D>(around, [&](const Index<D>& cell) {
      hasBody[offsetIn<D>(around, cell)] = cells.hasBody(nearestOnGrid(level, cell)) ? 1 : 0;
    });
    forEach<D>(box, [&](const Index<D>& cell) {
      std::uint8_t is = hasBody[offsetIn<D>(around, cell)];
      for (int d = 0; d < D; ++d)
        for (const Index<D>& next : {cell - Index<D>::unit(d), cell + Index<D>::unit(d)})
          is |= hasBody[offsetIn<D>(around, next)];
      is_flat_[offsetIn<D>(box_, cell)] = is;
    });
  }
  bool operator()(const Index<D>& cell) const { return is_flat_[offsetIn<D>(box_, cell)] != 0; }

 private:
  Box box_;
  std::vector<std::uint8_t> is_flat_;
};

/// Returns a function that tells whether a cell of a patch, or of two layers around it, has no slopes.
template <int D>
ice::IsFlat<D> flatAtBodies(const Patch& patch, const GasInCells<D>& cells) {
  return [flat = std::make_shared<const FlatCells<D>>(patch.level(), cells, patch.cells().grown(2, D))](
             const Index<D>& cell) { return (*flat)(cell); };
}

/// The equation for the change of pressure of a cell's gas. It is that of `ice`, through the open fractions g of faces,
/// and with wall fractions w that move at v_w:
///
///   (phi + dt² sum w gamma P y / h) d - dt sum g gamma P_f loss_f (d_n - d) / h
///       = -dt sum +- (g gamma P_f u_f + w gamma P v_w) / h + (gamma - 1) dt / 2 sum +- g v (p_n - p) / h.
///
/// y is the acceleration of a wall per pressure of this cell alone; its term keeps light bodies from oscillating
/// against a stiff gas. The matrix is symmetric, and positive in cells with gas. In a cell without gas, the equation is
/// d = 0.
template <int D>
numerics::CellEquation<D> pressureEquationBeside(const ice::FaceFlow<D>& flow, const FreeSpace<D>& space,
                                                 const WallSpeeds<D>& walls, double free, const Index<D>& cell,
                                                 double dt) {
  const double gamma = flow.gas().gamma;
  numerics::CellEquation<D> equation = ice::equationWith(cell, space.isEmpty(cell) ? 1 : free);
  if (space.isEmpty(cell)) return equation;
  const double own = gamma * (flow.old().number(cell, euler::kPressure<D>) + flow.gas().pInfinity);
  std::array<OpenFaces, D> faces;
  for (int d = 0; d < D; ++d) faces[d] = space.faces(cell, d);
  ice::forEachFaceOf<D>(flow.level(), cell, dt, [&](const ice::CellFace<D>& face) {
    if (const double wall = faces[face.axis].wall(face.side); wall > 0) {
      equation.right -= face.out * wall * own * walls.at(cell, face.axis, face.side);
      equation.left.weights[0] += face.ratio * wall * own * dt * walls.yield(cell, face.axis, face.side);
    }
    const double open = faces[face.axis].open[face.side];
    if (!(open > 0)) return;
    const double enthalpy = open * gamma * flow.stiffPressure(face.index, face.axis);
    const double velocity = flow.old().number(cell, euler::kVelocity(face.axis));
    equation.right -= face.out * enthalpy * flow.unchanged(face.index, face.axis);
    equation.right += 0.5 * (gamma - 1) * open * face.out * velocity * ice::riseAcross(flow, cell, face);
    ice::couple(flow, face.next, face.ratio * enthalpy * flow.loss(face.index, face.axis), equation.left);
  });
  return equation;
}

/// Views of the gas alone and of the walls that it meets.
template <int D>
struct GasAtWalls {
  GasAlone<D> alone;
  WallSpeeds<D> walls;

  static GasAtWalls from(auto& take) {
    GasAlone<D> alone = GasAlone<D>::from(take, 2);
    return {.alone = std::move(alone), .walls = WallSpeeds<D>::from(take)};
  }
};

/// Solves for the change of the pressure of the gas in the step [Pa], and computes the pressure at the end. Throws
/// NumericalError if the solver gives up.
template <int D>
void solvePressureBeside(const RankPatches& patches, const Workers& workers, const Settings& settings, double time,
                         double dt, const std::vector<GasAtWalls<D>>& gas, const std::vector<GasInCells<D>>& cells,
                         const std::vector<CellView<const double>>& guess, const std::vector<ice::PressureViews>& fresh,
                         const ice::SolveTotals& totals) {
  const Level& level = patches.front()->level();
  const euler::GhostRules<D> rules = euler::ghostRules<D>(level, settings.gas.gas, time);
  std::vector<ice::FaceFlow<D>> flows;
  std::vector<FreeSpace<D>> spaces;
  std::vector<NearBodies<D>> near;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    near.emplace_back(patches[p]->cells(), nearLayers, cells[p].free, cells[p].held.density);
    flows.emplace_back(level, settings.gas, *settings.implicit, rules, patches[p]->cells(), dt,
                       flatAtBodies<D>(*patches[p], cells[p]));
    spaces.emplace_back(level, settings, cells[p]);
  }
  forEachOn(workers, patches, [&](std::size_t p) { flows[p].hold(patches[p]->cells(), gas[p].alone.state); });
  const ice::ChangeEquations equations{
      [&](std::size_t p, const Index<D>& cell) {
        const double roundOff = 1e-12 * (pressureOfNothing + settings.gas.gas.pInfinity);
        const bool wasEmpty = std::abs(guess[p][cell] - pressureOfNothing) < roundOff;
        return spaces[p].isEmpty(cell) || wasEmpty;
      },
      [&](std::size_t p, const Index<D>& cell) {
        if (!near[p](cell)) return ice::pressureEquation<D>(level, flows[p], cell, dt);
        return pressureEquationBeside<D>(flows[p], spaces[p], gas[p].walls, cells[p].free[cell], cell, dt);
      },
      [&](std::size_t p, const Index<D>& cell) {
        return spaces[p].isEmpty(cell) ? 0.0 : ice::stiffPressureIn(flows[p], cell);
      }};
  ice::solveForChange<D>(patches, workers, *settings.implicit, flows, guess, fresh, totals, equations);
}

/// Computes the pressure of the gas on walls. It is the pressure at the end of the step; for approaching walls, the
/// viscosity of von Neumann and Richtmyer is added.
template <int D>
void takeWallPressure(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                      const GasInCells<D>& cells, const typename BodiesAtNodes<D>::Records& records,
                      CellView<const double> pressure, const WallPressures<D>& walls) {
  fillWallPressure<D>(patch, settings, cells, records, walls,
                      [&](const euler::Gas&, const Index<D>& cell, const CellWalls<D>& ofCell, const Vec<D>& velocity,
                          int d, int side) {
                        const double closing = std::max(0.0, ofCell.closing(velocity, d, side));
                        const double rho = cells.held.density[cell] / cells.free[cell];
                        return pressure[cell] + 0.5 * (settings.gas.gas.gamma + 1) * rho * closing * closing;
                      });
}

}  // namespace tushar::mpmice
