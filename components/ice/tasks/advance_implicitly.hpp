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
    if (flow_.hasSlopes())
      forEach<D>(level_.clipCells(block.grown(1, D)), [&](const Index<D>& cell) { goHalfway(cell); });
  }

  /// Computes the fluxes along an axis through the lower faces of the cells of `faces`. u_f transports the values of
  /// the upwind cell, half a step later. The pressure is the mean of p' on both sides; in compression, it also contains
  /// the viscosity of von Neumann and Richtmyer for a strong shock, (gamma + 1) / 2 rho (dv)². Returns the largest
  /// fraction of a cell that flows through a face.
  double computeFluxes(const Box& faces, int axis) {
    return computeFluxes(faces, axis, [](const Index<D>&) { return 1.0; });
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
      most = std::max(most, std::abs(u) * dt_ * level_.inverseSpacing(axis));
    });
    return most;
  }
  euler::Rows<D, K>& flux() { return flux_; }

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
  /// Computes the change of a cell due to flow, pressure and gravity in half a step.
  void goHalfway(const Index<D>& cell) {
    if (flow_.isFlat(cell)) return;
    const euler::State<D, K> w = flow_.old().state(cell);
    const auto middle = middle_.at(cell);
    for (int d = 0; d < D; ++d) {
      const double ratio = 0.5 * dt_ * level_.inverseSpacing(d);
      const euler::State<D, K> slopes = flow_.slopes(cell, d);
      for (std::size_t k = 0; k < w.size(); ++k) *middle[k] -= ratio * w[euler::kVelocity(d)] * slopes[k];
      const double push = 0.5 * (pressureBeyond(cell, d, 1) - pressureBeyond(cell, d, 0));
      *middle[euler::kVelocity(d)] +=
          0.5 * dt_ * flow_.acceleration(d, w[euler::kDensity]) - ratio * push / w[euler::kDensity];
    }
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
    euler::addFluxes<D, Axis>(dt / level.spacing(Axis), block, before, step.flux(), fresh);
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
