#pragma once

#include <optional>

#include "components/mpm/solid/constitutive/arenisca/closest_point.hpp"

namespace tushar::mpm::solid::arenisca {

/// The state that changes in a step, in axes that rotate with the material.
struct Point {
  Matrix3 stress;         ///< quasistatic stress [Pa]
  Matrix3 plasticStrain;  ///< plastic strain [1]
  double cap;             ///< X, end of the cap [Pa]
  double zeta;            ///< zeta, trace of the stress in the fluid [Pa]

  Moduli moduli(const Constants& c) const { return arenisca::moduli(c, stress.trace(), plasticStrain.trace()); }
};

/// One substep, with the moduli at its start: elastic, or with a return to a yield surface that moves with the
/// volumetric plastic strain. Bisection finds the strain that moves the surface, as a fraction of the plastic strain of
/// a return to the fixed surface: it equals the plastic strain of the return to the moved surface. Homel, Guilkey &
/// Brannon, Comput. Mech. 56 (2015) 565.
class Substep {
 public:
  Substep(const Constants& c, const Point& start, const Matrix3& strain)
      : c_(c),
        start_(start),
        strain_(strain),
        moduli_(start.moduli(c)),
        trial_stress_(start.stress + moduli_.stress(strain)),
        trial_(trial_stress_),
        start_volume_(start.plasticStrain.trace()),
        stiffness_(fluidStiffness(c, start.zeta, start_volume_)) {}

  Point end() const {
    if (contains({c_, start_.cap, start_.zeta})) return {trial_stress_, start_.plasticStrain, start_.cap, start_.zeta};
    const Return atRest = returned({c_, start_.cap, start_.zeta});
    Return moved = atRest;
    if (moves(atRest)) moved = c_.hasTangentCap() ? falsePosition(atRest) : consistent(atRest);
    Point end{moved.stress, start_.plasticStrain + moved.plasticStrain, 0, 0};
    const double excess = std::min(0.0, end.plasticStrain.trace() + c_.p3);
    end.plasticStrain.diagonal().array() -= excess / 3;
    const double volume = moved.plasticStrain.trace() - excess;
    end.cap = capEnd(c_, end.plasticStrain.trace());
    end.zeta = zetaAfter(volume);
    return end;
  }

 private:
  struct Return {
    Matrix3 stress, plasticStrain;
  };

  bool contains(const YieldSurface& surface) const { return surface.contains(trial_.i1, trial_.rootJ2, trial_.theta); }
  /// Zeta after a volumetric strain, at most 0: the fluid bears no tension.
  double zetaAfter(double volume) const { return std::min(start_.zeta + stiffness_ * volume, 0.0); }
  YieldSurface surfaceAfter(double volume) const { return {c_, capEnd(c_, start_volume_ + volume), zetaAfter(volume)}; }
  bool moves(const Return& atRest) const {
    const YieldSurface surface = surfaceAfter(atRest.plasticStrain.trace());
    return surface.end() != start_.cap || surface.zeta() != start_.zeta;
  }
  Return returned(const YieldSurface& surface) const {
    const Matrix3 stress = stressWith(ClosestPoint(c_, moduli_, surface)(trial_), trial_stress_, trial_);
    return {stress, strain_ - moduli_.strain(stress - start_.stress)};
  }
  Return consistent(const Return& atRest) const {
    const double whole = atRest.plasticStrain.trace();
    const bool compacts = trial_.i1<atRest.stress.trace(), dilates = trial_.i1> atRest.stress.trace();
    Return best = atRest;
    double low = 0, high = 1;
    while (high - low > 1e-7) {
      const double share = 0.5 * (low + high);
      const YieldSurface surface = surfaceAfter(share * whole);
      bool isTooFar = contains(surface);
      if (!isTooFar) {
        const Return next = returned(surface);
        isTooFar = compacts != (trial_.i1 < next.stress.trace()) || dilates != (trial_.i1 > next.stress.trace());
        if (!isTooFar) {
          best = next;
          isTooFar = std::abs(next.plasticStrain.trace()) <= share * std::abs(whole);
        }
      }
      (isTooFar ? high : low) = share;
    }
    return best;
  }

