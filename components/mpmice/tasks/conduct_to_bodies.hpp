#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/tasks/add_diffusion.hpp"
#include "components/mpmice/tasks/heat_of_bodies.hpp"
#include "components/mpmice/tasks/measure_motion.hpp"

namespace tushar::mpmice {

/// Views of the heat capacity and the temperature of those bodies in a cell that exchange heat with the gas.
struct BodyHeat {
  CellView<double> capacity, temperature;

  static BodyHeat from(auto& take) {
    return {.capacity = take(computes(c::bodyCapacity)), .temperature = take(computes(c::bodyTemperature))};
  }
};
struct KnownBodyHeat {
  CellView<const double> capacity, temperature;

  static KnownBodyHeat from(auto& take) {
    return {.capacity = take(requiresNew(c::bodyCapacity, 1)), .temperature = take(requiresNew(c::bodyTemperature, 1))};
  }
};
/// Number of layers of cells around a patch in which particles have boxes that extend into the patch at the start of a
/// step, when each particle is in its cell.
inline constexpr int reachAtStart = 1;

/// Views of the boxes of particles at the start of a step.
template <int D>
struct OldBoxes {
  Boxes<D> boxes;

  static OldBoxes from(auto& take, int ghost = 0) {
    return {{.x = take(requiresOld(p::x<D>, ghost)), .edges = take(requiresOld(p::boxEdges<D>, ghost))}};
  }
};
/// Views of the particles at the start of a step, on a patch and around it.
template <int D>
struct HeatOfParticles {
  OldBoxes<D> of;
  ParticleView<const double> mass, temperature;

  static HeatOfParticles from(auto& take) {
    return {.of = OldBoxes<D>::from(take, reachAtStart),
            .mass = take(requiresOld(p::mass, reachAtStart)),
            .temperature = take(requiresOld(p::temperature, reachAtStart))};
  }
};
/// Views of what walls conduct in a step: the heat from the gas, and the change of the temperature of the bodies.
struct WallHeats {
  CellView<double> fromGas, warming;

  static WallHeats from(auto& take) {
    return {.fromGas = take(computes(c::wallHeat)), .warming = take(computes(c::wallWarming))};
  }
};

/// Whether a body exchanges heat with a gas, that is, whether one of its coefficients with the gases is positive. They
/// are the last ones in the body's row, which contains its pairs with all materials after it.
inline bool warmsGas(const Settings& settings, std::size_t body, std::size_t bodies) {
  if (settings.heat.byMasses) return true;
  if (!settings.heat.act()) return false;
  const std::size_t gases = std::max<std::size_t>(1, settings.gases.size());
  std::size_t end = 0;
  for (std::size_t row = 0; row <= body; ++row) end += bodies + gases - row - 1;
  const auto first = settings.heat.pairs.begin();
  return std::any_of(first + static_cast<std::ptrdiff_t>(end - gases), first + static_cast<std::ptrdiff_t>(end),
                     [](double h) { return h > 0; });
}

/// Computes the heat capacity [J/(m³ K)] and the temperature [K] of the bodies in each cell near gas, which have the
/// parts of their particles that are in the cell.
template <int D>
void measureBodyHeat(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
                     const GasNearby& gas, const std::vector<HeatOfParticles<D>>& bodies, const BodyHeat& found) {
  const Level& level = patch.level();
  found.capacity.fill(0);
  found.temperature.fill(0);
  const CellMarks<D> nearGas = gas.mark<D>(patch);
  for (std::size_t m = 0; m < bodies.size(); ++m) {
    if (!warmsGas(settings, m, bodies.size())) continue;
    const HeatOfParticles<D>& body = bodies[m];
    const double perMass = materials[m].specificHeat / level.cellVolume();
    forEachCell<D>(level, body.of.boxes.x,
                   [&](const Index<D>& cell, const mpm::CellFrame<D>& frame, const auto& range) {
                     if (!nearGas(cell)) return;
                     for (const int p : range)
                       forEachPart<D>(level, cell, body.of.boxes.of(frame, p), [&](const Index<D>& at, double part) {
                         if (!found.capacity.box().contains(at)) return;
                         const double capacity = part * (body.mass[p] * perMass);
                         found.capacity[at] += capacity;
                         found.temperature[at] += capacity * body.temperature[p];
                       });
                   });
  }
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (found.capacity[cell] > 0) found.temperature[cell] /= found.capacity[cell];
  });
}

/// Computes the heat that the gas conducts to bodies through walls, k A dT / d, given the state at the start of the
/// step. The bodies at a face are those in the cells on both sides.
template <int D>
class WallHeat {
 public:
  WallHeat(const Level& level, const Settings& settings, const GasInCells<D>& cells, const KnownBodyHeat& bodies,
           double dt)
      : level_(level), settings_(settings), cells_(cells), space_(level, settings, cells), bodies_(bodies), dt_(dt) {}

