#pragma once

#include "components/euler/boundary.hpp"
#include "components/euler/face_masses.hpp"
#include "components/euler/tasks/diagnose.hpp"
#include "components/ice/scalar.hpp"
#include "core/base/limiters.hpp"

namespace tushar::ice {

/// Sets the initial product of scalar and density, from the last region that contains the centre of a cell. Throws
/// InputError for a centre that no region contains.
template <int D>
void initializeScalar(const Patch& patch, const CarriedScalar* scalar, CellView<const double> density,
                      CellView<double> held) {
  const auto& regions = scalar->settings().start;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    held[cell] = 0;
    if (!(density[cell] > 0)) return;  // a body fills it
    const Vec3 point = patch.level().template expandPoint<D>(patch.level().template cellCentre<D>(cell));
    const auto region =
        std::find_if(regions.rbegin(), regions.rend(), [&](const ScalarRegion& one) { return one.shape->owns(point); });
    if (region == regions.rend())
      throw InputError({{scalar->settings().where, "Models/Model/PassiveScalar/scalar/initialization",
                         fmt::format("no geom_object contains the centre of the cell at ({:g}, {:g}, {:g}); every cell "
                                     "needs a value at the start",
                                     point[0], point[1], point[2])}});
    held[cell] = density[cell] * region->at(point);
  });
}

/// The space that bodies leave to the gas: the label of the free fraction of a cell, and the smallest fractions at
/// which a cell counts as free of bodies, and as not full.
struct RoomOfGas {
  const CellLabel<double>* free = nullptr;  ///< null where there are no bodies
  double whole = 1, least = 0;
};

/// Variables of a scalar f and of its carrier gas that a step reads; all contents are per volume of the cell.
template <int D>
struct ScalarBefore {
  CellView<const double> density, held;
  CellView<const Vec<D>> below, above;
  std::optional<CellView<const double>> free = {};
  double whole = 1, least = 0;

  static ScalarBefore from(auto& take, const CarriedScalar* scalar, const RoomOfGas& room = {}) {
    ScalarBefore before{.density = take(requiresOld(euler::c::density, 2)),
                        .held = take(requiresOld(scalar->held(), 2)),
                        .below = take(requiresNew(euler::c::massFlux<D>[0], 1)),
                        .above = take(requiresNew(euler::c::massFlux<D>[1], 1)),
                        .whole = room.whole,
                        .least = room.least};
    if (room.free) before.free = take(requiresOld(*room.free, 2));
    return before;
  }
  bool hasGas(const Index<D>& cell) const { return density[cell] > 0; }
  /// Whether the gas of a cell can flow: bodies do not fill the cell, apart from a trace of gas.
  bool canFlow(const Index<D>& cell) const { return hasGas(cell) && (!free || (*free)[cell] >= least); }
  double value(const Index<D>& cell) const { return hasGas(cell) ? held[cell] / density[cell] : 0; }
  /// Whether a cell has no slopes because there is a body in it or next to it.
  bool isFlat(const Index<D>& cell) const {
    if (!free) return false;
    const auto isPlain = [&](const Index<D>& at) {
      return !free->box().contains(at) || ((*free)[at] >= whole && hasGas(at));
    };
    bool plain = isPlain(cell);
    for (int d = 0; d < D && plain; ++d) plain = isPlain(cell - Index<D>::unit(d)) && isPlain(cell + Index<D>::unit(d));
    return !plain;
  }
};

/// The values of a scalar f at the faces of cells.
///
/// In a cell, f varies with van Leer's slopes. The values that leave the cell through its faces are taken half a step
/// later. Their differences from the mean are then reduced until these values, and the mean of what remains in the
/// cell, lie between the values of the cell and its neighbours. So a step creates no new extrema. Source for this
/// limiter: X. Zhang & C.-W. Shu, J. Comput. Phys. 229 (2010) 3091.
template <int D>
class ScalarAtFaces {
 public:
  using Faces = std::array<std::array<double, 2>, D>;

