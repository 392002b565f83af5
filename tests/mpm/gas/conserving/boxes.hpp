#pragma once

#include <random>

#include "components/mpm/gas/conserving/cells.hpp"
#include "components/mpm/gas/conserving/redistribute.hpp"
#include "components/mpm/gas/conserving/transfer.hpp"
#include "components/mpm/gas/conserving/update_particles.hpp"
#include "tests/support/levels.hpp"
#include "tests/support/particles.hpp"

namespace tushar::mpm::gas::conserving {

/// A batch with one particle, in the first lane.
template <int D>
Batch<D> batchOfOne(const Index<D>& cell) {
  Lanes::Mask takes{};
  takes[0] = -1;
  return Batch<D>(cell, LaneIntegers{}, takes);
}

/// The footprint of a box, repeated in every lane.
template <int D>
Footprint<D> footprintOf(const Level& level, const Vec<D>& centre, const Vec<D>& edges) {
  return Footprint<D>(level, batchOfOne(level.cellOf<D>(centre)), centre.template cast<Lanes>(),
                      edges.template cast<Lanes>());
}

/// A grid with open sides.
inline grid::Domain freeDomain(const Index3& resolution) {
  grid::Domain domain = test::domain(resolution);
  for (auto& face : domain.boundaries.faces) face.clear();
  return domain;
}

/// A box of random size with random values, centred in every cell of a grid with open sides.
template <int D>
struct BoxCloud : test::Particles {
  std::vector<ParticleId> ids;
  std::vector<Vec<D>> x, edges, v;
  std::vector<Modes<D>> modes;
  std::vector<double> mass, energy, affine;
  Gas gas;

  explicit BoxCloud(const Index3& resolution) : Particles(freeDomain(resolution)) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    gas.name = "gas";
    set.reset(patch(), 2);
    forEach<D>(level.cells(), [&](const Index<D>& cell) {
      const int place = static_cast<int>(x.size());
      Vec<D> at = level.cellCentre<D>(cell), edge, speed;
      Modes<D> slopes;
      for (int d = 0; d < D; ++d) {
        at[d] += 0.4 * (uniform(generator) - 0.5) * level.spacing(d);
        edge[d] = (0.7 + 0.6 * uniform(generator)) * level.spacing(d);
        speed[d] = uniform(generator) - 0.5;
        for (int a = 0; a < slopes.cols(); ++a) slopes(d, a) = uniform(generator) - 0.5;
      }
      ids.push_back(static_cast<ParticleId>(place) << 16);
      x.push_back(at);
      edges.push_back(edge);
      v.push_back(speed);
      modes.push_back(slopes);
      mass.push_back(0.5 + uniform(generator));
      energy.push_back(1 + uniform(generator));
      affine.push_back(0.01 * uniform(generator));
      set.at(cell) = {place, place + 1};
    });
    set.setOwned(static_cast<int>(x.size()));
  }
  OldBoxes<D> boxes() const {
    return {.ids = read(ids),
            .x = read(x),
            .edges = read(edges),
            .mass = read(mass),
            .velocity = read(v),
            .modes = read(modes),
            .internalEnergy = read(energy),
            .affineEnergy = read(affine)};
  }
};

/// Values on the nodes or cells of a level, and views of these.
template <data::Centring C, class T>
struct GridValues {
  Box box;
  std::vector<T> values;

  explicit GridValues(const Level& level)
      : box(C == data::Centring::node ? level.nodes() : level.cells()), values(box.size()) {}
  data::GridView<C, T> write() { return {values.data(), box}; }
  data::GridView<C, const T> read() const { return {values.data(), box}; }
};
template <class T>
using NodeValues = GridValues<data::Centring::node, T>;
template <class T>
using CellValues = GridValues<data::Centring::cell, T>;

/// Total mass, momentum and energy.
template <int D>
struct Totals {
  double mass = 0, energy = 0;
  Vec<D> momentum = Vec<D>::Zero();

  Totals(const std::vector<double>& m, const std::vector<Vec<D>>& v, const std::vector<double>& e,
         const std::vector<double>& affine) {
    for (std::size_t p = 0; p < m.size(); ++p) {
      mass += m[p];
      momentum += m[p] * v[p];
      energy += m[p] * (0.5 * v[p].squaredNorm() + affine[p] + e[p]);
    }
  }
};

}  // namespace tushar::mpm::gas::conserving
