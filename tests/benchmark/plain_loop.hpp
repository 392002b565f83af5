#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace tushar::benchmark {

/// The gas method of Tran, Kim & Berzins on Sod's tube, in one dimension, without framework, patches or an order of
/// particles: an array for each variable, a loop for each equation. The cost of the framework is measured against this.
class PlainLoop {
 public:
  explicit PlainLoop(int cells)
      : n_(cells), h_(1.0 / cells), count_(cells), mean_(cells), pressure_(cells), delta_(cells) {
    for (int c = 0; c < cells; ++c) {
      const bool left = c < cells / 2;
      const int particles = left ? 8 : 1;
      for (int k = 0; k < particles; ++k) add((c + (k + 0.5) / particles) * h_, left ? 1 : 0.125, left ? 1 : 0.1);
    }
    for (auto* nodal : {&m_, &momentum_, &a_, &v1_}) nodal->resize(static_cast<std::size_t>(cells) + 1);
    bin();
  }

  /// Runs to t = 0.2 and returns the number of steps.
  int run() {
    const double end = 0.2;
    int steps = 0;
    for (double t = 0; t < end; ++steps) {
      const double dt = std::min(stableTimeStep(), end - t);
      interpolate();
      accelerate(dt);
      update(dt);
      bin();
      filter();
      press();
      t = t + dt >= end ? end : t + dt;
    }
    return steps;
  }
  const std::vector<double>& density() const { return rho_; }
  const std::vector<double>& position() const { return x_; }

 private:
  static constexpr double gamma = 1.4, cfl = 0.2125, quadratic = 0.6, linear = 2.75;

  void add(double x, double rho, double p) {
    x_.push_back(x);
    v_.push_back(0);
    rho_.push_back(rho);
    e_.push_back(p / ((gamma - 1) * rho));
    p_.push_back(p);
    d_.push_back(0);
    cell_.push_back(0);
  }

  double stableTimeStep() const {
    double fastest = 0;
    for (std::size_t p = 0; p < x_.size(); ++p)
      fastest = std::max(fastest, std::abs(v_[p]) + std::sqrt(gamma * (gamma - 1) * e_[p]));
    return cfl * h_ / fastest;
  }

  void interpolate() {
    std::fill(m_.begin(), m_.end(), 0.0);
    std::fill(momentum_.begin(), momentum_.end(), 0.0);
    std::fill(pressure_.begin(), pressure_.end(), 0.0);
    for (std::size_t p = 0; p < x_.size(); ++p) {
      const auto c = static_cast<std::size_t>(cell_[p]);
      const double s = x_[p] / h_ - cell_[p], mass = rho_[p] * h_ / count_[c];
      m_[c] += (1 - s) * mass;
      m_[c + 1] += s * mass;
      momentum_[c] += (1 - s) * mass * v_[p];
      momentum_[c + 1] += s * mass * v_[p];
      pressure_[c] += p_[p];
    }
    for (std::size_t c = 0; c < pressure_.size(); ++c) pressure_[c] /= std::max(count_[c], 1);
  }

  void accelerate(double dt) {
    const auto last = static_cast<std::size_t>(n_);
    for (std::size_t i = 1; i < last; ++i) {
      a_[i] = m_[i] > 0 ? (pressure_[i - 1] - pressure_[i]) / m_[i] : 0;
      v1_[i] = (m_[i] > 0 ? momentum_[i] / m_[i] : 0) + a_[i] * dt;
    }
    a_[0] = a_[last] = v1_[0] = v1_[last] = 0;
  }

  void update(double dt) {
    for (std::size_t p = 0; p < x_.size(); ++p) {
      const auto c = static_cast<std::size_t>(cell_[p]);
      const double s = x_[p] / h_ - cell_[p];
      const double d = (v1_[c + 1] - v1_[c]) / h_;
      v_[p] += dt * ((1 - s) * a_[c] + s * a_[c + 1]);
      x_[p] += dt * ((1 - s) * v1_[c] + s * v1_[c + 1]);
      e_[p] -= p_[p] / rho_[p] * d * dt;
      rho_[p] *= 1 - d * dt;
      d_[p] = d;
    }
  }

  void bin() {
    std::fill(count_.begin(), count_.end(), 0);
    for (std::size_t p = 0; p < x_.size(); ++p) {
      cell_[p] = std::min(static_cast<int>(x_[p] / h_), n_ - 1);
      ++count_[cell_[p]];
    }
  }

  void filter() {
    std::fill(mean_.begin(), mean_.end(), 0.0);
    for (std::size_t p = 0; p < x_.size(); ++p) mean_[cell_[p]] += rho_[p];
    for (std::size_t c = 0; c < mean_.size(); ++c) mean_[c] /= std::max(count_[c], 1);
    for (std::size_t c = 1; c + 1 < mean_.size(); ++c) {
      const double l = mean_[c - 1], m = mean_[c], r = mean_[c + 1];
      delta_[c] = l > 0 && r > 0 && (l - m) * (r - m) > 0 ? (l - 2 * m + r) / 3 : 0;
    }
    for (std::size_t p = 0; p < x_.size(); ++p) rho_[p] += delta_[cell_[p]];
  }

  void press() {
    for (std::size_t p = 0; p < x_.size(); ++p) {
      const double hd = std::min(d_[p], 0.0) * h_, c = std::sqrt(gamma * (gamma - 1) * e_[p]);
      p_[p] = (gamma - 1) * rho_[p] * e_[p] + rho_[p] * (quadratic * hd * hd - linear * c * hd);
    }
  }

  int n_;
  double h_;
  std::vector<int> count_, cell_;
  std::vector<double> mean_, pressure_, delta_;  // per cell
  std::vector<double> m_, momentum_, a_, v1_;    // per node
  std::vector<double> x_, v_, rho_, e_, p_, d_;  // per particle
};

}  // namespace tushar::benchmark