  /// Calls `visit(neighbour, heat, change)` for the walls of a cell through which heat passes, if the cell or its
  /// neighbour is in the box `own`: with the cell on the other side, if there is one, the heat that the gas of the cell
  /// loses in the step, per cell volume [J/m³], and the change of the temperature of the bodies in both cells [K].
  template <class Visit>
  void forEachWall(const Index<D>& cell, const Box& own, Visit&& visit) const {
    if (space_.isEmpty(cell)) return;
    std::optional<euler::DiffusingCell<D>> gas;
    for (int a = 0; a < D; ++a) {
      const OpenFaces faces = space_.faces(cell, a);
      for (int side = 0; side < 2; ++side) {
        const auto next = neighbour(cell, a, side);
        if (!(faces.wall(side) > 0) || !(own.contains(cell) || (next && own.contains(*next)))) continue;
        const double capacity = capacityAt(cell, next);
        if (!(capacity > 0)) continue;
        if (!gas) gas = diffusingAt<D>(level_, settings_, cells_, cell);
        const double difference = gas->w[euler::kTemperature] - heatAt(cell, next) / capacity;
        const double heat = heatPerKelvin(*gas, layerOf(cells_.free[cell]), faces.wall(side), a, capacity) * difference;
        if (heat != 0) visit(next, heat, heat / capacity);
      }
    }
  }

 private:
  std::optional<Index<D>> neighbour(const Index<D>& cell, int axis, int side) const {
    if (space_.isAtSide(cell, axis, side)) return {};
    return side == 0 ? cell - Index<D>::unit(axis) : cell + Index<D>::unit(axis);
  }
  double capacityAt(const Index<D>& cell, const std::optional<Index<D>>& next) const {
    return bodies_.capacity[cell] + (next ? bodies_.capacity[*next] : 0);
  }
  /// The heat of the bodies at a face, per cell volume [J/m³].
  double heatAt(const Index<D>& cell, const std::optional<Index<D>>& next) const {
    const double own = bodies_.capacity[cell] * bodies_.temperature[cell];
    return next ? own + bodies_.capacity[*next] * bodies_.temperature[*next] : own;
  }
  /// Heat from the gas of a cell through a wall per kelvin [J/(m³ K)], limited so that neither gas nor bodies pass
  /// their common temperature. The gas is a layer of this thickness, in cells; `capacity` is that of the bodies.
  double heatPerKelvin(const euler::DiffusingCell<D>& gas, double layer, double wall, int axis, double capacity) const {
    const double perWidth = level_.inverseSpacing(axis);
    const double flow = dt_ * gas.how.conductivity * wall * perWidth * perWidth / (0.5 * layer);
    return std::min(flow, 1 / (1 / (gas.density * layer * gas.specificHeat) + 2 * D / capacity));
  }

  const Level& level_;
  const Settings& settings_;
  const GasInCells<D>& cells_;
  FreeSpace<D> space_;
  const KnownBodyHeat& bodies_;
  double dt_;
};

/// Subtracts from the gas the heat that it conducts to bodies; to be called before small cells are merged. Also finds
/// the change of the temperature of bodies by this heat.
template <int D>
void conductFromGas(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                    const KnownBodyHeat& bodies, double dt, CellView<double> totalEnergy, const WallHeats& found) {
  const Box around = patch.level().clipCells(patch.cells().grown(1, D));
  const NearBodies<D> near(around, 1, cells.free, cells.held.density);  // a wall has a body beside it
  const WallHeat<D> walls(patch.level(), settings, cells, bodies, dt);
  found.fromGas.fill(0);
  found.warming.fill(0);
  near.forEachIn(around, [&](const Index<D>& cell) {
    const bool isOwn = patch.cells().contains(cell);
    walls.forEachWall(cell, patch.cells(), [&](const std::optional<Index<D>>& next, double heat, double change) {
      if (isOwn) {
        found.fromGas[cell] += heat;
        found.warming[cell] += change;
      }
      if (next && patch.cells().contains(*next)) found.warming[*next] += change;
    });
    if (isOwn) totalEnergy[cell] -= found.fromGas[cell];
  });
}

/// Adds to the temperature of each particle the mean of c.warmingByWalls over the box that it had at the start.
template <int D>
void conductToBodies(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                     const std::vector<OldBoxes<D>>& bodies, CellView<const double> warming,
                     const std::vector<ParticleView<double>>& temperatures) {
  const Level& level = patch.level();
  CellMarks<D> warmed(warming.box());
  forEach<D>(warming.box(), [&](const Index<D>& cell) { *warmed.row(cell) = warming[cell] != 0 ? 1 : 0; });
  warmed.spread(1, warmed.box());
  for (std::size_t m = 0; m < temperatures.size(); ++m) {
    if (!warmsGas(settings, m, temperatures.size())) continue;
    const Boxes<D>& boxes = bodies[m].boxes;
    forEachCell<D>(level, boxes.x, [&](const Index<D>& cell, const mpm::CellFrame<D>& frame, const auto& range) {
      if (!warmed(cell)) return;
      for (const int p : range) temperatures[m][p] += meanOver<D>(level, cell, boxes.of(frame, p), warming);
    });
  }
}

}  // namespace tushar::mpmice
