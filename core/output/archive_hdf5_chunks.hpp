#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/output/pieces.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::output {

/// Extents along axes, the last axis fastest; a vector of HDF5's hsize_t.
using Extents = std::vector<unsigned long long>;

/// The shape of a dataset: the shape of its entries, followed by the number of components.
Extents fullShape(const std::vector<std::uint64_t>& shape, const Array& array);

/// Number of values in a dataset.
unsigned long long numbersOf(const Extents& shape);

/// The shape of a chunk, the unit in which a dataset is written and compressed: about a megabyte, complete along the
/// axes that vary fastest, so that its entries are contiguous.
Extents chunkOf(const Extents& shape);

/// The chunks of a dataset, in the order of their entries.
class Chunks {
 public:
  explicit Chunks(Extents shape);

  std::size_t count() const { return count_; }
  /// The index of the first number of a chunk.
  Extents corner(std::size_t chunk) const;
  /// The entries of a chunk; each has `components` numbers.
  Piece entries(std::size_t chunk, int components) const;

 private:
  /// Along each axis: total number of values, number of values in a chunk, number of chunks.
  Extents shape_, chunk_, along_;
  std::size_t count_ = 1;
};

/// The time and size of compression on one rank.
struct PackingUse {
  double bytes = 0, packed = 0;     ///< size of the values without and with compression [bytes]
  double packing = 0, writing = 0;  ///< time spent on compressing, and on writing the result [s]

  PackingUse& operator+=(const PackingUse& other);
};

/// A chunk as it is stored in a file.
struct PackedChunk {
  std::uint32_t skipped = 0;  ///< HDF5's mask of filters that were skipped because they would not have reduced the size
  std::vector<std::byte> bytes;
};

/// Packs chunks with HDF5's own filters, using a file in memory, into the bytes that HDF5 would write.
class ChunkPacker {
 public:
  /// Creates a packer with a gzip level.
  explicit ChunkPacker(int compression);
  ~ChunkPacker();
  ChunkPacker(const ChunkPacker&) = delete;
  ChunkPacker& operator=(const ChunkPacker&) = delete;

  /// Sets the type of values and the shape of the array for the following chunks.
  void begin(const Array::Values& type, const Extents& shape, bool asFloat);
  /// Packs one chunk. `entries` has as many numbers as a chunk, or fewer at the end of the dataset. Throws FileError.
  PackedChunk pack(std::span<const std::byte> entries);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tushar::output
