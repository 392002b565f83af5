#include "components/mpm/solid/grains/clusters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tushar::mpm::solid {

namespace {

/// Sets of boxes, each a tree whose root is its first box.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  int rootOf(int k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void unite(int a, int b) {
    a = rootOf(a);
    b = rootOf(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

bool overlap(const GrainBox& a, const GrainBox& b, const GrainSpace& space) {
  for (int d = 0; d < space.dimension; ++d) {
    double apart = std::abs(a.centre[d] - b.centre[d]);
    if (space.period[d] > 0) apart = std::min(apart, std::abs(space.period[d] - apart));
    if (!(apart <= a.half[d] + b.half[d])) return false;
  }
  return true;
}

/// Bins of boxes, at least as wide as the widest box, so that boxes that overlap are in the same bin or in two that
/// are next to each other.
class Bins {
 public:
  Bins(std::span<const GrainBox> boxes, const GrainSpace& space) : boxes_(boxes), space_(space) {
    for (int d = 0; d < space.dimension; ++d) measure(d);
    while (count() > static_cast<double>(4 * boxes.size() + 64)) {
      const int d = static_cast<int>(std::max_element(bins_.begin(), bins_.end()) - bins_.begin());
      bins_[d] = (bins_[d] + 1) / 2;
    }
    first_.assign(static_cast<std::size_t>(count()), -1);
    next_.assign(boxes.size(), -1);
    for (int k = static_cast<int>(boxes.size()); k-- > 0;) {
      int& link = first_[number(binOf(boxes[k]))];
      next_[k] = std::exchange(link, k);
    }
  }

  /// Calls `visit(j)` for each box j after box k that is in its bin or in one next to it.
  template <class Visit>
  void forEachNear(int k, Visit&& visit) const {
    const Index3 at = binOf(boxes_[k]);
    Box around{{}, Index3::filled(1)};
    forEach<3>(around.grown(1, space_.dimension), [&](const Index3& shift) {
      Index3 bin = at + shift;
      for (int d = 0; d < 3; ++d) {
        if (space_.period[d] > 0 && bins_[d] > 1) bin[d] = (bin[d] + bins_[d]) % bins_[d];
        if (bin[d] < 0 || bin[d] >= bins_[d]) return;
      }
      for (int j = first_[number(bin)]; j >= 0; j = next_[j])
        if (j > k) visit(j);
    });
  }

 private:
  /// Finds the extent of the boxes along an axis, and the number of bins.
  void measure(int d) {
    double lower = boxes_[0].centre[d], upper = lower, widest = 0;
    for (const GrainBox& box : boxes_) {
      lower = std::min(lower, box.centre[d]);
      upper = std::max(upper, box.centre[d]);
      widest = std::max(widest, 2 * box.half[d]);
    }
    lower_[d] = lower;
    extent_[d] = space_.period[d] > 0 ? space_.period[d] : upper - lower;
    const double most = widest > 0 ? std::floor(extent_[d] / (widest * (1 + 1e-9))) : 1;
    bins_[d] = static_cast<int>(std::clamp(most, 1.0, 1e6));
  }
  double count() const { return static_cast<double>(bins_[0]) * bins_[1] * bins_[2]; }
  Index3 binOf(const GrainBox& box) const {
    Index3 bin;
    for (int d = 0; d < space_.dimension; ++d) {
      const double part = extent_[d] > 0 ? (box.centre[d] - lower_[d]) / extent_[d] : 0.0;
      bin[d] = std::clamp(static_cast<int>(part * bins_[d]), 0, bins_[d] - 1);
    }
    return bin;
  }
  std::size_t number(const Index3& bin) const {
    return (static_cast<std::size_t>(bin[2]) * bins_[1] + bin[1]) * bins_[0] + bin[0];
  }

  std::span<const GrainBox> boxes_;
  GrainSpace space_;
  std::array<int, 3> bins_{1, 1, 1};
  std::array<double, 3> lower_{}, extent_{};
  std::vector<int> first_, next_;  ///< the first box of each bin, and the next one after each box; -1: none
};

/// The particles of one type in a cluster.
struct Part {
  int type = 0;
  int cluster = 0;                          ///< index of the first box of its cluster
  std::vector<std::pair<int, int>> counts;  ///< its materials, and the number of its particles in each
  bool touches = false;                     ///< whether its cluster has particles of other types
  int next = -1;                            ///< the material to which it belongs from now on

  void add(int material) {
    for (auto& [known, count] : counts)
      if (known == material) {
        ++count;
        return;
      }
    counts.emplace_back(material, 1);
  }
};

/// The parts of all clusters, in the order of their first boxes.
struct Parts {
  std::vector<Part> all;
  std::vector<int> of;  ///< for each box, the index of its part

  Parts(std::span<const GrainBox> boxes, const std::vector<int>& clusters) {
    std::vector<int> latest(boxes.size(), -1);  // for each cluster, its latest part
    std::vector<int> parts(boxes.size(), 0);    // and the number of its parts
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const int cluster = clusters[k];
      if (latest[cluster] < 0 || all[latest[cluster]].type != boxes[k].type) {  // as boxes are sorted by type
        latest[cluster] = static_cast<int>(all.size());
        all.push_back({boxes[k].type, cluster, {}});
        ++parts[cluster];
      }
      all[latest[cluster]].add(boxes[k].material);
      of.push_back(latest[cluster]);
    }
    for (Part& part : all) part.touches = parts[part.cluster] > 1;
  }

  /// Lets each material that has the contacts that a part needs be kept by the part with the most of its particles,
  /// and each part keep the material in which it has the most.
  void keepMaterials(const std::vector<Grain>& materials) {
    std::vector<std::pair<int, int>> heir(materials.size(), {-1, 0});  // for each material, its part, and its particles
    for (int k = 0; k < static_cast<int>(all.size()); ++k)
      for (const auto& [material, count] : all[k].counts)
        if (materials[material].hasContact == all[k].touches && count > heir[material].second)
          heir[material] = {k, count};
    for (int k = 0; k < static_cast<int>(all.size()); ++k) {
      int most = 0;
      for (const auto& [material, count] : all[k].counts) {
        if (heir[material].first != k || count < most || (count == most && material > all[k].next)) continue;
        all[k].next = material;
        most = count;
      }
    }
  }
};

void refuseEqualIds(std::span<const GrainBox> boxes) {
  for (std::size_t k = 1; k < boxes.size(); ++k)
    if (!(boxes[k - 1] < boxes[k]))
      throw NumericalError(fmt::format("two particles of MatTypeIdx {} have the id {}: their bodies have too many "
                                       "particles in one cell",
                                       boxes[k].type, boxes[k].id),
                           "a smaller <res>, or bodies of one material");
}

}  // namespace

