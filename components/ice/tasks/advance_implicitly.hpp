#pragma once

#include "components/euler/face_masses.hpp"
#include "components/ice/face_flow.hpp"

namespace tushar::ice {

/// The update of cells in a step, block by block, after the pressure at its end has been computed.
template <int D, int K = 1>
class ImplicitStep {
 public:
  /// Allocates space for blocks no larger than `largest`.
  ImplicitStep(const Level& level, const euler::Settings& method, const IceSettings& settings,
               const euler::GhostRules<D>& rules, const Box& largest, double dt, IsFlat<D> isFlat = {}) requires(K == 1)
      : ImplicitStep(level, method.gas, method.method, settings, rules, largest, dt, std::move(isFlat)) {}
  /// Like the constructor above, for the given laws, which must outlive this object.
  ImplicitStep(const Level& level, const LawsOf<K>& gas, const euler::Method& method, const IceSettings& settings,
               const euler::GhostRules<D>& rules, const Box& largest, double dt, IsFlat<D> isFlat = {})
      : level_(level),
        dt_(dt),
        flow_(level, gas, method, settings, rules, largest, dt, std::move(isFlat)),
        after_(flow_.old()),
        middle_(flow_.old()),
        flux_(flow_.old()) {}

  /// Loads the cells of `block`, whose pressures change by `change` [Pa].
  void hold(const Box& block, const euler::ViewsOf<D, K, const double>& before, const CellView<const double>& change) {
    flow_.hold(block, before);
    change_ = &change;
    flow_.fillWithChange(change, after_);
    middle_ = flow_.old();
    flux_.hold(flow_.old().box());
    if (flow_.hasSlopes()) goHalfway(level_.clipCells(block.grown(1, D)));
  }

  /// Computes the fluxes along an axis through the lower faces of the cells of `faces`. u_f transports the values of
  /// the upwind cell, half a step later. The pressure is the mean of p' on both sides; in compression, it also contains
  /// the viscosity of von Neumann and Richtmyer for a strong shock, (gamma + 1) / 2 rho (dv)². Returns the largest
  /// fraction of a cell that flows through a face.
  double computeFluxes(const Box& faces, int axis) {
    const auto all = [](const Index<D>&) { return 1.0; };
    if (K > 1 || hasOwnLaw() || flow_.hasFlatCells()) return computeFluxes(faces, axis, all);
    Box between = faces;  // those between cells of the grid
    double most = 0;
    for (const int side : {0, 1}) {
      Box onSide = faces;
      onSide.lower[axis] = side == 0 ? faces.lower[axis] : faces.upper[axis] - 1;
      onSide.upper[axis] = onSide.lower[axis] + 1;
      if (!flow_.isSide(onSide.lower[axis], axis)) continue;
      most = std::max(most, computeFluxes(onSide, axis, all));
      (side == 0 ? between.lower : between.upper)[axis] += side == 0 ? 1 : -1;
    }
    if constexpr (K == 1) most = std::max(most, computeFluxesBetween(between, axis));
    return most;
  }
  /// Computes fluxes like the function above, with flow only through the open fraction `open(face)` of each face.
  template <class Open>
  double computeFluxes(const Box& faces, int axis, Open&& open) {
    double most = 0;
    forEach<D>(faces, [&](const Index<D>& face) {
      const double share = open(face);
      if (!(share > 0)) return euler::store<D>(flux_.at(face), 0, {});
      const double u = velocity(face, axis);
      const bool isFromBelow = u >= 0;
      const Index<D> from = isFromBelow ? face - Index<D>::unit(axis) : face;
      const euler::State<D, K> w = atFace(from, axis, isFromBelow ? 1 : -1);
      const double push = pressure(face, axis), mass = u * w[euler::kDensity];
      euler::State<D, K> flux;
      flux[euler::kDensity] = mass;
      for (int k = 0; k < D; ++k) flux[euler::kVelocity(k)] = mass * w[euler::kVelocity(k)];
      flux[euler::kVelocity(axis)] += push;
      flux[euler::kPressure<D>] = u * (euler::conserved<D>(flow_.gas(), w)[euler::kPressure<D>] + push);
      for (std::size_t k = D + 2; k < flux.size(); ++k) flux[k] = u * w[k];
      if (share != 1)
        for (double& number : flux) number *= share;
      euler::store<D>(flux_.at(face), 0, flux);
      most = std::max(most, std::abs(u));
    });
    return most * (dt_ * level_.inverseSpacing(axis));
  }
  euler::Rows<D, K>& flux() { return flux_; }
  bool areBlended() const { return euler::areBlended(flow_.gas()); }

