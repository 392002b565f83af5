#pragma once

#include "components/mpmice/free_space.hpp"
#include "components/mpmice/warm_cells.hpp"

namespace tushar::mpmice {

/// Computes the heat that bodies and gases in neighbouring cells exchange, with Uintah's coefficients.
///
/// Where the gas fills the fraction a of a cell, and a body the fraction b of the next one, they exchange heat as if
/// they shared 4 (a - 1/2)² (b - 1/2)² of a cell, if both are greater than 1/2. Where the surface of a body divides a
/// cell into s and 1 - s, gas and body share s (1 - s) of it, and the neighbours add (s - 1/2)². So a plane surface
/// normal to an axis always has 1/4 of a cell. The same applies to two bodies.
///
/// With Uintah's `do_convective_heat_transfer`, a body that fills the fraction b of a cell and a gas that fills a of a
/// neighbouring one also exchange heat as if they shared a b |n| / 4 of a cell, where n is the component of the normal
/// of the body along the axis. For a plane surface, this adds another 1/4 of a cell. In Uintah, the surface of the body
/// exchanges heat with the gas of a cell in front of it.
template <int D, int Most, class Gas>
class HeatAtFaces {
 public:
  using Vector = typename ice::WarmThings<Most>::Vector;

  HeatAtFaces(const Level& level, const Settings& settings, const Gas& gas, const WarmCells<D, Most, Gas>& cells,
              double dt)
      : level_(level), settings_(settings), gas_(gas), cells_(cells), dt_(dt) {}

  /// The heat that each body and gas of a cell receives through the faces of the cell, per cell volume [J/m³].
  Vector received(const Index<D>& cell) const {
    const ice::WarmThings<Most> own = cells_.at(cell);
    Vector heat = Vector::Zero(own.capacity.size());
    for (int d = 0; d < D; ++d) {  // opposite faces first, so that the sums of mirrored cells are alike
      Vector both = Vector::Zero(heat.size());
      for (const int side : {0, 1}) both += through(cell, own, d, side);
      heat += both;
    }
    return heat;
  }
  /// Calls `visit(cell)` for the cells of a box that may receive heat through a face.
  template <class Visit>
  void forEachIn(const Box& box, Visit&& visit) const {
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(box.extent(0)));
    forEachRow<D>(box, [&](const Index<D>& first, int count) {
      markRow(first, count, marks.data());
      Index<D> cell = first;
      for (int i = 0; i < count; ++i, ++cell[0])
        if (marks[i] != 0 && mayReceive(cell)) visit(cell);
    });
  }