std::vector<int> clustersOf(std::span<const GrainBox> boxes, const GrainSpace& space) {
  std::vector<int> first;
  if (boxes.empty()) return first;
  const Bins bins(boxes, space);
  Sets sets(boxes.size());
  for (int k = 0; k < static_cast<int>(boxes.size()); ++k)
    bins.forEachNear(k, [&](int j) {
      if (overlap(boxes[k], boxes[j], space)) sets.unite(k, j);
    });
  for (int k = 0; k < static_cast<int>(boxes.size()); ++k) first.push_back(sets.rootOf(k));
  return first;
}

std::vector<int> materialsOfClusters(std::span<const GrainBox> boxes, const std::vector<int>& clusters,
                                     const std::vector<Grain>& materials) {
  refuseEqualIds(boxes);
  Parts parts(boxes, clusters);
  parts.keepMaterials(materials);
  std::vector<char> isUsed(materials.size(), 0);
  for (const GrainBox& box : boxes) isUsed[box.material] = 1;
  std::vector<int> moved;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    Part& part = parts.all[parts.of[k]];
    if (!materials[boxes[k].material].maySplit) {
      moved.push_back(boxes[k].material);
      continue;
    }
    for (std::size_t m = 0; m < materials.size() && part.next < 0; ++m) {
      const bool fits = materials[m].type == part.type && materials[m].hasContact == part.touches;
      if (fits && materials[m].maySplit && !isUsed[m]) part.next = static_cast<int>(m);
    }
    if (part.next < 0)
      throw NumericalError(fmt::format("there are more clusters of particles than materials with MatTypeIdx {}, "
                                       "<applied_contact_model> {} and no particles",
                                       part.type, part.touches),
                           "more such materials in <MaterialProperties>");
    isUsed[part.next] = 1;
    moved.push_back(part.next);
  }
  return moved;
}

}  // namespace tushar::mpm::solid