  /// Adds gravity and the driving force along an axis to each cell of a block, in equal parts at the two faces normal
  /// to the axis, and its work on the flow through these faces. So stratified gas remains at rest.
  void addGravity(const Box& block, int axis, const euler::StateViews<D, double>& fresh) {
    addGravity(block, axis, fresh, [](const Index<D>&) { return true; });
  }
  /// Adds gravity like the function above, but only in the cells for which `takes(cell)` is true.
  template <class Takes>
  void addGravity(const Box& block, int axis, const euler::StateViews<D, double>& fresh, Takes&& takes) {
    const double g = flow_.gravity()[axis], force = flow_.push()[axis];
    if (g == 0 && force == 0) return;
    forEach<D>(block, [&](const Index<D>& cell) {
      if (!takes(cell)) return;
      const Index<D> above = cell + Index<D>::unit(axis);
      const double rho = flow_.density(cell, axis), rhoAbove = flow_.density(above, axis);
      const double mass = flux_.number(cell, euler::kDensity), massAbove = flux_.number(above, euler::kDensity);
      fresh.momentum[cell][axis] += 0.5 * dt_ * g * (rho + rhoAbove) + dt_ * force;
      fresh.totalEnergy[cell] += 0.5 * dt_ * g * (mass + massAbove);
      fresh.totalEnergy[cell] += 0.5 * dt_ * force * (mass / rho + massAbove / rhoAbove);
    });
  }

