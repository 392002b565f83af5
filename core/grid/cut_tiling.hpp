#pragma once

#include "core/grid/morton_curve.hpp"
#include "core/grid/tiling.hpp"

namespace tushar::grid {

/// The patches of a grid of one level, divided by cuts along each axis. Needs no memory per patch.
class CutTiling : public Tiling {
 public:
  explicit CutTiling(MortonCurve::Cuts cuts) : curve_(std::move(cuts)) {}

  const MortonCurve& curve() const { return curve_; }

  int count() const override { return curve_.blocks(); }
  Tile tile(int id) const override { return {id, 0, curve_.cellsAt(curve_.blockAt(id))}; }
  Tile tileOf(int level, const Index3& cell) const override;
  std::vector<Tile> overlapping(int level, const Box& cells) const override;
  std::uint64_t cells() const override { return curve_.cells(); }
  std::uint64_t cellsBefore(int id) const override { return curve_.cellsBefore(id); }
  int patchAfter(std::uint64_t cells) const override { return curve_.placeAfter(cells); }

 private:
  MortonCurve curve_;
};

}  // namespace tushar::grid
