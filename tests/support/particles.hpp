#pragma once

#include <vector>

#include "core/core.hpp"

namespace tushar::test {

/// The particles of a grid of one patch, with views of their values.
struct Particles {
  Grid grid;
  const Level& level = grid.level();
  data::ParticleSet set;

  explicit Particles(const grid::Domain& domain) : grid(domain) {}
  const Patch& patch() const { return grid.patches().front(); }
  template <class T>
  ParticleView<const T> read(const std::vector<T>& values) const {
    return {values.data(), set, level.cells()};
  }
  /// One value for each particle.
  template <class T>
  ParticleView<T> write(std::vector<T>& values) const {
    values.resize(set.owned());
    return {values.data(), set, level.cells()};
  }
};

}  // namespace tushar::test
