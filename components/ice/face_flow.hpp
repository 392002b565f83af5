#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "components/euler/diffusion.hpp"
#include "components/euler/mixture.hpp"
#include "components/euler/settings.hpp"
#include "components/euler/tasks/advance_block.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::ice {

/// Gravity, driving force and diffusion of a gas, and the settings of implicit steps.
struct IceSettings {
  euler::Diffusion diffusion;
  Vec3 gravity = Vec3::Zero();  ///< gravity [m/s²]
  Vec3 push = Vec3::Zero();     ///< driving force per volume [N/m³]
  double soundSpeedKnob = 0;    ///< fraction of the speed of sound that limits implicit steps; 0: no limit
  solvers::LinearSettings solver = {};
};

/// A function that returns whether a cell has no slopes, because a body is in it or next to it. If it is empty, all
/// cells have slopes.
template <int D>
using IsFlat = std::function<bool(const Index<D>&)>;

/// The laws of one gas, or of K gases that share cells.
template <int K>
using LawsOf = std::conditional_t<K == 1, euler::Gas, euler::Mixture<K>>;

/// Makes a state of several gases consistent after its components have been changed separately: scales masses and
/// volume fractions so that the fractions add up to 1, and sets the density to the sum of the masses. Returns whether
/// each mass and each fraction is at least 0.
template <int D, int K>
bool closeState([[maybe_unused]] euler::State<D, K>& w) {
  if constexpr (K == 1) {
    return true;
  } else {
    double shares = 0, density = 0;
    bool isFine = true;
    for (int k = 0; k < K; ++k) shares += w[euler::kShare<D, K>(k)];
    for (std::size_t k = D + 2; k < w.size(); ++k) {
      isFine &= w[k] >= 0;
      w[k] /= shares;
    }
    for (int k = 0; k < K; ++k) density += w[euler::kMass<D>(k)];
    w[euler::kDensity] = density;
    return isFine;
  }
}

