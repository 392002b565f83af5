#pragma once

#include <compare>
#include <limits>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/data/reduction.hpp"

namespace tushar::tasks {

/// Describes how and where the run of a graph stopped early: the first failing task in the order of the graph, over all
/// ranks. It is sent in messages byte by byte.
///
/// A task that shortens the time step takes precedence over one that violates a bound, because the results of a
/// shortened step are not used.
struct Outcome {
  /// The ways in which a task can stop a run. If there are several, the first in this order is reported, so that the
  /// report does not depend on patches and ranks. Among exceptions of bodies, the lowest cell comes first; among
  /// violated bounds, the first variable of the task.
  enum class Kind { shortensStep, throws, breaks };
  static constexpr int none = std::numeric_limits<int>::max();

  int task = none;  ///< index of the task in the graph
  Kind kind = Kind::shortensStep;
  int material = 0;
  std::uint64_t place = 0;  ///< position of the cell, or index of the variable
  int rank = 0;
  data::Minimum factor{};  ///< factor by which the time step must be shortened
  data::Reason value{};    ///< name of the invalid value, or of the task

  bool isNone() const { return task == none; }
  void merge(const Outcome& other);
};

/// Sends the error of rank `from` to all ranks, and returns it on every rank. Collective.
NumericalError broadcastError(const mpi::Communicator& ranks, const std::optional<NumericalError>& mine, int from);

}  // namespace tushar::tasks
