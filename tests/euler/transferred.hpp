#pragma once

#include <vector>

#include "core/data/joint_interpolation.hpp"
#include "core/grid/box.hpp"

namespace tushar::euler {

/// Values of several variables in a box of coarse cells, and in the finer cells of one of them.
template <int D>
struct Transferred {
  Box cells, finer;
  std::vector<std::vector<double>> coarse, fine;

  explicit Transferred(const std::vector<data::VariableName>& names) {
    for (int d = 0; d < 3; ++d) cells.lower[d] = d < D ? -1 : 0, cells.upper[d] = d < D ? 2 : 1;
    for (int d = 0; d < 3; ++d) finer.lower[d] = 0, finer.upper[d] = d < D ? 2 : 1;
    for (const data::VariableName& name : names) {
      coarse.emplace_back(cells.size() * name.label->components);
      fine.emplace_back(finer.size() * name.label->components);
    }
  }
  void correct(const data::JointInterpolation& how) {
    const Box parents{{}, Index3::filled(1)};
    how.correct(parents, valuesOf(coarse, cells), valuesOf(fine, finer));
  }
  static std::vector<data::CellValues> valuesOf(std::vector<std::vector<double>>& of, const Box& box) {
    std::vector<data::CellValues> values;
    for (std::vector<double>& one : of) values.push_back({reinterpret_cast<std::byte*>(one.data()), box});
    return values;
  }
  /// The place of the parent among the coarse cells.
  std::size_t parent() const { return cells.offset({}); }
};

inline double mean(const std::vector<double>& values, std::size_t components = 1, std::size_t component = 0) {
  double sum = 0;
  for (std::size_t k = component; k < values.size(); k += components) sum += values[k];
  return sum * static_cast<double>(components) / static_cast<double>(values.size());
}

}  // namespace tushar::euler