  ScalarAtFaces(const Level& level, const ScalarBefore<D>& before, double dt, bool hasSlopes, const Box& block)
      : level_(level),
        before_(before),
        dt_(dt),
        hasSlopes_(hasSlopes),
        box_(level.clipCells(block.grown(1, D))),
        known_(level.clipCells(box_.grown(1, D))) {
    values_.resize(box_.size());
    flows_.resize(box_.size());
    forEachRow<D>(box_, [&](const Index<D>& first, int count) {
      std::size_t at = offset(first);
      Index<D> cell = first;
      for (int i = 0; i < count; ++i, ++cell[0], ++at) {
        values_[at] = facesOf(cell);
        flows_[at] = static_cast<std::uint8_t>(before_.canFlow(cell));
      }
    });
    for (int d = 1; d < D; ++d) stride_[d] = stride_[d - 1] * box_.extent(d - 1);
  }
  /// f of the gas that leaves a cell through its lower (0) or upper (1) face.
  double at(const Index<D>& cell, int axis, int side) const { return values_[offset(cell)][axis][side]; }
  bool has(const Index<D>& cell) const { return box_.contains(cell); }
  /// Whether all neighbours of a cell are in the box.
  bool hasAround(const Index<D>& cell) const {
    bool has = true;
    for (int d = 0; d < D; ++d) has &= cell[d] > box_.lower[d] && cell[d] < box_.upper[d] - 1;
    return has;
  }
  std::size_t offset(const Index<D>& cell) const {
    std::size_t at = 0;
    for (int d = D - 1; d >= 0; --d) at = at * box_.extent(d) + (cell[d] - box_.lower[d]);
    return at;
  }
  /// f at a face inside the box, of the cell at this offset or of its neighbour; null if their gas cannot flow.
  const double* between(std::size_t cell, int axis, int side, bool leaves) const {
    const std::size_t next = side == 0 ? cell - stride_[axis] : cell + stride_[axis];
    const std::size_t donor = leaves ? cell : next;
    return flows_[donor] != 0 ? &values_[donor][axis][leaves ? side : 1 - side] : nullptr;
  }

 private:
  Faces facesOf(const Index<D>& cell) const {
    const double f = before_.value(cell);
    Faces change{};
    double least = 0, most = 0;
    if (hasSlopes_ && !before_.isFlat(cell)) {
      double ahead = 0;
      std::array<double, D> slopes{};
      for (int d = 0; d < D; ++d) {
        const Index<D> lower = cell - Index<D>::unit(d), upper = cell + Index<D>::unit(d);
        const double fall = known_.contains(lower) ? f - before_.value(lower) : 0;
        const double rise = known_.contains(upper) ? before_.value(upper) - f : 0;
        slopes[d] = VanLeer::slope(fall, rise);
        least = std::min({least, -fall, rise});
        most = std::max({most, -fall, rise});
        ahead += 0.25 * (before_.below[cell][d] + before_.above[cell][d]) * perMass(cell, d) * slopes[d];
      }
      for (int d = 0; d < D; ++d)
        for (const int side : {0, 1})
          change[d][side] = std::clamp((side == 0 ? -0.5 : 0.5) * slopes[d] - ahead, least, most);
    }
    const double shrink = least < most ? shrinkage(cell, change, least, most) : 0;
    Faces faces;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) faces[d][side] = f + shrink * change[d][side];
    return faces;
  }
  double perMass(const Index<D>& cell, int axis) const {
    return dt_ * level_.inverseSpacing(axis) / before_.density[cell];
  }
  /// The factor by which to shrink the differences, so that the mean of what remains in the cell is within the limits.
  double shrinkage(const Index<D>& cell, const Faces& change, double least, double most) const {
    double rest = 1, gone = 0;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const double out = side == 0 ? -before_.below[cell][d] : before_.above[cell][d];
        if (!(out > 0)) continue;
        rest -= out * perMass(cell, d);
        gone += out * perMass(cell, d) * change[d][side];
      }
    if (!(rest > 0)) return 0;
    const double stays = -gone / rest;
    if (stays > most) return most / stays;
    if (stays < least) return least / stays;
    return 1;
  }

  const Level& level_;
  const ScalarBefore<D>& before_;
  double dt_;
  bool hasSlopes_;
  Box box_, known_;
  std::vector<Faces> values_;
  std::vector<std::uint8_t> flows_;       ///< whether the gas of a cell can flow
  std::array<std::size_t, D> stride_{1};  ///< distances between neighbours along each axis in `values_`
};

/// The flux of a scalar through the faces of cells [kg/(m² s)]. If the cell from which gas flows, the donor, had no gas
/// before the step, f is the mean of the gas that flows into it; if none does, f is that of the receiver or, if the
/// receiver had none either, the mean around the donor.
template <int D>
class ScalarFlux {
 public:
  ScalarFlux(const Level& level, const euler::Gas& gas, const CarriedScalar& scalar, const ScalarBefore<D>& before,
             const ScalarAtFaces<D>& faces, double time)
      : level_(level), gas_(gas), scalar_(scalar), before_(before), faces_(faces), time_(time) {}