/// The state of one gas, or of K gases, before a step, including cells beyond the sides of the grid, and the values
/// prescribed at faces on these sides. A face is identified by an axis and by the cell above it.
template <int D, int K = 1>
class GasBefore {
 public:
  /// Allocates space for boxes of up to `cells` cells; the laws and the rules at the sides must outlive this object.
  GasBefore(const Level& level, const LawsOf<K>& gas, const IceSettings& settings, const euler::GhostRules<D>& rules,
            std::size_t cells, IsFlat<D> isFlat = {})
      : level_(level),
        rules_(rules),
        gas_(gas),
        gravity_(level.reduce<D>(settings.gravity)),
        push_(level.reduce<D>(settings.push)),
        is_flat_(std::move(isFlat)),
        old_(cells) {
    for (int d = 0; d < D; ++d)
      if (level.isPeriodic(d))
        sides_[d] = {std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
      else
        sides_[d] = {0, level.cells().upper[d]};
  }

  /// Loads the gas in the cells of `box`.
  void hold(const Box& box, const euler::ViewsOf<D, K, const double>& before) {
    old_.hold(box);
    if constexpr (K == 1)
      gas_.withLaw([&](const auto& law) { euler::recover<D>(law, level_, old_.box(), before, old_); });
    else
      euler::recover<D>(gas_, level_, old_.box(), before, old_);
    euler::fillBeyondGrid<D>(level_, rules_, old_);
    has_flat_cells_ = false;
    if (is_flat_)
      forEach<D>(level_.clipCells(box.grown(-1, D)),
                 [&](const Index<D>& cell) { has_flat_cells_ = has_flat_cells_ || is_flat_(cell); });
  }

  const Level& level() const { return level_; }
  const LawsOf<K>& gas() const { return gas_; }
  /// The acceleration [m/s²] by gravity and the driving force where the density [kg/m³] is `density`, which may be 0
  /// without a driving force. Numbers are double or Lanes.
  template <class Number>
  Number acceleration(int axis, const Number& density) const {
    return push_[axis] == 0 ? Number(gravity_[axis]) : gravity_[axis] + push_[axis] / density;
  }
  const Vec<D>& gravity() const { return gravity_; }
  const Vec<D>& push() const { return push_; }
  /// Rho, v and p; for several gases also their masses and volume fractions.
  const euler::Rows<D, K>& old() const { return old_; }
  /// Speed of sound in a cell [m/s].
  double soundSpeed(const Index<D>& cell) const { return soundSpeed(cell, old_.number(cell, euler::kDensity)); }
  /// Speed of sound [m/s] that a cell would have with the given density [kg/m³].
  double soundSpeed(const Index<D>& cell, double density) const {
    const double pressure = old_.number(cell, euler::kPressure<D>);
    return std::sqrt(euler::lawIn<D>(gas_, old_.state(cell)).soundSpeedSquared(density, pressure));
  }
  /// Fills `rows` with the old state, but with the given pressure in the cells of the grid; cells beyond sides follow
  /// from it.
  void fillWithPressure(const CellView<const double>& pressure, euler::Rows<D, K>& rows) const {
    fillWith(rows, [&](const Index<D>& cell, double) { return pressure[cell]; });
  }
  /// Fills `rows` like fillWithPressure, given the change of the old pressure.
  void fillWithChange(const CellView<const double>& change, euler::Rows<D, K>& rows) const {
    fillWith(rows, [&](const Index<D>& cell, double old) { return old + change[cell]; });
  }
  /// Whether a cell is on the grid, or is the periodic image of such a cell.
  bool isOnGrid(const Index<D>& cell) const {
    for (int d = 0; d < D; ++d)
      if (cell[d] < sides_[d][0] || cell[d] >= sides_[d][1]) return false;
    return true;
  }
  /// Whether a face lies on a side of the grid; it is identified by an axis and by the cell above it, of which only the
  /// place along the axis matters.
  bool isOnSide(const Index<D>& face, int axis) const { return isSide(face[axis], axis); }
  bool isSide(int place, int axis) const { return place == sides_[axis][0] || place == sides_[axis][1]; }
  bool isFlat(const Index<D>& cell) const { return is_flat_ && is_flat_(cell); }
  /// Whether isFlat is true in one of the cells that are held, except for the outermost ones.
  bool hasFlatCells() const { return has_flat_cells_; }
  /// The limited differences of the state across a cell along an axis.
  euler::State<D, K> slopes(const Index<D>& cell, int axis) const {
    euler::State<D, K> slopes{};
    if (isFlat(cell)) return slopes;
    const std::ptrdiff_t step = old_.stride(axis);
    const double* middle = old_.component(0) + old_.offsetOf(cell);
    for (std::size_t k = 0; k < slopes.size(); ++k, middle += old_.room())
      slopes[k] = VanLeer::slope(middle[0] - middle[-step], middle[step] - middle[0]);
    return slopes;
  }

  /// The normal velocity at a face [m/s], if it does not depend on the pressure.
  std::optional<double> givenVelocity(const Index<D>& face, int axis) const {
    if (!isOnSide(face, axis)) return {};
    const std::optional<euler::GhostRule<D>> rule = ruleOf(face, axis);
    if (rule && rule->mirrored) return 0.0;
    if (rule && rule->factor[euler::kVelocity(axis)] == 0) return rule->value[euler::kVelocity(axis)];
    return {};
  }
  /// Whether a face lies on a side at which no pressure is given.
  bool isFree(const Index<D>& face, int axis) const {
    if (!isOnSide(face, axis)) return false;
    const std::optional<euler::GhostRule<D>> rule = ruleOf(face, axis);
    return rule && rule->factor[euler::kPressure<D>] != 0;
  }
  /// Whether a face lies on a side through which gas leaves: neither a pressure nor a normal velocity is given.
  bool isOpen(const Index<D>& face, int axis) const { return isFree(face, axis) && !givenVelocity(face, axis); }
  /// Density at a face, rho_f [kg/m³].
  double density(const Index<D>& face, int axis) const { return mean(old_, face, axis, euler::kDensity); }
  /// The mean of p + p_inf on both sides of a face [Pa].
  double stiffPressure(const Index<D>& face, int axis) const {
    return mean(old_, face, axis, euler::kPressure<D>) + gas_.pInfinity;
  }
  /// dt / (rho_f h) [m/(s Pa)]: the decrease of the normal velocity in a time dt [s], per Pa by which the pressure
  /// rises across the face; 0 where pressure does not act.
  double mobility(const Index<D>& face, int axis, double dt) const {
    if (isOnSide(face, axis) && (isFree(face, axis) || givenVelocity(face, axis))) return 0;
    return dt * level_.inverseSpacing(axis) / density(face, axis);
  }

 protected:
  /// The first and the last face along each axis; out of reach if periodic.
  std::array<std::array<int, 2>, D> sides_;

  /// The relaxation at the side that contains a face.
  euler::Relaxation relaxationOf(const Index<D>& face, int axis) const {
    const std::optional<euler::GhostRule<D>> rule = ruleOf(face, axis);
    return rule ? rule->relaxes : euler::Relaxation();
  }
  static double mean(const euler::Rows<D, K>& of, const Index<D>& face, int axis, std::size_t number) {
    const double* above = of.component(number) + of.offsetOf(face);
    return 0.5 * (above[-of.stride(axis)] + above[0]);
  }

 private:
  template <class PressureOf>
  void fillWith(euler::Rows<D, K>& rows, PressureOf&& pressureOf) const {
    rows = old_;
    forEach<D>(level_.clipCells(rows.box()), [&](const Index<D>& cell) {
      double& pressure = *rows.at(cell)[euler::kPressure<D>];
      pressure = pressureOf(cell, pressure);
    });
    euler::fillBeyondGrid<D>(level_, rules_, rows);
  }
  /// The rule at a face on a side of the grid, that is, for the cell beyond it; none at other faces.
  std::optional<euler::GhostRule<D>> ruleOf(const Index<D>& face, int axis) const {
    if (!isOnSide(face, axis)) return {};
    const bool isUpper = face[axis] == sides_[axis][1];
    return euler::ruleAt<D>(level_, rules_, axis, isUpper ? 1 : 0, isUpper ? face : face - Index<D>::unit(axis));
  }

  const Level& level_;
  const euler::GhostRules<D>& rules_;
  const LawsOf<K>& gas_;
  Vec<D> gravity_, push_;
  IsFlat<D> is_flat_;
  bool has_flat_cells_ = false;
  euler::Rows<D, K> old_;
};

/// The normal velocities at the faces of cells that follow from the pressure p' at the end of a step:
///
///   u_f = u*_f - dt / (rho_f h) (p'_R - p'_L),   u*_f = the mean of v - dt (v . grad) v of both cells + dt g,
///
/// where rho_f is the mean density. At walls, and at sides with a Velocity, u_f is the velocity given there, whatever
/// the pressure. Other sides without a Pressure are open: no wave enters through them. With the outward normal n, the
/// pressure p_o = p + rho g_n h / 2 at the centre of the side, and the adjacent cell c,
///
///   u_n = v_n,c + (p'_f - p_o + r) / (rho_f c) = u*_n,c - dt / (rho_f h / 2) (p'_f - p'_c),
///
/// where r is the loss of the incoming wave if the side relaxes to a far-field pressure, and 0 otherwise.
///
/// Only the change p' - p is used, so that round-off of p does not move gas at rest.
/// Sources: F. H. Harlow & A. A. Amsden, J. Comput. Phys. 8 (1971) 197; N. Kwatra, J. Su, J. T. Gretarsson & R. Fedkiw,
/// J. Comput. Phys. 228 (2009) 4146; for open sides, K. W. Thompson, J. Comput. Phys. 68 (1987) 1.
template <int D, int K = 1>
class FaceFlow : public GasBefore<D, K> {
 public:
  /// Allocates space for boxes no larger than `largest`.
  FaceFlow(const Level& level, const euler::Settings& method, const IceSettings& settings,
           const euler::GhostRules<D>& rules, const Box& largest, double dt, IsFlat<D> isFlat = {}) requires(K == 1)
      : FaceFlow(level, method.gas, method.method, settings, rules, largest, dt, std::move(isFlat)) {}
  /// Like the constructor above, for the given laws, which must outlive this object.
  FaceFlow(const Level& level, const LawsOf<K>& gas, const euler::Method& method, const IceSettings& settings,
           const euler::GhostRules<D>& rules, const Box& largest, double dt, IsFlat<D> isFlat = {})
      : GasBefore<D, K>(level, gas, settings, rules, largest.grown(2, D).size(), std::move(isFlat)),
        dt_(dt),
        hasSlopes_(method.reconstruction != euler::Reconstruction::firstOrder),
        ahead_(this->old()) {
    for (int d = 0; d < D; ++d) {
      unchanged_[d].resize(ahead_.room());
      loss_[d].resize(ahead_.room());
    }
  }

