#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/core.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::mpm::solid::implicit {

/// Indices of grid nodes in a system of equations, which contains only the nodes near particles. A node beyond a
/// symmetry plane moves as the mirror image of the one inside; a node on a periodic face is the same node as the one on
/// the opposite face.
///
/// The rank that owns the cell above a node owns the node. A rank numbers its own nodes first, then those of other
/// ranks that its particles touch or that lie near its patches.
template <int D>
class NodeMap {
 public:
  /// A node of the system, and the sign with which it moves along each axis.
  struct Image {
    Index<D> node;
    Vec<D> sign = Vec<D>::Ones();
  };

  explicit NodeMap(const Level& level, const mpi::Communicator& ranks = mpi::Communicator::alone())
      : level_(&level), ranks_(&ranks), box_(level.nodes()), known_(box_.size(), 0), numbers_(box_.size(), -1) {}

  const Level& level() const { return *level_; }
  const mpi::Communicator& ranks() const { return *ranks_; }
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
  void touch(const Index<D>& node) { known_[place(node)] = isTouched | isNear; }
  /// Numbers all nodes that any rank has marked as touched; this rank stores those within `reach` of its patches.
  void number(const RankPatches& patches, int reach) {
    for (const Patch* patch : patches)
      forEach<D>(patch->nodesWithin(reach), [&](const Index<D>& node) {
        const Index<D> inside = imageOf(node).node;
        if (box_.contains(inside)) known_[place(inside)] |= isNear;
      });
    shareTouched();
    numberOwners();
  }

  /// Number of nodes that this rank stores.
  int size() const { return static_cast<int>(nodes_.size()); }
  int owned() const { return owned_; }
  /// The index of a node; -1 if this rank does not store the node.
  int operator()(const Index<D>& node) const { return box_.contains(node) ? numbers_[place(node)] : -1; }
  const Index<D>& node(int number) const { return nodes_[number]; }
  /// The unknowns, with `block` numbers for each node.
  solvers::Unknowns unknowns(int block) const {
    solvers::Unknowns unknowns;
    unknowns.ranks = ranks_;
    unknowns.axes = D;
    unknowns.block = block;
    unknowns.owned = owned_;
    unknowns.ghosts = ghosts_;
    return unknowns;
  }
  /// For each owned node, the number of nodes of the system that are at most `width` away from it along every axis.
  std::vector<int> neighbours(int width) const {
    std::vector<int> counts;
    for (int k = 0; k < owned_; ++k) {
      Box around{{}, Index3::filled(1)};
      for (int d = 0; d < D; ++d) {
        around.lower[d] = node(k)[d] - width;
        around.upper[d] = node(k)[d] + width + 1;
      }
      int count = 0;
      forEach<D>(around, [&](const Index<D>& other) {
        const Index<D> inside = imageOf(other).node;
        count += box_.contains(inside) && (known_[place(inside)] & isTouched) != 0;
      });
      counts.push_back(count);
    }
    return counts;
  }
  /// Position of a node [m].
  Vec<D> position(int number) const {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = level_->nodePosition(d, node(number)[d]);
    return x;
  }

 private:
  static constexpr unsigned char isTouched = 1, isNear = 2;

  static void reflect(Image& image, int d, int at) {
    image.node[d] = at;
    image.sign[d] = -1;
  }
  std::size_t place(const Index<D>& node) const {
    Index3 wide{};
    for (int d = 0; d < D; ++d) wide[d] = node[d];
    return box_.offset(wide);
  }
  /// Sends the nodes that any rank has marked as touched to all ranks.
  void shareTouched() {
    std::vector<unsigned char> touched(known_);
    ranks_->merge(std::as_writable_bytes(std::span(touched)), [&](const std::byte* from, std::byte* into) {
      for (std::size_t k = 0; k < known_.size(); ++k) into[k] |= from[k];
    });
    for (std::size_t k = 0; k < known_.size(); ++k) known_[k] = (known_[k] & isNear) | (touched[k] & isTouched);
  }
  int ownerOf(const Index<D>& node) const {
    if (ranks_->isAlone()) return level_->grid().share().rank;
    Index3 cell{};
    for (int d = 0; d < D; ++d) cell[d] = std::clamp(node[d], 0, level_->cells().extent(d) - 1);
    return level_->grid().ownerOf(level_->grid().patchOf(cell, level_->number()).id());
  }
  /// Numbers the rank's own nodes, followed by the ghosts, each in lexicographic order.
  void numberOwners() {
    const int mine = level_->grid().share().rank;
    std::vector<int> counts(level_->grid().share().ranks + 1, 0), ownerOfGhost;
    std::vector<Index<D>> ghosts;
    forEach<D>(box_, [&](const Index<D>& node) {
      if ((known_[place(node)] & isTouched) == 0) return;
      const int owner = ownerOf(node), among = counts[owner + 1]++;
      if (owner == mine) {
        numbers_[place(node)] = among;
        nodes_.push_back(node);
      } else if ((known_[place(node)] & isNear) != 0) {
        ghosts.push_back(node);
        ghosts_.push_back(among);
        ownerOfGhost.push_back(owner);
      }
    });
    owned_ = static_cast<int>(nodes_.size());
    std::partial_sum(counts.begin(), counts.end(), counts.begin());
    for (std::size_t k = 0; k < ghosts.size(); ++k) {
      numbers_[place(ghosts[k])] = owned_ + static_cast<int>(k);
      ghosts_[k] += counts[ownerOfGhost[k]];
      nodes_.push_back(ghosts[k]);
    }
  }

  const Level* level_;
  const mpi::Communicator* ranks_;
  Box box_;
  std::vector<unsigned char> known_;
  std::vector<int> numbers_, ghosts_;
  std::vector<Index<D>> nodes_;
  int owned_ = 0;
};

}  // namespace tushar::mpm::solid::implicit
