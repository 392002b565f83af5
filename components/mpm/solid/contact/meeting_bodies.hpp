#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "components/mpm/solid/transfer/node_record.hpp"
#include "core/core.hpp"
#include "core/data/touched_rows.hpp"

namespace tushar::mpm::solid {

/// The rows of nodes that the particles of each material touch.
using RowsOfNodes = std::vector<const data::TouchedRows*>;

/// The nodes of a patch at which more than one body has mass.
template <int D>
class MeetingPlaces {
 public:
  explicit MeetingPlaces(const Box& nodes) : box_(nodes), bodies_(nodes.size(), 0) {}

  /// Counts a body at the nodes of its rows where it has mass.
  template <class Record>
  void add(const data::TouchedRows& rows, const NodeView<Record>& record) {
    rows.forEachRow(box_, [&](Index3 node, int end) {
      const NodeRecord* at = record.values() + record.stored().offset(node);
      std::uint16_t* count = bodies_.data() + box_.offset(node);
      for (; node[0] < end; ++node[0], ++at, ++count)
        *count = static_cast<std::uint16_t>(*count + ((*at)[lane::mass] > 0));
    });
  }
  const Box& box() const { return box_; }
  /// The number of bodies at each node of the box.
  const std::vector<std::uint16_t>& counts() const { return bodies_; }
  /// Whether bodies meet at a node of a cell, or of the `layers` around it.
  bool areNear(const Index<D>& cell, int layers) const {
    Box near;
    for (int d = 0; d < 3; ++d) {
      near.lower[d] = d < D ? std::max(cell[d] - layers, box_.lower[d]) : box_.lower[d];
      near.upper[d] = d < D ? std::min(cell[d] + 2 + layers, box_.upper[d]) : box_.upper[d];
    }
    bool any = false;
    if (!near.empty())
      forEach<3>(near.rowStarts(), [&](const Index3& row) {
        const std::uint16_t* count = bodies_.data() + box_.offset(row);
        for (int k = 0; k < near.extent(0); ++k) any |= count[k] > 1;
      });
    return any;
  }
  /// Calls `visit(node)` for each of these nodes, given by three indices.
  template <class Visit>
  void forEachPlace(Visit&& visit) const {
    const std::uint16_t* count = bodies_.data();
    forEach<3>(box_, [&](const Index3& node) {
      if (*count++ > 1) visit(node);
    });
  }
  /// Calls `visit(node)` for each of these nodes in the rows, if `meet`, otherwise for each other node of the rows.
  template <class Visit>
  void forEachIn(const data::TouchedRows& rows, bool meet, Visit&& visit) const {
    rows.forEachRow(box_, [&](Index3 node, int end) {
      const std::uint16_t* count = bodies_.data() + box_.offset(node);
      for (; node[0] < end; ++node[0])
        if ((*count++ > 1) == meet) visit(node);
    });
  }

 private:
  Box box_;
  std::vector<std::uint16_t> bodies_;  ///< number of bodies at each node
};

/// The bodies that have mass at each node at which more than one has. Where hundreds of bodies share a patch, few meet
/// at any node, and tasks across materials need not ask all of them at every node.
template <int D>
class MeetingBodies {
 public:
  /// `bodies` are the indices, in ascending order, of materials in `rows` and `records`.
  template <class Record>
  MeetingBodies(const Box& nodes, const std::vector<std::size_t>& bodies, const RowsOfNodes& rows,
                const std::vector<NodeView<Record>>& records)
      : places_(nodes), begin_(1, 0) {
    for (const std::size_t m : bodies) places_.add(*rows[m], records[m]);
    const std::vector<std::uint16_t>& counts = places_.counts();
    std::vector<int> next(counts.size(), -1);  // for each node, the place of its next body
    for (std::size_t k = 0; k < counts.size(); ++k) {
      if (counts[k] <= 1) continue;
      next[k] = begin_.back();
      begin_.push_back(begin_.back() + counts[k]);
    }
    bodies_.resize(static_cast<std::size_t>(begin_.back()));
    for (const std::size_t m : bodies)
      rows[m]->forEachRow(nodes, [&](Index3 node, int end) {
        const NodeRecord* at = records[m].values() + records[m].stored().offset(node);
        int* place = next.data() + nodes.offset(node);
        for (; node[0] < end; ++node[0], ++at, ++place)
          if (*place >= 0 && (*at)[lane::mass] > 0) bodies_[static_cast<std::size_t>((*place)++)] = m;
      });
  }

  /// All materials of `records`, at the nodes of their views.
  template <class Record>
  MeetingBodies(const RowsOfNodes& rows, const std::vector<NodeView<Record>>& records)
      : MeetingBodies(records.front().box(), indices(records.size()), rows, records) {}

  /// Calls `visit(node, bodies)` for each of these nodes in lexicographic order, with the indices of its bodies in
  /// ascending order.
  template <class Visit>
  void forEachNode(Visit&& visit) const {
    std::size_t k = 0;
    places_.forEachPlace([&](const Index3& place) {
      Index<D> node;
      for (int d = 0; d < D; ++d) node[d] = place[d];
      const auto first = static_cast<std::size_t>(begin_[k]), count = static_cast<std::size_t>(begin_[k + 1]) - first;
      visit(std::as_const(node), std::span<const std::size_t>(bodies_.data() + first, count));
      ++k;
    });
  }

 private:
  static std::vector<std::size_t> indices(std::size_t count) {
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }

  MeetingPlaces<D> places_;
  std::vector<int> begin_;  ///< where the bodies of each of these nodes begin, and end
  std::vector<std::size_t> bodies_;
};

}  // namespace tushar::mpm::solid
