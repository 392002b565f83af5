#pragma once

#include <utility>
#include <vector>

#include "components/mpm/solid/constitutive/model.hpp"
#include "core/data/particle_set.hpp"

namespace tushar::mpm::solid {

/// Cells whose particles are contiguous in memory: constitutive models process the particles of several cells together,
/// up to stressGroup, or all those of one cell.
template <int D>
class CellRun {
 public:
  int first() const { return cells_.front().second.first; }
  int count() const { return cells_.empty() ? 0 : cells_.back().second.last - first(); }
  /// Whether the particles of another cell can be added to the run.
  bool takes(const data::ParticleRange& range) const {
    return cells_.empty() || (range.first == cells_.back().second.last && count() + range.size() <= stressGroup);
  }
  void add(const Index<D>& cell, const data::ParticleRange& range) { cells_.emplace_back(cell, range); }
  void clear() { cells_.clear(); }
  /// Calls `visit(cell, range)` for each cell.
  template <class Visit>
  void forEachCell(Visit&& visit) const {
    for (const auto& [cell, range] : cells_) visit(cell, range);
  }
  /// Calls `visit(k, count)` for each group of up to stressGroup particles; a group starts with the k-th particle of
  /// the run.
  template <class Visit>
  void forEachGroup(Visit&& visit) const {
    for (int k = 0; k < count(); k += stressGroup) visit(k, std::min(stressGroup, count() - k));
  }

 private:
  std::vector<std::pair<Index<D>, data::ParticleRange>> cells_;
};

}  // namespace tushar::mpm::solid
