#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "core/base/quad.hpp"
#include "core/data/reduction.hpp"

namespace tushar::data {

/// Adds many numbers to a Sum, in eight lanes of vector registers. Numbers wait until there are enough for a loop over
/// registers; the Sum is complete when this object has been destroyed.
class WideSum {
 public:
  explicit WideSum(Sum& sum) : sum_(&sum) {}
  WideSum(const WideSum&) = delete;
  WideSum& operator=(const WideSum&) = delete;
  ~WideSum() {
    while (count_ % width != 0) waiting_[count_++] = 0;
    addWaiting();
    for (std::size_t r = 0; r < registers; ++r)
      for (int lane = 0; lane < 4; ++lane) sum_->merge({value_[r][lane], error_[r][lane], rest_[r][lane]});
  }

  void add(double x) {
    waiting_[count_++] = x;
    if (count_ == waiting_.size()) addWaiting();
  }
  /// Adds `valueOf(k)` for k = 0 to `count` - 1.
  template <class ValueOf>
  void addAll(int count, ValueOf&& valueOf) {
    for (int done = 0; done < count;) {
      double* const to = waiting_.data() + count_;
      const int now = std::min(count - done, static_cast<int>(waiting_.size() - count_));
      for (int k = 0; k < now; ++k) to[k] = valueOf(done + k);
      done += now;
      count_ += static_cast<std::size_t>(now);
      if (count_ == waiting_.size()) addWaiting();
    }
  }

 private:
  static constexpr std::size_t registers = 2, width = 4 * registers;
  using Lanes = std::array<Quad, registers>;

  void addWaiting() {
    Lanes value = value_, error = error_, rest = rest_;  // copies, which the loop keeps in registers
    for (std::size_t k = 0; k < count_; k += width)
      for (std::size_t r = 0; r < registers; ++r) {
        Quad x;
        std::memcpy(&x, waiting_.data() + k + 4 * r, sizeof(x));
        addExactly(value[r], x);
        addExactly(error[r], x);
        rest[r] += x;
      }
    value_ = value;
    error_ = error;
    rest_ = rest;
    count_ = 0;
  }

  Lanes value_{}, error_{}, rest_{};
  std::array<double, 128> waiting_;
  std::size_t count_ = 0;
  Sum* sum_;
};

}  // namespace tushar::data