  /// The flux through the lower (0) or upper (1) face of a cell: the mass flux times f of the gas in it, plus -rho D
  /// df/dx.
  double operator()(const Index<D>& cell, int axis, int side) const {
    const double mass = side == 0 ? before_.below[cell][axis] : before_.above[cell][axis];
    const Index<D> next = side == 0 ? cell - Index<D>::unit(axis) : cell + Index<D>::unit(axis);
    const bool leaves = side == 0 ? mass < 0 : mass > 0;
    const double diffusivity = scalar_.settings().diffusivity, perWidth = level_.inverseSpacing(axis);
    if (faces_.has(next)) {
      const double f = carriedFrom(leaves ? cell : next, leaves ? next : cell, axis, leaves ? side : 1 - side);
      if (diffusivity == 0) return mass * f;
      const Index<D>&below = side == 0 ? next : cell, &above = side == 0 ? cell : next;
      const double rho = 0.5 * (before_.density[below] + before_.density[above]);
      return mass * f - rho * diffusivity * perWidth * (before_.value(above) - before_.value(below));
    }
    auto given = euler::givenAt(placeOf(cell, axis, side), gas_, scalar_.atSides()[0]);
    if (!given) given = euler::givenAt(placeOf(cell, axis, side), gas_, scalar_.atSides()[1]);
    const double f = leaves || !given ? faces_.at(cell, axis, side) : *given;
    if (diffusivity == 0 || !given) return mass * f;
    const double rise = (side == 0 ? 2 : -2) * (before_.value(cell) - *given);
    return mass * f - before_.density[cell] * diffusivity * perWidth * rise;
  }

  /// The sum over axes of what leaves a cell minus what enters it, per cell volume. `at` is the offset of the cell in
  /// the values at faces, `isInside` whether all its neighbours are in their box.
  double outOf(const Index<D>& cell, std::size_t at, bool isInside) const {
    const bool isPlain = isInside && scalar_.settings().diffusivity == 0;
    const Vec<D>&below = before_.below[cell], &above = before_.above[cell];
    double sum = 0;
    for (int d = 0; d < D; ++d) {
      const double *lower = nullptr, *upper = nullptr;
      if (isPlain) {
        lower = faces_.between(at, d, 0, below[d] < 0);
        upper = faces_.between(at, d, 1, above[d] > 0);
      }
      const double out = upper ? above[d] * *upper : (*this)(cell, d, 1);
      sum += level_.inverseSpacing(d) * (out - (lower ? below[d] * *lower : (*this)(cell, d, 0)));
    }
    return sum;
  }

 private:
  /// f of the gas that flows out of a donor through its lower (0) or upper (1) face.
  double carriedFrom(const Index<D>& donor, const Index<D>& receiver, int axis, int side) const {
    if (before_.canFlow(donor)) return faces_.at(donor, axis, side);
    if (const auto passing = passedBy(donor)) return *passing;
    if (before_.canFlow(receiver)) return faces_.at(receiver, axis, 1 - side);
    double held = 0, mass = 0;
    for (int d = 0; d < D; ++d)
      for (const Index<D>& at : {donor - Index<D>::unit(d), donor + Index<D>::unit(d)}) {
        if (!before_.density.box().contains(at) || !before_.hasGas(at) || !((*before_.free)[at] > 0)) continue;
        const double inverse = 1 / (*before_.free)[at];
        held += inverse * before_.held[at];
        mass += inverse * before_.density[at];
      }
    return mass > 0 ? held / mass : 0;
  }
  /// The mean f of the gas that flows into a cell from neighbours, which have no slopes because bodies fill the cell.
  std::optional<double> passedBy(const Index<D>& cell) const {
    double held = 0, mass = 0;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        const Index<D> at = side == 0 ? cell - Index<D>::unit(d) : cell + Index<D>::unit(d);
        const double in = level_.inverseSpacing(d) * (side == 0 ? before_.below[cell][d] : -before_.above[cell][d]);
        if (!(in > 0) || !before_.density.box().contains(at) || !before_.canFlow(at)) continue;
        held += in * before_.value(at);
        mass += in;
      }
    return mass > 0 ? std::optional(held / mass) : std::nullopt;
  }
  euler::Place placeOf(const Index<D>& cell, int axis, int side) const {
    Index<D> beyond = cell;
    if (side == 1)
      ++beyond[axis];
    else
      --beyond[axis];
    return {level_, axis, side, level_.partAt<D>(axis, side, beyond), level_.middleOfSide<D>(axis, side, beyond),
            time_};
  }

  const Level& level_;
  const euler::Gas& gas_;
  const CarriedScalar& scalar_;
  const ScalarBefore<D>& before_;
  const ScalarAtFaces<D>& faces_;
  double time_;
};

