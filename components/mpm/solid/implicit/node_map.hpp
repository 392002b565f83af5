#pragma once

#include <vector>

#include "core/core.hpp"

namespace tushar::mpm::solid {

/// Where nodes of a grid stand in a system of equations: only those that particles touch are in it. A node beyond a
/// symmetry plane moves as the mirror image of the one inside; one on a periodic face is that on the other side.
template <int D>
class NodeMap {
 public:
  /// A node of the system, and the sign with which it moves along each axis.
  struct Image {
    Index<D> node;
    Vec<D> sign = Vec<D>::Ones();
  };

  explicit NodeMap(const Level& level) : level_(&level), box_(level.nodes()), numbers_(box_.size(), -1) {}

  const Level& level() const { return *level_; }
  Image imageOf(Index<D> node) const {
    Image image{node};
    for (int d = 0; d < D; ++d) {
      const int cells = level_->cells().extent(d);
      int& at = image.node[d];
      if (level_->isPeriodic(d))
        at = (at % cells + cells) % cells;
      else if (at < 0 && level_->isSymmetry(d, 0))
        reflect(image, d, -at);
      else if (at > cells && level_->isSymmetry(d, 1))
        reflect(image, d, 2 * cells - at);
    }
    return image;
  }
  void touch(const Index<D>& node) { numbers_[place(node)] = 0; }
  /// Numbers all touched nodes in lexicographic order.
  void number() {
    for (std::size_t k = 0; k < numbers_.size(); ++k)
      if (numbers_[k] >= 0) numbers_[k] = count_++;
    nodes_.reserve(static_cast<std::size_t>(count_));
    forEach<D>(box_, [&](const Index<D>& node) {
      if ((*this)(node) >= 0) nodes_.push_back(node);
    });
  }

  int size() const { return count_; }
  /// The number of a node, -1 for one that is not in the system.
  int operator()(const Index<D>& node) const { return box_.contains(node) ? numbers_[place(node)] : -1; }
  const Index<D>& node(int number) const { return nodes_[static_cast<std::size_t>(number)]; }
  /// For each node: how many nodes of the system are at most `width` away from it along every axis.
  std::vector<int> neighbours(int width) const {
    std::vector<int> counts;
    for (const Index<D>& node : nodes_) {
      Box around{{}, Index3::filled(1)};
      for (int d = 0; d < D; ++d) {
        around.lower[d] = node[d] - width;
        around.upper[d] = node[d] + width + 1;
      }
      int count = 0;
      forEach<D>(around, [&](const Index<D>& other) { count += (*this)(imageOf(other).node) >= 0; });
      counts.push_back(count);
    }
    return counts;
  }
  /// Position of a node, m.
  Vec<D> position(int number) const {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = level_->nodePosition(d, node(number)[d]);
    return x;
  }

 private:
  static void reflect(Image& image, int d, int at) {
    image.node[d] = at;
    image.sign[d] = -1;
  }
  std::size_t place(const Index<D>& node) const {
    Index3 wide{};
    for (int d = 0; d < D; ++d) wide[d] = node[d];
    return box_.offset(wide);
  }

  const Level* level_;
  Box box_;
  std::vector<int> numbers_;
  std::vector<Index<D>> nodes_;
  int count_ = 0;
};

}  // namespace tushar::mpm::solid
