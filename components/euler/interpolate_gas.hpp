#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "components/euler/children.hpp"
#include "components/euler/tasks/check_state.hpp"

namespace tushar::euler {

/// The interpolation between levels of one gas, and of quantities that it carries, which are stored times its density.
///
/// If density, momentum and energy, each interpolated by itself, give an impossible state in a finer cell, all finer
/// cells in its coarse cell get the state of the coarse cell. Carried quantities f per mass have limited slopes:
///
///     f_k = f + t (s_k - sum of rho_k s_k / sum of rho_k),   s_k = sum_d ± s_d / 4,
///
/// with the greatest t <= 1 such that all f_k are between the values of the cell and its neighbours. So rho f is
/// conserved, and f does not leave its range.
template <int D>
class GasInterpolation : public data::JointInterpolation {
 public:
  GasInterpolation(Gas gas, std::vector<const data::Label*> carried)
      : gas_(std::move(gas)), carried_(std::move(carried)) {}

  std::vector<data::VariableName> variables() const override {
    std::vector<data::VariableName> names{{&c::density, -1}, {&c::momentum<D>, -1}, {&c::totalEnergy, -1}};
    for (const data::Label* label : carried_) names.push_back({label, -1});
    return names;
  }
  void correct(const Box& parents, const std::vector<data::CellValues>& coarse,
               const std::vector<data::CellValues>& fine) const override {
    bool areAllFine = true;
    grid::forEachRow<3>(parents.refined(D),
                        [&](const Index3& first, int count) { areAllFine = areAllFine && canBe(first, count, fine); });
    if (areAllFine && coarse.size() == 3) return;
    grid::forEach<3>(parents, [&](const Index3& parent) {
      if (!areAllFine && !areFine(parent, fine)) flatten(parent, coarse, fine);
      for (std::size_t k = 3; k < coarse.size(); ++k) carry(parent, {coarse[0], coarse[k]}, {fine[0], fine[k]});
    });
  }

 private:
  using Children = ChildCells<D>;
  /// The density, and a carried quantity times it.
  struct Carried {
    data::CellValues density, held;
    double value(const Index3& cell) const { return valueIn<double>(held, cell) / valueIn<double>(density, cell); }
  };

  /// Whether the states of a row of finer cells are possible.
  bool canBe(const Index3& first, int count, const std::vector<data::CellValues>& fine) const {
    const auto* momentum = reinterpret_cast<const double*>(fine[1].values) + fine[1].stored.offset(first) * D;
    return euler::canBe<D>(gas_, &valueIn<double>(fine[0], first), momentum, &valueIn<double>(fine[2], first), count);
  }
  bool areFine(const Index3& parent, const std::vector<data::CellValues>& fine) const {
    constexpr int rows = Children::count / 2;  // the two children along x are beside one another in memory
    for (int row = 0; row < rows; ++row)
      if (!canBe(Children::at(parent, 2 * row), 2, fine)) return false;
    return true;
  }
  static void flatten(const Index3& parent, const std::vector<data::CellValues>& coarse,
                      const std::vector<data::CellValues>& fine) {
    for (int k = 0; k < Children::count; ++k) {
      const Index3 child = Children::at(parent, k);
      valueIn<double>(fine[0], child) = valueIn<double>(coarse[0], parent);
      valueIn<Vec<D>>(fine[1], child) = valueIn<Vec<D>>(coarse[1], parent);
      valueIn<double>(fine[2], child) = valueIn<double>(coarse[2], parent);
    }
  }
  static void carry(const Index3& parent, const Carried& coarse, const Carried& fine) {
    const double value = coarse.value(parent);
    std::array<double, D> quarters{};
    double least = 0, most = 0;
    for (int d = 0; d < D; ++d) {
      if (!hasNeighbours(coarse.held, parent, d)) continue;
      Index3 lower = parent, upper = parent;
      --lower[d], ++upper[d];
      const Differences differences{value - coarse.value(lower), coarse.value(upper) - value};
      quarters[d] = 0.25 * differences.slope();
      least = std::min({least, -differences.below, differences.above});
      most = std::max({most, -differences.below, differences.above});
    }
    std::array<double, Children::count> density{}, change{}, moved{};
    for (int k = 0; k < Children::count; ++k) {
      density[k] = valueIn<double>(fine.density, Children::at(parent, k));
      change[k] = Children::change(quarters, k);
      moved[k] = density[k] * change[k];
    }
    const double shift = Children::mean(moved) / Children::mean(density);
    double part = 1;
    for (double& one : change) {
      one -= shift;
      if (one > most) part = std::min(part, most / one);
      if (one < least) part = std::min(part, least / one);
    }
    for (int k = 0; k < Children::count; ++k)
      valueIn<double>(fine.held, Children::at(parent, k)) = density[k] * (value + part * change[k]);
  }

  Gas gas_;
  std::vector<const data::Label*> carried_;
};

}  // namespace tushar::euler