 private:
  /// Whether anything may pass through a face of a cell.
  bool mayReceive(const Index<D>& cell) const {
    bool may = false;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) may = may || mayPass(cell, d, side);
    return may;
  }
  /// Marks the cells of a row that bodies fill by more than this fraction, or beside which there is one.
  void markRow(const Index<D>& first, int count, std::uint8_t* marks) const {
    const double most = settings_.convection ? 1 : 0.5;
    Index<D> last = first;
    last[0] += count - 1;
    const auto add = [&](const double* free, std::uint8_t* to, int cells) {
#pragma GCC ivdep
      for (int i = 0; i < cells; ++i) to[i] = static_cast<std::uint8_t>(to[i] | static_cast<int>(free[i] < most));
    };
    std::fill_n(marks, count, std::uint8_t{0});
    add(&gas_.free[first], marks, count);
    for (const int side : {0, 1}) {
      const Index<D>& end = side == 0 ? first : last;
      if (isInGrid(beside(end, 0, side), 0))
        add(&gas_.free[beside(end, 0, side)], side == 0 ? marks : marks + count - 1, 1);
      add(&gas_.free[first] + (side == 0 ? 0 : 1), side == 0 ? marks + 1 : marks, count - 1);
      for (int d = 1; d < D; ++d)
        if (isInGrid(beside(first, d, side), d)) add(&gas_.free[beside(first, d, side)], marks, count);
    }
  }
  static Index<D> beside(const Index<D>& cell, int axis, int side) {
    return side == 0 ? cell - Index<D>::unit(axis) : cell + Index<D>::unit(axis);
  }
  bool isInGrid(const Index<D>& cell, int axis) const {
    return level_.isPeriodic(axis) ||
           (cell[axis] >= level_.cells().lower[axis] && cell[axis] < level_.cells().upper[axis]);
  }
  bool mayPass(const Index<D>& cell, int axis, int side) const {
    const Index<D> next = beside(cell, axis, side);
    if (!isInGrid(next, axis)) return false;
    if (settings_.convection && (meets(cell, next) || meets(next, cell))) return true;
    const bool isFilled = gas_.free[cell] < 0.5, isNextFilled = gas_.free[next] < 0.5;
    if (isFilled != isNextFilled) return true;
    if (!isFilled || cells_.bodies() == 1) return false;
    const Eigen::Index own = cells_.bodyThatFills(cell), other = cells_.bodyThatFills(next);
    return own >= 0 && other >= 0 && own != other;
  }
  /// Whether there are bodies in a cell and gas in the next one.
  bool meets(const Index<D>& cell, const Index<D>& next) const { return gas_.free[cell] < 1 && gas_.free[next] > 0; }
  /// What `a` in a cell and `b` in a neighbouring cell share of a cell for convection; 0 unless they are the body and
  /// the gas that convect.
  double convectedBy(Eigen::Index a, Eigen::Index b, const ice::WarmThings<Most>& own,
                     const ice::WarmThings<Most>& other, const Index<D>& cell, const Index<D>& next, int axis) const {
    if (!settings_.convection) return 0;
    const Eigen::Index body = settings_.convection->body, gas = cells_.bodies() + settings_.convection->gas;
    if (a == body && b == gas) return 0.25 * own.volume[a] * other.volume[b] * normalAlong(cell, axis);
    if (a == gas && b == body) return 0.25 * (other.volume[b] * own.volume[a]) * normalAlong(next, axis);
    return 0;
  }
  /// The component along an axis of the unit vector along the gradient of the free volume; 1 if there is no gradient.
  double normalAlong(const Index<D>& cell, int axis) const {
    Vec<D> gradient = Vec<D>::Zero();
    for (int d = 0; d < D; ++d) {
      const Index<D> below = beside(cell, d, 0), above = beside(cell, d, 1);
      gradient[d] = gas_.free[isInGrid(above, d) ? above : cell] - gas_.free[isInGrid(below, d) ? below : cell];
      gradient[d] *= level_.inverseSpacing(d);
    }
    const double length = gradient.norm();
    return length > 0 ? std::abs(gradient[axis]) / length : 1;
  }
  Vector through(const Index<D>& cell, const ice::WarmThings<Most>& own, int axis, int side) const {
    Vector heat = Vector::Zero(own.capacity.size());
    if (!mayPass(cell, axis, side)) return heat;
    const Index<D> next = beside(cell, axis, side);
    const ice::WarmThings<Most> other = cells_.at(next);
    const double ofGas = over(gas_.free[cell]) * over(1 - gas_.free[next]);
    const double ofNextGas = over(1 - gas_.free[cell]) * over(gas_.free[next]);
    const Eigen::Index bodies = cells_.bodies(), count = heat.size();
    for (Eigen::Index a = 0; a < count; ++a)
      for (Eigen::Index b = 0; b < count; ++b) {
        if (a == b || !(own.capacity[a] > 0) || !(other.capacity[b] > 0)) continue;
        double share = 0;
        if (a < bodies && b < bodies)
          share = square(over(own.volume[a]) * over(other.volume[b]));
        else if (a < bodies)
          share = square(ofNextGas) * (partOf(own, a, 1 - gas_.free[cell]) * partOf(other, b, gas_.free[next]));
        else if (b < bodies)
          share = square(ofGas) * (partOf(own, a, gas_.free[cell]) * partOf(other, b, 1 - gas_.free[next]));
        share = 4 * share + convectedBy(a, b, own, other, cell, next, axis);
        if (share > 0) heat[a] += flow(own, a, other, b, share);
      }
    return heat;
  }
  /// The heat from `b` in another cell to `a`. It is limited so that none of them, with all that they exchange through
  /// faces, passes the temperatures of those with which it exchanges heat.
  double flow(const ice::WarmThings<Most>& own, Eigen::Index a, const ice::WarmThings<Most>& other, Eigen::Index b,
              double share) const {
    const auto count = own.capacity.size();
    const double coefficient =
        settings_.heat.of(pairOf(std::min(a, b), std::max(a, b), count), own.mass[a], other.mass[b]);
    const auto partners = static_cast<double>(2 * D * (count - 1));
    const double most = 1 / (partners * (1 / own.capacity[a] + 1 / other.capacity[b]));
    return std::min(coefficient * dt_ * share, most) * (other.temperature[b] - own.temperature[a]);
  }
  /// The index of the pair a < b of `count` things, row by row.
  static std::size_t pairOf(Eigen::Index a, Eigen::Index b, Eigen::Index count) {
    return static_cast<std::size_t>(a * count - a * (a + 1) / 2 + (b - a - 1));
  }
  static double over(double fraction) { return std::max(0.0, fraction - 0.5); }
  static double square(double x) { return x * x; }
  static double partOf(const ice::WarmThings<Most>& things, Eigen::Index k, double whole) {
    return things.volume[k] / whole;
  }

  const Level& level_;
  const Settings& settings_;
  const Gas& gas_;
  const WarmCells<D, Most, Gas>& cells_;
  double dt_;
};

/// Views of the heat that each gas receives through faces.
struct HeatOfGasAtFaces {
  std::vector<CellView<double>> ofGas;

  static HeatOfGasAtFaces from(auto& take, std::size_t gases) {
    return {viewsOfGases(take, std::max<std::size_t>(1, gases),
                         [](std::size_t k) { return computes(c::heatOfGasAtFaces[k]); })};
  }
};
struct HeatOfBodyAtFaces {
  CellView<double> ofBody;

  static HeatOfBodyAtFaces from(auto& take) { return {take(computes(c::heatOfBodyAtFaces))}; }
};

/// Computes the heat that bodies and gases receive from neighbouring cells, given the state after a step.
template <int D, int Most>
void exchangeHeatAtFaces(const Patch& patch, const std::vector<mpm::solid::Material>& materials,
                         const Settings& settings, double dt, const WarmGas<D, const double>& gas,
                         const std::vector<WarmBody>& bodies, const std::vector<HeatOfBodyAtFaces>& toBodies,
                         const HeatOfGasAtFaces& toGases) {
  for (const HeatOfBodyAtFaces& one : toBodies) one.ofBody.fill(0);
  for (const CellView<double>& one : toGases.ofGas) one.fill(0);
  const WarmCells<D, Most, WarmGas<D, const double>> cells(materials, settings, gas, bodies);
  const HeatAtFaces<D, Most, WarmGas<D, const double>> faces(patch.level(), settings, gas, cells, dt);
  faces.forEachIn(patch.cells(), [&](const Index<D>& cell) {
    const auto heat = faces.received(cell);
    for (std::size_t m = 0; m < toBodies.size(); ++m) toBodies[m].ofBody[cell] = heat[m];
    for (std::size_t k = 0; k < toGases.ofGas.size(); ++k)
      toGases.ofGas[k][cell] = heat[static_cast<Eigen::Index>(bodies.size() + k)];
  });
}

}  // namespace tushar::mpmice