 private:
  bool hasOwnLaw() const {
    if constexpr (K == 1)
      return flow_.gas().law != nullptr;
    else
      return true;
  }
  /// Computes fluxes as computeFluxes does, of a single stiffened gas between cells of the grid; several at once.
  double computeFluxesBetween(const Box& faces, int axis) requires(K == 1) {
    const double perWidth = dt_ * level_.inverseSpacing(axis);
    double most = 0;
    grid::forEachRow<D>(faces, [&](const Index<D>& row, int count) {
      const double *change = &(*change_)[row], *changeBelow = &(*change_)[row - Index<D>::unit(axis)];
      const std::ptrdiff_t first = flow_.old().offsetOf(row);
      const auto to = flux_.at(row);
      euler::forEachRegister(count, [&](auto number, std::ptrdiff_t i) {
        using Number = decltype(number);
        const Number rise = euler::numberAt<Number>(change + i) - euler::numberAt<Number>(changeBelow + i);
        const Number u = euler::numberAt<Number>(flow_.unchangedAt(axis, first + i)) -
                         euler::numberAt<Number>(flow_.lossAt(axis, first + i)) * rise;
        euler::store<D, Number>(to, i, fluxBetween(u, first + i, axis));
        using std::abs;
        if constexpr (std::is_same_v<Number, Lanes>)
          most = std::max(most, greatest(abs(u)));
        else
          most = std::max(most, abs(u));
      });
    });
    return most * perWidth;
  }
  /// The flux through the face at a place in the rows, or through those that begin there, with the velocity u.
  template <class Number>
  [[gnu::always_inline]] euler::State<D, 1, Number> fluxBetween(const Number& u, std::ptrdiff_t place, int axis) const {
    const euler::StiffenedGas law = euler::lawOf<euler::StiffenedGas>(flow_.gas());
    const std::ptrdiff_t step = flow_.old().stride(axis);
    const std::size_t p = euler::kPressure<D>, v = euler::kVelocity(axis);
    const auto at = [&](const euler::Rows<D>& of, std::size_t k, std::ptrdiff_t from) {
      return euler::numberAt<Number>(of.component(k) + from);
    };
    const auto isFromBelow = u >= 0.0;
    euler::State<D, 1, Number> w, old;
    for (std::size_t k = 0; k < w.size(); ++k) {
      const Number below = at(flow_.old(), k, place - step), above = at(flow_.old(), k, place);
      old[k] = select(isFromBelow, below, above);
      w[k] = select(isFromBelow, at(middle_, k, place - step), at(middle_, k, place));
      if (!flow_.hasSlopes()) continue;
      const Number outer =
          select(isFromBelow, below - at(flow_.old(), k, place - 2 * step), at(flow_.old(), k, place + step) - above);
      const Number half = VanLeer::half(above - below, outer);
      w[k] = select(isFromBelow, w[k] + half, w[k] - half);
    }
    const auto fine = (w[euler::kDensity] > 0.0) & (law.heat(w[euler::kDensity], w[p]) > 0.0);
    for (std::size_t k = 0; k < w.size(); ++k) w[k] = select(fine, w[k], old[k]);
    const Number below = at(flow_.old(), v, place - step), above = at(flow_.old(), v, place), together = below - above;
    const Number rho = 0.5 * (at(flow_.old(), euler::kDensity, place - step) + at(flow_.old(), euler::kDensity, place));
    const Number viscous = select(together > 0.0, law.shockSlope() * rho * together * together, Number(0.0));
    const Number push = 0.5 * (at(after_, p, place - step) + at(after_, p, place)) + viscous;
    const Number mass = u * w[euler::kDensity];
    euler::State<D, 1, Number> flux;
    flux[euler::kDensity] = mass;
    for (int k = 0; k < D; ++k) flux[euler::kVelocity(k)] = mass * w[euler::kVelocity(k)];
    flux[v] += push;
    flux[p] = u * (euler::conserved<D>(law, w)[p] + push);
    return flux;
  }
  /// (gamma + 1) / 2 at a face; for several gases, the mean of the values on both sides.
  double shockSlope(const Index<D>& face, int axis) const {
    if constexpr (K == 1) return flow_.gas().shockSlope();
    const auto of = [&](const Index<D>& cell) {
      return euler::lawIn<D>(flow_.gas(), flow_.old().state(cell)).shockSlope();
    };
    return 0.5 * (of(face - Index<D>::unit(axis)) + of(face));
  }
  double velocity(const Index<D>& face, int axis) const {
    return flow_.unchanged(face, axis) -
           flow_.loss(face, axis) * (changeIn(face) - changeIn(face - Index<D>::unit(axis)));
  }
  /// p' - p of a cell [Pa]; 0 beyond sides of the grid.
  double changeIn(const Index<D>& cell) const { return flow_.isOnGrid(cell) ? (*change_)[cell] : 0; }
  /// p' on an open side [Pa].
  double openPressure(const Index<D>& face, int axis) const {
    return flow_.openPressure(face, axis, changeIn(face) + changeIn(face - Index<D>::unit(axis)));
  }
  double pressure(const Index<D>& face, int axis) const {
    if (flow_.isOpen(face, axis)) return openPressure(face, axis);
    const std::size_t p = euler::kPressure<D>, v = euler::kVelocity(axis);
    const Index<D> below = face - Index<D>::unit(axis);
    const double together = flow_.old().number(below, v) - flow_.old().number(face, v);
    const double rho = flow_.density(face, axis);
    const double viscous = together > 0 ? shockSlope(face, axis) * rho * together * together : 0;
    // If a velocity is given without a pressure, as at a wall, p' follows from the adjacent cell, whose centre is half
    // a cell away.
    const double weight =
        flow_.isFree(face, axis) ? 0.5 * level_.spacing(axis) * rho * flow_.acceleration(axis, rho) : 0;
    return 0.5 * (after_.number(below, p) + after_.number(face, p)) + viscous + (face[axis] == 0 ? -weight : weight);
  }
  /// p' beyond a face of a cell [Pa]. Beyond an open side, it is the value whose mean with the value of the cell is p'
  /// on the side.
  double pressureBeyond(const Index<D>& cell, int axis, int side) const {
    const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(axis);
    const std::size_t p = euler::kPressure<D>;
    if (flow_.isOpen(face, axis)) return 2 * openPressure(face, axis) - after_.number(cell, p);
    return after_.number(side == 0 ? cell - Index<D>::unit(axis) : face, p);
  }
  /// The state of a cell at the face above (1) or below it (-1), half a step later. For several gases, its density is
  /// always the sum of the masses; otherwise, a difference would grow where gas flows in with the state of the adjacent
  /// cell.
  euler::State<D, K> atFace(const Index<D>& cell, int axis, int side) const {
    euler::State<D, K> w = middle_.state(cell);
    const bool isSloped = flow_.hasSlopes() && flow_.isOnGrid(cell);
    if (isSloped) {
      const euler::State<D, K> slopes = flow_.slopes(cell, axis);
      for (std::size_t k = 0; k < w.size(); ++k) w[k] += 0.5 * side * slopes[k];
    }
    const bool fine = closeState<D, K>(w) && w[euler::kDensity] > 0 &&
                      euler::lawIn<D>(flow_.gas(), w).heat(w[euler::kDensity], w[euler::kPressure<D>]) > 0;
    if (fine || !isSloped) return w;
    w = flow_.old().state(cell);
    closeState<D, K>(w);
    return w;
  }
  /// Computes the changes of cells due to flow, pressure and gravity in half a step.
  void goHalfway(const Box& cells) {
    const auto alone = [&](const Index<D>& cell) {
      goHalfwayIn(cell, 1, [&](int d, int side, auto, std::ptrdiff_t) { return pressureBeyond(cell, d, side); });
    };
    if (flow_.hasFlatCells())
      return forEach<D>(cells, [&](const Index<D>& cell) {
        if (!flow_.isFlat(cell)) alone(cell);
      });
    grid::forEachRow<D>(cells, [&](const Index<D>& row, int count) {
      goHalfwayIn(row, count, [&](int d, int side, auto number, std::ptrdiff_t place) {
        const std::ptrdiff_t step = side == 0 ? -after_.stride(d) : after_.stride(d);
        return euler::numberAt<decltype(number)>(after_.component(euler::kPressure<D>) + place + step);
      });
    });
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        Box beside = cells;
        (side == 0 ? beside.upper : beside.lower)[d] = side == 0 ? cells.lower[d] + 1 : cells.upper[d] - 1;
        if (!flow_.isSide(beside.lower[d] + side, d)) continue;
        forEach<D>(beside, [&](const Index<D>& cell) {
          if (flow_.isOpen(side == 0 ? cell : cell + Index<D>::unit(d), d)) alone(cell);
        });
      }
  }
  /// The same in a row of cells. `beyond(axis, side, number, place)` returns p' beyond a face of the cell at a place in
  /// the rows or, for Lanes, of the cells that begin there.
  template <class Beyond>
  void goHalfwayIn(const Index<D>& row, int count, Beyond&& beyond) {
    const std::ptrdiff_t first = flow_.old().offsetOf(row);
    const auto to = middle_.at(row);
    euler::forEachRegister(count, [&](auto number, std::ptrdiff_t i) {
      using Number = decltype(number);
      const auto at = [&](std::size_t k, std::ptrdiff_t step) {
        return euler::numberAt<Number>(flow_.old().component(k) + first + i + step);
      };
      euler::State<D, K, Number> w;
      for (std::size_t k = 0; k < w.size(); ++k) w[k] = at(k, 0);
      euler::State<D, K, Number> middle = w;
      for (int d = 0; d < D; ++d) {
        const double ratio = 0.5 * dt_ * level_.inverseSpacing(d);
        const std::ptrdiff_t step = flow_.old().stride(d);
        for (std::size_t k = 0; k < w.size(); ++k)
          middle[k] -= ratio * w[euler::kVelocity(d)] * (2.0 * VanLeer::half(w[k] - at(k, -step), at(k, step) - w[k]));
        const Number push = 0.5 * (beyond(d, 1, number, first + i) - beyond(d, 0, number, first + i));
        middle[euler::kVelocity(d)] +=
            0.5 * dt_ * flow_.acceleration(d, w[euler::kDensity]) - ratio * push / w[euler::kDensity];
      }
      euler::store<D, Number>(to, i, middle);
    });
  }