  /// Loads the faces of the cells in `box`; it needs the state in two more layers of cells.
  void hold(const Box& box, const euler::ViewsOf<D, K, const double>& before) {
    GasBefore<D, K>::hold(box.grown(2, D), before);
    ahead_ = this->old();
    if (hasSlopes_) carryVelocities(this->level().clipCells(box.grown(1, D)));
    for (int d = 0; d < D; ++d) {
      Box faces = box;
      ++faces.upper[d];
      findFaces(faces, d);
      for (const int side : {0, 1})
        if (this->sides_[d][side] >= faces.lower[d] && this->sides_[d][side] < faces.upper[d]) {
          Box onSide = faces;
          onSide.lower[d] = this->sides_[d][side];
          onSide.upper[d] = onSide.lower[d] + 1;
          forEach<D>(onSide, [&](const Index<D>& face) { findFaceOnSide(face, d); });
        }
    }
  }
  /// Whether cells have van Leer's slopes, rather than constant values.
  bool hasSlopes() const { return hasSlopes_; }

  /// u_f [m/s] for unchanged pressures.
  double unchanged(const Index<D>& face, int axis) const { return unchanged_[axis][this->old().offsetOf(face)]; }
  /// The decrease of u_f per increase of the pressure in the cell above the face [m/(s Pa)]. It equals the increase of
  /// u_f per increase of the pressure in the cell below. The pressure beyond a side does not change.
  double loss(const Index<D>& face, int axis) const { return loss_[axis][this->old().offsetOf(face)]; }
  /// The same, by the face's place in the rows of old().
  const double* unchangedAt(int axis, std::ptrdiff_t offset) const { return unchanged_[axis].data() + offset; }
  const double* lossAt(int axis, std::ptrdiff_t offset) const { return loss_[axis].data() + offset; }
  /// p' [Pa] on an open side if the pressure of the adjacent cell changes by `change` [Pa].
  double openPressure(const Index<D>& face, int axis, double change) const {
    const OpenSide side = openSide(face, axis);
    return side.pressure +
           (side.carried + side.push * change - side.lightness * side.relaxed) / (side.push + side.lightness);
  }

