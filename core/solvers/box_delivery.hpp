#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/mpi_together.hpp"
#include "core/solvers/box_solve.hpp"

namespace tushar::solvers {

/// Consecutive cells of a box along its first axis.
struct BoxCells {
  std::array<int, 3> first;  ///< the place of the first one in the box
  int count;
};

/// Brings the equations of a box from the ranks that have its cells, row by row, to those that have its slabs, and the
/// solution back. All ranks of a communicator call its functions together; its first ones have the slabs.
class BoxDelivery {
 public:
  /// `rows` are the cells of this rank, `axes` the axes with links, and `borders` those of BoxSlabs.
  BoxDelivery(const mpi::Communicator& ranks, std::vector<int> borders, std::vector<int> axes,
              std::vector<BoxCells> rows);

  /// Where the numbers of the cells of a row are written: those of BoxRow, and the initial guess.
  struct Numbers {
    double *diagonal, *right, *guess, *links;  ///< links: those of all cells along the first of `axes`, then others
  };
  Numbers numbersOf(std::size_t row);
  /// Sends the rows, and fills the system of this rank; null on ranks without a slab.
  void deliver(BoxSystem* system);
  /// Sends the solutions of cells that deliver() has received, and returns those of the cells of this rank, row by row.
  std::vector<double> fetch(const BoxSystem* system);

 private:
  /// The rows that come from a rank.
  struct Received {
    int from;
    std::vector<BoxCells> rows;
  };
  int ownerOf(const BoxCells& row) const;
  void take(int from, const mpi::Bytes& bytes, BoxSystem& system);

  const mpi::Communicator& ranks_;
  std::vector<int> borders_;
  std::vector<int> axes_;
  std::vector<BoxCells> rows_;
  std::vector<std::vector<std::size_t>> of_;  ///< for each rank with a slab, the rows that it gets
  std::vector<std::size_t> places_;           ///< where the numbers of each row begin in the letter
  std::vector<mpi::Bytes> letters_;           ///< to each rank with a slab
  std::vector<Received> received_;
  mpi::Outbox outbox_;
};

/// Returns the outcome of the first rank on all ranks.
std::optional<Outcome> broadcast(const mpi::Communicator& ranks, const std::optional<Outcome>& outcome);

}  // namespace tushar::solvers