  const Level& level_;
  double dt_;
  FaceFlow<D, K> flow_;
  const CellView<const double>* change_ = nullptr;
  euler::Rows<D, K> after_, middle_, flux_;
};

/// Advances the cells of a block by a step. Returns the largest fraction of a cell that flows through a face.
template <int D, int K>
double advanceBlockImplicitly(const Level& level, const Box& block, const euler::ViewsOf<D, K, const double>& before,
                              double dt, const CellView<const double>& change, ImplicitStep<D, K>& step,
                              const euler::ViewsOf<D, K, double>& fresh, const euler::FaceMasses<D>& masses) {
  double most = 0;
  step.hold(block, before, change);
  const auto sweep = [&]<int Axis>() {
    Box faces = block;
    ++faces.upper[Axis];
    most = std::max(most, step.computeFluxes(faces, Axis));
    euler::addFluxes<D, Axis>(dt / level.spacing(Axis), block, before, step.flux(), fresh, step.areBlended());
    step.addGravity(block, Axis, fresh);
    masses.keep(block, Axis, step.flux());
  };
  sweep.template operator()<0>();
  if constexpr (D > 1) sweep.template operator()<1>();
  if constexpr (D > 2) sweep.template operator()<2>();
  return most;
}

/// Throws NumericalError if gas would cross more than one cell in the step.
inline void refuseCrossing(double most, double dt) {
  if (!(most <= 1))
    throw NumericalError(fmt::format("gas would cross {:.3g} cells in a step of {:.3g} s", most, dt),
                         "a smaller CFD/cfl", "c.velocity");
}

