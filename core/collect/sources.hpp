#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/collect/collect.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::collect {

/// Entries that are consecutive on a patch and in the order of the whole grid.
struct Run {
  std::size_t place;                  ///< of the first in the order of the whole grid
  std::uint32_t patch, first, count;  ///< where that is among the parts and on its patch, and how many there are
};

/// Runs in the order of their places.
using Runs = std::vector<Run>;

/// The rows of the cells or nodes in an order that this rank's patches have.
Runs runsOfGrid(const grid::Grid& grid, const data::Label& label, const Parts& parts, const GridOrder& order);

/// Where a particle is: its patch among the parts, and its place there.
struct Place {
  std::uint32_t patch, index;
};

/// Where the particles with these ids are, in ascending order of the ids.
std::vector<Place> placesById(const Parts& ids);

/// How an entry of a variable is converted for an array: it stays as it is, or is widened to x, y, z.
class EntryForm {
 public:
  /// Entries of `bytes` bytes, which stay as they are.
  explicit EntryForm(std::size_t bytes) : bytes_(bytes) {}
  explicit EntryForm(const data::Label& label) : EntryForm(label.bytes) {}
  /// Vectors get 0 along the axes that the grid leaves out, and positions the middle of the domain.
  EntryForm(const data::Label& label, const grid::Level& level);

  std::size_t bytes() const { return bytes_; }  ///< of an entry of the variable
  std::size_t bytesOut() const { return axes_ == 0 ? bytes_ : sizeof(rest_); }
  /// Takes consecutive entries.
  void copy(const std::byte* from, std::size_t count, std::byte* to) const;
  /// Takes the entries at given places in patches.
  void gather(const std::vector<Part>& parts, std::span<const Place> places, std::byte* to) const;

 private:
  template <class EntryAt>
  void widen(const EntryAt& entryAt, std::size_t count, std::byte* to) const;

  std::size_t bytes_;
  int axes_ = 0;                ///< of the grid where entries are widened; else 0
  int axis_[2] = {0, 0};        ///< x, y or z for each of these
  double rest_[3] = {0, 0, 0};  ///< what x, y, z are along the others
};

/// Where the particles of this rank are, and their places in an order of those of all ranks.
struct ParticlePlaces {
  std::vector<Place> places;            ///< in the order
  std::vector<std::uint64_t> ranked{};  ///< place of each among those of all ranks; empty if there are no others
  std::size_t count = 0;                ///< on all ranks
};

/// The particles with these ids, in ascending order of the ids. Collective.
ParticlePlaces rankedById(const mpi::Communicator& ranks, const Parts& ids);

/// The entries in the order of runs; `entries` is their number on all ranks.
std::shared_ptr<const output::Source> sourceInRuns(std::shared_ptr<const Runs> runs, std::size_t entries, Parts parts,
                                                   const EntryForm& form);

/// The entries at these places.
std::shared_ptr<const output::Source> sourceAt(std::shared_ptr<const ParticlePlaces> places, Parts parts,
                                               const EntryForm& form);

}  // namespace tushar::collect
