#pragma once

#include <algorithm>
#include <optional>

#include "core/base/lanes.hpp"
#include "core/base/limiters.hpp"

namespace tushar::euler {

/// The Courant number of a scene, and what it limits: dt times the sum over axes of (|v_d| + c) / h_d, or dt times the
/// greatest of these rates, with a separate limit for the sum.
struct Courant {
  double number = 0.8;  ///< cfl
  /// The limit of dt times the sum, if `number` is that for each axis; none if `number` is the limit of the sum.
  std::optional<double> sum = {};
};

/// The rate [1/s] from which the time step follows, dt = cfl / rate: the greater of the greatest rate of an axis and of
/// a fraction of the sum over axes; or the sum, as always in one dimension.
template <int D>
class CrossingRate {
 public:
  explicit CrossingRate(const Courant& courant) {
    if (D == 1 || !courant.sum) return;
    ofSum_ = std::min(1.0, courant.number / *courant.sum);
    ofAxis_ = 1;
  }

  /// Numbers are double or Lanes.
  template <class Number>
  [[gnu::always_inline]] Number operator()(const Number& sum, const Number& greatest) const {
    const Number fraction = ofSum_ * sum, one = ofAxis_ * greatest;
    return select(fraction > one, fraction, one);
  }
  /// Of the rates along(d) of all axes [1/s].
  template <class Along>
  double ofAxes(Along&& along) const {
    double sum = 0, greatest = 0;
    for (int d = 0; d < D; ++d) {
      const double one = along(d);
      sum += one;
      greatest = std::max(greatest, one);
    }
    return (*this)(sum, greatest);
  }

 private:
  double ofSum_ = 1, ofAxis_ = 0;
};

}  // namespace tushar::euler