/// Performs one step on a patch in which pressures change by `change`, p' - p [Pa]: U' = U - dt sum_d (F_{d,i+1/2} -
/// F_{d,i-1/2}) / h_d, where F = u_f (rho, rho v, E + p_f) + (0, p_f n, 0). Mass, momentum and total energy are
/// conserved for any p'; a contact keeps a uniform pressure and velocity. The step is of second order in space and of
/// first order in time. Throws NumericalError if a density or p + p_inf would not be positive, or if gas would cross
/// more than a cell. Sources: those of FaceFlow; for shocks, J. von Neumann & R. D. Richtmyer, J. Appl. Phys. 21 (1950)
/// 232.
template <int D>
void advanceImplicitly(const Patch& patch, const euler::Settings& method, const IceSettings& settings,
                       const euler::OldState<D>& before, double time, double dt, CellView<const double> change,
                       const euler::NewState<D>& fresh, const euler::FaceMasses<D>& masses) {
  const Level& level = patch.level();
  const euler::GhostRules<D> rules = euler::ghostRules<D>(level, method.gas, time);
  ImplicitStep<D> step(level, method, settings, rules, euler::largestBlock<D>(patch.cells()), dt);
  double most = 0;
  bool fine = true;
  euler::forEachBlock<D>(patch.cells(), [&](const Box& block) {
    most = std::max(most, advanceBlockImplicitly<D, 1>(level, block, before, dt, change, step, fresh, masses));
    fine &= euler::canBe<D>(method.gas, block, fresh);
  });
  if (!fine) euler::refuseBroken<D, double>(patch, method.gas, fresh, &before);
  refuseCrossing(most, dt);
}

}  // namespace tushar::ice
