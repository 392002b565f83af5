#pragma once

#include <array>
#include <cmath>

#include "components/euler/courant.hpp"
#include "core/base/limiters.hpp"

namespace tushar::ice {

/// The rates at which the gas of a cell crosses it along each axis, by flow, diffusion and acceleration. Numbers are
/// double or Lanes.
template <int D, class Number = double>
struct PushedGas {
  std::array<Number, D> flow = {}, diffusion = {}, push = {};  ///< [1/s], [1/s], [1/s²]

  /// (r + sqrt(r² + 4 sum_d push_d)) / 2, where r = sum_d flow_d + diffusion_d, and the greatest such rate with the
  /// flow and the push of one axis, combined as a CrossingRate [1/s].
  Number rate(const euler::CrossingRate<D>& crossing) const {
    Number all = 0.0, spread = 0.0, pushes = 0.0, greatest = 0.0;
    for (int d = 0; d < D; ++d) {
      all += flow[d];
      all += diffusion[d];
      spread += diffusion[d];
      pushes += push[d];
    }
    for (int d = 0; d < D; ++d) {
      const Number one = pushed(flow[d] + spread, push[d]);
      greatest = select(greatest < one, one, greatest);
    }
    return crossing(pushed(all, pushes), greatest);
  }

 private:
  static Number pushed(const Number& rate, const Number& push) {
    using std::sqrt;
    return 0.5 * (rate + sqrt(rate * rate + 4.0 * push));
  }
};

}  // namespace tushar::ice