 private:
  /// An open side and the adjacent cell.
  struct OpenSide {
    double normal;     ///< 1 or -1: the outward direction
    double speed;      ///< outward velocity before the step [m/s]
    double carried;    ///< change of this velocity by (v . grad) v in the step [m/s]
    double pressure;   ///< pressure p_o [Pa]
    double lightness;  ///< 1 / (rho c) [m/(s Pa)]
    double push;       ///< dt / (rho h / 2) [m/(s Pa)]
    double relaxed;    ///< change of the incoming wave due to relaxation [Pa]
  };
  OpenSide openSide(const Index<D>& face, int axis) const {
    const bool isLower = face[axis] == 0;
    const Index<D> cell = isLower ? face : face - Index<D>::unit(axis);
    const std::size_t v = euler::kVelocity(axis);
    const double rho = this->density(face, axis), h = this->level().spacing(axis), normal = isLower ? -1 : 1;
    const double pressure = this->old().number(cell, euler::kPressure<D>), speed = this->old().number(cell, v);
    const double sound = this->soundSpeed(cell, rho);
    const euler::Relaxation relaxes = this->relaxationOf(face, axis);
    return {.normal = normal,
            .speed = normal * speed,
            .carried = normal * (ahead_.number(cell, v) - speed),
            .pressure = pressure + 0.5 * rho * h * normal * this->acceleration(axis, rho),
            .lightness = 1 / (rho * sound),
            .push = 2 * dt_ / (rho * h),
            .relaxed = relaxes.acts() ? relaxes.loss(pressure, normal * speed, sound, sound * dt_ / h) : 0};
  }
  /// u_f [m/s] through an open side, for unchanged pressures.
  static double throughOpenSide(const OpenSide& side) {
    return side.normal *
           (side.speed + side.lightness * (side.carried + side.push * side.relaxed) / (side.push + side.lightness));
  }
  /// Changes the velocities of cells to v - dt (v . grad) v.
  void carryVelocities(const Box& cells) {
    if (this->hasFlatCells())
      return forEach<D>(cells, [&](const Index<D>& cell) {
        if (!this->isFlat(cell)) carryVelocity(cell, 1);
      });
    grid::forEachRow<D>(cells, [&](const Index<D>& row, int count) { carryVelocity(row, count); });
  }
  void carryVelocity(const Index<D>& row, int count) {
    const std::ptrdiff_t first = this->old().offsetOf(row);
    const auto ahead = ahead_.at(row);
    euler::forEachRegister(count, [&](auto number, std::ptrdiff_t i) {
      using Number = decltype(number);
      const auto at = [&](int axis) { return this->old().component(euler::kVelocity(axis)) + first + i; };
      std::array<Number, D> ratios;
      for (int d = 0; d < D; ++d) ratios[d] = dt_ * this->level().inverseSpacing(d) * euler::numberAt<Number>(at(d));
      for (int k = 0; k < D; ++k) {
        const double* v = at(k);
        const auto middle = euler::numberAt<Number>(v);
        auto carried = middle;
        for (int d = 0; d < D; ++d) {
          const std::ptrdiff_t step = this->old().stride(d);
          const Number below = middle - euler::numberAt<Number>(v - step);
          const Number above = euler::numberAt<Number>(v + step) - middle;
          carried = carried - ratios[d] * (2.0 * VanLeer::half(below, above));
        }
        euler::put(carried, ahead[euler::kVelocity(k)] + i);
      }
    });
  }
  /// Computes the flow through faces as if none of them were on a side.
  void findFaces(const Box& faces, int axis) {
    const std::ptrdiff_t step = this->old().stride(axis);
    const double perWidth = dt_ * this->level().inverseSpacing(axis);
    grid::forEachRow<D>(faces, [&](const Index<D>& row, int count) {
      const std::ptrdiff_t first = this->old().offsetOf(row);
      euler::forEachRegister(count, [&](auto number, std::ptrdiff_t i) {
        using Number = decltype(number);
        const auto pair = [&](const euler::Rows<D, K>& of, std::size_t k) {
          const double* above = of.component(k) + first + i;
          return std::pair(euler::numberAt<Number>(above - step), euler::numberAt<Number>(above));
        };
        const auto mean = [](const auto& two) { return 0.5 * (two.first + two.second); };
        const Number rho = mean(pair(this->old(), euler::kDensity)), loss = perWidth / rho;
        const auto pressure = pair(this->old(), euler::kPressure<D>);
        const Number ahead = mean(pair(ahead_, euler::kVelocity(axis)));
        euler::put(ahead + dt_ * this->acceleration(axis, rho) - loss * (pressure.second - pressure.first),
                   unchanged_[axis].data() + first + i);
        euler::put(loss, loss_[axis].data() + first + i);
      });
    });
  }
  /// Corrects what findFaces has computed for a face on a side.
  void findFaceOnSide(const Index<D>& face, int axis) {
    const std::ptrdiff_t at = this->old().offsetOf(face);
    double &unchanged = unchanged_[axis][at], &loss = loss_[axis][at];
    if (const auto given = this->givenVelocity(face, axis)) {
      unchanged = *given;
      loss = 0;
    } else if (this->isFree(face, axis)) {
      const OpenSide side = openSide(face, axis);
      unchanged = throughOpenSide(side);
      loss = side.lightness * side.push / (side.push + side.lightness);
    }
  }

  double dt_;
  bool hasSlopes_;
  euler::Rows<D, K> ahead_;
  std::array<std::vector<double>, D> unchanged_, loss_;  ///< for the faces along each axis, at their places in old()
};

}  // namespace tushar::ice
