#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/collect/collect.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::collect {

/// Entries that are consecutive both in the memory of a patch and in the order of the whole grid.
struct Run {
  std::size_t place;  ///< position of the first entry in the order of the whole grid
  /// Index of the part, index of the first entry on the patch, and number of entries.
  std::uint32_t patch, first, count;
};

/// Runs, sorted by position.
using Runs = std::vector<Run>;

/// The runs of the cells or nodes of this rank's patches in a given order.
Runs runsOfGrid(const grid::Grid& grid, const data::Label& label, const Parts& parts, const GridOrder& order);

/// The memory location of a particle: the index of its part, and its index there.
struct Place {
  std::uint32_t patch, index;
};

/// The memory locations of the particles with these ids, sorted by id; of particles with the same id, one.
std::vector<Place> placesById(const Parts& ids);

/// How entries of a variable are converted for an array: unchanged, or extended to x, y, z.
class EntryForm {
 public:
  /// Entries of `bytes` bytes that are not changed.
  explicit EntryForm(std::size_t bytes) : bytes_(bytes) {}
  explicit EntryForm(const data::Label& label) : EntryForm(label.bytes) {}
  /// Vectors become 0 along the axes that the grid does not use; positions become the middle of the domain there.
  EntryForm(const data::Label& label, const grid::Level& level);

  std::size_t bytes() const { return bytes_; }  ///< Size of an entry of the variable [bytes].
  std::size_t bytesOut() const { return axes_ == 0 ? bytes_ : sizeof(rest_); }
  /// Converts consecutive entries.
  void copy(const std::byte* from, std::size_t count, std::byte* to) const;
  /// Converts the entries at the given locations in patches.
  void gather(const std::vector<Part>& parts, std::span<const Place> places, std::byte* to) const;

 private:
  template <class EntryAt>
  void widen(const EntryAt& entryAt, std::size_t count, std::byte* to) const;

  std::size_t bytes_;
  int axes_ = 0;                ///< number of kernel axes if entries are extended, otherwise 0
  int axis_[2] = {0, 0};        ///< the axis (x, y or z) that corresponds to each kernel axis
  double rest_[3] = {0, 0, 0};  ///< values along the unused axes
};

/// The memory locations of this rank's particles, and their positions in an order of the particles of all ranks.
struct ParticlePlaces {
  std::vector<Place> places;  ///< memory locations, in that order
  /// Position of each particle among the particles of all ranks; empty on a single rank.
  std::vector<std::uint64_t> ranked{};
  std::size_t count = 0;  ///< number of particles on all ranks
};

/// The particles with these ids, sorted by id, with their positions among those of all ranks. Throws TaskError if ids
/// repeat, on any ranks. Collective.
ParticlePlaces rankedById(const mpi::Communicator& ranks, const Parts& ids);

/// A source that provides entries in the order of the runs; `entries` is the number of entries on all ranks.
std::shared_ptr<const output::Source> sourceInRuns(std::shared_ptr<const Runs> runs, std::size_t entries, Parts parts,
                                                   const EntryForm& form);

/// A source that provides the entries at these locations.
std::shared_ptr<const output::Source> sourceAt(std::shared_ptr<const ParticlePlaces> places, Parts parts,
                                               const EntryForm& form);

}  // namespace tushar::collect
