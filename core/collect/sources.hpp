#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/collect/collect.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::collect {

/// Entries that are consecutive both on a patch and in the order of the whole grid.
struct Run {
  std::size_t place;                  ///< place of the first entry in the order of the whole grid
  std::uint32_t patch, first, count;  ///< index of its part, index on the patch, and number of entries
};

/// Runs in the order of their places.
using Runs = std::vector<Run>;

/// The runs of an order of cells or nodes that this rank's patches have.
Runs runsOfGrid(const grid::Grid& grid, const data::Label& label, const Parts& parts, const GridOrder& order);

/// The location of a particle: the index of its part, and its index there.
struct Place {
  std::uint32_t patch, index;
};

/// Where the particles with these ids are, in ascending order of the ids.
std::vector<Place> placesById(const Parts& ids);

/// The conversion of entries of a variable for an array: they are unchanged, or extended to x, y, z.
class EntryForm {
 public:
  /// Entries of `bytes` bytes, which are not changed.
  explicit EntryForm(std::size_t bytes) : bytes_(bytes) {}
  explicit EntryForm(const data::Label& label) : EntryForm(label.bytes) {}
  /// Vectors get 0 along the axes that the grid does not use, and positions the middle of the domain.
  EntryForm(const data::Label& label, const grid::Level& level);

  std::size_t bytes() const { return bytes_; }  ///< Size of an entry of the variable.
  std::size_t bytesOut() const { return axes_ == 0 ? bytes_ : sizeof(rest_); }
  /// Converts consecutive entries.
  void copy(const std::byte* from, std::size_t count, std::byte* to) const;
  /// Converts the entries at given places in patches.
  void gather(const std::vector<Part>& parts, std::span<const Place> places, std::byte* to) const;

 private:
  template <class EntryAt>
  void widen(const EntryAt& entryAt, std::size_t count, std::byte* to) const;

  std::size_t bytes_;
  int axes_ = 0;                ///< number of kernel axes if entries are extended, otherwise 0
  int axis_[2] = {0, 0};        ///< the axis x, y or z of each
  double rest_[3] = {0, 0, 0};  ///< values along the unused axes
};

/// The locations of this rank's particles, and their places in an order of all ranks' particles.
struct ParticlePlaces {
  std::vector<Place> places;            ///< in that order
  std::vector<std::uint64_t> ranked{};  ///< place of each among the particles of all ranks; empty for a single rank
  std::size_t count = 0;                ///< number of particles on all ranks
};

/// The particles with these ids, in ascending order, with their places among those of all ranks. Collective.
ParticlePlaces rankedById(const mpi::Communicator& ranks, const Parts& ids);

/// A source of the entries in the order of runs; `entries` is their number on all ranks.
std::shared_ptr<const output::Source> sourceInRuns(std::shared_ptr<const Runs> runs, std::size_t entries, Parts parts,
                                                   const EntryForm& form);

/// A source of the entries at these places.
std::shared_ptr<const output::Source> sourceAt(std::shared_ptr<const ParticlePlaces> places, Parts parts,
                                               const EntryForm& form);

}  // namespace tushar::collect