  /// Finds the result of `consistent` by the Illinois variant of false position while the excess at both ends is known,
  /// and by bisection while there is no return to the surface at the upper end.
  Return falsePosition(const Return& atRest) const {
    const double whole = std::abs(atRest.plasticStrain.trace());
    Return best = atRest;
    Share low{0, -whole, true}, high{1, 0, false};
    for (int k = 0, side = 0; k < 60 && high.at - low.at > 1e-7; ++k) {
      const double fraction = high.isKnown ? low.excess / (low.excess - high.excess) : 0.5;
      const double share = low.at + fraction * (high.at - low.at);
      const YieldSurface surface = surfaceAfter(share * atRest.plasticStrain.trace());
      const auto next = returnedAhead(surface, atRest);
      if (!next) {
        high = {share, 0, false};
        continue;
      }
      best = *next;
      const double excess = share * whole - std::abs(next->plasticStrain.trace());
      if (std::abs(excess) <= 1e-12 * whole) break;
      const int now = excess > 0 ? 1 : -1;
      if (now == side) (now > 0 ? low : high).excess /= 2;
      side = now;
      (now > 0 ? high : low) = {share, excess, true};
    }
    return best;
  }
  /// A fraction of the plastic strain, and the amount by which it exceeds that of the return to the moved surface.
  struct Share {
    double at, excess;
    bool isKnown;
  };
  /// The return to a moved surface; none if the trial point is inside the surface, or on the other side of it.
  std::optional<Return> returnedAhead(const YieldSurface& surface, const Return& atRest) const {
    if (contains(surface)) return std::nullopt;
    const Return next = returned(surface);
    const double there = next.stress.trace(), before = atRest.stress.trace();
    const bool turns = (trial_.i1 < before) != (trial_.i1 < there) || (trial_.i1 > before) != (trial_.i1 > there);
    return turns ? std::nullopt : std::optional(next);
  }

  const Constants& c_;
  const Point& start_;
  const Matrix3& strain_;
  Moduli moduli_;
  Matrix3 trial_stress_;
  Invariants trial_;
  double start_volume_;  ///< volumetric plastic strain
  double stiffness_;     ///< stiffness of the fluid [Pa]
};

/// Number of substeps for a step that leaves the yield surface with a tangent cap: `mostSubsteps` for every 0.1 % of
/// strain, or for every stress increment of the length of the surface, whichever gives more substeps. A step that stays
/// inside is not divided.
inline int substepsOfTangentCap(const Constants& c, const Point& start, const Matrix3& strain) {
  const Matrix3 change = Moduli{c.b0, c.g0}.stress(strain);
  const Invariants trial(start.stress + change);
  if (YieldSurface(c, start.cap, start.zeta).contains(trial.i1, trial.rootJ2, trial.theta)) return 1;
  const double length = c.peakI1 - start.cap;
  const double size = std::hypot(std::min(0.001 * c.b0, length), std::min(0.002 * c.g0, c.vertexSlope * length));
  constexpr double most = 10000;
  return int(std::ceil(std::clamp(c.mostSubsteps * (std::floor(change.norm() / size) + 1), 1.0, most)));
}

/// Number of substeps; more than one if the bulk modulus changes by more than its value, or the stress by more than
/// 1/`sharpness` of the size of the yield surface.
inline int substeps(const Constants& c, const Point& start, const Matrix3& strain, double sharpness) {
  if (c.hasTangentCap()) return substepsOfTangentCap(c, start, strain);
  const Matrix3 change = Moduli{c.matrixBulk(), c.g0}.stress(strain);
  const double bulk = start.moduli(c).bulk;
  const double there = moduli(c, start.stress.trace() + change.trace(), start.plasticStrain.trace()).bulk;
  double size = 0.5 * (c.peakI1 - start.cap);
  if (c.strength > 0) size = std::min(size, c.strength);
  const double wanted = std::max(std::abs(bulk - there) / bulk, sharpness * change.norm() / size);
  return int(std::ceil(std::clamp(wanted, 1.0, std::max(1.0, c.mostSubsteps))));
}

inline Point advance(const Constants& c, Point point, const Matrix3& strain, double sharpness) {
  const int parts = substeps(c, point, strain, sharpness);
  const Matrix3 part = strain / parts;
  for (int k = 0; k < parts; ++k) point = Substep(c, point, part).end();
  return point;
}

}  // namespace tushar::mpm::solid::arenisca
