#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "components/euler/courant.hpp"

namespace tushar::ice {

/// The rates at which the gas of a cell crosses it along each axis, by flow, diffusion and acceleration.
template <int D>
struct PushedGas {
  std::array<double, D> flow = {}, diffusion = {}, push = {};  ///< [1/s], [1/s], [1/s²]

  /// (r + sqrt(r² + 4 sum_d push_d)) / 2, where r = sum_d flow_d + diffusion_d, and the greatest such rate with the
  /// flow and the push of one axis, combined as a CrossingRate [1/s].
  double rate(const euler::CrossingRate<D>& crossing) const {
    double all = 0, spread = 0, pushes = 0, greatest = 0;
    for (int d = 0; d < D; ++d) {
      all += flow[d];
      all += diffusion[d];
      spread += diffusion[d];
      pushes += push[d];
    }
    for (int d = 0; d < D; ++d) greatest = std::max(greatest, pushed(flow[d] + spread, push[d]));
    return crossing(pushed(all, pushes), greatest);
  }

 private:
  static double pushed(double rate, double push) { return 0.5 * (rate + std::sqrt(rate * rate + 4 * push)); }
};

}  // namespace tushar::ice