/// Advects a scalar f with the mass of the gas: (rho f)' = rho f - dt sum_d (F_{d,i+1/2} - F_{d,i-1/2}) / h_d, where F
/// is the mass flux of the step times f at the face. So the total changes only by fluxes through sides of the grid, a
/// uniform f stays uniform, and no value leaves the range of the previous values, except for round-off.
template <int D>
void carryScalar(const Patch& patch, const CarriedScalar* scalar, const euler::Gas& gas, bool hasSlopes,
                 const ScalarBefore<D>& before, double time, double dt, CellView<double> held,
                 const RimFlux<double>& rim) {
  const Level& level = patch.level();
  euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
    const ScalarAtFaces<D> faces(level, before, dt, hasSlopes, block);
    const ScalarFlux<D> flux(level, gas, *scalar, before, faces, time);
    forEachRow<D>(block, [&](const Index<D>& first, int count) {
      std::size_t at = faces.offset(first);
      Index<D> cell = first;
      for (int i = 0; i < count; ++i, ++cell[0], ++at)
        held[cell] = before.held[cell] - dt * flux.outOf(cell, at, faces.hasAround(cell));
    });
    for (int d = 0; d < D; ++d) {
      Box lower = block;
      ++lower.upper[d];
      rim.template forEachFaceIn<D>(lower, d, [&](const Index<D>& face, double& through) {
        through += block.contains(face) ? flux(face, d, 0) : flux(face - Index<D>::unit(d), d, 1);
      });
    }
  });
}

/// Applies the interior sources of a scalar: in every step, each raises the scalar by its value, up to its limit.
template <int D>
void raiseScalar(const Patch& patch, const CarriedScalar* scalar, CellView<const double> density,
                 CellView<double> held) {
  const Level& level = patch.level();
  for (const ScalarRegion& region : scalar->settings().interior) {
    const input::Box3 bounds = region.shape->bounds();
    forEach<D>(level.cellsNear(bounds.min, bounds.max), [&](const Index<D>& cell) {
      const Vec3 point = level.expandPoint<D>(level.cellCentre<D>(cell));
      if (!patch.cells().contains(cell) || !(density[cell] > 0) || !region.shape->owns(point)) return;
      const double before = held[cell] / density[cell];
      const double after = std::min(before + region.value(point), region.most);
      if (after > before) held[cell] = density[cell] * after;
    });
  }
}

/// Adds the tasks that set a scalar at the start.
template <int D>
void scheduleStartOfScalar(TaskList& tasks, const CarriedScalar& scalar, const CellLabel<double>& density) {
  tasks.perPatch("ice::initializeScalar", initializeScalar<D>, with(&scalar), requiresNew(density),
                 computes(scalar.held()));
  if (const ScalarDecay& decay = scalar.settings().decay; decay.isExponential)
    tasks.perPatch("ice::initializeDecay", initializeDecay<D>, with(decay), computes(scalar.decayCoefficient()));
}

/// Adds the tasks that change a scalar other than by transport: first it falls, then the sources raise it.
template <int D>
void scheduleChangesOfScalar(TaskList& tasks, const CarriedScalar& scalar, const CellLabel<double>& density) {
  const ScalarDecay& decay = scalar.settings().decay;
  if (decay.acts())
    tasks.perPatch("ice::decayScalar", decayScalar<D>, with(decay), requiresOld(delT), requiresNew(density),
                   when(decay.coefficients != nullptr, requiresOld(scalar.decayCoefficient())),
                   modifies(scalar.held()));
  if (!scalar.settings().interior.empty())
    tasks.perPatch("ice::raiseScalar", raiseScalar<D>, with(&scalar), requiresNew(density), modifies(scalar.held()));
}

/// Computes dt = cfl / (4 sum_d D / h_d²), so that diffusion and flow together create no new extrema.
template <int D>
void limitScalarDiffusion(const Patch& patch, double diffusivity, double cfl, CellView<const double>, Minimum& dt) {
  double rate = 0;
  for (int d = 0; d < D; ++d)
    rate += 4 * diffusivity * patch.level().inverseSpacing(d) * patch.level().inverseSpacing(d);
  dt.add(cfl / rate, "diffusion of a scalar");
}

template <int D>
void computeScalar(const Patch& patch, CellView<const double> density, CellView<const double> held,
                   CellView<double> value) {
  forEach<D>(patch.cells(),
             [&](const Index<D>& cell) { value[cell] = density[cell] > 0 ? held[cell] / density[cell] : 0; });
}

/// Computes the amount of a scalar on the patch [kg].
template <int D>
void sumScalar(const Patch& patch, CellView<const double> held, Sum& total) {
  euler::sumOverCells<D>(patch, held, total);
}

}  // namespace tushar::ice
