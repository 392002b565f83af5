#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/tasks/ghost_plan.hpp"
#include "core/tasks/near_rows.hpp"
#include "core/tasks/transfer.hpp"

namespace tushar::tasks {

/// One ghost fill of a variable, which is given by its index.
struct BoundGhostFill {
  int variable;
  data::Generation generation;
  data::Generation set;  ///< the particle set to which the values belong or, on nodes, from which they were computed
  bool particles;
};

/// Calls `visit(first, length)` for each row of a box along the first axis; `length` is its size [bytes].
template <class Visit>
void forEachRowOf(const grid::Box& box, std::size_t bytes, Visit&& visit) {
  const std::size_t length = static_cast<std::size_t>(box.extent(0)) * bytes;
  grid::forEach<3>(box.rowStarts(), [&](const Index3& first) { visit(first, length); });
}

/// The address of the value of a cell or node.
template <class Values>
std::byte* valueAt(const Values& values, const Index3& place, std::size_t bytes) {
  return values.values + values.stored.offset(place) * bytes;
}

/// Computes the values of a copy if they differ from those of `copy.from`: means of finer cells, or values of coarser
/// cells at a time within their step, old + part (new - old), limited to the range between old and new. Writes them to
/// `values` one after the other. Returns false, and computes nothing, if the values of `copy.from` are to be copied
/// unchanged.
bool computeValues(data::Warehouse& warehouse, const BoundGhostFill& fill, const GhostCopy& copy, double part,
                   mpi::Bytes& values);

/// Appends to a message the values that another rank receives for one ghost fill.
class Packer {
 public:
  /// `part` is the elapsed fraction of the step of coarser cells.
  Packer(data::Warehouse& warehouse, const BoundGhostFill& fill, double part, mpi::Bytes& message)
      : warehouse_(warehouse), fill_(fill), name_(warehouse.table()[fill.variable]), part_(part), message_(message) {}

  void addGrid(const GhostCopy& copy);
  /// Packs only rows of nodes near particles: the number of rows, and the position, length and values of each.
  void addNear(const GhostCopy& copy, const data::TouchedRows& rows);
  /// Packs the numbers of particles: the number of cells that contain any, and the position and number of particles of
  /// each.
  void addCounts(const GhostCopy& copy);
  void addParticles(const GhostCopy& copy);

 private:
  data::Variable variable(int patch) { return warehouse_.variable(fill_.generation, fill_.variable, patch); }
  template <class Visit>
  void forEachCell(const GhostCopy& copy, Visit&& visit);

  data::Warehouse& warehouse_;
  const BoundGhostFill& fill_;
  const data::VariableName name_;
  double part_;
  mpi::Bytes& message_;
};

/// The messages of other ranks, read from front to back.
class ReceivedMessages {
 public:
  void add(int from, mpi::Bytes bytes) { messages_[from] = {std::move(bytes), 0}; }
  /// The next `length` bytes of the message from a rank.
  const std::byte* next(int from, std::size_t length);
  /// The cells packed by addCounts, with the indices of their particles among those of the copy.
  std::vector<std::pair<Index3, data::ParticleRange>> takeCounts(const GhostCopy& copy);
  /// Whether a rank has stopped, according to its message.
  bool readStopped(int from) { return *next(from, 1) != std::byte{0}; }
  /// Copies the values packed by addGrid or addNear, of `bytes` bytes each, to their positions.
  void takeGrid(const GhostCopy& copy, std::size_t bytes, const CellValues& to);
  void takeNear(const GhostCopy& copy, std::size_t bytes, const CellValues& to);

 private:
  template <class T>
  T nextNumber(int from);

  struct Message {
    mpi::Bytes bytes;
    std::size_t read = 0;
  };
  std::map<int, Message> messages_;
};

}  // namespace tushar::tasks
