#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/output/pieces.hpp"
#include "core/output/snapshot.hpp"

namespace tushar::output {

/// Extents along axes, the last fastest; HDF5's hsize_t.
using Extents = std::vector<unsigned long long>;

/// The shape of a dataset: that of its entries, and their components.
Extents fullShape(const std::vector<std::uint64_t>& shape, const Array& array);

/// How many numbers there are.
unsigned long long numbersOf(const Extents& shape);

/// The part of a dataset that is written at once, and compressed by itself: about a megabyte, whole along the axes that
/// vary fastest. So its entries follow one another.
Extents chunkOf(const Extents& shape);

/// The chunks of a dataset, in the order of their entries.
class Chunks {
 public:
  explicit Chunks(Extents shape);

  std::size_t count() const { return count_; }
  /// The index of the first number of a chunk.
  Extents corner(std::size_t chunk) const;
  /// Its entries, of so many numbers each.
  Piece entries(std::size_t chunk, int components) const;

 private:
  Extents shape_, chunk_, along_;  ///< along each axis: numbers, those of a chunk, chunks
  std::size_t count_ = 1;
};

/// A chunk as it is stored in a file.
struct PackedChunk {
  std::uint32_t skipped = 0;  ///< HDF5's mask of the filters that did not pay
  std::vector<std::byte> bytes;
};

/// Packs chunks by HDF5's own filters, in a file that is in memory alone: so they have the bytes that HDF5 would write.
class ChunkPacker {
 public:
  /// At a level of gzip.
  explicit ChunkPacker(int compression);
  ~ChunkPacker();
  ChunkPacker(const ChunkPacker&) = delete;
  ChunkPacker& operator=(const ChunkPacker&) = delete;

  /// The chunks that follow are of an array with values of this type, and of this shape.
  void begin(const Array::Values& type, const Extents& shape, bool asFloat);
  /// `entries` is as many numbers as a chunk has, or fewer for one at an end. Throws FileError.
  PackedChunk pack(std::span<const std::byte> entries);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tushar::output
